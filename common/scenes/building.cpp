/// @file
/// A doll's house of any height: storeys of eight furnished rooms, open at the front. It stands in
/// for the large architectural models that cannot be had: few kinds of object, many copies, rooms
/// that hide each other.
#include "common/pcg32.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <array>

namespace space {
namespace {

// Metres. A room is seen from +z; x to the right, y up; (0, 0, 0) is its left back corner on the
// floor.
constexpr double width = 4.0, depth = 3.6, storey = 2.8, slab = 0.2, wall = 0.1, corridor = 1.4;
constexpr int rooms_across = 4;

struct Part {
    TriangleMesh mesh;
    Color color;
};
using Parts = std::vector<Part>;

TriangleMesh joined(std::initializer_list<TriangleMesh> meshes) {
    TriangleMesh whole;
    for (const TriangleMesh& mesh : meshes) whole.append(mesh);
    return whole;
}

TriangleMesh table(double w, double d, double h) {
    TriangleMesh mesh = box({0, h - 0.04, 0}, {w, h, d});
    for (const double x : {0.04, w - 0.09})
        for (const double z : {0.04, d - 0.09})
            mesh.append(box({x, 0, z}, {x + 0.05, h - 0.04, z + 0.05}));
    return mesh;
}

/// Looks towards +z.
TriangleMesh chair() {
    return joined({table(0.44, 0.44, 0.46), box({0.0, 0.46, 0.0}, {0.04, 0.95, 0.04}),
                   box({0.40, 0.46, 0.0}, {0.44, 0.95, 0.04}),
                   box({0.04, 0.70, 0.005}, {0.40, 0.92, 0.03})});
}

TriangleMesh cushion(double w, double h, double d) {
    return transformed(icosphere(5), {{0.5 * w, 0, 0}, {0, 0.5 * h, 0}, {0, 0, 0.5 * d}},
                       {0.5 * w, 0.5 * h, 0.5 * d});
}

/// On the floor, against the left wall: pot, stem and crown.
void add_plant(Parts& parts, const Double3& place) {
    const glm::dvec2 pot[] = {{0.0, 0.0}, {0.12, 0.0}, {0.17, 0.28}, {0.14, 0.28}, {0.0, 0.25}};
    parts.push_back({moved(lathe(pot, 20), place), srgb(0xB8643F)});
    parts.push_back(
        {moved(tube({{0, 0.2, 0}, 0.02}, {{0, 0.9, 0}, 0.015}, 6), place), srgb(0x6B4A33)});
    TriangleMesh crown;
    for (const Double3& p :
         {Double3{0, 1.0, 0}, {0.16, 0.82, 0.05}, {-0.14, 0.86, 0.10}, {0.02, 0.80, -0.16}})
        crown.append(ball(p, 0.2, 3));
    parts.push_back({moved(crown, place), srgb(0x5C8A4A)});
}

void add_lamp(Parts& parts, const Double3& place) {
    parts.push_back({joined({moved(tube({{0, 0, 0}, 0.15}, {{0, 0.03, 0}, 0.14}, 20), place),
                             moved(tube({{0, 0.03, 0}, 0.012}, {{0, 1.3, 0}, 0.012}, 8), place)}),
                     srgb(0x39424A)});
    parts.push_back({moved(tube({{0, 1.25, 0}, 0.22}, {{0, 1.55, 0}, 0.13}, 24, false), place),
                     srgb(0xF3DFB0)});
}

void add_shelf(Parts& parts, const Double3& place, Pcg32& random) {
    TriangleMesh boards =
        joined({box({0, 0, 0}, {0.03, 1.9, 0.28}), box({1.17, 0, 0}, {1.2, 1.9, 0.28})});
    const Color colors[] = {srgb(0xB5483A), srgb(0x35607A), srgb(0xD9A441), srgb(0x5C7F5A),
                            srgb(0xE6DCC8)};
    for (int row = 0; row < 5; ++row) {
        const double y = 0.06 + 0.45 * row;
        boards.append(box({0.03, y, 0}, {1.17, y + 0.025, 0.28}));
        if (row == 4) break;
        for (int book = 0; book < 14; ++book) {
            const double x = 0.05 + 0.078 * book, height = 0.22 + 0.14 * random.uniform_double();
            parts.push_back(
                {moved(box({x, y + 0.025, 0.03}, {x + 0.06, y + 0.025 + height, 0.22}), place),
                 colors[random.below(5)]});
        }
    }
    parts.push_back({moved(boards, place), srgb(0x8A6244)});
}

const Color wood = srgb(0x94694A);

Parts living_room() {
    Parts parts;
    parts.push_back(
        {joined({box({0.9, 0.1, 0.15}, {2.9, 0.42, 1.0}), box({0.9, 0.42, 0.15}, {2.9, 0.85, 0.35}),
                 box({0.7, 0.1, 0.15}, {0.9, 0.62, 1.0}), box({2.9, 0.1, 0.15}, {3.1, 0.62, 1.0})}),
         srgb(0x3D6C7C)});
    parts.push_back({moved(cushion(0.5, 0.42, 0.2), {1.0, 0.44, 0.38}), srgb(0xD9A441)});
    parts.push_back({moved(cushion(0.5, 0.42, 0.2), {2.3, 0.44, 0.38}), srgb(0xC8553D)});
    parts.push_back({moved(table(1.1, 0.55, 0.4), {1.4, 0, 1.5}), wood});
    parts.push_back(
        {moved(transformed(teapot(4), glm::dmat3(0.7)), {1.9, 0.4, 1.75}), srgb(0xE6E0D2)});
    parts.push_back({box({0.8, 0, 1.2}, {3.2, 0.015, 2.6}), srgb(0xD8B98C)});
    add_lamp(parts, {3.45, 0, 0.5});
    add_plant(parts, {0.35, 0, 0.5});
    return parts;
}

Parts dining_room() {
    Parts parts;
    const glm::dvec2 round[] = {{0.0, 0.70}, {0.66, 0.70}, {0.68, 0.72}, {0.66, 0.74}, {0.0, 0.74}};
    const glm::dvec2 leg[] = {{0.28, 0.0}, {0.26, 0.03}, {0.05, 0.08}, {0.05, 0.60}, {0.15, 0.70}};
    parts.push_back({moved(joined({lathe(round, 40), lathe(leg, 20)}), {2.0, 0, 1.7}), wood});
    for (int seat = 0; seat < 4; ++seat)
        parts.push_back({transformed(moved(chair(), {-0.22, 0, -1.02}),
                                     rotation({0, 1, 0}, 90 * seat + 45), {2.0, 0, 1.7}),
                         seat % 2 ? srgb(0xB5483A) : srgb(0xD9A441)});
    parts.push_back({moved(teapot(5), {2.0, 0.74, 1.7}), srgb(0x4F8F86)});
    for (int fruit = 0; fruit < 3; ++fruit)
        parts.push_back({ball({2.3 + 0.09 * (fruit % 2), 0.785, 1.95 + 0.06 * fruit}, 0.045, 3),
                         srgb(0xE08A2C)});
    parts.push_back({box({0.0, 0, 0.0}, {2.4, 0.9, 0.5}), srgb(0xDAD3C4)});
    parts.push_back({box({0.0, 0.9, 0.0}, {2.45, 0.94, 0.55}), srgb(0x5A5048)});
    parts.push_back({box({0.2, 1.45, 0.0}, {2.2, 2.1, 0.3}), srgb(0xC9D3CF)});
    add_plant(parts, {3.6, 0, 0.45});
    return parts;
}

Parts bedroom() {
    Parts parts;
    Pcg32 random(2);
    const Color linen = srgb(0xEFE8DA);
    parts.push_back(
        {joined({box({0.7, 0.12, 0.1}, {2.3, 0.32, 2.2}), box({0.7, 0.0, 0.04}, {2.3, 1.0, 0.1})}),
         wood});
    parts.push_back({box({0.74, 0.32, 0.1}, {2.26, 0.5, 2.16}), linen});
    parts.push_back({box({0.72, 0.42, 0.8}, {2.28, 0.54, 2.18}), srgb(0x7C8FB0)});
    parts.push_back({moved(cushion(0.62, 0.18, 0.4), {0.82, 0.5, 0.18}), linen});
    parts.push_back({moved(cushion(0.62, 0.18, 0.4), {1.56, 0.5, 0.18}), linen});
    parts.push_back({moved(table(0.42, 0.42, 0.5), {2.4, 0, 0.1}), wood});
    add_lamp(parts, {0.35, 0, 0.4});
    add_shelf(parts, {2.85, 0, 0.02}, random);
    return parts;
}

Parts study() {
    Parts parts;
    Pcg32 random(3);
    parts.push_back({moved(table(1.6, 0.75, 0.74), {1.9, 0, 0.7}), wood});
    parts.push_back(
        {transformed(moved(chair(), {-0.22, 0, -0.22}), rotation({0, 1, 0}, 180), {2.6, 0, 1.8}),
         srgb(0x39424A)});
    parts.push_back({joined({box({2.35, 0.80, 0.85}, {2.95, 1.16, 0.88}),
                             box({2.6, 0.74, 0.83}, {2.7, 0.82, 0.86})}),
                     srgb(0x2B3036)});
    parts.push_back({ball({3.25, 0.89, 0.95}, 0.15, 6), srgb(0x5E93A8)});
    parts.push_back({box({0.4, 0, 1.6}, {3.4, 0.015, 3.0}), srgb(0x9C4A3C)});
    add_shelf(parts, {0.25, 0, 0.02}, random);
    add_plant(parts, {3.6, 0, 0.4});
    return parts;
}

}  // namespace

void make_building(Scene& scene, std::uint32_t storeys, std::uint64_t seed) {
    Pcg32 random(seed);
    const std::array<Parts, 4> kinds{living_room(), dining_room(), bedroom(), study()};
    const Color papers[] = {srgb(0xE9D9B8), srgb(0xC98F73), srgb(0x9DB8B0), srgb(0xB9C3D3),
                            srgb(0xD8A9A0), srgb(0xE6E2D8), srgb(0x7F9C8C)};
    const Color plaster = srgb(0xE7E0D4), outside = srgb(0xA9583F), floor = srgb(0xB58B62);

    const double length = rooms_across * width, back = -(2 * depth + corridor);
    for (std::uint32_t level = 0; level < storeys; ++level) {
        const double y = storey * level, top = y + storey - slab;
        add(scene, box({-wall, y - slab, back}, {length + wall, y, 0}), floor);
        add(scene, box({-wall, y, back}, {0, top, 0}), outside);
        add(scene, box({length, y, back}, {length + wall, top, 0}), outside);
        add(scene, box({0, y, back}, {length, top, back + wall}), outside);
        for (int row = 0; row < 2; ++row) {  // the front row, and one behind the corridor
            const double z = row == 0 ? -depth : back + wall;
            for (int room = 0; room < rooms_across; ++room) {
                const double x = width * room;
                const Color paper = papers[random.below(7)];
                const double door =
                    row == 0 ? z - wall : z + depth - wall;  // in the wall to the corridor
                add(scene, box({x, y, door}, {x + 2.9, top, door + wall}), paper);
                add(scene, box({x + 3.7, y, door}, {x + width, top, door + wall}), paper);
                add(scene, box({x + 2.9, y + 2.05, door}, {x + 3.7, top, door + wall}), paper);
                if (room > 0)
                    add(scene, box({x - 0.5 * wall, y, z}, {x + 0.5 * wall, top, z + depth - wall}),
                        plaster);
                for (const Part& part : kinds[(std::size_t(room) + level + std::size_t(row)) % 4])
                    add(scene, moved(part.mesh, {x, y, z}), part.color);
            }
        }
    }
    const double height = storey * storeys;
    add(scene, box({-0.4, height - slab, back - 0.3}, {length + 0.4, height, 0.3}), srgb(0x5A6470));
    add(scene,
        parallelogram({-4 * length, -slab, 4 * length}, {9 * length, 0, 0}, {0, 0, -8 * length}),
        srgb(0x8FA67A));

    // The whole of a low house; of a high one four storeys in the middle.
    const double seen = storey * std::min(storeys, 4u);
    const Double3 middle{0.5 * length, 0.5 * height, 0.0};
    const double far = 1.2 * length + 0.3 * seen;
    scene.camera = {.eye = Point3(middle + far * Double3{0.30, 0.14, 1.0}),
                    .target = Point3(middle),
                    .field_of_view = 36};
    scene.background = srgb(0xC4DDEB);
    add_light(scene, middle + 6.0 * far * Double3{-0.45, 0.55, 1.0}, middle,
              Color{0.80f, 0.74f, 0.64f});
    add_light(scene, middle + 6.0 * far * Double3{0.60, 0.10, 1.0}, middle,
              Color{0.24f, 0.25f, 0.28f});
    add_eye_light(scene, Color{0.22f, 0.22f, 0.24f});
}

}  // namespace space
