// What a hemisphere of cells tells: exact means, distances in closed form, and gradients against
// differences of Lambert's formula for polygons.
#include "chapters/ch11_sampling_and_caching/hemisphere_gather.hpp"

#include "chapters/ch11_sampling_and_caching/form_factors.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"
#include "tests/ch11/up.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace space {
namespace {

using Look = std::function<SeenLight(const Double3& from, const Double3& direction)>;

IrradianceRecord gather(const Look& look, const HemisphereGrid& grid, const Double3& position = {},
                        const Double3& normal = up, std::uint64_t seed = 1) {
    Sampler sampler(SamplePattern::sobol, static_cast<std::uint32_t>(grid.cells()), seed);
    std::vector<SeenLight> cells;
    return gather_irradiance(
        position, normal, grid, 1e-3, sampler, 0, cells,
        [&](const Double3& direction, Sampler&) { return look(position, direction); });
}

/// A gradient's row.
Double3 red(const glm::dmat3& gradient) {
    return {gradient[0][0], gradient[1][0], gradient[2][0]};
}
double size_of(const glm::dmat3& gradient) {
    return glm::length(red(gradient));
}

/// A rectangle two units above the floor that shines down on it with radiance 1.
struct Lamp {
    double left = -1.0, right = 0.5, front = -0.6, back = 1.2;
    static constexpr double height = 2.0;

    std::array<Double3, 4> corners() const {
        return {Double3(left, front, height), Double3(left, back, height),
                Double3(right, back, height), Double3(right, front, height)};
    }
    SeenLight look(const Double3& from, const Double3& direction) const {
        const double t = (height - from.z) / direction.z;
        if (!(t > 0.0)) return {};
        const Double3 at = from + t * direction;
        const bool lit = left < at.x && at.x < right && front < at.y && at.y < back;
        return {.radiance = Double3(lit ? 1.0 : 0.0), .distance = t};
    }
    double irradiance(const Double3& from, const Double3& normal) const {
        return polygon_irradiance(from, normal, corners());
    }
};

/// Central differences of `irradiance` along the three axes.
template <class Function>
Double3 slope_of(const Function& irradiance) {
    constexpr double step = 1e-5;
    Double3 slope{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        Double3 along{0.0};
        along[axis] = step;
        slope[axis] = (irradiance(along) - irradiance(-along)) / (2.0 * step);
    }
    return slope;
}

}  // namespace

TEST_CASE("under an even sky irradiance is pi times it, and nothing changes with place or turn") {
    const Double3 radiance{0.25, 1.0, 3.0};
    for (const HemisphereGrid grid : {HemisphereGrid{1, 3}, {2, 4}, {8, 24}, {5, 17}}) {
        const Look look = [&](const Double3&, const Double3&) { return SeenLight{radiance, 2.0}; };
        const Double3 n = glm::normalize(Double3(1, -2, 0.5));
        const IrradianceRecord record = gather(look, grid, {1, 2, 3}, n);
        CHECK(glm::length(record.irradiance - std::numbers::pi * radiance) < 1e-13);
        CHECK(record.radius == Approx(2.0).epsilon(1e-14));
        CHECK(size_of(record.translation_gradient) < 1e-14);
        CHECK(size_of(record.rotation_gradient) < 1e-14);
        CHECK(record.position == Double3(1, 2, 3));
        CHECK(record.normal == n);
    }
}

TEST_CASE(
    "the mean distance is 3/2 below a plane, 3 pi/2 beside one, 0 on it, infinite below none") {
    const HemisphereGrid grid{.rings = 80, .sectors = 240};
    const auto mean_distance = [&](const Double3& n, double distance) {
        const Look look = [&](const Double3&, const Double3& direction) {
            const double t = distance / glm::dot(n, direction);
            return SeenLight{Double3(1.0), t >= 0.0 ? t : infinity};
        };
        const IrradianceRecord record = gather(look, grid);
        if (record.radius > 0.0 && record.radius < infinity)
            CHECK(record.nearest == Approx(distance).epsilon(0.01));
        return record.radius;
    };
    CHECK(mean_distance({0, 0, 1}, 1.0) == Approx(1.5).epsilon(1e-3));
    CHECK(mean_distance({1, 0, 0}, 1.0) == Approx(1.5 * std::numbers::pi).epsilon(1e-3));
    CHECK(mean_distance({0, 0, 1}, 0.0) == 0.0);
    CHECK(mean_distance({0, 0, -1}, 1.0) == infinity);
}

TEST_CASE("light closer than the smallest radius changes no faster than at that distance") {
    const HemisphereGrid grid{.rings = 4, .sectors = 12};
    const Look look = [](const Double3&, const Double3& direction) {
        return SeenLight{Double3(direction.x > 0.0), 0.0};
    };
    const IrradianceRecord record = gather(look, grid);
    CHECK(record.radius == 0.0);
    CHECK(std::isfinite(size_of(record.translation_gradient)));
    CHECK(size_of(record.translation_gradient) > 100.0);
}

TEST_CASE("below a lamp both gradients are the differences of Lambert's formula") {
    const Lamp lamp;
    const HemisphereGrid grid{.rings = sized(200, 60), .sectors = sized(640, 180)};
    const double tolerance = sized(0.01, 0.06);
    for (const Double3 from : {Double3(0, 0, 0), Double3(0.8, 0.3, 0), Double3(-1.5, 1.9, 0.5)}) {
        CAPTURE(from.x, from.y);
        const Look look = [&](const Double3& at, const Double3& d) { return lamp.look(at, d); };
        const IrradianceRecord record = gather(look, grid, from);
        CHECK(record.irradiance.x == Approx(lamp.irradiance(from, up)).epsilon(tolerance));

        Double3 move = slope_of([&](const Double3& d) { return lamp.irradiance(from + d, up); });
        move.z = 0.0;  // steps along the surface only
        CHECK(glm::length(red(record.translation_gradient) - move) <
              2.0 * tolerance * glm::length(move));

        const Double3 turn = slope_of([&](const Double3& axis) {
            return lamp.irradiance(from, glm::normalize(up + glm::cross(axis, up)));
        });
        CHECK(glm::length(red(record.rotation_gradient) - turn) < tolerance * glm::length(turn));
    }
}

TEST_CASE("the edge of a nearer shade moves over the lamp behind it, and the gradient knows") {
    const Lamp lamp;
    constexpr double edge = 0.1, shade_height = 1.0;  // it shades all that is left of the edge
    const auto visible = [&](const Double3& from) {
        Lamp rest = lamp;
        const double at_lamp = from.x + (edge - from.x) * Lamp::height / shade_height;
        rest.left = std::max(rest.left, at_lamp);
        return rest;
    };
    const Look look = [&](const Double3& from, const Double3& direction) {
        const double t = shade_height / direction.z;
        if (from.x + t * direction.x < edge) return SeenLight{Double3(0.0), t};
        return lamp.look(from, direction);
    };
    const HemisphereGrid grid{.rings = sized(200, 60), .sectors = sized(640, 180)};
    const Double3 from{0.2, 0.3, 0.0};
    const IrradianceRecord record = gather(look, grid, from);
    const double move = slope_of([&](Double3 d) {
                            d.z = 0.0;
                            return visible(from + d).irradiance(from + d, up);
                        }).x;
    const double without = slope_of([&](Double3 d) {
                               d.z = 0.0;
                               return visible(from).irradiance(
                                   from + d, up);  // the shade's edge stays where it is seen
                           }).x;
    CHECK(record.translation_gradient[0][0] == Approx(move).epsilon(sized(0.02, 0.08)));
    CHECK(std::abs(without - move) > 0.3 * std::abs(move));
}

TEST_CASE("gradients come nearer to Lambert's with finer grids") {
    const Lamp lamp;
    const Double3 from{0.8, 0.3, 0};
    const Look look = [&](const Double3& at, const Double3& d) { return lamp.look(at, d); };
    Double3 exact = slope_of([&](const Double3& d) { return lamp.irradiance(from + d, up); });
    exact.z = 0.0;
    std::vector<double> errors;
    for (const int rings : {4, 16, 64}) {
        double squares = 0.0;
        constexpr int seeds = 20;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const HemisphereGrid grid{.rings = rings, .sectors = 3 * rings};
            const auto record = gather(look, grid, from, up, seed);
            const Double3 error = red(record.translation_gradient) - exact;
            squares += glm::dot(error, error) / seeds;
        }
        errors.push_back(std::sqrt(squares));
    }
    CHECK(errors[1] < 0.7 * errors[0]);
    CHECK(errors[2] < 0.7 * errors[1]);
}

TEST_CASE("gradients turn with the normal: a rotated scene has the rotated gradients") {
    const Lamp lamp;
    const HemisphereGrid grid{.rings = 40, .sectors = 120};
    const Double3 n = glm::normalize(Double3(2, 1, -2));
    const Basis basis(n);
    const glm::dmat3 frame(basis.x, basis.y, basis.z);
    const Look look = [&](const Double3&, const Double3& d) {
        return lamp.look({0.8, 0.3, 0}, glm::transpose(frame) * d);
    };
    const Look upright = [&](const Double3& at, const Double3& d) { return lamp.look(at, d); };
    const IrradianceRecord turned = gather(look, grid, {5, 6, 7}, n);
    const IrradianceRecord plain = gather(upright, grid, {0.8, 0.3, 0});
    CHECK(glm::length(red(turned.translation_gradient) - frame * red(plain.translation_gradient)) <
          1e-12);
    CHECK(glm::length(red(turned.rotation_gradient) - frame * red(plain.rotation_gradient)) <
          1e-12);
}

TEST_CASE("noise in radiance makes noise in the gradient that falls with the root of the rays") {
    // Radiance 0 or 2 by chance from a plane above: nothing changes with place.
    const auto spread = [](int rings) {
        Pcg32 random(17);
        double squares = 0.0;
        constexpr int times = 100;
        for (int i = 0; i < times; ++i) {
            const Look look = [&](const Double3&, const Double3& d) {
                return SeenLight{Double3(random.next() >> 31 ? 2.0 : 0.0), 1.0 / d.z};
            };
            const double size = size_of(gather(look, {rings, 3 * rings}).translation_gradient);
            squares += size * size / times;
        }
        return std::sqrt(squares);
    };
    const double coarse = spread(4), fine = spread(16);  // sixteen times the rays
    CHECK(fine < 0.35 * coarse);
    CHECK(fine > 0.15 * coarse);
}

}  // namespace space
