// The collapse of a binary tree: the cheapest of all choices, as it says, and no dearer than the
// greedy one.
#include "chapters/ch10_fast_traversal/collapse.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "common/accelerator.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/wide_faults.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space {
namespace {

/// What becomes of an inner node.
enum class Fate { vanishes, stays, is_leaf };

/// Tries all fates of the inner nodes of a small tree.
template <int N>
class AllChoices {
  public:
    AllChoices(const BvhNodes<3>& tree, const CollapseConfig& config)
        : tree_(tree), config_(config), chance_(tree.nodes[0].box) {
        tree.for_each_node([&](std::uint32_t node, unsigned) {
            if (!tree.nodes[node].is_leaf()) inner_.push_back(node);
        });
    }

    double least() {
        fates_.assign(tree_.nodes.size(), Fate::vanishes);
        best_ = infinity;
        choose(0);
        return best_;
    }

  private:
    struct Below {
        std::size_t places;
        double cost;
    };

    void choose(std::size_t i) {
        if (i < inner_.size()) {
            for (const Fate fate : {Fate::vanishes, Fate::stays, Fate::is_leaf}) {
                fates_[inner_[i]] = fate;
                choose(i + 1);
            }
            return;
        }
        const Below all = below(0);
        if (all.places == 1) best_ = std::min(best_, all.cost);
    }
    std::size_t references(std::uint32_t node) const {
        const BvhNode<3>& n = tree_.nodes[node];
        return n.is_leaf() ? n.count : references(n.first) + references(n.first + 1);
    }
    /// Infinite where it is not allowed.
    Below below(std::uint32_t index) const {
        const BvhNode<3>& node = tree_.nodes[index];
        const double chance = chance_(node.box);
        const std::size_t size = references(index),
                          blocks = (size + config_.block_size - 1) / config_.block_size;
        const bool joins = !node.is_leaf() && fates_[index] == Fate::is_leaf;
        if (joins && size > config_.max_leaf) return {1, infinity};
        if (joins || node.is_leaf()) return {1, config_.block_cost * chance * double(blocks)};
        const Below a = below(node.first), b = below(node.first + 1);
        const Below both{a.places + b.places, a.cost + b.cost};
        if (fates_[index] == Fate::vanishes) return both;
        return {1, both.places > N ? infinity : both.cost + config_.node_cost * chance};
    }

    const BvhNodes<3>& tree_;
    CollapseConfig config_;
    HitChance<3> chance_;
    std::vector<std::uint32_t> inner_;
    std::vector<Fate> fates_;
    double best_ = infinity;
};

/// The cost of a wide tree as it stands.
template <int N>
double cost_of(const WideTree<N>& tree, const CollapseConfig& config) {
    const HitChance<3> chance(tree.box);
    struct Waiting {
        WideChild child;
        Aabb box;
    };
    std::vector<Waiting> waiting{{tree.root, tree.box}};
    double cost = 0.0;
    while (!waiting.empty()) {
        const auto [child, box] = waiting.back();
        waiting.pop_back();
        cost +=
            chance(box) * (child.is_leaf() ? config.block_cost * child.count() : config.node_cost);
        if (child.is_leaf()) continue;
        const WideNode<N>& node = tree.nodes[child.index()];
        for (std::size_t i = 0; i < N; ++i)
            if (node.is_used(i)) waiting.push_back({node.children[i], node.box(i)});
    }
    return cost;
}

template <int N, class Builder>
void check_least(std::span<const Triangle> triangles, const typename Builder::Config& binary,
                 const CollapseConfig& config) {
    const auto tree = Builder::template build<3>(triangles, binary);
    const auto wide = collapsed<N>(tree, triangles, config);
    REQUIRE(wide_faults(wide, triangles) == "");
    REQUIRE(wide.cost == Approx(cost_of(wide, config)).epsilon(1e-5));
    REQUIRE(wide.cost == Approx(AllChoices<N>(tree, config).least()).epsilon(1e-5));
}

}  // namespace

TEST_CASE("the collapse is the cheapest of all choices, and costs what it says") {
    Pcg32 random(1);
    for (int i = 0; i < sized(120, 12); ++i) {
        const std::uint32_t count = 2 + random.below(8);
        const auto triangles = scenes::soup(count, 0.3f, random.next());
        const std::size_t max_leaf = 1 + random.below(9);
        const double node_cost = 0.25 * double(random.below(9));
        const double block_cost = 0.25 * double(1 + random.below(8));
        const CollapseConfig config{
            .node_cost = node_cost, .block_cost = block_cost, .max_leaf = max_leaf};
        CAPTURE(i, count, max_leaf, node_cost, block_cost);
        check_least<4, MedianBuilder>(triangles, {.max_leaf_size = 1}, config);
        check_least<8, MedianBuilder>(triangles, {.max_leaf_size = 1}, config);
        check_least<4, BinnedBuilder>(triangles, {}, config);
    }
}

TEST_CASE("on the book's scenes the greedy collapse is dearer, and both cost what they say") {
    for (const char* name : {"icosphere", "soup", "slivers", "boxes", "building:1", "stadium:3"}) {
        const auto triangles = make_scene(name, 1, true).mesh.triangles();
        const auto check = [&](const BvhNodes<3>& binary, Named how) {
            const auto compare = [&]<int N>() {
                const CollapseConfig config{}, greedy{.way = CollapseConfig::Way::greedy};
                const auto best = collapsed<N>(binary, triangles, config),
                           other = collapsed<N>(binary, triangles, greedy);
                REQUIRE(wide_faults(best, triangles, how) == "");
                REQUIRE(wide_faults(other, triangles, how) == "");
                REQUIRE(best.cost == Approx(cost_of(best, config)).epsilon(1e-4));
                REQUIRE(cost_of(other, greedy) >= best.cost * (1.0 - 1e-4));
                return cost_of(other, greedy) / best.cost;
            };
            const double four = compare.template operator()<4>();
            const double eight = compare.template operator()<8>();
            fmt::print("  {}: greedy / least cost {:.3f} with nodes of four, {:.3f} of eight\n",
                       name, four, eight);
            CHECK(four > 1.0);
        };
        CAPTURE(name);
        check(BinnedBuilder::build<3>(triangles), Named::once);
        check(SpatialSplitBuilder::build<3>(triangles), Named::in_parts);
    }
}

TEST_CASE("a leaf names a triangle once, though spatial splits have put it into all of its parts") {
    // Rods along the diagonal: splits cut them, and the collapse joins what they were cut into.
    const auto rods = make_scene("slivers:200").mesh.triangles();
    const SpatialSplitConfig splits{.costs = {0.0, 1.0},
                                    .max_leaf_size = 1,
                                    .min_overlap = 0.0,
                                    .max_growth = 4.0,
                                    .unsplits = false};
    const auto binary = SpatialSplitBuilder::build<3>(rods, splits);
    REQUIRE(binary.references.size() > rods.size());
    const CollapseConfig large{.node_cost = 4.0, .max_leaf = 32};
    const auto four = collapsed<4>(binary, rods, large);
    const auto eight = collapsed<8>(binary, rods, large);
    CHECK(wide_faults(four, rods, Named::in_parts) == "");
    CHECK(wide_faults(eight, rods, Named::in_parts) == "");
    CHECK(four.references < binary.references.size());
    CHECK(eight.references < binary.references.size());
    CHECK(eight.references > rods.size());
}

TEST_CASE("a triangle that is named twice is a fault") {
    const auto triangles = scenes::soup(20, 0.3f, 1);
    const auto binary = MedianBuilder::build<3>(triangles, {.max_leaf_size = 3});
    auto tree = collapsed<4>(binary, triangles, {.max_leaf = 3});
    REQUIRE(wide_faults(tree, triangles) == "");
    TriangleBlock& block = tree.blocks.front();
    REQUIRE((block.is_used(0) && !block.is_used(3)));
    const std::uint32_t own = block.indices[0], other = tree.blocks.back().indices[0];
    ++tree.references;
    const auto fault_with = [&](std::uint32_t index, Named how) {
        block.put(block.is_used(2) ? 3 : 2, triangles[index], index);
        std::string fault = wide_faults(tree, triangles, how);
        block.clear(block.is_used(3) ? 3 : 2);
        return fault;
    };
    for (const Named how : {Named::once, Named::in_parts})
        CHECK(fault_with(own, how) == fmt::format("triangle {}: twice in one leaf", own));
    CHECK(fault_with(other, Named::once) != "");
    CHECK(fault_with(other, Named::in_parts) == "");
}

namespace {

/// One binary leaf with so many triangles, which a wide leaf may not hold.
template <int N>
void check_crowd(std::uint32_t count) {
    constexpr std::size_t most = WideChild::max_blocks * TriangleBlock::size;
    const auto triangles = scenes::soup(count, 0.2f, count);
    const auto binary = MedianBuilder::build<3>(triangles, {.max_leaf_size = count});
    REQUIRE(binary.depth == 0);
    const auto tree = collapsed<N>(binary, triangles);
    CAPTURE(N, count);
    REQUIRE(wide_faults(tree, triangles) == "");
    REQUIRE(tree.root.is_leaf() == (count <= most));
    // As few levels as there can be, and boxes no larger than what is in them.
    unsigned levels = 0;
    for (std::size_t room = most; room < count; room *= N) ++levels;
    CHECK(tree.depth == levels);
    for (const WideNode<N>& node : tree.nodes)
        for (std::size_t i = 0; i < N; ++i) {
            if (!node.is_used(i) || !node.children[i].is_leaf()) continue;
            Aabb box;
            tree.each_block(node.children[i], [&](const TriangleBlock& block) {
                for (std::size_t lane = 0; lane < 4 && block.is_used(lane); ++lane)
                    box.extend(bounds(block.triangle(lane)));
                return true;
            });
            REQUIRE(box == node.box(i));
        }
    const auto naive = Naive<FilteredExact>::build(triangles);
    RayMaker maker(triangles, 3);
    std::vector<Ray> rays;
    for (const Triangle& t : triangles) rays.push_back(maker.probe(t));
    for (const InstructionSet set : usable_instruction_sets()) {
        const auto bvh = WideBvh<N, MedianBuilder>::of(tree, set);
        CAPTURE(name_of(set));
        for (const Ray& ray : rays) {
            REQUIRE(closest_hit(bvh, ray) == closest_hit(naive, ray));
            REQUIRE(any_hit(bvh, ray) == closest_hit(naive, ray).has_value());
        }
    }
}

}  // namespace

TEST_CASE("a crowd that no leaf may hold is shared out, from 33 triangles on, and none is lost") {
    for (const std::uint32_t count : {1u, 31u, 32u, 33u, 64u, 65u, 128u, 129u, 257u, 300u}) {
        check_crowd<4>(count);
        check_crowd<8>(count);
    }
}

}  // namespace space
