/// @file
/// A statue as a scanner gives it: one closed mesh of small triangles, all of about a size.
#include "common/pcg32.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <cmath>

namespace space {
namespace {

/// What the sculptor added (or, where negative, took away) about a direction.
struct Feature {
    Double3 where;  ///< on the unit sphere, nearly
    double width, height;
};

/// A face that looks along +z; what has x > 0 is on its other side, too.
constexpr Feature features[] = {
    {{0.00, 0.30, 0.95}, 0.30, 0.07},   {{0.30, 0.30, 0.90}, 0.32, 0.09},    // brows
    {{0.29, 0.10, 0.94}, 0.24, -0.13},  {{0.29, 0.09, 0.94}, 0.13, 0.05},    // eyes
    {{0.00, 0.16, 0.98}, 0.16, 0.09},   {{0.00, 0.04, 0.99}, 0.18, 0.14},    // nose
    {{0.00, -0.08, 0.99}, 0.20, 0.21},  {{0.10, -0.13, 0.98}, 0.11, 0.06},   // nostrils
    {{0.42, -0.12, 0.88}, 0.32, 0.07},  {{0.34, -0.44, 0.82}, 0.26, -0.05},  // cheeks
    {{0.00, -0.34, 0.93}, 0.25, 0.07},  {{0.12, -0.41, 0.91}, 0.10, -0.06},  // mouth
    {{0.00, -0.41, 0.91}, 0.10, -0.07}, {{0.00, -0.49, 0.87}, 0.22, 0.08},
    {{0.00, -0.74, 0.66}, 0.34, 0.16},  {{0.45, -0.62, 0.62}, 0.35, 0.05},   // chin, jaw
    {{0.98, 0.02, -0.05}, 0.26, 0.13},  {{0.96, -0.22, -0.02}, 0.18, 0.10},  // ears
    {{0.00, -1.00, -0.15}, 0.75, 0.45},                                      // neck
};

/// 1 at 0, 0 from 1 on, with a slope of 0 at both.
double fading(double square) {
    return square < 1.0 ? (1.0 - square) * (1.0 - square) : 0.0;
}

double sculpted(const Double3& p) {
    double height = 0.0;
    for (const Feature& feature : features)
        for (const double side : {1.0, -1.0}) {
            const Double3 away = p - Double3{side, 1, 1} * feature.where;
            if (side > 0.0 || feature.where.x > 0.0)
                height +=
                    feature.height * fading(glm::dot(away, away) / (feature.width * feature.width));
        }
    return height;
}

/// Value noise: a random number from -1 to 1 at each point of the integer lattice, smooth between
/// them.
double noise(const Double3& p, std::uint64_t seed) {
    const Double3 floor = glm::floor(p), part = p - floor;
    const Double3 share = part * part * (3.0 - 2.0 * part);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        std::uint64_t place = 0;
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const int bit = corner >> axis & 1;
            place = place << 21 | static_cast<std::uint64_t>(floor[axis] + bit + 0x1p20);
            weight *= bit ? share[axis] : 1.0 - share[axis];
        }
        sum += weight * (2.0 * Pcg32(seed, place).uniform_double() - 1.0);
    }
    return sum;
}

/// Weathered stone: octaves of noise, down to what the triangles can show.
double weathered(const Double3& p, std::uint32_t frequency, std::uint64_t seed) {
    double sum = 0.0, height = 0.03;
    for (std::uint32_t waves = 4; waves <= 2 * frequency; waves *= 2, height *= 0.45)
        sum += height * noise(double(waves) * p, seed + waves);
    return sum;
}

}  // namespace

void make_scan(Scene& scene, std::uint32_t frequency, std::uint64_t seed) {
    scene.mesh = icosphere(frequency);
    for (Point3& vertex : scene.mesh.vertices) {
        const Double3 p{vertex};
        const double radius = 1.0 + sculpted(p) + weathered(p, frequency, seed);
        vertex = Point3(radius * p * Double3{0.72, 1.0, 0.82});
    }
    scene.colors.assign(scene.mesh.faces.size(), srgb(0xCDBFA6));
    scene.camera = {
        .eye = {1.25f, 0.2f, 3.5f}, .target = {0.0f, -0.15f, 0.0f}, .field_of_view = 39};
    scene.background = srgb(0x2B3A42);
    add_light(scene, {-2.4, 2.4, 3.4}, {0, 0, 0}, Color{1.00f, 0.93f, 0.80f});
    add_light(scene, {3.5, 0.8, 0.8}, {0, 0, 0}, Color{0.26f, 0.34f, 0.42f});
    add_eye_light(scene, Color{0.07f, 0.07f, 0.08f});
}

}  // namespace space
