#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/measured/signs.hpp"

#include <cmath>

namespace space::ch02 {

/// Small volumes of large whole numbers: what they are, and what double makes of them.
Svg fig_02_04(const Options& options) {
    constexpr double half = 230, reach = 50;  // of the square on the paper, and in volumes
    const Point2 zero = at(320, half + 40);
    const auto place = [&](double exact, double computed) {
        return moved(zero, half / reach * exact, -half / reach * computed);
    };
    Svg svg(
        "Exact volumes against those that double computes: a band along the diagonal, in which "
        "signs are lost near zero",
        640, 2 * half + 84);
    svg.rect(place(-reach, reach), at(half, half),
             {.stroke = {}, .fill = Ink::faint, .opacity = 0.6});
    svg.rect(place(0, 0), at(half, half), {.stroke = {}, .fill = Ink::faint, .opacity = 0.6});
    svg.line(place(-reach, 0), place(reach, 0), {.stroke = Ink::quiet});
    svg.line(place(0, -reach), place(0, reach), {.stroke = Ink::quiet});
    Pcg32 random(options.seed);
    for (int i = 0; i < 1'200; ++i) {
        const auto size =
            static_cast<std::int64_t>(1 + random.below(static_cast<std::uint32_t>(reach)));
        const Volume volume = volume_of(with_volume(random.below(2) ? size : -size, random));
        if (std::abs(volume.in_double) > reach) continue;
        const bool lost = volume.in_double * volume.exact <= 0.0;
        svg.circle(place(volume.exact, volume.in_double), lost ? 3 : 2,
                   {.stroke = {}, .fill = lost ? Ink::vermillion : Ink::blue});
    }
    svg.rect(place(-reach, reach), at(2 * half, 2 * half), {.stroke = Ink::quiet});
    svg.text(at(320, 2 * half + 66), "the exact volume, from −50 to 50", {});
    svg.text(at(320 - half, 26), "what double says", {.anchor = Anchor::start});
    svg.text(place(-0.96 * reach, 0.88 * reach), "wrong sign",
             {.anchor = Anchor::start, .ink = Ink::vermillion});
    svg.text(place(0.96 * reach, -0.93 * reach), "wrong sign",
             {.anchor = Anchor::end, .ink = Ink::vermillion});
    return svg;
}

}  // namespace space::ch02
