#include "ex03_front_under_a_mirror.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <glm/matrix.hpp>

#include <cmath>
#include <utility>
#include <vector>

using namespace space;

namespace {

using Path = std::vector<glm::dmat3>;

glm::dmat3 diagonal(double x, double y, double z) {
    return {Double3(x, 0, 0), Double3(0, y, 0), Double3(0, 0, z)};
}
/// x goes to y, y to -x.
const glm::dmat3 quarter(Double3(0, 1, 0), Double3(-1, 0, 0), Double3(0, 0, 1));
const glm::dmat3 half = diagonal(-1, -1, 1);
/// x and y change places.
const glm::dmat3 swapped(Double3(0, 1, 0), Double3(1, 0, 0), Double3(0, 0, 1));

/// Its front looks up.
const Triangle flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

Triangle placed(const Triangle& local, const Path& path) {
    const auto through = [&](const Point3& p) {
        Double3 q(p);
        for (std::size_t i = path.size(); i-- > 0;) q = path[i] * q;
        return Point3(q);
    };
    return {through(local.a), through(local.b), through(local.c)};
}

/// Looks from the image of a point above the triangle, and of one below it.
void check_sides(const Triangle& local, const Path& path) {
    const Triangle world = placed(local, path);
    Double3 up = normal(local);
    for (std::size_t i = path.size(); i-- > 0;) up = path[i] * up;
    const Vector3 down_on_it(-up);
    REQUIRE(glm::dot(normal(world), Double3(down_on_it)) != 0.0);
    REQUIRE(sees_front(down_on_it, world, path));
    REQUIRE(!sees_front(-down_on_it, world, path));

    const Triangle front = with_front_restored(world, path);
    REQUIRE(front.a == world.a);
    REQUIRE(
        ((front.b == world.b && front.c == world.c) || (front.b == world.c && front.c == world.b)));
    REQUIRE(glm::dot(normal(front), Double3(down_on_it)) < 0.0);
}

}  // namespace

TEST_CASE("without a matrix the plain rule holds") {
    check_sides(flat, {});
    REQUIRE(with_front_restored(flat, {}) == flat);
}

TEST_CASE("turning and stretching change nothing") {
    check_sides(flat, {quarter});
    check_sides(flat, {diagonal(2, 3, 4)});
    check_sides(flat, {quarter, diagonal(2, 3, 4), quarter});
    REQUIRE(with_front_restored(flat, Path{quarter}) == flat);
}

TEST_CASE("one mirror turns the winding, whichever axis it is across") {
    check_sides(flat, {diagonal(-1, 1, 1)});
    check_sides(flat, {diagonal(1, -1, 1)});
    check_sides(flat, {diagonal(1, 1, -1)});
    REQUIRE(with_front_restored(flat, Path{diagonal(-1, 1, 1)}) ==
            Triangle{flat.a, flat.c, flat.b});
}

TEST_CASE("two negative scales are half a turn, three are a mirror") {
    check_sides(flat, {diagonal(-1, -1, 1)});
    check_sides(flat, {diagonal(-2, 1, -3)});
    check_sides(flat, {diagonal(-1, -1, -1)});
}

TEST_CASE("a mirror without a negative number on the diagonal, and a turn with two") {
    check_sides(flat, {swapped});
    check_sides(flat, {half});
    check_sides(flat, {swapped, half});
    check_sides(flat, {glm::dmat3(Double3(1, 2, 0), Double3(2, 1, 0), Double3(0, 0, 1))});
}

TEST_CASE("a mirror anywhere on the path counts, and two of them cancel") {
    const glm::dmat3 mirror = diagonal(-1, 1, 1);
    check_sides(flat, {mirror, quarter, quarter});
    check_sides(flat, {quarter, mirror, quarter});
    check_sides(flat, {quarter, quarter, mirror});
    check_sides(flat, {mirror, quarter, mirror});
    check_sides(flat, {mirror, mirror, swapped, mirror, mirror});
}

TEST_CASE("a ray that comes at a slant sees the same side") {
    const Path path{diagonal(1, 1, -1)};  // flat's front looks down now
    const Triangle world = placed(flat, path);
    REQUIRE(sees_front({5, -3, 0.125f}, world, path));
    REQUIRE(!sees_front({5, -3, -0.125f}, world, path));
}

TEST_CASE("no path is too long, no scale too small or too large") {
    for (const double scale : {1e-40, 1e40})
        for (const auto& [mirrors, at_end] : {std::pair(0u, false),
                                              {1u, false},
                                              {1u, true},
                                              {2u, false},
                                              {7u, false},
                                              {7u, true}}) {
            Path path;
            for (std::size_t i = 0; i < 100; ++i) {
                const bool mirrors_now = at_end ? i >= 100 - mirrors : i < mirrors;
                path.push_back(diagonal(mirrors_now ? -scale : scale, scale, scale));
                path.push_back(diagonal(1 / scale, 1 / scale, 1 / scale));
            }
            CAPTURE(scale, mirrors, at_end);
            check_sides(flat, path);
            Path sorted;  // first all that shrinks, then all that grows: it ends at 1, too
            for (std::size_t i = 0; i < 200; i += 2) sorted.push_back(path[i]);
            Triangle world = mirrors % 2 ? Triangle{{0, 0, 0}, {-1, 0, 0}, {0, 1, 0}} : flat;
            for (std::size_t i = 1; i < 200; i += 2) sorted.push_back(path[i]);
            REQUIRE(sees_front({0, 0, -1}, world, sorted));
            REQUIRE(!sees_front({0, 0, 1}, world, sorted));
        }
}

TEST_CASE("a ray that grazes the triangle, a triangle that is tiny, and a sliver have sides, too") {
    const Path path{diagonal(1, 1, -1)};
    const Triangle turned = placed(flat, path);
    REQUIRE(sees_front({1, 0, 0x1p-30f}, turned, path));
    REQUIRE(!sees_front({1, 0, -0x1p-30f}, turned, path));
    const Path small{diagonal(0x1p-40, 0x1p-40, -0x1p-40)};
    const Triangle tiny = placed(flat, small);
    REQUIRE(sees_front({0, 0, 0x1p-10f}, tiny, small));
    REQUIRE(!sees_front({0, 0, -0x1p-10f}, tiny, small));
    const Triangle sliver{{0, 0, 0}, {8193, 8192, 0}, {8192, 8191, 0}};  // its normal is (0, 0, -1)
    check_sides(sliver, {});
    check_sides(sliver, {swapped});
}

TEST_CASE("no path is too long for scales that differ by axis") {
    // Not one of the determinants is far from 1. But a product of the first half has entries
    // from 10^-4000 to 10^4000.
    for (const std::size_t mirrors : {0u, 1u, 2u, 3u}) {
        Path path;
        for (std::size_t i = 0; i < 200; ++i) {
            const double scale = i < 100 ? 1e-40 : 1e40;
            path.push_back(diagonal(scale, i < mirrors ? -1 : 1, 1 / scale));
        }
        CAPTURE(mirrors);
        const Triangle world = mirrors % 2 ? Triangle{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}} : flat;
        REQUIRE(sees_front({0, 0, -1}, world, path));
        REQUIRE(!sees_front({0, 0, 1}, world, path));
        REQUIRE(glm::dot(normal(with_front_restored(world, path)), Double3(0, 0, 1)) > 0.0);
    }
}

TEST_CASE("random paths: the front is where a point above the triangle went") {
    Pcg32 random(95);
    for (int i = 0; i < 1000; ++i) {
        Path path;
        for (std::uint32_t k = random.below(5); k > 0; --k) {
            glm::dmat3 m;
            do
                for (int column = 0; column < 3; ++column)
                    m[column] = Double3(random_vector(random));
            while (std::abs(glm::determinant(m)) < 0.2);
            path.push_back(m);
        }
        const Point3 a = random_vector(random);
        const Point3 b = random_vector(random);
        const Point3 c = random_vector(random);
        if (glm::length(normal({a, b, c})) < 0.2) continue;
        CAPTURE(i, path.size());
        check_sides({a, b, c}, path);
    }
}
