// The linear BVH: where prefixes are cut, and what equal codes do (catalogue V7).
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

namespace space {
namespace {

using Prefix = std::function<int(std::uint32_t, std::uint32_t)>;

/// Of codes alone, as if they all differed.
Prefix plain(const std::vector<std::uint64_t>& codes) {
    return [&codes](auto i, auto j) { return std::countl_zero(codes[i] ^ codes[j]); };
}
Prefix with_places(const std::vector<std::uint64_t>& codes) {
    return [&codes](auto i, auto j) { return MortonKeys{codes}.common_prefix(i, j); };
}

/// What an inner node covers, both ends included, and the last key of its first child.
using Covered = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

/// Inner node i of n - 1, by itself, as Karras 2012 finds it (section 4): it has key i at one end,
/// and reaches to the side on which the neighbour has more in common with it.
Covered karras_node(std::uint32_t i, std::uint32_t n, const Prefix& prefix) {
    const auto common = [&](std::int64_t j) {
        return j < 0 || j >= n ? -1 : prefix(i, static_cast<std::uint32_t>(j));
    };
    const std::int64_t here = i, step = common(here + 1) > common(here - 1) ? 1 : -1;
    // Keys are sorted: in both directions less and less is common.
    const auto reach = [&](int more_than) {
        std::int64_t j = here;
        while (common(j + step) > more_than) j += step;
        return j;
    };
    const std::int64_t other = reach(common(here - step));
    const std::int64_t split = reach(common(other)) + std::min<std::int64_t>(step, 0);
    return {std::uint32_t(std::min(here, other)), std::uint32_t(std::max(here, other)),
            std::uint32_t(split)};
}

/// How many of the inner nodes (but the root, 0) and of the leaves have not one parent.
std::pair<int, int> not_one_parent(std::uint32_t n, const Prefix& prefix) {
    std::vector<int> of_inner(n - 1, 0), of_leaf(n, 0);
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
        const auto [first, last, split] = karras_node(i, n, prefix);
        ++(first == split ? of_leaf[first] : of_inner[split]);
        if (split + 1 < n) ++(last == split + 1 ? of_leaf[last] : of_inner.at(split + 1));
    }
    const auto wrong = [](auto begin, auto end) {
        return int(std::count_if(begin, end, [](int parents) { return parents != 1; }));
    };
    return {wrong(of_inner.begin() + 1, of_inner.end()), wrong(of_leaf.begin(), of_leaf.end())};
}

/// What prefix_split makes of all keys, and the depth.
std::pair<std::vector<Covered>, unsigned> top_down(std::uint32_t n, const Prefix& prefix) {
    std::vector<Covered> nodes;
    unsigned depth = 0;
    std::vector<std::tuple<std::uint32_t, std::uint32_t, unsigned>> waiting{{0, n, 0}};
    while (!waiting.empty()) {
        const auto [first, last, level] = waiting.back();
        waiting.pop_back();
        depth = std::max(depth, level);
        if (last - first == 1) continue;
        const std::uint32_t middle = prefix_split(first, last, prefix);
        REQUIRE((first < middle && middle < last));
        nodes.emplace_back(first, last - 1, middle - 1);
        waiting.emplace_back(first, middle, level + 1);
        waiting.emplace_back(middle, last, level + 1);
    }
    std::ranges::sort(nodes);
    return {nodes, depth};
}

std::vector<std::uint64_t> random_codes(std::uint32_t n, std::uint32_t bound, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<std::uint64_t> codes;
    for (std::uint32_t i = 0; i < n; ++i) codes.push_back(random.below(bound));
    std::ranges::sort(codes);
    return codes;
}

/// 64 codes, of which 40 are equal: the catalogue's.
std::vector<std::uint64_t> forty_equal() {
    auto codes = random_codes(24, 1u << 30, 7);
    codes.insert(codes.end(), 40, codes[11]);
    std::ranges::sort(codes);
    return codes;
}

}  // namespace

TEST_CASE("V7, as it is printed: equal codes leave nodes without a parent, or with several") {
    const auto codes = forty_equal();
    const auto [inner, leaves] = not_one_parent(64, plain(codes));
    INFO(inner << " inner nodes, " << leaves << " leaves");
    CHECK(inner + leaves > 0);
    CHECK(not_one_parent(64, with_places(codes)) == std::pair(0, 0));
    // Without equal ones codes do alone.
    auto different = codes;
    for (std::size_t i = 0; i < different.size(); ++i) different[i] = different[i] * 64 + i;
    CHECK(not_one_parent(64, plain(different)) == std::pair(0, 0));
}

TEST_CASE("V7 from the root down: equal codes make a chain, and with their places halves") {
    const std::vector<std::uint64_t> codes(1'000, 42);
    CHECK(top_down(1'000, plain(codes)).second == 999);
    CHECK(top_down(1'000, with_places(codes)).second == 10);
}

TEST_CASE("each split is the one that Karras finds from the node's own key") {
    for (const std::uint32_t bound : {2u, 20u, 1u << 20, ~0u})
        for (const std::uint32_t n : {2u, 3u, 64u, 333u}) {
            const auto codes = random_codes(n, bound, n);
            std::vector<Covered> by_keys;
            for (std::uint32_t i = 0; i + 1 < n; ++i)
                by_keys.push_back(karras_node(i, n, with_places(codes)));
            std::ranges::sort(by_keys);
            CHECK(top_down(n, with_places(codes)).first == by_keys);
        }
}

TEST_CASE("four points in the plane, by hand") {
    // Codes have y's bit above x's: 1 and 3 are below the middle in y, 0 and 2 above.
    const std::vector<Segment> points{
        {{0, 3}, {0, 3}}, {{0, 0}, {0, 0}}, {{3, 3}, {3, 3}}, {{3, 0}, {3, 0}}};
    const auto tree = MortonBuilder::build<2>(points, {.max_leaf_size = 1});
    CHECK(tree.references == std::vector<std::uint32_t>{1, 3, 0, 2});
    CHECK(tree.depth == 2);
    CHECK(tree.nodes[2].box == Aabb2{{0, 0}, {3, 0}});
    CHECK(tree.nodes[3].box == Aabb2{{0, 3}, {3, 3}});
    CHECK(MortonBuilder::build<2>(points, {.max_leaf_size = 2}).size() == 3);
    CHECK(MortonBuilder::build<2>(points, {.max_leaf_size = 4}).size() == 1);
}

TEST_CASE("copies of a triangle make a tree that is as deep as the logarithm of their number") {
    const std::vector<Triangle> copies(1'000, Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto tree = MortonBuilder::build<3>(copies, {.max_leaf_size = 1});
    CHECK(tree.depth == 10);
    CHECK(faults_of(tree, copies, 1) == "");
    // Nested clusters, each a thousandth as wide: as many levels as codes have bits, and no more.
    std::vector<Triangle> nested;
    float size = 1.0f;
    for (int i = 0; i < 24; ++i, size *= 0x1p-10f)
        for (const Triangle& t : scenes::soup(8, 0.1f, 3))
            nested.push_back({t.a * size, t.b * size, t.c * size});
    const auto deep = MortonBuilder::build<3>(nested, {.max_leaf_size = 1});
    CHECK(faults_of(deep, nested, 1) == "");
    CHECK(deep.depth <= 63u + 8u);
}

}  // namespace space
