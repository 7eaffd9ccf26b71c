#include "ex03_watertight_edge_rule.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <array>
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
    int holes = 0, twice = 0;
    for (int y = 1; y < 24; ++y)
        for (int x = 1; x < 24; ++x) {
            const int count = owners(faces, Point2(x, y));
            holes += count == 0;
            twice += count > 1;
        }
    CHECK(holes == 0);
    CHECK(twice == 0);
}

TEST_CASE("the hub of a fan belongs to exactly one of its triangles") {
    const std::array<Point2, 6> rim{{{8, 0}, {4, 7}, {-4, 7}, {-8, 0}, {-4, -7}, {4, -7}}};
    std::vector<Face> fan;
    for (std::size_t i = 0; i < rim.size(); ++i)
        fan.push_back({Point2(0), rim[i], rim[(i + 1) % rim.size()]});
    CHECK(owners(fan, Point2(0)) == 1);
}
