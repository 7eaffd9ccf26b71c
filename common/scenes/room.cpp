/// @file
/// A room for pictures: everything in it is made here, so that it looks the same on every machine.
#include "common/pcg32.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <algorithm>

namespace space {
namespace {

// Metres; y is up, the camera looks towards -z.
constexpr double left = -2.1, right = 2.3, back = -1.9, front = 2.6, ceiling = 2.6,
                 table_height = 0.74;

void add_walls(Scene& scene) {
    const double width = right - left, depth = front - back;
    const Color red = srgb(0xC4674A), teal = srgb(0x3E7C86), cream = srgb(0xEFE3CF),
                white = srgb(0xF4EFE6);
    add(scene, parallelogram({left, 0, front}, {0, 0, -depth}, {0, ceiling, 0}), red);
    add(scene, parallelogram({right, 0, back}, {0, 0, depth}, {0, ceiling, 0}), teal);
    add(scene, parallelogram({left, 0, back}, {width, 0, 0}, {0, ceiling, 0}), cream);
    add(scene, parallelogram({right, 0, front}, {-width, 0, 0}, {0, ceiling, 0}), cream);
    add(scene, parallelogram({left, ceiling, back}, {width, 0, 0}, {0, 0, depth}), white);

    // Boards with a narrow gap between them, on a dark ground.
    add(scene, parallelogram({left, -0.02, front}, {width, 0, 0}, {0, 0, -depth}), srgb(0x3A2A1E));
    constexpr int boards = 14;
    const Color woods[] = {srgb(0xA87B4F), srgb(0xB58657), srgb(0x9C7046), srgb(0xAE8052),
                           srgb(0xBB8E60)};
    Pcg32 random(7);
    for (int i = 0; i < boards; ++i) {
        const double x = left + width * i / boards, gap = 0.004;
        double z = back;
        while (z < front) {
            const double end = std::min(front, z + 1.2 + 1.6 * random.uniform_double());
            add(scene,
                parallelogram({x + gap, 0, end}, {width / boards - 2 * gap, 0, 0},
                              {0, 0, z - end + 2 * gap}),
                woods[random.below(5)]);
            z = end;
        }
    }
    // Skirting boards.
    add(scene, box({left, 0, back}, {right, 0.09, back + 0.02}), white);
    add(scene, box({left, 0, back}, {left + 0.02, 0.09, front}), white);
    add(scene, box({right - 0.02, 0, back}, {right, 0.09, front}), white);
}

/// A frame on the back wall with hills under a sun in it.
void add_picture(Scene& scene) {
    const double x = -0.62, y = 1.20, w = 1.05, h = 0.78, z = back + 0.01, rim = 0.045;
    add(scene, box({x - rim, y - rim, back}, {x + w + rim, y + h + rim, z + 0.015}),
        srgb(0x2E2A28));
    const double paper = z + 0.017;
    add(scene, parallelogram({x, y, paper}, {w, 0, 0}, {0, h, 0}), srgb(0xF3D9A4));
    const glm::dvec2 disc[] = {{0.0, 0.0}, {0.13, 0.0}};
    TriangleMesh sun = turned_inside_out(lathe(disc, 32));
    add(scene,
        transformed(sun, rotation({1, 0, 0}, 90), {x + 0.68 * w, y + 0.62 * h, paper + 0.002}),
        srgb(0xD9573F));
    const auto hill = [&](double from, double to, double top, double lift, const Color& color) {
        TriangleMesh mesh;
        const double middle = 0.5 * (from + to);
        for (const glm::dvec2& p :
             {glm::dvec2{from, 0}, glm::dvec2{to, 0}, glm::dvec2{to, 0.35 * top},
              glm::dvec2{middle + 0.1, 0.9 * top}, glm::dvec2{middle, top},
              glm::dvec2{middle - 0.15, 0.8 * top}, glm::dvec2{from, 0.3 * top}})
            mesh.vertices.emplace_back(x + p.x * w, y + p.y * h, paper + lift);
        for (std::uint32_t i = 2; i < 7; ++i) mesh.faces.push_back({0, i - 1, i});
        add(scene, mesh, color);
    };
    hill(0.30, 1.00, 0.50, 0.004, srgb(0x6E9AA0));
    hill(0.00, 0.75, 0.42, 0.006, srgb(0x3F6C73));
    hill(0.45, 1.00, 0.24, 0.008, srgb(0x27474F));
}

void add_table(Scene& scene) {
    const Color wood = srgb(0x8A5A3A);
    const glm::dvec2 top[] = {{0.0, 0.695},  {0.68, 0.695},        {0.70, 0.705},
                              {0.70, 0.730}, {0.69, table_height}, {0.0, table_height}};
    add(scene, lathe(top, 64), wood);
    const glm::dvec2 turned[] = {{0.050, 0.12}, {0.060, 0.20}, {0.035, 0.30},
                                 {0.060, 0.42}, {0.040, 0.56}, {0.090, 0.695}};
    add(scene, lathe(smooth_curve(turned, 4), 24), wood);
    for (int leg = 0; leg < 3; ++leg) {
        const glm::dmat3 turn = rotation({0, 1, 0}, 30 + 120 * leg);
        const TubePoint path[] = {{{0.02, 0.17, 0}, 0.034},
                                  {{0.18, 0.14, 0}, 0.030},
                                  {{0.33, 0.05, 0}, 0.026},
                                  {{0.44, 0.022, 0}, 0.022}};
        add(scene, transformed(tube(path, 10), turn), wood);
    }
}

void add_stool(Scene& scene, const Double3& place, const Color& color) {
    const glm::dvec2 seat[] = {
        {0.0, 0.43}, {0.17, 0.43}, {0.18, 0.445}, {0.17, 0.46}, {0.0, 0.465}};
    add(scene, moved(lathe(seat, 32), place), color);
    for (int leg = 0; leg < 4; ++leg) {
        const glm::dmat3 turn = rotation({0, 1, 0}, 45 + 90 * leg);
        add(scene,
            transformed(tube({{0.11, 0.435, 0}, 0.016}, {{0.19, 0.0, 0}, 0.012}, 8), turn, place),
            srgb(0xC9A071));
    }
}

void add_lamp(Scene& scene) {
    const Color shade = srgb(0x2F3B45);
    add(scene, tube({{0, ceiling, 0}, 0.006}, {{0, 2.10, 0}, 0.006}, 6, false), srgb(0x222222));
    const glm::dvec2 outside[] = {{0.26, 1.86}, {0.20, 1.98}, {0.07, 2.08}, {0.0, 2.10}};
    add(scene, lathe(smooth_curve(outside, 3), 40), shade);
    const glm::dvec2 inside[] = {{0.255, 1.86}, {0.195, 1.975}, {0.065, 2.075}, {0.0, 2.09}};
    add(scene, turned_inside_out(lathe(smooth_curve(inside, 3), 40)), srgb(0xFFF3D8));
}

/// The room without anything on the table.
void add_room(Scene& scene) {
    add_walls(scene);
    add_picture(scene);
    const glm::dvec2 rug[] = {{1.25, 0.0}, {1.24, 0.012}, {1.10, 0.014}};
    const glm::dvec2 rug_middle[] = {{1.10, 0.014}, {0.0, 0.014}};
    add(scene, lathe(rug, 64), srgb(0xE9DCC3));
    add(scene, lathe(rug_middle, 64), srgb(0x2F5D73));
    add_table(scene);
    add_stool(scene, {-1.02, 0.014, 0.30}, srgb(0xD9A441));
    add_stool(scene, {1.10, 0.014, -0.55}, srgb(0xB5483A));
    add_lamp(scene);

    scene.camera = {
        .eye = {0.66f, 1.40f, 2.30f}, .target = {-0.03f, 0.94f, 0.0f}, .field_of_view = 39.0f};
    scene.background = srgb(0xBFD4E0);
    const Double3 middle{0.0, table_height, 0.0};
    add_light(scene, {0.0, 1.88, 0.0}, middle,
              Color{0.62f, 0.53f, 0.38f});  // below the lamp's shade
    add_light(scene, {1.9, 2.35, 2.1}, middle,
              Color{0.72f, 0.70f, 0.68f});  // daylight from behind, right
    add_eye_light(scene, Color{0.34f, 0.34f, 0.36f});
}

}  // namespace

void make_room(Scene& scene, std::uint32_t detail, std::uint64_t) {
    add_room(scene);
    const Double3 place{-0.06, table_height, -0.02};
    add(scene, transformed(teapot(detail), 1.9 * rotation({0, 1, 0}, -28), place), srgb(0x4F8F86));
    const glm::dvec2 cup[] = {{0.030, 0.0},   {0.046, 0.035}, {0.050, 0.080},
                              {0.047, 0.080}, {0.042, 0.035}, {0.0, 0.010}};
    add(scene, moved(lathe(cup, 32), {0.42, table_height, 0.20}), srgb(0xE8DFD0));
    add(scene, moved(lathe(cup, 32), {-0.36, table_height, 0.33}), srgb(0xE8DFD0));
    const std::uint32_t f = std::min(detail, 8u);
    add(scene, ball({0.38, table_height + 0.045, -0.20}, 0.045, f), srgb(0xE08A2C));
    add(scene, ball({0.47, table_height + 0.042, -0.15}, 0.042, f), srgb(0xD9772B));
    add(scene, ball({0.44, table_height + 0.040, -0.26}, 0.040, f), srgb(0xC8442F));
}

void make_room_with(Scene& scene, const TriangleMesh& on_table) {
    add_room(scene);
    constexpr double height = 0.55, width = 0.75;  // of the box that the mesh is fitted into
    const Aabb box = bounds(on_table);
    const Double3 min{box.min}, max{box.max}, size = max - min;
    const double widest = std::max(size.x, size.z);
    double scale = size.y > 0.0 ? height / size.y : 1.0;
    if (widest > 0.0) scale = std::min(scale, width / widest);
    const Double3 foot{0.5 * (min.x + max.x), min.y, 0.5 * (min.z + max.z)};
    add(scene,
        transformed(on_table, glm::dmat3(scale), Double3{0.0, table_height, 0.0} - scale * foot),
        srgb(0xD8C7A8));
}

}  // namespace space
