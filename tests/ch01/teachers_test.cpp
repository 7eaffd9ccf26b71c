// What the teachers' notes on chapter 1 say was measured is measured here.
#include "chapters/ch01_naive_ray_tracing/solutions/ex04_tests_per_pixel.hpp"
#include "common/program/report.hpp"
#include "tests/text.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <numeric>
#include <utility>

namespace space {
namespace {

double area(const Triangle& t) {
    return 0.5 * glm::length(glm::cross(Double3(t.b) - Double3(t.a), Double3(t.c) - Double3(t.a)));
}

using Key = std::function<double(const Triangle&)>;

/// The scene's triangles by rising key; equal ones stay in order.
Scene sorted(const Scene& scene, const Key& key) {
    std::vector<std::size_t> order(scene.mesh.faces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<double> keys;
    for (std::size_t i = 0; i < order.size(); ++i) keys.push_back(key(scene.mesh.triangle(i)));
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return keys[i]; });
    Scene result = scene;
    for (std::size_t i = 0; i < order.size(); ++i) {
        result.mesh.faces[i] = scene.mesh.faces[order[i]];
        if (!scene.colors.empty()) result.colors[i] = scene.colors[order[i]];
    }
    return result;
}

/// Of `count` triangles, in the order of the list or the largest, as whole percent of all.
int share_of_area(const Scene& scene, std::size_t count, bool largest) {
    std::vector<double> areas;
    for (std::size_t i = 0; i < scene.mesh.faces.size(); ++i)
        areas.push_back(area(scene.mesh.triangle(i)));
    const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
    if (largest) std::ranges::sort(areas, std::greater());
    return static_cast<int>(std::lround(
        100.0 * std::accumulate(areas.begin(), areas.begin() + static_cast<long>(count), 0.0) /
        all));
}

}  // namespace

TEST_CASE("the hits that Algorithm 1 keeps are those of the figure that teachers are told of") {
    Text("docs/teachers/ch01.md")
        .check_says(
            "Of the 761 pixels of figure 1.5 that see something one would expect a tenth, "
            "76. There are 15:");
    Text("figures/fig_01_05.svg").check_says(">15 of 761 hits shown<");
}

TEST_CASE("no order of the room's triangles saves much: the table for teachers") {
    constexpr int width = 80, height = 60;
    const Text notes("docs/teachers/ch01.md");
    const Scene room = make_scene("room");
    notes.check_says(fmt::format("The room at {} × {} pixels, {} triangles, three lights", width,
                                 height, with_commas(room.mesh.faces.size())));
    REQUIRE(room.lights.size() == 3);
    const Double3 lamp(room.lights[0].position);
    const auto distance = [&](const Triangle& t) {
        return glm::length((Double3(t.a) + Double3(t.b) + Double3(t.c)) / 3.0 - lamp);
    };
    const std::uint64_t camera = std::uint64_t{width} * height * room.mesh.faces.size();
    double first = 0.0, most = 0.0;
    for (const auto& [name, key] :
         {std::pair<const char*, Key>{"as it is", [](const Triangle&) { return 0.0; }},
          {"nearest to the first lamp first", distance},
          {"farthest first", [&](const Triangle& t) { return -distance(t); }},
          {"largest first", [](const Triangle& t) { return -area(t); }}}) {
        const std::vector<std::uint64_t> tests = tests_per_pixel(sorted(room, key), width, height);
        const auto all = std::accumulate(tests.begin(), tests.end(), std::uint64_t{0});
        const std::string row = fmt::format(
            "| {} | {} | {} | {} |", name, with_commas(camera), with_commas(all - camera),
            with_commas(static_cast<std::uint64_t>(
                std::llround(static_cast<double>(all) / (width * height)))));
        fmt::print("{}\n", row);
        notes.check_says(row);
        const auto shadow = static_cast<double>(all - camera);
        if (first == 0.0) first = shadow;
        most = std::max(most, std::abs(shadow / first - 1.0));
    }
    notes.check_says(
        fmt::format("none of the orders changes their tests by more than {:.1f} %", 100.0 * most));
    notes.check_says(
        fmt::format("the first 50 triangles have {} % of the whole area, the largest 50 have {} %",
                    share_of_area(room, 50, false), share_of_area(room, 50, true)));
}

}  // namespace space
