#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch08_parallel_builds/parallel_morton_builder.hpp"
#include "chapters/ch08_parallel_builds/parallel_radix_sort.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch08/parallel_builders.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <cstdint>
#include <limits>
#include <vector>

using namespace space;

namespace {

/// With limits that give small scenes large nodes, tasks and chunks.
ParallelMortonBuilder::Config config_of(unsigned threads, std::size_t max_leaf_size = 2) {
    ParallelMortonBuilder::Config config;
    config.max_leaf_size = max_leaf_size;
    config.threads = threads, config.large = 60, config.chunk = 7, config.grain = 5;
    return config;
}

void check_same(std::span<const Triangle> triangles) {
    for (const std::size_t leaf : {std::size_t{1}, std::size_t{2}, std::size_t{8}}) {
        const BvhNodes<3> expected = MortonBuilder::build<3>(triangles, {.max_leaf_size = leaf});
        for (const unsigned threads : {1u, 2u, 3u, 8u}) {
            CAPTURE(leaf, threads);
            REQUIRE(difference(ParallelMortonBuilder::build<3>(triangles, config_of(threads, leaf)),
                               expected) == "");
        }
        REQUIRE(difference(ParallelMortonBuilder::build<3>(triangles, config_of(0, leaf)),
                           expected) == "");
    }
}

std::vector<CodedIndex> items_of(std::size_t size, std::uint64_t mask, Pcg32& random) {
    std::vector<CodedIndex> items;
    for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint64_t high = random.next(), low = random.next();
        items.push_back({((high << 32) | low) & mask, i});
    }
    return items;
}

}  // namespace

TEST_CASE("items are sorted as one thread sorts them, equal codes in their order") {
    Pcg32 random(1);
    for (const std::uint64_t mask :
         {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{0xff00},
          std::uint64_t{1} << 63, std::uint64_t{0xf0000000'0000000f}})
        for (const std::size_t size : {0, 1, 2, 6, 7, 8, 100, 1'000})
            for (const std::size_t chunk : {1, 7, 64, 5'000}) {
                const std::vector<CodedIndex> items = items_of(size, mask, random);
                std::vector<CodedIndex> expected = items, scratch, mine = items, other(size);
                radix_sort(expected, scratch);
                WorkStealing threads(3);
                const auto sorted = parallel_radix_sort(mine, other, chunk, threads);
                CAPTURE(mask, size, chunk);
                REQUIRE(std::ranges::equal(sorted, expected));
            }
}

TEST_CASE("any number of threads gives the tree of the sequential builder") {
    for (const std::uint32_t size : {1u, 2u, 3u, 30u, 200u, 900u})
        check_same(scenes::soup(size, 0.1f, size));
}

TEST_CASE("so it is where codes are equal, and where triangles are not finite") {
    check_same(std::vector<Triangle>(100, scenes::soup(1, 0.1f, 3).front()));
    std::vector<Triangle> triangles = scenes::soup(300, 0.1f, 4);
    for (std::size_t i = 0; i < 300; i += 3)
        triangles[i].b.y = std::numeric_limits<float>::infinity();
    for (std::size_t i = 1; i < 300; i += 7) triangles[i] = triangles[2];
    check_same(triangles);
    check_same(std::vector<Triangle>{});
    for (Triangle& triangle : triangles) triangle.a.x = std::numeric_limits<float>::quiet_NaN();
    check_same(triangles);
}

TEST_CASE("a scene that is large by the builder's own limits gives the sequential tree, too") {
    const auto triangles = scenes::soup(sized(100'000u, 40'000u), 0.01f, 6);
    const BvhNodes<3> expected = MortonBuilder::build<3>(triangles);
    ParallelMortonBuilder::Config config;
    config.threads = 4;
    CHECK(difference(ParallelMortonBuilder::build<3>(triangles, config), expected) == "");
}

TEST_CASE("a chunk of none is one of one, and one of more than there are is one of all") {
    const auto triangles = scenes::soup(100, 0.1f, 8);
    for (const std::size_t chunk : {std::size_t{0}, std::size_t{1} << 60, ~std::size_t{0}}) {
        ParallelMortonBuilder::Config config = config_of(2);
        config.chunk = chunk, config.large = 0, config.grain = 0;
        CAPTURE(chunk);
        CHECK(difference(ParallelMortonBuilder::build<3>(triangles, config),
                         MortonBuilder::build<3>(triangles)) == "");
    }
}
