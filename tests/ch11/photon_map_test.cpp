// The density estimate of a photon map: where the usual one fails (M1 to M4 of the failures that
// the book lists) and by how much, the cure, and what no cure here mends.
#include "chapters/ch11_sampling_and_caching/photon_map.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"
#include "tests/ch11/up.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace space {
namespace {

Photon photon_at(const Point3& position, const Vector3& normal = {0.0f, 0.0f, 1.0f}) {
    return {.position = position, .normal = normal, .power = Double3(1.0)};
}

/// Photons of power 1 on the plane z = 0, each at the same chance anywhere in the square of this
/// half side around the centre.
std::vector<Photon> even_photons(std::size_t count, std::uint64_t seed, double half = 1.0,
                                 const Double3& centre = Double3(0.0)) {
    Pcg32 random(seed, 11);
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = half * (2.0 * random.uniform_double() - 1.0);
        const double y = half * (2.0 * random.uniform_double() - 1.0);
        photons.push_back(photon_at(Point3(centre + Double3(x, y, 0.0))));
    }
    return photons;
}

double density(const PhotonMap& map, const DensityConfig& config, const Double3& at,
               const Double3& normal = up) {
    return DensityEstimator(map, config).irradiance(at, normal).x;
}

/// Of what `estimate(seed)` gives for seeds 1 .. count.
Mean mean_over(std::uint64_t count, const std::function<double(std::uint64_t)>& estimate) {
    Mean mean;
    for (std::uint64_t seed = 1; seed <= count; ++seed) mean.add(estimate(seed));
    return mean;
}

constexpr std::uint64_t seeds = sized(4'000, 200);

}  // namespace

TEST_CASE("M1: of 3 photons of 50 the usual density reaches to the farthest, 100 times too high") {
    const std::vector<Photon> three{photon_at({0.1f, 0, 0}), photon_at({0, 0.05f, 0}),
                                    photon_at({-0.03f, 0.02f, 0})};
    const PhotonMap map = PhotonMap::build(three);
    CHECK(plain_density(map, Point3(0.0f), 50, 1.0f).x == Approx(95.49).margin(0.01));
    CHECK(density(map, {.k = 50, .largest_radius = 1.0f}, Double3(0.0)) ==
          Approx(3.0 / std::numbers::pi));
    CHECK(density(map, {.k = 50, .largest_radius = 0.07f}, Double3(0.0)) ==
          Approx(2.0 / (std::numbers::pi * 0.0049)));
    CHECK(density(map, {.k = 50}, Double3(0.0)) == 0.0);  // three on an endless plane
}

TEST_CASE("M1: no photon in reach is no light, where the usual density divides 0 by 0") {
    const std::vector<Photon> one{photon_at({3.0f, 0, 0})};
    for (const auto& photons : {std::vector<Photon>{}, one}) {
        const PhotonMap map = PhotonMap::build(photons);
        CHECK(std::isnan(plain_density(map, Point3(0.0f), 50, 1.0f).x));
        CHECK(density(map, {.k = 50, .largest_radius = 1.0f}, Double3(0.0)) == 0.0);
        CHECK(density(map, {.k = 50, .largest_radius = 0.0f}, Double3(0.0)) == 0.0);
    }
}

TEST_CASE(
    "M2: of photons at one point the usual density is infinite; the smallest disc holds all") {
    for (const std::size_t count : {50u, 51u, 1000u})
        for (const Point3 at : {Point3(0.25f, -0.5f, 0.0f), Point3(0.0f)}) {
            const PhotonMap map = PhotonMap::build(std::vector<Photon>(count, photon_at(at)));
            const double r = map.smallest_radius();
            CHECK(std::isinf(plain_density(map, at, 50, 1.0f).x));
            CHECK(density(map, {.k = 50}, Double3(at)) ==
                  Approx(double(count) / (std::numbers::pi * r * r)));
        }
}

TEST_CASE("M2: far from the origin photons fall on one float; the smallest disc bounds the error") {
    // From 2^23 on floats are whole numbers: 4 photons on each point of a grid in the mean.
    constexpr double per_area = 4.0, half = 60.0;
    const Double3 centre{8'388'608.0 + 512.0, 8'388'608.0 + 512.0, 0.0};
    const auto count = static_cast<std::size_t>(per_area * 4.0 * half * half);
    const PhotonMap map = PhotonMap::build(even_photons(count, 1, half, centre));
    const double r = map.smallest_radius();
    REQUIRE(r + 4.0 < half);
    CHECK(std::isinf(plain_density(map, Point3(centre), 3, infinity).x));
    // By rounding (33 / 32)^2 - 1; and four times what chance does among 38,000 photons.
    for (int step = -4; step <= 4; ++step)
        CHECK(density(map, {.k = 3}, centre + Double3(step, 0.0, 0.0)) ==
              Approx(per_area).epsilon(0.0635 + 4.0 / std::sqrt(38'000.0)));
}

TEST_CASE(
    "M3: the usual density is k / (k - 1) times too high in the mean; k - 1 photons are not") {
    // Of n photons in the unit of area the k-th nearest has a disc of area Beta(k, n - k + 1),
    // whose reciprocal has the mean n / (k - 1).
    constexpr std::size_t k = 10;
    constexpr std::uint64_t enough = 2'000;  // for five errors to be half of the bias
    const auto map_of = [](std::uint64_t seed) {
        return PhotonMap::build(even_photons(500, seed, 0.5));
    };
    const Mean plain = mean_over(enough, [&](std::uint64_t seed) {
        return plain_density(map_of(seed), Point3(0.0f), k, infinity).x;
    });
    const Mean cured = mean_over(
        enough, [&](std::uint64_t seed) { return density(map_of(seed), {.k = k}, Double3(0.0)); });
    CAPTURE(plain.mean(), plain.error(), cured.mean(), cured.error());
    CHECK(plain.agrees_with(500.0 * k / (k - 1)));
    CHECK_FALSE(plain.agrees_with(500.0));
    CHECK(cured.agrees_with(500.0));
    CHECK_FALSE(cured.agrees_with(500.0 * k / (k - 1)));
}

TEST_CASE("even light is estimated without bias for every k and every largest disc") {
    for (const std::size_t k : {2u, 3u, 10u, 50u})
        for (const double expected : {0.5, 2.0, 10.0, 45.0}) {  // photons in the largest disc
            const auto r = static_cast<float>(std::sqrt(expected / (200.0 * std::numbers::pi)));
            const Mean mean = mean_over(seeds / 2, [&](std::uint64_t seed) {
                const PhotonMap map = PhotonMap::build(even_photons(200, 7 * seed + k, 0.5));
                return density(map, {.k = k, .largest_radius = r}, Double3(0.0));
            });
            CAPTURE(k, expected, mean.mean(), mean.error());
            CHECK(mean.agrees_with(200.0));
        }
}

TEST_CASE("even light is estimated without bias where the smallest disc decides, now and then") {
    const Double3 centre{100'000.0, 0.0, 0.0};
    const double r = PhotonMap::build(even_photons(1, 1, 0.0, centre)).smallest_radius();
    const double half = 4.0 * r, per_area = 4.0 / (std::numbers::pi * r * r);
    const auto count = static_cast<std::size_t>(per_area * 4.0 * half * half);
    std::uint64_t smallest = 0, found = 0;
    const Mean mean = mean_over(seeds, [&](std::uint64_t seed) {
        const PhotonMap map = PhotonMap::build(even_photons(count, seed, half, centre));
        DensityEstimator estimator(map, {.k = 5});
        const double square = estimator.disc_around(Point3(centre)).squared_radius;
        smallest += square < 1.01 * r * r;
        found += square > 1.01 * r * r;
        return estimator.irradiance(centre, up).x * 4.0 * half * half / double(count);
    });
    CAPTURE(mean.mean(), mean.error(), smallest, found);
    CHECK(mean.agrees_with(1.0));
    CHECK(smallest > seeds / 5);
    CHECK(found > seeds / 5);
}

namespace {

/// A balanced k-d tree as a photon map's is often written: a median by nth_element, equal
/// coordinates on both sides, and a search that goes to the other side only where it is strictly
/// nearer than the radius.
struct BalancedTree {
    std::vector<Point3> points;

    explicit BalancedTree(std::vector<Point3> all) : points(std::move(all)) {
        build(0, points.size());
    }
    std::size_t within(const Point3& query, float radius) const {
        return within(0, points.size(), query, radius * radius);
    }

  private:
    static std::size_t middle(std::size_t first, std::size_t last) {
        return first + (last - first) / 2;
    }
    int axis(std::size_t first, std::size_t last) const {
        Aabb box;
        for (std::size_t i = first; i < last; ++i) box.extend(points[i]);
        return box.longest_axis();
    }
    void build(std::size_t first, std::size_t last) {
        if (last - first < 2) return;
        const int a = axis(first, last);
        const auto at = [&](std::size_t i) { return points.begin() + std::ptrdiff_t(i); };
        std::nth_element(at(first), at(middle(first, last)), at(last),
                         [a](const Point3& p, const Point3& q) { return p[a] < q[a]; });
        build(first, middle(first, last));
        build(middle(first, last) + 1, last);
    }
    std::size_t within(std::size_t first, std::size_t last, const Point3& query,
                       float square) const {
        if (first == last) return 0;
        const std::size_t m = middle(first, last);
        const int a = axis(first, last);
        const float delta = query[a] - points[m][a];
        const Vector3 away = query - points[m];
        std::size_t found = glm::dot(away, away) <= square;
        if (delta < 0.0f || delta * delta < square) found += within(first, m, query, square);
        if (delta >= 0.0f || delta * delta < square) found += within(m + 1, last, query, square);
        return found;
    }
};

}  // namespace

TEST_CASE("M4: of 30 equal photons a balanced tree searched with < finds 4 or 5; ours all") {
    const std::vector<Point3> equal(30, Point3(1.0f, 0.0f, 0.0f));
    for (const Point3 query : {Point3(1, 0, 0), Point3(0, 0, 0), Point3(2, 0, 0)}) {
        const float radius = std::abs(query.x - 1.0f);  // of the closed ball
        std::vector<Neighbour> found;
        within_radius<3>(KdPoints<3>::build(equal), query, radius, found);
        CHECK(BalancedTree(equal).within(query, radius) == (query.x < 1.0f ? 5 : 4));
        CHECK(BalancedTree(equal).within(query, radius + 0.01f) == 30);
        CHECK(found.size() == 30);
        CHECK(k_nearest<3>(KdPoints<3>::build(equal), query, 30).back().squared_distance ==
              double(radius * radius));
    }
}

TEST_CASE("photons of a wall and of the back are left out, and the floor's mean stays right") {
    const auto map_of = [](std::uint64_t seed) {
        std::vector<Photon> photons = even_photons(200, seed, 0.5);
        for (const Photon& photon : even_photons(800, seed + 100'000, 0.5)) {
            const Point3 p = photon.position;
            photons.push_back(photon_at({0.03f, p.x, p.y}, {-1, 0, 0}));       // a wall
            photons.push_back(photon_at({p.x, p.y, -0.001f}, {0, 0, -1}));     // the floor's back
            if (p.x < 0.0f) photons.push_back(photon_at({p.x, p.y, -0.02f}));  // a step below
        }
        return PhotonMap::build(photons);
    };
    const Mean plain = mean_over(seeds / 4, [&](std::uint64_t seed) {
        return density(map_of(seed), {.k = 10, .only_own_surface = false}, Double3(0.0));
    });
    const Mean cured = mean_over(seeds / 4, [&](std::uint64_t seed) {
        return density(map_of(seed), {.k = 10}, Double3(0.0));
    });
    CAPTURE(plain.mean(), plain.error(), cured.mean(), cured.error());
    CHECK(plain.mean() > 5.0 * 200.0);
    CHECK(cured.agrees_with(200.0));
}

TEST_CASE("what stays: at a floor's edge half of the light, behind a thin wall's foot as much") {
    // Photons on x < 0 only. The disc around a point of the edge is half empty, and one around a
    // point beyond it that is nearer than the disc's radius finds light where there is none.
    const auto map_of = [](std::uint64_t seed) {
        std::vector<Photon> photons = even_photons(400, seed, 0.5);
        std::erase_if(photons, [](const Photon& photon) { return photon.position.x >= 0.0f; });
        return PhotonMap::build(photons);
    };
    const auto mean_at = [&](double x) {
        return mean_over(seeds / 4, [&](std::uint64_t seed) {
            return density(map_of(seed), {.k = 10, .largest_radius = 0.2f}, {x, 0, 0});
        });
    };
    const Mean edge = mean_at(0.0), beyond = mean_at(0.02), far = mean_at(0.21);
    CAPTURE(edge.mean(), edge.error(), beyond.mean(), far.mean());
    CHECK(edge.agrees_with(200.0));
    CHECK(beyond.mean() > 0.25 * 400.0);
    CHECK(far.mean() == 0.0);  // the largest radius is how far light can leak
}

TEST_CASE("a map keeps every photon once, whatever their number, and its tree names them") {
    for (const std::size_t count : {0u, 1u, 8u, 9u, 1000u}) {
        std::vector<Photon> photons = even_photons(count, 5);
        for (std::size_t i = 0; i < count; ++i) {
            photons[i].power.x = double(i);
            photons[i].path = i % 3 == 0 ? PhotonPath::caustic : PhotonPath::indirect;
        }
        const PhotonMap map = PhotonMap::build(photons);
        REQUIRE(map.photons.size() == count);
        std::vector<bool> seen(count);
        for (std::uint32_t slot = 0; slot < count; ++slot) {
            const auto index = std::size_t(map.photons[slot].power.x);
            CHECK(map.photons[slot] == photons[index]);
            CHECK(map.photons[map.tree.index(slot)].position == map.tree.point(slot));
            seen[index] = true;
        }
        CHECK(std::ranges::count(seen, true) == std::ptrdiff_t(count));
        CHECK(PhotonMap::build(photons, PhotonPath::caustic).photons.size() == (count + 2) / 3);
    }
}

TEST_CASE("fewer than 2 photons, or a radius that is none, are refused") {
    const PhotonMap map;
    CHECK_THROWS_AS(DensityEstimator(map, {.k = 1}), std::invalid_argument);
    CHECK_THROWS_AS(DensityEstimator(map, {.largest_radius = -1.0f}), std::invalid_argument);
    CHECK_THROWS_AS(DensityEstimator(map, {.largest_radius = std::nanf("")}),
                    std::invalid_argument);
}

}  // namespace space
