#include "ex05_canonical_order.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace space;

namespace {

struct Case {
    Point3 p, q;
    Vector3 normal;
    float offset;

    Point3 forwards() const { return cut(p, q, normal, offset); }
    Point3 backwards() const { return cut(q, p, normal, offset); }
};

/// With all digits, so that points that differ look different.
std::string both(const Case& edge) {
    const Point3 p = edge.forwards(), q = edge.backwards();
    return fmt::format("p -> q: {:.9g} {:.9g} {:.9g}, q -> p: {:.9g} {:.9g} {:.9g}", p.x, p.y, p.z,
                       q.x, q.y, q.z);
}

/// Edges with coordinates up to `size`, and planes that cross them, not too near to an end.
template <class Visit>
void each_edge(int count, float size, const Visit& visit) {
    Pcg32 random(35);
    const auto point = [&](float s) { return random_point(random, -s, s); };
    for (int visited = 0; visited < count;) {
        const Case edge{point(size), point(size), point(1.0f), random.uniform(-size, size)};
        const double at_p = glm::dot(Double3(edge.normal), Double3(edge.p)) - edge.offset;
        const double at_q = glm::dot(Double3(edge.normal), Double3(edge.q)) - edge.offset;
        if (at_p * at_q > 0.0 || std::min(std::abs(at_p), std::abs(at_q)) < 0.001 * size) continue;
        visit(edge);
        ++visited;
    }
}

constexpr int edges = 100'000;
constexpr double u = 0x1p-24;  // a float's rounding

}  // namespace

TEST_CASE("an edge is cut where it meets the plane") {
    CHECK(cut({0, 0, 0}, {4, 8, 0}, {0, 1, 0}, 2) == Point3(1, 2, 0));
    CHECK(cut({4, 8, 0}, {0, 0, 0}, {0, 1, 0}, 2) == Point3(1, 2, 0));
    CHECK(cut({0, 0, -2}, {2, 4, 6}, {0, 0, -1}, 0) == Point3(0.5f, 1, 0));
}

TEST_CASE("the neighbours at the edge (1.1, 0.3, 0.7), (-0.4, 0.9, -0.2) agree") {
    const Case edge{{1.1f, 0.3f, 0.7f}, {-0.4f, 0.9f, -0.2f}, {0.2f, -0.8f, 0.7f}, -0.2f};
    INFO(both(edge));
    CHECK((edge.forwards() == edge.backwards()));
}

TEST_CASE("no edge has a crack") {
    for (const float size : {1.0f, 1000.0f}) {
        int cracks = 0;
        each_edge(edges, size,
                  [&](const Case& edge) { cracks += edge.forwards() != edge.backwards(); });
        CHECK(cracks == 0);
    }
}

TEST_CASE("where the cut is halfway between two floats, doubles crack as well") {
    const Vector3 normal{1, 0, 0};
    for (const Case& edge : {Case{{2, 0x1.f0f22ap-1f, 0}, {-9, -0x1.4b93b6p-3f, 0}, normal, 0},
                             Case{{4, 0x1.e2f2dcp-1f, 0}, {-25, -0x1.a1f61ap-4f, 0}, normal, 0},
                             Case{{13, 0x1.de43d2p-1f, 0}, {-28, -0x1.8eb566p-2f, 0}, normal, 0}}) {
        INFO(both(edge));
        CHECK((edge.forwards() == edge.backwards()));
    }
}

TEST_CASE("every cut lies on its plane and its edge, to within roundings") {
    for (const float size : {1.0f, 1000.0f}) {
        int off_plane = 0, off_edge = 0;
        each_edge(edges, size, [&](const Case& edge) {
            const Double3 p(edge.p), q(edge.q), normal(edge.normal);
            for (const Double3 x : {Double3(edge.forwards()), Double3(edge.backwards())}) {
                // Three products and sums, a quotient, an interpolation: at most 16 roundings of
                // numbers up to 4 size.
                off_plane += !(std::abs(glm::dot(normal, x) - edge.offset) <= 64 * u * size);
                const Double3 along = glm::normalize(q - p);
                const double t = glm::dot(x - p, along);
                off_edge += !(glm::length(x - p - t * along) <= 64 * u * size) || t < 0.0 ||
                            t > glm::length(q - p);
            }
        });
        CHECK(off_plane == 0);
        CHECK(off_edge == 0);
    }
}
