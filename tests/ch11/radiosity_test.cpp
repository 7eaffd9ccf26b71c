#include "chapters/ch11_sampling_and_caching/radiosity.hpp"

#include "tests/check.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace space;

namespace {

/// A room of the size a x b x c with these reflectances: floor, ceiling, walls at x = 0, x = a, y =
/// 0, y = b.
std::vector<Wall> room(double a, double b, double c, const std::array<double, 6>& reflectances) {
    const Double3 x{a, 0, 0}, y{0, b, 0}, z{0, 0, c}, o{0.0};
    return {{{o, x, y}, reflectances[0]}, {{z, y, x}, reflectances[1]},
            {{o, y, z}, reflectances[2]}, {{x, z, y}, reflectances[3]},
            {{o, z, x}, reflectances[4]}, {{y, x, z}, reflectances[5]}};
}

const std::array<double, 6> colourful{0.5, 0.7, 0.6, 0.2, 0.8, 0.5};

/// The ceiling in nine parts, of which the one in the middle shines.
std::vector<Wall> room_with_lamp() {
    std::vector<Wall> walls = room(3, 2, 1.5, colourful);
    const Wall ceiling = walls[1];
    walls.erase(walls.begin() + 1);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Double3 u = ceiling.shape.u / 3.0, v = ceiling.shape.v / 3.0;
            walls.push_back({{ceiling.shape.corner + double(i) * u + double(j) * v, u, v},
                             ceiling.reflectance,
                             i == 1 && j == 1 ? 5.0 : 0.0});
        }
    return walls;
}

/// What all walls send out themselves, and what they do not reflect.
void balance(std::span<const Wall> walls, int cuts) {
    const Patches patches = cut_walls(walls, cuts);
    const std::vector<double> radiance = patch_radiances(patches, walls);
    double sent = 0.0, kept = 0.0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const Wall& wall = walls[patches.wall[i]];
        sent += patches.shapes[i].area() * wall.emission;
        double arriving = 0.0;
        for (std::size_t j = 0; j < radiance.size(); ++j)
            arriving += patches.form_factor(i, j) * radiance[j];
        kept += patches.shapes[i].area() * (1.0 - wall.reflectance) * arriving;
    }
    CHECK(kept == Approx(sent).epsilon(1e-11));
}

}  // namespace

TEST_CASE("a white furnace: L = E + r L") {
    CHECK(furnace_radiance(0.25, 0.75) == 1.0);
    CHECK(furnace_radiance(1.0, 0.5) == 2.0);
    CHECK(furnace_radiance(3.0, 0.0) == 3.0);
}

TEST_CASE("all light of a patch comes to the others: rows of form factors add up to 1") {
    for (const auto& walls : {room(1, 1, 1, colourful), room(3, 2, 1.5, colourful),
                              room(0.1, 20, 5, colourful), room_with_lamp()})
        for (const int cuts : {1, 2, 4}) {
            const Patches patches = cut_walls(walls, cuts);
            const std::size_t n = patches.shapes.size();
            for (std::size_t i = 0; i < n; ++i) {
                double sum = 0.0;
                for (std::size_t j = 0; j < n; ++j) {
                    CAPTURE(cuts, i, j);
                    if (!(patches.form_factor(i, j) >= -1e-10)) {
                        FAIL("a negative form factor");
                    }
                    sum += patches.form_factor(i, j);
                }
                CAPTURE(cuts, i);
                REQUIRE(sum == Approx(1.0).epsilon(1e-9));
            }
        }
}

TEST_CASE("a furnace whose walls differ, but for E = 1 - r, is white all the same") {
    for (auto walls : {room(1, 1, 1, colourful), room(3, 2, 1.5, colourful), room_with_lamp()}) {
        for (Wall& wall : walls) wall.emission = 1.0 - wall.reflectance;
        for (const double radiance : patch_radiances(cut_walls(walls, 2), walls))
            REQUIRE(radiance == Approx(1.0).epsilon(1e-11));
        for (const WallRadiance& wall : wall_radiances(walls, 1))
            REQUIRE(wall.radiance == Approx(1.0).epsilon(1e-11));
    }
}

TEST_CASE("a cube of six patches, solved by hand") {
    std::vector<Wall> walls = room(1, 1, 1, {0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
    walls[1].emission = 1.0;
    // Ceiling c, floor f, sides s; F across, G = (1 - F) / 4 around an edge. By symmetry
    // c - f = 1 - F (c - f) / 2, s = (G (c + f) + (2 G + F) s) / 2, c + f = 1 + (8 G s + F (c + f))
    // / 2.
    const double F = 0.199824895698, G = (1 - F) / 4;
    const double difference = 1 / (1 + F / 2);
    const double sum = 1 / (1 - F / 2 - 4 * G * G / (2 - 2 * G - F));
    const double side = G * sum / (2 - 2 * G - F);
    const std::vector<double> radiance = patch_radiances(cut_walls(walls, 1), walls);
    CHECK(radiance[0] == Approx((sum - difference) / 2).epsilon(1e-10));
    CHECK(radiance[1] == Approx((sum + difference) / 2).epsilon(1e-10));
    for (std::size_t i = 2; i < 6; ++i) CHECK(radiance[i] == Approx(side).epsilon(1e-10));
}

TEST_CASE("what is sent out is kept somewhere") {
    auto walls = room(3, 2, 1.5, colourful);
    walls[1].emission = 2.0;
    walls[2].emission = 0.5;
    balance(walls, 3);
    balance(room_with_lamp(), 2);
}

TEST_CASE("in a black room the light of the lamp alone arrives") {
    auto walls = room(1, 1, 1, {0, 0, 0, 0, 0, 0});
    walls[1].emission = 1.0;
    const Patches patches = cut_walls(walls, 2);
    const std::vector<double> radiance = patch_radiances(patches, walls);
    // By Lambert's formula, in the middle below a unit square at the distance 1.
    const double far = std::sqrt(1.25);
    CHECK(room_irradiance(patches, radiance, {0.5, 0.5, 0}, {0, 0, 1}) ==
          Approx(4 * 0.5 / far * std::atan(0.5 / far)).epsilon(1e-12));
    const std::vector<WallRadiance> means = wall_radiances(walls, 1);
    CHECK(means[1].radiance == 1.0);
    for (const std::size_t i : {0u, 2u, 3u, 4u, 5u}) CHECK(means[i].radiance == 0.0);
}

TEST_CASE("the exchange is symmetric, and its diagonal grows with the cuts") {
    const auto walls = room(3, 2, 1.5, colourful);
    std::vector<double> before;
    for (const int cuts : {1, 2, 4}) {
        const std::vector<double> exchange = wall_exchange(walls, cuts);
        for (std::size_t k = 0; k < 6; ++k) {
            for (std::size_t l = 0; l < k; ++l)
                REQUIRE(exchange[k * 6 + l] == Approx(exchange[l * 6 + k]).epsilon(1e-11));
            CAPTURE(cuts, k);
            if (!before.empty()) {
                REQUIRE(exchange[k * 6 + k] > before[k * 6 + k]);
            }
        }
        before = exchange;
    }
}

TEST_CASE("with each doubling of the cuts the diagonal changes by less than half as much") {
    // Which is what the bound takes for certain; from one patch a wall to four it is not yet so.
    const auto walls = room(3, 2, 1.5, colourful);
    std::vector<std::vector<double>> levels;
    for (int cuts = 2; cuts <= 8; cuts *= 2) levels.push_back(wall_exchange(walls, cuts));
    for (std::size_t level = 2; level < levels.size(); ++level)
        for (std::size_t i = 0; i < 36; i += 7) {
            const double last = levels[level][i] - levels[level - 1][i];
            const double before = levels[level - 1][i] - levels[level - 2][i];
            CAPTURE(level, i, last, before);
            CHECK(last < before / 2);
        }
}

TEST_CASE("finer cuts stay within the bounds of coarser ones") {
    auto walls = room(1, 1, 1, colourful);
    walls[1].emission = 1.0;
    const std::vector<WallRadiance> fine = wall_radiances(walls, 4);
    for (const int cuts : {1, 2}) {
        const std::vector<WallRadiance> coarse = wall_radiances(walls, cuts);
        for (std::size_t k = 0; k < 6; ++k) {
            CAPTURE(cuts, k);
            CHECK(std::abs(fine[k].radiance - coarse[k].radiance) < coarse[k].error);
            CHECK(fine[k].error < 0.5 * coarse[k].error);
        }
    }
    CHECK(fine[0].error < 0.03 * fine[0].radiance);
}

TEST_CASE("a brighter wall brightens all, and none darkens") {
    auto walls = room(3, 2, 1.5, colourful);
    walls[1].emission = 1.0;
    const auto before = wall_radiances(walls, 1);
    walls[0].reflectance = 0.9;
    const auto after = wall_radiances(walls, 1);
    for (std::size_t k = 0; k < 6; ++k) CHECK(after[k].radiance > before[k].radiance);
}

TEST_CASE("the irradiance of points adds up to that of their patch") {
    const auto walls = room_with_lamp();
    const Patches patches = cut_walls(walls, 2);
    const std::vector<double> radiance = patch_radiances(patches, walls);
    for (const std::size_t i : {std::size_t{1}, std::size_t{6}}) {
        const Rectangle& patch = patches.shapes[i];
        double mean = 0.0, exact = 0.0;
        const int n = 20;
        for (int x = 0; x < n; ++x)
            for (int y = 0; y < n; ++y)
                mean += room_irradiance(
                            patches, radiance,
                            patch.corner + patch.u * ((x + 0.5) / n) + patch.v * ((y + 0.5) / n),
                            glm::normalize(glm::cross(patch.u, patch.v))) /
                        (n * n);
        for (std::size_t j = 0; j < radiance.size(); ++j)
            exact += std::numbers::pi * patches.form_factor(i, j) * radiance[j];
        CHECK(mean == Approx(exact).epsilon(1e-3));
    }
}
