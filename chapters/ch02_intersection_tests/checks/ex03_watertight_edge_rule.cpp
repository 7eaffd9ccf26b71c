#include "ex03_watertight_edge_rule.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

using namespace space;

namespace {

using Face = std::array<Point2, 3>;

/// A square of n x n cells, each cut along one of its diagonals.
std::vector<Face> square(int n, Pcg32& random) {
    std::vector<Face> faces;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const Point2 a(4 * x, 4 * y), b(4 * x + 4, 4 * y), c(4 * x + 4, 4 * y + 4),
                d(4 * x, 4 * y + 4);
            if (random.below(2))
                faces.insert(faces.end(), {Face{a, b, c}, Face{a, c, d}});
            else
                faces.insert(faces.end(), {Face{a, b, d}, Face{b, c, d}});
        }
    return faces;
}

int owners(const std::vector<Face>& faces, const Point2& point) {
    int count = 0;
    for (const Face& face : faces) count += owns(face[0], face[1], face[2], point);
    return count;
}

}  // namespace

TEST_CASE("a point in the middle of a triangle is its own, and one outside is not") {
    CHECK(owns({0, 0}, {8, 0}, {0, 8}, {2, 2}));
    CHECK_FALSE(owns({0, 0}, {8, 0}, {0, 8}, {5, 5}));
    CHECK_FALSE(owns({0, 0}, {8, 0}, {0, 8}, {-1, 2}));
}

TEST_CASE("every point inside a triangulated square belongs to exactly one triangle") {
    Pcg32 random(3);
    const std::vector<Face> faces = square(6, random);
    for (int y = 1; y < 24; ++y)
        for (int x = 1; x < 24; ++x) {
            const Point2 point(x, y);
            CAPTURE(point);
            REQUIRE(owners(faces, point) == 1);
        }
}

TEST_CASE("a point is given away on edges of every slope and length") {
    // Both triangles of a parallelogram with whole corners, and its diagonal's whole points.
    for (int dx = -12; dx <= 12; ++dx)
        for (int dy = -12; dy <= 12; ++dy)
            for (const int length : {2, 40}) {
                if (dx == 0 && dy == 0) continue;
                const Point2 step(dx, dy), a(-7, 5), c = a + static_cast<float>(length) * step;
                const Point2 left(-2 * dy, 2 * dx);
                const std::vector<Face> faces{{a, c, a + left}, {c, a, c - left}};
                for (int i = 1; i < length; ++i) {
                    const Point2 point = a + static_cast<float>(i) * step;
                    CAPTURE(a, c, point);
                    REQUIRE(owners(faces, point) == 1);
                }
            }
}

TEST_CASE("what is inside is owned and what is outside is not, in thin triangles, too") {
    Pcg32 random(23);
    const auto place = [&] { return static_cast<float>(random.below(2001)) - 1000.0f; };
    for (int i = 0; i < 20'000; ++i) {
        Point2 a, b, c;
        for (Point2* corner : {&a, &b, &c})
            for (int axis = 0; axis < 2; ++axis) (*corner)[axis] = place();
        if (i % 2) c = b + Point2(random.below(2), 1);
        const auto area = [](const Point2& p, const Point2& q, const Point2& r) {
            const Double2 pq = Double2(q) - Double2(p), pr = Double2(r) - Double2(p);
            return pq.x * pr.y - pq.y * pr.x;
        };
        if (area(a, b, c) < 0) std::swap(a, b);
        // Near the middle of a side, a step or none off it.
        Point2 point = glm::floor(0.5f * (a + b));
        const auto right = random.below(3), up = random.below(3);
        point += Point2(right, up) - Point2(1);
        const double least = std::min({area(a, b, point), area(b, c, point), area(c, a, point)});
        if (least == 0) continue;
        CAPTURE(a, b, c, point);
        REQUIRE(owns(a, b, c, point) == (least > 0));
    }
}

TEST_CASE("the hub of a fan belongs to exactly one of its triangles") {
    const std::array<Point2, 6> rim{{{8, 0}, {4, 7}, {-4, 7}, {-8, 0}, {-4, -7}, {4, -7}}};
    std::vector<Face> fan;
    for (std::size_t i = 0; i < rim.size(); ++i)
        fan.push_back({Point2(0), rim[i], rim[(i + 1) % rim.size()]});
    CHECK(owners(fan, Point2(0)) == 1);
}
