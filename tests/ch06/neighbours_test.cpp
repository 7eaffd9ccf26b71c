// Neighbours over faces: by codes, and all leaves against all others.
#include "chapters/ch06_quadtrees_and_octrees/cell_neighbours.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <vector>

namespace space {
namespace {

template <int D>
std::vector<CellFace> all_faces() {
    std::vector<CellFace> faces;
    for (int axis = 0; axis < D; ++axis)
        for (const bool upper : {false, true}) faces.push_back({axis, upper});
    return faces;
}

/// One more or one less on one axis, without codes.
template <int D>
std::optional<OrthtreeCell<D>> next_cell(OrthtreeCell<D> cell, CellFace face) {
    std::uint32_t& along = cell.place[std::size_t(face.axis)];
    const std::uint32_t last = std::uint32_t((std::uint64_t{1} << cell.depth) - 1);
    if (along == (face.upper ? last : 0)) return std::nullopt;
    along += face.upper ? 1u : ~0u;
    return cell;
}

template <int D>
void check_same_size() {
    Pcg32 random(D);
    for (int i = 0; i < sized(20'000, 2'000); ++i) {
        OrthtreeCell<D> cell{random.below(max_orthtree_depth<D> + 1), {}};
        const auto last = std::uint32_t((std::uint64_t{1} << cell.depth) - 1);
        for (std::uint32_t& along : cell.place) {
            const std::uint32_t any = random.next() & last;
            along = std::array{0u, last, any, any, last / 2, last / 2 + 1}[random.below(6)] & last;
        }
        for (const CellFace face : all_faces<D>()) {
            const auto beyond = face_neighbour<D>(cell, face);
            REQUIRE(beyond == next_cell<D>(cell, face));
            if (beyond) REQUIRE(face_neighbour<D>(*beyond, face.opposite()) == cell);
        }
    }
}

template <int D>
void append_leaves(const LinearOrthtree<D>& tree, const OrthtreePlace<D>& place,
                   std::vector<OrthtreePlace<D>>& leaves) {
    if (place.is_leaf()) {
        leaves.push_back(place);
        return;
    }
    for (std::uint32_t k = 0; k < orthants<D>; ++k)
        append_leaves<D>(tree, {place.cell.child(k), tree.child(*place.node, k)}, leaves);
}

/// Whether b lies beyond a's face, by their corners in cells at the finest depth.
template <int D>
bool share_face(const OrthtreeCell<D>& a, const OrthtreeCell<D>& b, CellFace face) {
    const auto low = [](const OrthtreeCell<D>& cell, std::size_t axis) {
        return std::uint64_t{cell.place[axis]} << (max_orthtree_depth<D> - cell.depth);
    };
    const auto high = [&](const OrthtreeCell<D>& cell, std::size_t axis) {
        return low(cell, axis) + (std::uint64_t{1} << (max_orthtree_depth<D> - cell.depth));
    };
    for (std::size_t axis = 0; axis < D; ++axis) {
        if (axis != std::size_t(face.axis)) {
            if (low(a, axis) >= high(b, axis) || low(b, axis) >= high(a, axis)) return false;
        } else if (face.upper ? high(a, axis) != low(b, axis) : low(a, axis) != high(b, axis)) {
            return false;
        }
    }
    return true;
}

struct Pairs {
    std::size_t same_size = 0, larger = 0, smaller = 0, empty = 0;
};

template <int D>
Pairs check_all_leaves(std::span<const Point<D>> points, const LinearOrthtreeConfig& config) {
    const auto tree = OrthtreePoints<D>::build(points, config);
    std::vector<OrthtreePlace<D>> leaves;
    append_leaves<D>(tree.cells, {{}, &tree.cells.nodes.front()}, leaves);
    Pairs pairs;
    for (const auto& leaf : leaves)
        for (const CellFace face : all_faces<D>()) {
            std::vector<OrthtreePlace<D>> wanted, found;
            for (const auto& other : leaves)
                if (share_face(leaf.cell, other.cell, face)) wanted.push_back(other);
            for_each_leaf_beyond<D>(tree.cells, leaf.cell, face,
                                    [&](const auto& other) { found.push_back(other); });
            REQUIRE(found == wanted);
            for (const auto& other : found) {
                pairs.same_size += other.cell.depth == leaf.cell.depth;
                pairs.larger += other.cell.depth < leaf.cell.depth;
                pairs.smaller += other.cell.depth > leaf.cell.depth;
                pairs.empty += other.node == nullptr;
            }
        }
    return pairs;
}

template <int D>
std::vector<Point<D>> uneven_points(std::size_t count) {
    Pcg32 random(count);
    std::vector<Point<D>> points;
    for (std::size_t i = 0; i < count; ++i) {
        Point<D> p = random_point(random, BasicAabb<D>{Point<D>(0.0f), Point<D>(1.0f)});
        points.push_back(p * p * p);
    }
    return points;
}

}  // namespace

TEST_CASE("neighbours in a plane of eight cells an edge are as counted by hand") {
    // Code 6 is the cell (2, 1): 01 10.
    REQUIRE(interleave<2>({2, 1}) == 0b01'10);
    CHECK(face_neighbour<2>(6, 3, {0, true}) == interleave<2>({3, 1}));
    CHECK(face_neighbour<2>(6, 3, {0, false}) == interleave<2>({1, 1}));
    CHECK(face_neighbour<2>(6, 3, {1, true}) == interleave<2>({2, 2}));
    CHECK(face_neighbour<2>(6, 3, {1, false}) == interleave<2>({2, 0}));
    CHECK(face_neighbour<2>(interleave<2>({7, 0}), 3, {0, true}) == std::nullopt);
    CHECK(face_neighbour<2>(interleave<2>({7, 0}), 3, {1, false}) == std::nullopt);
    CHECK(face_neighbour<2>(0, 0, {0, true}) == std::nullopt);
}

TEST_CASE("a carry and a borrow go through the whole code") {
    CHECK(face_neighbour<3>(interleave<3>({(1u << 20) - 1, 5, 9}), 21, {0, true}) ==
          interleave<3>({1u << 20, 5, 9}));
    CHECK(face_neighbour<3>(interleave<3>({5, 9, 1u << 20}), 21, {2, false}) ==
          interleave<3>({5, 9, (1u << 20) - 1}));
}

TEST_CASE("the neighbour of the same size is one place on, and comes back") {
    check_same_size<2>();
    check_same_size<3>();
}

TEST_CASE("a leaf's neighbours are all leaves that share a part of its face, and no others") {
    const auto in_plane =
        check_all_leaves<2>(uneven_points<2>(200), {.leaf_size = 1, .max_depth = 8});
    const auto in_space =
        check_all_leaves<3>(uneven_points<3>(60), {.leaf_size = 1, .max_depth = 5});
    for (const Pairs& pairs : {in_plane, in_space}) {
        CHECK(pairs.larger == pairs.smaller);  // each such pair is seen from both sides
        CHECK(pairs.larger > 200);
        CHECK(pairs.same_size > 200);
        CHECK(pairs.empty > 200);
    }
    check_all_leaves<2>(std::vector<Point2>{{1, 1}}, {});
}

TEST_CASE("a cell is found in the leaf that holds it, or as itself") {
    const std::vector<Point2> points{{0.1f, 0.1f}, {0.2f, 0.1f}, {0.9f, 0.9f}};
    const auto tree = OrthtreePoints<2>::build(points, OrthtreeFrame<2>{}, {.leaf_size = 1}).cells;
    CHECK(find_cell<2>(tree, {0, {0, 0}}).node == &tree.nodes[0]);
    CHECK(find_cell<2>(tree, {1, {0, 0}}).cell == OrthtreeCell<2>{1, {0, 0}});
    CHECK(find_cell<2>(tree, {5, {31, 31}}).cell == OrthtreeCell<2>{1, {1, 1}});
    CHECK(find_cell<2>(tree, {5, {31, 0}}) == OrthtreePlace<2>{{1, {1, 0}}, nullptr});
    CHECK(find_cell<2>(tree, {1, {1, 0}}) == OrthtreePlace<2>{{1, {1, 0}}, nullptr});
}

}  // namespace space
