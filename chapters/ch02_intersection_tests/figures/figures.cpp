#include "chapters/ch02_intersection_tests/figures/figures.hpp"

#include "chapters/ch02_intersection_tests/figures/drawings.hpp"
#include "chapters/ch02_intersection_tests/figures/far_pictures.hpp"
#include "chapters/ch02_intersection_tests/measured/measurements.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

namespace space::ch02 {
namespace {

// -------------------------------------------------------------------------------------------------
// 2.10 The same mesh through the eyes of every test

void fig_02_10(const Options& options) {
    constexpr int side = 150, gap = 8, row_height = 206;
    /// Pixels that are alone are too small to see: few of them are circled.
    constexpr std::uint64_t few = 60;
    Svg svg("fig_02_10",
            "One mesh, a million radii from the origin, seen by every ray-triangle test; wrong "
            "pixels are marked",
            4 * side + 5 * gap, 2 * row_height);
    const auto pictures = far_pictures(side, 6, options.threads);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const FarPicture& picture = pictures[i];
        const auto left = static_cast<float>(gap + static_cast<int>(i % 4) * (side + gap)),
                   top = static_cast<float>(i / 4 * row_height);
        const float middle = left + 0.5f * side;
        svg.picture({left, top}, {side, side}, picture.image, picture.test);
        if (picture.wrong <= few)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    if (picture.image.at(x, y) == FarPicture::mark)
                        svg.circle({left + static_cast<float>(x) + 0.5f,
                                    top + static_cast<float>(y) + 0.5f},
                                   4, {.stroke = Ink::vermillion});
        svg.text({middle, top + side + 18}, picture.test, {.size = 16});
        svg.text({middle, top + side + 40},
                 picture.wrong == 0 ? "none wrong" : with_commas(picture.wrong) + " wrong",
                 {.ink = Ink::quiet, .size = 16});
    }
    write_file(options.out / "fig_02_10.svg", svg.document());
}

// -------------------------------------------------------------------------------------------------
// 2.11 to 2.14 Charts: only what each of them shows is measured

using Part = void (*)(const Options&, Measurements&);

template <Chart (*chart)(const Measurements&), Part... parts>
void measured_chart(const Options& options) {
    Measurements measured;
    (parts(options, measured), ...);
    write_chart(options.out, chart(measured));
}

// -------------------------------------------------------------------------------------------------

constexpr Figure figures[] = {
    {"fig_02_01", FigureKind::drawing, draw_shared_edge},
    {"fig_02_02", FigureKind::drawing, draw_slabs},
    {"fig_02_03", FigureKind::drawing, draw_filter},
    {"fig_02_04", FigureKind::drawing, draw_sphere},
    {"fig_02_05", FigureKind::drawing, draw_newton_root},
    {"fig_02_10", FigureKind::drawing, fig_02_10},
    {"fig_02_11", FigureKind::chart, measured_chart<triangle_chart, count_leaks, time_triangles>},
    {"fig_02_12", FigureKind::chart, measured_chart<root_chart, count_roots, time_others>},
    {"fig_02_13", FigureKind::chart, measured_chart<box_chart, count_boxes, time_patterns>},
    {"fig_02_14", FigureKind::chart, measured_chart<sphere_chart, count_spheres, time_others>},
};

}  // namespace

std::span<const Figure> chapter02_figures() {
    return figures;
}

}  // namespace space::ch02
