#include "ex05_canonical_order.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>

using namespace space;

namespace {

struct Case {
    Point3 p, q;
    Vector3 normal;
    float offset;

    Point3 forwards() const { return cut(p, q, normal, offset); }
    Point3 backwards() const { return cut(q, p, normal, offset); }
};

void check(const Case& edge) {
    const Point3 forwards = edge.forwards(), backwards = edge.backwards();
    if (forwards == backwards) return;
    CAPTURE(edge.p, edge.q, edge.normal, Number{edge.offset});
    REQUIRE(forwards == backwards);
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
    check(edge);
}

TEST_CASE("no edge has a crack") {
    for (const float size : {1.0f, 1000.0f}) each_edge(edges, size, check);
}

TEST_CASE("an edge whose ends have a coordinate or their length in common has no crack either") {
    int turn = 0;
    each_edge(1000, 1.0f, [&](Case edge) {
        const int axis = ++turn % 3;
        if (turn % 2)
            edge.q[axis] = edge.p[axis];
        else
            edge.q = -Point3(edge.p.y, edge.p.z, edge.p.x);
        edge.offset = 0.5f * (glm::dot(edge.normal, edge.p) + glm::dot(edge.normal, edge.q));
        check(edge);
    });
}

TEST_CASE("where the cut is halfway between two floats, doubles crack as well") {
    const Vector3 normal{1, 0, 0};
    for (const Case& edge : {Case{{2, 0x1.f0f22ap-1f, 0}, {-9, -0x1.4b93b6p-3f, 0}, normal, 0},
                             Case{{4, 0x1.e2f2dcp-1f, 0}, {-25, -0x1.a1f61ap-4f, 0}, normal, 0},
                             Case{{13, 0x1.de43d2p-1f, 0}, {-28, -0x1.8eb566p-2f, 0}, normal, 0}}) {
        check(edge);
    }
}

TEST_CASE("where the cut is halfway between two places of a grid, snapping to it cracks as well") {
    const Vector3 normal{1, 0, 0};
    for (const Case& edge : {
             Case{{34, -0x1.76ep-6f, 0}, {-35, 0x1.d452p-1f, 0}, normal, 0},    // 2^-16
             Case{{37, -0x1.ff3ap-3f, 0}, {-35, 0x1.62418p-1f, 0}, normal, 0},  // 2^-17
             Case{{28, -0x1.a60dp-3f, 0}, {-12, -0x1.d4e8p-6f, 0}, normal, 0},  // 2^-18
             Case{{16, 0x1.616ep-5f, 0}, {-29, 0x1.b91p-3f, 0}, normal, 0},     // 2^-19
             Case{{18, -0x1.6ee9p-5f, 0}, {-23, -0x1.22c8p-8f, 0}, normal, 0},  // 2^-20
             Case{{6, -0x1.a0d6p-7f, 0}, {-29, 0x1.5d42p-6f, 0}, normal, 0},    // 2^-21
             Case{{13, -0x1.10a8p-8f, 0}, {-11, 0x1.54dp-9f, 0}, normal, 0},    // 2^-22
             Case{{15, -0x1.099ap-9f, 0}, {-7, 0x1.b246p-9f, 0}, normal, 0},    // 2^-23
             Case{{23, -0x1.6a7bp-9f, 0}, {-32, 0x1.baeep-10f, 0}, normal, 0},  // 2^-24
             Case{{177, 0, 0}, {-1823, 0x1.8p+1f, 0}, normal, 0},               // 1e-3
             Case{{1721, 0x1p+1f, 0}, {-18279, 0x1.4p+2f, 0}, normal, 0},       // 1e-4
             Case{{944055, -0x1p+0f, 0}, {-1055945, 0x1p+0f, 0}, normal, 0},    // 1e-5
             Case{{1595863, -0x1p+1f, 0}, {-404137, 0x1p+0f, 0}, normal, 0},    // 1e-6
         }) {
        check(edge);
    }
}

TEST_CASE("every cut lies on its plane and its edge, to within roundings") {
    for (const float size : {0x1p-10f, 1.0f, 1000.0f}) {
        each_edge(edges, size, [&](const Case& edge) {
            const Double3 p(edge.p), q(edge.q), normal(edge.normal);
            for (const Double3 x : {Double3(edge.forwards()), Double3(edge.backwards())}) {
                // Three products and sums, a quotient, an interpolation: at most 16 roundings of
                // numbers up to 4 size.
                const Error off_plane{std::abs(glm::dot(normal, x) - edge.offset), 64 * u * size};
                const Double3 along = glm::normalize(q - p);
                const double t = glm::dot(x - p, along);
                const Error off_edge{glm::length(x - p - t * along), 64 * u * size};
                const bool between = t >= 0.0 && t <= glm::length(q - p);
                if (off_plane && off_edge && between) continue;
                CAPTURE(edge.p, edge.q, edge.normal, Number{edge.offset}, x);
                REQUIRE(off_plane);
                REQUIRE(off_edge);
                REQUIRE(between);
            }
        });
    }
}
