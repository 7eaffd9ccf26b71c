// The sort of Morton codes against the library's stable one.
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <vector>

namespace space {
namespace {

/// Codes with `bits` bits from bit `shift` on, and indices in order, so that equal codes show
/// whether they kept it.
std::vector<CodedIndex> some_items(std::size_t count, int bits, int shift, std::uint64_t others) {
    Pcg32 random(count + std::uint64_t(bits));
    std::vector<CodedIndex> items(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t high = random.next(), low = random.next();
        const std::uint64_t code = bits == 0 ? 0 : ((high << 32) | low) >> (64 - bits);
        items[i] = {(code << shift) | others, i};
    }
    return items;
}

RadixSortWork check_sorted(std::vector<CodedIndex> items) {
    std::vector<CodedIndex> wanted = items, scratch;
    std::ranges::stable_sort(wanted, {}, &CodedIndex::code);
    const RadixSortWork work = radix_sort(items, scratch);
    REQUIRE(items == wanted);
    CHECK(work.items == items.size());
    return work;
}

}  // namespace

TEST_CASE("sorted as std::stable_sort does it, at any size and width of codes") {
    for (const std::size_t count :
         {0u, 1u, 2u, 3u, 255u, 256u, 257u, 1'000u, sized(100'000u, 5'000u)})
        for (const int bits : {0, 1, 3, 8, 9, 30, 62, 63, 64})
            check_sorted(some_items(count, bits, 0, 0));
}

TEST_CASE("digits that are the same in all codes take no pass") {
    CHECK(check_sorted(some_items(1'000, 64, 0, 0)).passes == 8);
    CHECK(check_sorted(some_items(1'000, 63, 0, 0)).passes == 8);
    CHECK(check_sorted(some_items(1'000, 30, 0, 0)).passes == 4);
    CHECK(check_sorted(some_items(1'000, 8, 40, 0x1234)).passes == 1);
    CHECK(check_sorted(some_items(1'000, 0, 0, 77)).passes == 0);
    CHECK(check_sorted({}).passes == 0);
    CHECK(check_sorted({{5, 0}}).passes == 0);
}

TEST_CASE("equal codes stay in order, whatever their indices are") {
    std::vector<CodedIndex> items{{2, 9}, {1, 8}, {2, 7}, {1, 6}, {2, 5}}, scratch;
    radix_sort(items, scratch);
    CHECK(items == std::vector<CodedIndex>{{1, 8}, {1, 6}, {2, 9}, {2, 7}, {2, 5}});
}

TEST_CASE("bytes are counted: one look at each item, then twice its size a pass") {
    CHECK(RadixSortWork{.items = 10, .passes = 0}.bytes_moved() == 160);
    CHECK(RadixSortWork{.items = 10, .passes = 8}.bytes_moved() == 160 * 17);
}

TEST_CASE("the second sort of as many items allocates nothing") {
    std::vector<CodedIndex> items = some_items(1'000, 63, 0, 0), scratch;
    radix_sort(items, scratch);
    const auto *a = items.data(), *b = scratch.data();
    std::ranges::reverse(items);
    radix_sort(items, scratch);
    CHECK(
        ((items.data() == a && scratch.data() == b) || (items.data() == b && scratch.data() == a)));
}

}  // namespace space
