#include "ex02_sorting_network.hpp"

#include "common/geometry.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace space;

namespace {

/// An exchange of two places: the smaller goes to the first.
struct Exchange {
    int smaller, larger;
};

/// What the answer calls; it cannot depend on any numbers, for it sees none.
std::vector<Exchange> network() {
    std::vector<Exchange> pairs;
    sort_four([&](int i, int j) {
        if (i < 0 || i > 3 || j < 0 || j > 3) FAIL("exchange(" << i << ", " << j << "): no place");
        if (i == j) FAIL("exchange(" << i << ", " << j << "): one place");
        if (pairs.size() == 1'000) FAIL("exchanges without end");
        pairs.push_back({i, j});
    });
    return pairs;
}

using Row = std::array<float, 4>;
std::string text(const Row& row) {
    std::string numbers;
    for (const float x : row) numbers += fmt::format("{}{}", numbers.empty() ? "" : " ", x);
    return numbers;
}
/// What stands there after the network.
std::string sorted_by_answer(Row row) {
    for (const auto& [i, j] : network())
        if (row[std::size_t(j)] < row[std::size_t(i)])
            std::swap(row[std::size_t(i)], row[std::size_t(j)]);
    return text(row);
}
std::string in_order(Row row) {
    std::ranges::sort(row);
    return text(row);
}

}  // namespace

TEST_CASE("it asks for exchanges, of two places from 0 to 3") {
    CHECK_FALSE(network().empty());
}

TEST_CASE("each of the 16 rows of zeros and ones comes out in order, and so does everything") {
    for (unsigned bits = 0; bits < 16; ++bits) {
        Row row{};
        for (unsigned place = 0; place < 4; ++place) row[place] = float(bits >> place & 1u);
        CAPTURE(text(row));
        REQUIRE(sorted_by_answer(row) == in_order(row));
    }
}

TEST_CASE("five exchanges are enough") {
    CHECK(network().size() <= 5);
}

TEST_CASE("the 24 orders of four numbers, as the principle says") {
    Row row{1, 2, 3, 4};
    do {
        CAPTURE(text(row));
        REQUIRE(sorted_by_answer(row) == "1 2 3 4");
    } while (std::ranges::next_permutation(row).found);
}

TEST_CASE("equal numbers, and children that are missed, at infinity") {
    for (const Row& row : {Row{2, 1, 2, 1}, Row{infinity, 3, infinity, 1}, Row{5, 5, 5, 5},
                           Row{infinity, infinity, -0.5f, 2}}) {
        CAPTURE(text(row));
        REQUIRE(sorted_by_answer(row) == in_order(row));
    }
}
