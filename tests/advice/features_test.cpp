// What is seen of a scene, by hand and by symmetry; and the regression that reads it.
#include "chapters/ch12_comparison/ridge.hpp"
#include "chapters/ch12_comparison/scene_features.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace space;

namespace {

/// A right triangle in a plane z = const., of legs `size`.
Triangle corner_at(Point3 p, float size) {
    return {p, p + Vector3(size, 0, 0), p + Vector3(0, size, 0)};
}

/// Coordinates are multiples of 2^-12: moved by some powers of two they are still floats.
std::vector<Triangle> gritty_soup(std::size_t count) {
    Pcg32 random(5);
    const auto number = [&](std::uint32_t below) {
        return static_cast<float>(random.below(below)) * 0x1p-12f;
    };
    std::vector<Triangle> soup;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t size = 1u << (2 + random.below(9));
        std::array<Point3, 3> p;
        for (int axis = 0; axis < 3; ++axis) {
            const float at = number(4096);
            for (Point3& corner : p) corner[axis] = at + number(size);
        }
        soup.push_back({p[0], p[1], p[2]});
    }
    return soup;
}

std::vector<Triangle> moved(std::vector<Triangle> triangles, float scale, Vector3 by) {
    for (Triangle& t : triangles) t = {scale * t.a + by, scale * t.b + by, scale * t.c + by};
    return triangles;
}

bool all_in_range(const SceneFeatures& f) {
    return f.count >= 0 && f.count < 64 && f.overlap >= 0 && f.overlap <= f.count + 1.01 &&
           f.spread >= 0 && f.spread <= 24 && f.alignment >= 0 && f.alignment <= 1 &&
           f.emptiness >= 0 && f.emptiness < 1 && f.slenderness >= 0 && f.slenderness <= 24;
}

}  // namespace

TEST_CASE("the features of one right triangle are those worked out by hand") {
    const SceneFeatures f = features_of(std::vector{corner_at({1, 2, 3}, 2.0f)});
    CHECK(values(f) == std::array{0.0, 1.0, 0.0, 1.0, 0.0, 1.0});
    // Out of all axis planes, and with sides of sqrt(2): an equilateral triangle.
    const SceneFeatures g = features_of(std::vector<Triangle>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    CHECK(g.alignment == 0.0);
    CHECK(g.slenderness == Approx(std::log2(2.0 / std::sqrt(3.0))));
}

TEST_CASE("the features of the page's three triangles are those of the page") {
    const std::vector<Triangle> three{corner_at({0, 0, 0}, 1.0f), corner_at({1, 1, 0}, 1.0f),
                                      corner_at({0, 0, 0}, 2.0f)};
    const SceneFeatures f = features_of(three);
    CHECK(values(f) == std::array{std::log2(3.0), std::log2(2.5), 1.0, 1.0, 0.0, 1.0});
}

TEST_CASE("overlap counts the boxes that a random line meets") {
    // Seven times the same box, which is the scene's.
    const std::vector<Triangle> pile(7, corner_at({0, 0, 0}, 1.0f));
    CHECK(features_of(pile).overlap == 3.0);
    // Two in opposite corners of a square: each box has a quarter of its area.
    const std::vector<Triangle> apart{corner_at({0, 0, 0}, 1.0f), corner_at({1, 1, 0}, 1.0f)};
    CHECK(features_of(apart).overlap == std::log2(1.5));
}

TEST_CASE("spread is from the median to the largest") {
    const std::vector<Triangle> two_small{corner_at({0, 0, 0}, 1.0f), corner_at({5, 0, 0}, 1.0f),
                                          corner_at({0, 0, 0}, 8.0f)};
    CHECK(features_of(two_small).spread == 3.0);
    const std::vector<Triangle> two_large{corner_at({0, 0, 0}, 8.0f), corner_at({5, 0, 0}, 8.0f),
                                          corner_at({0, 0, 0}, 1.0f)};
    CHECK(features_of(two_large).spread == 0.0);
    // Points have no size: the median is taken as 2^-24 of the scene.
    const Triangle point{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    CHECK(features_of(std::vector{point, point, corner_at({0, 0, 0}, 1.0f)}).spread == 24.0);
}

TEST_CASE("emptiness is the share of empty cells") {
    std::vector<Triangle> eight;
    for (int i = 0; i < 8; ++i)
        eight.push_back(
            corner_at({3.0f * float(i & 1), 3.0f * float(i >> 1 & 1), 3.0f * float(i >> 2)}, 1.0f));
    CHECK(features_of(eight).emptiness == 0.0);
    for (int i = 1; i < 7; ++i) eight[static_cast<std::size_t>(i)] = eight[0];
    CHECK(features_of(eight).emptiness == 0.75);
    // In a plane there are 2 x 2 cells for seven triangles, on a line seven.
    const std::vector<Triangle> pile(7, corner_at({0, 0, 0}, 1.0f));
    CHECK(features_of(pile).emptiness == 0.75);
    std::vector<Segment> row;
    for (int i = 0; i < 7; ++i) row.push_back({{float(i), 0.0f}, {float(i) + 0.5f, 0.0f}});
    CHECK(features_of<2>(row).emptiness == 0.0);
    row[3] = row[4];
    CHECK(features_of<2>(row).emptiness == Approx(1.0 / 7.0));
}

TEST_CASE("slenderness is the median of length by height") {
    const std::vector<Triangle> one{{{0, 0, 0}, {16, 0, 0}, {3, 0, 1}}};
    CHECK(features_of(one).slenderness == 4.0);
    const std::vector<Triangle> line{{{0, 0, 0}, {16, 0, 0}, {3, 0, 0}}};
    CHECK(features_of(line).slenderness == 24.0);
    const std::vector<Triangle> hair{{{0, 0, 0}, {0x1p30f, 0, 0}, {3, 0, 0x1p-10f}}};
    CHECK(features_of(hair).slenderness == 24.0);
}

TEST_CASE("neither order nor scale nor place changes a feature, in any bit") {
    const std::vector<Triangle> soup = gritty_soup(sized(20'000, 2'000));
    const SceneFeatures f = features_of(soup);
    CHECK(all_in_range(f));
    CHECK(f.spread > 0.0);
    CHECK(f.emptiness > 0.0);
    std::vector<Triangle> shuffled = soup;
    Pcg32 random(6);
    for (std::size_t i = shuffled.size(); i > 1; --i)
        std::swap(shuffled[i - 1], shuffled[random.below(static_cast<std::uint32_t>(i))]);
    CHECK(values(features_of(shuffled)) == values(f));
    for (const float scale : {0x1p-40f, 0.5f, 0x1p30f})
        CHECK(values(features_of(moved(soup, scale, Vector3(0)))) == values(f));
    CHECK(values(features_of(moved(soup, 1.0f, {64, -512, 8}))) == values(f));
    // A third is not a power of two: nearly the same.
    const auto x = values(f), third = values(features_of(moved(soup, 1.0f / 3.0f, Vector3(0))));
    for (std::size_t j = 0; j < x.size(); ++j) CHECK(third[j] == Approx(x[j]).margin(0.01));
}

TEST_CASE("what is empty, broken or huge has features in their ranges") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float most = std::numeric_limits<float>::max(), least = 1e-45f;
    const Triangle broken{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        endless{{0, 0, 0}, {infinity, 0, 0}, {0, 1, 0}}, point{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    const std::array<double, 6> nothing{};
    CHECK(values(features_of(std::vector<Triangle>{})) == nothing);
    CHECK(values(features_of(std::vector{broken, endless})) == nothing);
    CHECK(values(features_of(std::vector{point, point, broken})) ==
          std::array{1.0, 0.0, 0.0, 0.0, 0.0, 24.0});
    CHECK(values(features_of(std::vector{broken, corner_at({1, 2, 3}, 2.0f), endless})) ==
          values(features_of(std::vector{corner_at({1, 2, 3}, 2.0f)})));
    const std::vector<Triangle> huge{{{-most, -most, -most}, {most, most, most}, {most, -most, 0}},
                                     {{0, 0, 0}, {least, 0, 0}, {0, least, 0}},
                                     {{most, most, most}, {most, most, most}, {0, 0, 0}}};
    CHECK(all_in_range(features_of(huge)));
    CHECK(all_in_range(features_of(std::vector<Triangle>(5, huge[1]))));
}

TEST_CASE("regression finds the model that made the data") {
    Pcg32 random(7);
    std::vector<std::vector<double>> rows;
    std::vector<double> y;
    for (int i = 0; i < 40; ++i) {
        std::vector<double> row;
        for (int j = 0; j < 4; ++j) row.push_back(random.uniform_double() * std::ldexp(1.0, 3 * j));
        y.push_back(2.5 - 3.0 * row[0] + 0.5 * row[1] + 0.125 * row[3]);
        rows.push_back(row);
    }
    const auto fit = [&](double penalty) {
        return fit_ridge(rows, y, std::vector<double>(4, penalty));
    };
    const LinearModel exact = fit(0.0);
    CHECK(exact.intercept == Approx(2.5));
    CHECK(exact.weights[0] == Approx(-3.0));
    CHECK(exact.weights[1] == Approx(0.5));
    CHECK(exact.weights[2] == Approx(0.0).margin(1e-12));
    CHECK(exact.weights[3] == Approx(0.125));
    // The larger the penalty the smaller the weights, down to the mean.
    const LinearModel some = fit(1.0), all = fit(1e12);
    CHECK(std::abs(some.weights[0]) < 3.0);
    CHECK(std::abs(some.weights[0]) > 1.0);
    double mean = 0.0;
    for (const double value : y) mean += value / 40.0;
    CHECK(all(rows[3]) == Approx(mean));
}

TEST_CASE("columns that say nothing, or nothing new, do no harm") {
    Pcg32 random(8);
    std::vector<std::vector<double>> rows;
    std::vector<double> y;
    for (int i = 0; i < 30; ++i) {
        const double a = random.uniform_double();
        const double b = random.uniform_double();
        rows.push_back({a, 0.1, b, a + b, 0.0});  // 0.1 is no sum of powers of two: its mean is off
        y.push_back(1.0 + 2.0 * a + 3.0 * b);
    }
    for (const double penalty : {0.0, 1e-6}) {
        const LinearModel model = fit_ridge(rows, y, std::vector<double>(5, penalty));
        CHECK(model.weights[1] == 0.0);
        CHECK(model.weights[4] == 0.0);
        for (std::size_t i = 0; i < rows.size(); ++i)
            CHECK(model(rows[i]) == Approx(y[i]).epsilon(1e-5));
    }
    // One row says no more than its own value.
    const LinearModel single =
        fit_ridge(std::span(rows).first(1), std::span(y).first(1), std::vector<double>(5));
    CHECK(single(rows[1]) == y[0]);
}
