// Classification and cuts worked out by hand, in all grades, for segments in the plane and
// triangles in space.
#include "chapters/ch03_bsp_trees/fragment.hpp"

#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <string>
#include <tuple>

namespace space {
namespace {

constexpr Grade grades[] = {Grade::thick_float, Grade::ordered_float, Grade::ordered_double,
                            Grade::exact};
/// Coordinates here are small multiples of 1/4, and cuts lie at such: every grade gets them without
/// rounding.
constexpr double thickness = 0x1p-20;

/// Each edge is the same to the corner that it leaves and to the one that it comes to.
bool is_chained(const Fragment<3>& fragment) {
    const auto& corners = fragment.corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i].carriers[1] != corners[(i + 1) % corners.size()].carriers[0]) return false;
    return true;
}

template <int D>
struct ToCut {
    std::vector<Simplex<D>> polygons;
    std::vector<SplitPlane<D>> planes;

    Cutter<D> cutter(Grade grade) const { return {polygons, planes, grade, thickness}; }
    std::vector<int> sides(Grade grade, const Fragment<D>& fragment,
                           std::uint32_t plane = 0) const {
        std::vector<int> result;
        cutter(grade).corner_sides(fragment, planes[plane], result);
        return result;
    }
    auto split(Grade grade, const Fragment<D>& fragment, std::uint32_t plane = 0) const {
        auto pieces = cutter(grade).split(fragment, sides(grade, fragment, plane), plane);
        if constexpr (D == 3) {
            CHECK(is_chained(pieces.first));
            CHECK(is_chained(pieces.second));
        }
        return pieces;
    }
};

template <int D>
std::vector<Double<D>> points(const Fragment<D>& fragment) {
    std::vector<Double<D>> result;
    for (const auto& corner : fragment.corners) result.push_back(corner.at);
    return result;
}
/// Of the ends, or of the edges that go out; "p3 e1": the plane 3, the original edge (or end) 1.
template <int D>
std::string carriers(const Fragment<D>& fragment) {
    std::string text;
    for (const auto& corner : fragment.corners) {
        const Carrier carrier = corner.carriers.back();
        text += (text.empty() ? "" : " ") + (carrier.is_original()
                                                 ? "e" + std::to_string(carrier.edge())
                                                 : "p" + std::to_string(carrier.number()));
    }
    return text;
}
/// z = 0, seen from above in front; x = 0, front where x is larger.
const SplitPlane<3> ground({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
const SplitPlane<3> wall = axis_plane<3>(0, 0.0f);

using Points = std::vector<Double3>;
using Points2 = std::vector<Double2>;

}  // namespace

TEST_CASE("axis planes have the larger coordinate in front, in every dimension") {
    for (int axis = 0; axis < 3; ++axis) {
        const SplitPlane<3> plane = axis_plane<3>(axis, 2.5f);
        for (int other = 0; other < 3; ++other)
            CHECK((plane.normal[other] > 0.0) == (other == axis));
        Double3 p(7.0);
        p[axis] = 2.75;
        CHECK(side_filter(plane, p, 0.0) == 1);
        p[axis] = 2.25;
        CHECK(side_filter(plane, p, 0.0) == -1);
    }
    for (int axis = 0; axis < 2; ++axis) {
        const SplitPlane<2> line = axis_plane<2>(axis, 2.5f);
        Double2 p(7.0);
        p[axis] = 2.75;
        CHECK(side_filter(line, p, 0.0) == 1);
        p[axis] = 2.25;
        CHECK(side_filter(line, p, 0.0) == -1);
    }
}

TEST_CASE("a segment is in front, behind, on or across a line") {
    const SplitPlane<2> line({{0, 0}, {1, 0}});  // the x axis: its left is above
    ToCut<2> scene{{{{0, 1}, {2, 3}},
                    {{0, -1}, {2, -3}},
                    {{5, 0}, {-3, 0}},
                    {{0, -1}, {2, 3}},
                    {{1, 0}, {1, 4}},
                    {{1, -2}, {1, 0}}},
                   {line}};
    const std::vector<int> expected[] = {{1, 1}, {-1, -1}, {0, 0}, {-1, 1}, {0, 1}, {-1, 0}};
    const PlaneSide expected_side[] = {PlaneSide::front,      PlaneSide::back,  PlaneSide::coplanar,
                                       PlaneSide::straddling, PlaneSide::front, PlaneSide::back};
    for (const Grade grade : grades)
        for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
            const std::vector<int> sides =
                scene.sides(grade, whole_polygon<2>(scene.polygons[i], i));
            CHECK(sides == expected[i]);
            CHECK(Cutter<2>::classify(sides) == expected_side[i]);
        }
}

TEST_CASE("a segment across a line is cut once, and its two parts keep its direction") {
    ToCut<2> scene{{{{0, -1}, {2, 3}}, {{2, 3}, {0, -1}}},
                   {SplitPlane<2>({{0, 0}, {1, 0}}), SplitPlane<2>({{0, 2}, {1, 2}})}};
    for (const Grade grade : grades) {
        const auto [front, back] = scene.split(grade, whole_polygon<2>(scene.polygons[0], 0));
        CHECK(points(front) == Points2{{0.5, 0}, {2, 3}});
        CHECK(points(back) == Points2{{0, -1}, {0.5, 0}});
        CHECK(carriers(front) == "p0 e1");
        CHECK(carriers(back) == "e0 p0");
        const auto [other_front, other_back] =
            scene.split(grade, whole_polygon<2>(scene.polygons[1], 1));
        CHECK(points(other_front) == Points2{{2, 3}, {0.5, 0}});
        CHECK(points(other_back) == Points2{{0.5, 0}, {0, -1}});
        CHECK(other_front.polygon == 1);
        // Cut again: the middle part ends at two lines.
        const auto [upper, middle] = scene.split(grade, front, 1);
        CHECK(points(upper) == Points2{{1.5, 2}, {2, 3}});
        CHECK(points(middle) == Points2{{0.5, 0}, {1.5, 2}});
        CHECK(carriers(middle) == "p0 p1");
        CHECK(scene.sides(grade, middle, 0) == std::vector<int>{0, 1});
        CHECK(scene.sides(grade, middle, 1) == std::vector<int>{-1, 0});
    }
}

TEST_CASE(
    "a triangle is in front, behind, on or across a plane; corners and edges in the plane count as "
    "on it") {
    struct Case {
        Triangle triangle;
        std::vector<int> sides;
        PlaneSide side;
    };
    const Case cases[] = {
        {{{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}, {1, 1, 1}, PlaneSide::front},
        {{{0, 0, -1}, {1, 0, -1}, {0, 1, -2}}, {-1, -1, -1}, PlaneSide::back},
        {{{0, 0, 0}, {1, 0, 1}, {0, 1, 2}}, {0, 1, 1}, PlaneSide::front},  // a corner in the plane
        {{{0, 0, -3}, {1, 0, 0}, {0, 1, -2}}, {-1, 0, -1}, PlaneSide::back},
        {{{0, 0, 0}, {1, 0, 0}, {0, 1, 2}}, {0, 0, 1}, PlaneSide::front},  // an edge in the plane
        {{{0, 0, 0}, {1, 0, -1}, {3, 1, 0}}, {0, -1, 0}, PlaneSide::back},
        {{{4, 0, 0}, {5, 0, 0}, {4, 1, 0}},
         {0, 0, 0},
         PlaneSide::coplanar},  // coplanar, the same facing
        {{{4, 0, 0}, {4, 1, 0}, {5, 0, 0}},
         {0, 0, 0},
         PlaneSide::coplanar},  // coplanar, the other facing
        {{{0, 0, -1}, {1, 0, 1}, {0, 1, 1}}, {-1, 1, 1}, PlaneSide::straddling},
        {{{0, 0, 0}, {1, 0, 1}, {0, 1, -1}},
         {0, 1, -1},
         PlaneSide::straddling},  // through a corner
    };
    for (const Grade grade : grades)
        for (const Case& c : cases) {
            const ToCut<3> scene{{c.triangle}, {ground}};
            const std::vector<int> sides = scene.sides(grade, whole_polygon<3>(c.triangle, 0));
            CHECK(sides == c.sides);
            CHECK(Cutter<3>::classify(sides) == c.side);
        }
}

TEST_CASE("a triangle with one corner behind is cut into a triangle and a quadrangle") {
    const ToCut<3> scene{{{{0, 0, -2}, {4, 0, 2}, {0, 4, 2}}}, {ground}};
    for (const Grade grade : grades) {
        const auto [front, back] = scene.split(grade, whole_polygon<3>(scene.polygons[0], 0));
        CHECK(points(front) == Points{{2, 0, 0}, {4, 0, 2}, {0, 4, 2}, {0, 2, 0}});
        CHECK(points(back) == Points{{0, 0, -2}, {2, 0, 0}, {0, 2, 0}});
        CHECK(carriers(front) == "e0 e1 e2 p0");  // the new edge lies on the plane
        CHECK(carriers(back) == "e0 p0 e2");
        CHECK(front.polygon == 0);
        CHECK(back.polygon == 0);
        CHECK(scene.sides(grade, front) == std::vector<int>{0, 1, 1, 0});
        CHECK(scene.sides(grade, back) == std::vector<int>{-1, 0, 0});
    }
}

TEST_CASE("a plane through a corner cuts a triangle into two triangles that share it") {
    // From front to back along the opposite edge, and from back to front.
    const ToCut<3> scene{{{{1, 1, 0}, {4, 0, 2}, {0, 4, -2}}, {{1, 1, 0}, {0, 4, -2}, {4, 0, 2}}},
                         {ground}};
    for (const Grade grade : grades) {
        const auto [front, back] = scene.split(grade, whole_polygon<3>(scene.polygons[0], 0));
        CHECK(points(front) == Points{{1, 1, 0}, {4, 0, 2}, {2, 2, 0}});
        CHECK(points(back) == Points{{1, 1, 0}, {2, 2, 0}, {0, 4, -2}});
        CHECK(carriers(front) == "e0 e1 p0");
        CHECK(carriers(back) == "p0 e1 e2");
        const auto [other_front, other_back] =
            scene.split(grade, whole_polygon<3>(scene.polygons[1], 1));
        CHECK(points(other_front) == Points{{1, 1, 0}, {2, 2, 0}, {4, 0, 2}});
        CHECK(points(other_back) == Points{{1, 1, 0}, {0, 4, -2}, {2, 2, 0}});
        CHECK(carriers(other_front) == "p0 e1 e2");
        CHECK(carriers(other_back) == "e0 e1 p0");
    }
}

TEST_CASE("a corner where two splitting planes meet is known by both") {
    // The triangle in z = 0 below x + y = 4; cut by x = 0 and y = 1, then by planes through the
    // corner that they make.
    const SplitPlane<3> shelf = axis_plane<3>(1, 1.0f);
    const SplitPlane<3> diagonal(
        {{0, 1, 0}, {1, 2, 0}, {0, 1, 1}});  // through (0, 1), in front: below and right of it
    const ToCut<3> scene{{{{-4, 0, 0}, {4, 0, 0}, {-4, 8, 0}}}, {wall, shelf, diagonal}};
    for (const Grade grade : grades) {
        const auto [right, left] = scene.split(grade, whole_polygon<3>(scene.polygons[0], 0), 0);
        CHECK(points(right) == Points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
        CHECK(carriers(right) == "e0 e1 p0");
        const auto [upper, lower] = scene.split(grade, right, 1);
        CHECK(points(upper) == Points{{3, 1, 0}, {0, 4, 0}, {0, 1, 0}});
        CHECK(carriers(upper) == "e1 p0 p1");
        CHECK(points(lower) == Points{{0, 0, 0}, {4, 0, 0}, {3, 1, 0}, {0, 1, 0}});
        CHECK(carriers(lower) == "e0 e1 p1 p0");
        CHECK(scene.sides(grade, upper, 2) == std::vector<int>{1, -1, 0});
        const auto [below, above] = scene.split(grade, upper, 2);
        CHECK(points(below) == Points{{3, 1, 0}, {1.5, 2.5, 0}, {0, 1, 0}});
        CHECK(carriers(below) == "e1 p2 p1");
        CHECK(points(above) == Points{{1.5, 2.5, 0}, {0, 4, 0}, {0, 1, 0}});
        CHECK(carriers(above) == "e1 p0 p2");
        CHECK(scene.sides(grade, above, 1) == std::vector<int>{1, 1, 0});
        CHECK(scene.sides(grade, above, 0) == std::vector<int>{1, 0, 0});
    }
}

TEST_CASE(
    "a thick plane takes corners within its thickness for its own, and the exact grade doesn't") {
    const float just = 0x1p-21f, beyond = 0x1p-19f;
    for (const float size : {0.25f, 1.0f, 4.0f}) {  // of what the plane goes through
        const SplitPlane<3> plane({{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
        const ToCut<3> scene{{{{0, 0, just}, {1, 0, -just}, {0, 1, beyond}}}, {plane}};
        const Fragment<3> fragment = whole_polygon<3>(scene.polygons[0], 0);
        for (const Grade grade : {Grade::thick_float, Grade::ordered_float, Grade::ordered_double})
            CHECK(scene.sides(grade, fragment) == std::vector<int>{0, 0, 1});
        CHECK(scene.sides(Grade::exact, fragment) == std::vector<int>{1, -1, 1});
    }
}

TEST_CASE("a fragment has an extent with as many different corners as its dimension") {
    const auto fragment3 = [](const Points& points) {
        Fragment<3> fragment{0, {}};
        for (const Double3& p : points) fragment.corners.push_back({p, 0.0, {}});
        return fragment;
    };
    CHECK(Cutter<3>::has_extent(fragment3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})));
    CHECK_FALSE(Cutter<3>::has_extent(fragment3({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}})));
    CHECK_FALSE(Cutter<3>::has_extent(fragment3({{0, 0, 0}, {1, 0, 0}})));
    Fragment<2> segment{0, {{{1, 2}, 0.0, {}}, {{1, 2}, 0.0, {}}}};
    CHECK_FALSE(Cutter<2>::has_extent(segment));
    segment.corners[1].at.x = 3;
    CHECK(Cutter<2>::has_extent(segment));
}

TEST_CASE("no tree holds a fragment with fewer different corners than its dimension") {
    for (const Grade grade : {Grade::thick_float, Grade::ordered_float, Grade::ordered_double})
        for (const float size : {1.0f, 1e-3f}) {
            const std::vector<Triangle> polygons = scenes::soup(100, size, 3);
            std::size_t small = 0;
            for (const Fragment<3>& f :
                 BspBuilder<3>::build(
                     polygons, {.splitter = BspConfig::SplitterChoice::first, .grade = grade})
                     .fragments)
                small += !Cutter<3>::has_extent(f);
            CHECK(small == 0);
        }
}

TEST_CASE("a tip whose two cuts round to one point is left out, but not by the exact grade") {
    for (const auto& [grade, tip, pieces] : {std::tuple{Grade::thick_float, -0x1p-20f, 1},
                                             std::tuple{Grade::ordered_float, -0x1p-20f, 1},
                                             std::tuple{Grade::ordered_double, -0x1p-48f, 1},
                                             std::tuple{Grade::exact, -0x1p-48f, 2}}) {
        const std::vector<Triangle> polygons{{{0, 0, 1}, {0, 1, 1}, {0, 0, 2}},
                                             {{tip, 1, 0}, {1, 1, 0}, {1, 1 + 0x1p-10f, 0}}};
        const BspTree<3> tree = BspBuilder<3>::build(
            polygons, {.splitter = BspConfig::SplitterChoice::first, .grade = grade});
        CHECK(std::count_if(tree.fragments.begin(), tree.fragments.end(),
                            [](const auto& f) { return f.polygon == 1; }) == pieces);
    }
}

TEST_CASE("the exact grade keeps a sliver whose corners are the same in double") {
    // On the ground, x = 1 and a plane through (1, y, -2^-60) and (1 + 2^-23, y, 1) have 2^-83
    // between them.
    const SplitPlane<3> upright = axis_plane<3>(0, 1.0f);
    const SplitPlane<3> leaning({{1, 0, -0x1p-60f}, {1, 1, -0x1p-60f}, {1 + 0x1p-23f, 0, 1}});
    const ToCut<3> scene{{{{0, -1, 0}, {4, -1, 0}, {0, 3, 0}}}, {upright, leaning}};
    const auto [right, left] = scene.split(Grade::exact, whole_polygon<3>(scene.polygons[0], 0), 0);
    CHECK(Cutter<3>::classify(scene.sides(Grade::exact, right, 1)) == PlaneSide::straddling);

    const std::vector<Triangle> polygons{
        scene.polygons[0],
        {{1, 5, -1}, {1, 6, -1}, {1, 5, 1}},  // off the first, in x = 1
        {{1, 5, -0x1p-60f}, {1, 6, -0x1p-60f}, {1 + 0x1p-23f, 5, 1}}};
    const std::uint32_t order[] = {1, 2};
    const BspTree<3> tree = BspBuilder<3>::build(
        polygons, {.splitter = BspConfig::SplitterChoice::first, .order = order});
    CHECK(std::count_if(tree.fragments.begin(), tree.fragments.end(),
                        [](const auto& f) { return f.polygon == 0; }) == 3);
}

TEST_CASE("a polygon lies in its own plane, whatever rounding says, and so every build ends") {
    const std::vector<Triangle> polygons = scenes::soup(30, 0.7f, 5);
    for (const Grade grade : grades) {
        const BspTree<3> tree =
            BspBuilder<3>::build(polygons, {.splitter = BspConfig::SplitterChoice::first,
                                            .grade = grade,
                                            .thickness_in_roundings = 0.0,
                                            .max_placed = 30 * 30 * 30});
        CHECK(std::all_of(tree.nodes.begin(), tree.nodes.end(),
                          [](const auto& node) { return node.count > 0; }));
    }
}

TEST_CASE("polygons stay as they were given, and fragments name theirs") {
    const std::vector<Triangle> polygons = scenes::soup(50, 0.7f, 4);
    for (const Grade grade : grades) {
        const BspTree<3> tree = BspBuilder<3>::build(polygons, {.grade = grade});
        CHECK(tree.polygons == polygons);
        std::vector<bool> seen(polygons.size());
        for (const Fragment<3>& fragment : tree.fragments) seen.at(fragment.polygon) = true;
        CHECK(std::count(seen.begin(), seen.end(), true) == 50);
        CHECK(tree.fragments.size() > 100);
    }
}

TEST_CASE("coplanar polygons of either facing stand in one node; nothing else does") {
    const std::vector<Triangle> polygons{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                         {{5, 5, 0}, {5, 6, 0}, {6, 5, 0}},
                                         {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                         {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};
    for (const Grade grade : grades) {
        const BspTree<3> tree = BspBuilder<3>::build(
            polygons, {.splitter = BspConfig::SplitterChoice::first, .grade = grade});
        REQUIRE(tree.nodes.size() == 2);
        CHECK(tree.nodes[0].count == 3);
        CHECK(tree.nodes[0].front == 1);
        CHECK(tree.nodes[0].back == BspTree<3>::none);
        CHECK(tree.nodes[1].count == 1);
        CHECK(tree.fragments[tree.nodes[1].first].polygon == 3);
    }
}

}  // namespace space
