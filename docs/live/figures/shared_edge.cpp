#include "chapters/ch02_intersection_tests/figures/drawn_edge.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace space::live {
namespace {

using namespace std::string_view_literals;
using ch02::EdgeVerdicts, ch02::GlassPlace;

constexpr std::array aims{"at the common edge"sv, "anywhere"sv};
constexpr int widest = 18;  ///< then the glass shows all of both triangles

/// "3 squares to the left and 2 up"
std::string written(const GlassPlace& place) {
    return fmt::format("{} square{} to the {} and {} {}", std::abs(place.right),
                       std::abs(place.right) == 1 ? "" : "s", place.right < 0 ? "left" : "right",
                       std::abs(place.up), place.up < 0 ? "down" : "up");
}

/// What each test makes of all rays, and of the marked one.
std::string summed_up(const ch02::EdgeScene& scene, const std::array<EdgeVerdicts, 3>& verdicts,
                      const GlassPlace& place) {
    const EdgeVerdicts& exact = verdicts.back();
    std::string rays, one;
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string_view test = ch02::drawn_test_names[scene.tests[i]];
        int others = 0;
        for (std::size_t k = 0; k < exact.size(); ++k) others += verdicts[i][k] != exact[k];
        rays += fmt::format(
            "{} {} lets {} through that hit, and decides {} otherwise than exact arithmetic",
            i == 0 ? "" : ";", test, ch02::leaks_of(verdicts[i], exact), others);
        one += fmt::format(" {} by {},", ch02::verdict_names[verdicts[i].of(place)], test);
    }
    return fmt::format("Of 1,600 rays{}. The ray {} hits{} {} exactly.", rays,
                       place == GlassPlace{} ? "in the middle" : written(place), one,
                       ch02::verdict_names[exact.of(place)]);
}

}  // namespace

Answer shared_edge(const State& state) {
    std::vector<Handle> handles;
    const auto corner = [&](const char* name, const Point3& first) {
        const Double2 p = state.point(name, Double2(first), -1.2, 1.2);
        handles.push_back(
            {name, fmt::format("corner {}", name), p, ch02::edge_zero, ch02::edge_unit});
        return Point3(Point2(p), first.z);
    };
    ch02::EdgeScene scene{};
    scene.a = corner("a", ch02::edge_a);
    scene.b = corner("b", ch02::edge_b);
    scene.c = corner("c", ch02::edge_c);
    scene.d = corner("d", ch02::edge_d);

    const std::size_t how = state.choice("aim", 0, aims);
    const Double2 a(scene.a), way = Double2(scene.c) - a,
                              wanted = state.point("at", {0.7375, 0.625}, -1.2, 1.2);
    const double along =
        a == Double2(scene.c) ? 0.0 : glm::dot(wanted - a, way) / glm::dot(way, way);
    const auto share = static_cast<float>(std::clamp(along, 0.0, 1.0));
    const Double2 on_edge = a + double{share} * way;
    scene.aim = ch02::edge_ray(scene.a, scene.c, share,
                               how == 0 ? Vector2(0.0f) : Vector2(wanted - on_edge));
    handles.push_back({"at", "where the rays are aimed", how == 0 ? on_edge : wanted,
                       ch02::edge_zero, ch02::edge_unit});

    const std::size_t wide = state.whole("wide", 0, 0, widest);
    scene.step = std::ldexp(ch02::edge_step(scene.aim), static_cast<int>(wide));
    scene.tests = {state.choice("left", ch02::edge_tests[0], ch02::drawn_test_names),
                   state.choice("middle", ch02::edge_tests[1], ch02::drawn_test_names),
                   ch02::edge_tests[2]};
    const Double2 square = state.point("square", {0.0, 0.0}, -20.0, 20.0);
    const GlassPlace place{std::min(static_cast<int>(std::lround(square.x)), 19),
                           std::max(static_cast<int>(std::lround(square.y)), -19)};
    if (place != GlassPlace{}) scene.marked = place;
    handles.push_back({"square", "one of the rays, by the squares between it and the middle",
                       square, ch02::glass_corner(2) + Double2(20.5 * ch02::glass_square),
                       ch02::glass_square * Double2(1.0, -1.0)});

    const std::array<EdgeVerdicts, 3> verdicts = ch02::edge_verdicts(scene);
    return {.drawing = ch02::drawn_edge(scene, verdicts),
            .summary = summed_up(scene, verdicts, place),
            .handles = std::move(handles),
            .choices = {{"left", "On the left", ch02::drawn_test_names, scene.tests[0]},
                        {"middle", "In the middle", ch02::drawn_test_names, scene.tests[1]},
                        {"aim", "Rays aimed", aims, how}},
            .sliders = {{"wide", "Glass, from neighbouring floats to the whole", double(wide), 0,
                         widest, 1}}};
}

}  // namespace space::live
