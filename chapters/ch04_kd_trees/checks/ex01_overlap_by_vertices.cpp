#include "ex01_overlap_by_vertices.hpp"

#include "chapters/ch04_kd_trees/kd_builder.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace space {

static std::ostream& operator<<(std::ostream& out, const KdSplit& split) {
    return out << "xyz"[split.axis] << " = " << split.position << ", what lies in it "
               << (split.coplanar_below ? "below" : "above");
}

}  // namespace space

using namespace space;

namespace {

std::string_view words(const NamedBy& halves) {
    return halves.below   ? halves.above ? "both halves" : "the half below"
           : halves.above ? "the half above"
                          : "no half";
}

/// Tested with x, y and z in turn as the split's axis, so that an answer for one axis is not
/// enough; the answer for all three, or what was said of the first that differs.
std::string_view named(const Triangle& triangle, const Aabb& cell, float position,
                       bool coplanar_below = true) {
    const auto turned = [](const Point3& p, int by) {
        return Point3(p[(3 - by) % 3], p[(4 - by) % 3], p[(5 - by) % 3]);
    };
    const std::string_view first = words(named_by(triangle, cell, {0, position, coplanar_below}));
    for (const int axis : {1, 2}) {
        const std::string_view other = words(named_by(
            {turned(triangle.a, axis), turned(triangle.b, axis), turned(triangle.c, axis)},
            {turned(cell.min, axis), turned(cell.max, axis)}, {axis, position, coplanar_below}));
        if (other != first) return other;
    }
    return first;
}

const Aabb cube{Point3(0), Point3(8)};

/// Within the cube; its corners have these x.
Triangle across(float a, float b, float c) {
    return {{a, 1, 1}, {b, 7, 2}, {c, 2, 6}};
}

/// By trying places of the axis, half a unit apart: for whole coordinates only.
NamedBy by_trying(const Triangle& triangle, const Aabb& cell, const KdSplit& split) {
    const Aabb box = bounds(triangle);
    NamedBy halves{false, false};
    for (float x = -16.0f; x <= 16.0f; x += 0.5f) {
        const bool inside = box.min[split.axis] <= x && x <= box.max[split.axis] &&
                            cell.min[split.axis] <= x && x <= cell.max[split.axis];
        if (inside && x < split.position) halves.below = true;
        if (inside && x > split.position) halves.above = true;
    }
    if (!halves.below && !halves.above) (split.coplanar_below ? halves.below : halves.above) = true;
    return halves;
}

/// Sends triangles down a tree that stands already, by the answer's rule, and compares what comes
/// to its leaves with what they name.
struct SortedIn {
    const std::vector<Triangle>& triangles;
    const KdNodes<3>& tree;
    std::size_t references = 0;

    void visit(std::uint32_t index, const Aabb& cell, const std::vector<std::uint32_t>& named) {
        const KdNode node = tree.nodes[index];
        if (!node.is_leaf()) {
            const KdSplit split{node.axis(), node.position()};
            std::vector<std::uint32_t> in_below, in_above;
            for (const std::uint32_t i : named) {
                const NamedBy halves = named_by(triangles[i], cell, split);
                if (halves.below) in_below.push_back(i);
                if (halves.above) in_above.push_back(i);
            }
            const auto [below, above] = halves(cell, split);
            visit(node.below(), below, in_below);
            visit(node.below() + 1, above, in_above);
            return;
        }
        references += named.size();
        const auto wanted = tree.own(index);
        for (const std::uint32_t i : named) {
            CAPTURE(cell, triangles[i]);
            const bool only_a_wider_rule_names_it = std::ranges::count(wanted, i) == 0;
            REQUIRE_FALSE(only_a_wider_rule_names_it);
        }
        for (const std::uint32_t i : wanted) {
            CAPTURE(cell, triangles[i]);
            const bool is_lost = std::ranges::count(named, i) == 0;
            REQUIRE_FALSE(is_lost);
        }
    }
};

/// With whole coordinates many corners lie in planes; with others hardly any.
std::vector<Triangle> random_triangles(Pcg32& random, std::size_t count, float size, bool whole) {
    const auto rounded = [&](const Point3& p) { return whole ? glm::floor(p) : p; };
    std::vector<Triangle> triangles;
    while (triangles.size() < count) {
        const Point3 corner = random_point(random, 0.0f, 64.0f);
        const Point3 a = random_point(random, -size, size), b = random_point(random, -size, size);
        triangles.push_back({rounded(corner), rounded(corner + a), rounded(corner + b)});
    }
    return triangles;
}

}  // namespace

TEST_CASE("a triangle beside the plane belongs to its half, one across it to both") {
    CHECK(named(across(1, 2, 3), cube, 4) == "the half below");
    CHECK(named(across(5, 7, 6), cube, 4) == "the half above");
    CHECK(named(across(3, 5, 1), cube, 4) == "both halves");
}

TEST_CASE("a triangle that spans the cell, without a corner in it, belongs to both halves") {
    const Triangle spans{{-10, -9, 0.5f}, {11, -8, 0.5f}, {0, 12, 0.5f}};
    CHECK(named(spans, {Point3(0), Point3(1)}, 0.5f) == "both halves");
    CHECK(named({{2, -9, 4}, {6, -9, 4}, {4, 30, 4}}, cube, 4) == "both halves");
}

TEST_CASE("a triangle with a corner in one half and the others outside the cell is not lost") {
    CHECK(named({{1, 4, 4}, {20, 4, 4}, {20, 5, 4}}, cube, 4) == "both halves");
    CHECK(named({{7, 4, 4}, {-9, 4, 4}, {-9, 5, 4}}, cube, 4) == "both halves");
    CHECK(named({{1, 20, 4}, {2, -20, 4}, {3, 20, 5}}, cube, 4) == "the half below");
    CHECK(named({{5, 20, 4}, {6, -20, 4}, {7, 20, 5}}, cube, 4) == "the half above");
}

TEST_CASE("a triangle that only touches the plane belongs to the side on which it lies") {
    for (const bool coplanar_below : {true, false}) {
        CAPTURE(coplanar_below);
        REQUIRE(named(across(4, 2, 1), cube, 4, coplanar_below) == "the half below");
        REQUIRE(named(across(4, 4, 1), cube, 4, coplanar_below) == "the half below");
        REQUIRE(named(across(6, 5, 4), cube, 4, coplanar_below) == "the half above");
        REQUIRE(named(across(4, 5, 4), cube, 4, coplanar_below) == "the half above");
    }
}

TEST_CASE("a triangle in the plane belongs to the half that the split says, and to no other") {
    CHECK(named(across(4, 4, 4), cube, 4, true) == "the half below");
    CHECK(named(across(4, 4, 4), cube, 4, false) == "the half above");
}

TEST_CASE("the least difference from the plane counts, and so does the greatest") {
    const float before = std::nextafter(4.0f, 0.0f), behind = std::nextafter(4.0f, 8.0f);
    CHECK(named(across(before, 4, 4), cube, 4, false) == "the half below");
    CHECK(named(across(4, 4, behind), cube, 4, true) == "the half above");
    CHECK(named(across(before, 4, behind), cube, 4) == "both halves");
    const Aabb wide{Point3(-3e38f), Point3(3e38f)};
    CHECK(named(across(1e-45f, 0, 0), wide, 0, true) == "the half above");
    CHECK(named(across(-1e-45f, 0, 0), wide, 0, false) == "the half below");
    CHECK(named(across(-3e38f, 3e38f, 1), wide, 0) == "both halves");
    CHECK(named(across(2e38f, 3e38f, 2e38f), wide, 1e38f) == "the half above");
}

TEST_CASE("a half without thickness names only what lies in the plane") {
    const Triangle wide = across(-5, 20, 3);
    CHECK(named(wide, cube, 0, true) == "the half above");
    CHECK(named(wide, cube, 8, false) == "the half below");
    CHECK(named(across(-5, 0, -1), cube, 0, true) == "the half below");
    CHECK(named(across(0, 0, 0), cube, 0, true) == "the half below");
    CHECK(named(across(8, 8, 8), cube, 8, false) == "the half above");
    const Aabb flat{Point3(4, 0, 0), Point3(4, 8, 8)};
    CHECK(named(wide, flat, 4, true) == "the half below");
    CHECK(named(wide, flat, 4, false) == "the half above");
}

TEST_CASE("triangles, cells and planes with whole coordinates: as found by trying every place") {
    Pcg32 random(41);
    const auto whole = [&](int low, int high) {
        return static_cast<float>(low + int(random.below(std::uint32_t(high - low + 1))));
    };
    int both = 0, coplanar = 0;
    for (int i = 0; i < 50'000; ++i) {
        Triangle triangle{};
        for (Point3* corner : {&triangle.a, &triangle.b, &triangle.c})
            for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = whole(-6, 6);
        const Aabb box = bounds(triangle);
        Aabb cell;
        for (int axis = 0; axis < 3; ++axis) {  // it meets the box
            cell.min[axis] = whole(-6, int(box.max[axis]));
            cell.max[axis] = whole(int(std::max(cell.min[axis], box.min[axis])), 6);
        }
        KdSplit split{int(random.below(3)), 0.0f};
        split.position = whole(int(cell.min[split.axis]), int(cell.max[split.axis]));
        split.coplanar_below = random.below(2) == 0;
        const NamedBy wanted = by_trying(triangle, cell, split);
        both += wanted.below && wanted.above;
        coplanar +=
            box.min[split.axis] == box.max[split.axis] && box.min[split.axis] == split.position;
        CAPTURE(triangle, cell, split);
        REQUIRE(words(named_by(triangle, cell, split)) == words(wanted));
    }
    CHECK(both > 5'000);
    CHECK(coplanar > 50);
}

TEST_CASE("in trees no reference is lost, and none is there that only a wider rule would add") {
    Pcg32 random(42);
    for (const bool whole : {true, false})
        for (const float size : {1.0f, 8.0f, 100.0f}) {
            const std::vector<Triangle> triangles = random_triangles(random, 300, size, whole);
            const KdNodes<3> tree =
                KdBuilder<3>::build(triangles, {.rule = KdTreeConfig::Rule::middle,
                                                .straddlers = KdTreeConfig::Straddlers::duplicate,
                                                .max_straddling = 1.0,
                                                .max_depth = 9});
            std::vector<std::uint32_t> all;
            for (std::uint32_t i = 0; i < triangles.size(); ++i) all.push_back(i);
            SortedIn sorted{triangles, tree};
            CAPTURE(whole, size);
            sorted.visit(0, tree.box, all);
            REQUIRE(sorted.references == tree.references.size());
            CHECK(tree.depth == 9);
        }
}
