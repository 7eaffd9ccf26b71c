#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace space {
namespace {

/// A float of any size that is below `largest`.
float any_float(Pcg32& random, int lowest_exponent, int highest_exponent) {
    const float mantissa = random.uniform(-2.0f, 2.0f);
    const auto range = static_cast<std::uint32_t>(highest_exponent - lowest_exponent + 1);
    return std::ldexp(mantissa, lowest_exponent + static_cast<int>(random.below(range)));
}

WideNode<8> random_node(Pcg32& random, int lowest, int highest) {
    WideNode<8> node;
    const std::uint32_t count = 1 + random.below(8);
    for (std::size_t i = 0; i < 8; ++i) {
        Aabb box;
        for (int corner = 0; corner < 2 && i < count; ++corner) {
            Point3 p;
            for (int axis = 0; axis < 3; ++axis) p[axis] = any_float(random, lowest, highest);
            box.extend(p);
        }
        node.put(i, box, WideChild::node(static_cast<std::uint32_t>(i)));
    }
    return node;
}

TEST_CASE("no box is smaller in a compressed node") {
    Pcg32 random(3);
    struct Exponents {
        int lowest, highest;
    };
    for (const auto& [lowest, highest] :
         {Exponents{0, 0}, Exponents{-30, 30}, Exponents{-149, 126}, Exponents{-149, -140},
          Exponents{100, 126}, Exponents{-3, 3}})
        for (int i = 0; i < sized(20'000, 500); ++i) {
            WideNode<8> node = random_node(random, lowest, highest);
            if (i % 3 == 0)  // far from the origin beside its size
                for (std::size_t row = 0; row < 6; ++row)
                    for (std::size_t child = 0; child < 8; ++child)
                        if (node.is_used(child))
                            node.planes[row][child] =
                                1e6f + std::clamp(node.planes[row][child], -1e6f, 1e6f) * 1e-6f;
            const CompressedNode small = compressed(node);
            std::size_t place = 0;
            for (std::size_t child = 0; child < 8; ++child) {
                if (!node.is_used(child)) continue;
                REQUIRE(small.is_used(place));
                REQUIRE(small.children[place] == node.children[child]);
                const Aabb is = small.box(place++), was = node.box(child);
                CAPTURE(lowest, highest, i, child);
                REQUIRE(is.contains(was));
            }
            REQUIRE(small.count == place);
        }
}

TEST_CASE(
    "a box grows by less than two steps a side, and a step is less than a 127th of the node") {
    Pcg32 random(4);
    for (int i = 0; i < 10'000; ++i) {
        const WideNode<8> node = random_node(random, -2, 2);
        const CompressedNode small = compressed(node);
        Aabb all;
        for (std::size_t child = 0; child < small.count; ++child) all.extend(node.box(child));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            const double step = small.step(axis), extent = double{all.max[a]} - all.min[a];
            REQUIRE(127.0 * step <= extent);
            for (std::size_t child = 0; child < small.count; ++child) {
                const Aabb is = small.box(child), was = node.box(child);
                REQUIRE(double{was.min[a]} - is.min[a] < 2.0 * step);
                REQUIRE(double{is.max[a]} - was.max[a] < 2.0 * step);
            }
        }
    }
}

TEST_CASE("a plane is the same whether it is fused or not") {
    Pcg32 random(5);
    for (int i = 0; i < 100'000; ++i) {
        CompressedNode node{};
        node.origin[0] = any_float(random, -20, 20);
        node.exponents[0] = static_cast<std::uint8_t>(1 + random.below(200));
        const auto q = static_cast<int>(random.below(256));
        REQUIRE(node.plane(0, q) == std::fma(static_cast<float>(q), node.step(0), node.origin[0]));
    }
}

/// The box of what is below a child, by its triangles; each inner box must hold what is below it.
Aabb checked_box(const CompressedTree& tree, WideChild child, std::vector<int>& seen) {
    Aabb all;
    if (child.is_leaf()) {
        tree.each_block(child, [&](const TriangleBlock& block) {
            for (std::size_t lane = 0; lane < TriangleBlock::size && block.is_used(lane); ++lane) {
                all.extend(bounds(block.triangle(lane)));
                ++seen[block.indices[lane]];
            }
            return true;
        });
        return all;
    }
    const CompressedNode& node = tree.nodes[child.index()];
    for (std::size_t i = 0; i < node.count; ++i) {
        const Aabb below = checked_box(tree, node.children[i], seen);
        REQUIRE(node.box(i).contains(below));
        all.extend(below);
    }
    return all;
}

TEST_CASE(
    "every box of a compressed tree holds what is below it, and every triangle is there once") {
    for (const char* name : {"icosphere:20", "stadium", "soup:3000", "slivers:500"}) {
        const std::vector<Triangle> triangles = make_scene(name).mesh.triangles();
        const CompressedBvh<> bvh = CompressedBvh<>::build(triangles);
        std::vector<int> seen(triangles.size());
        CAPTURE(name);
        checked_box(bvh.tree(), bvh.tree().root, seen);
        CHECK(std::ranges::count(seen, 1) == std::ssize(triangles));
    }
}

TEST_CASE("compressed trees of meshes take at most 40 bytes a triangle") {
    for (const char* name : {"icosphere:60", "stadium", "mount:6"}) {
        const std::vector<Triangle> triangles = make_scene(name).mesh.triangles();
        const TreeShape compressed = CompressedBvh<>::build(triangles).shape(),
                        wide = FastBvh<>::build(triangles).shape();
        CAPTURE(name, compressed.bytes, wide.bytes, triangles.size());
        CHECK(compressed.bytes <= 40 * triangles.size());
        CHECK(compressed.nodes == wide.nodes);
        CHECK(compressed.depth == wide.depth);
        CHECK(compressed.references == wide.references);
    }
}

}  // namespace

TEST_CASE("the suite: compressed wide tree") {
    run_suite<CompressedBvh>("compressed wide tree");
}

TEST_CASE("the suite: compressed wide tree by each instruction set") {
    for (const InstructionSet set : usable_instruction_sets()) {
        CompressedBvh<>::Config config;
        config.instructions = set;
        check_accelerator<CompressedBvh<>>(
            "compressed, " + std::string(name_of(set)),
            [&](std::span<const Triangle> triangles) {
                return CompressedBvh<>::build(triangles, config);
            },
            SuiteOptions{}.fewer());
    }
}

}  // namespace space
