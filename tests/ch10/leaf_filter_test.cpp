// The filter of a leaf's four lanes: its bounds hold, and are not much larger than errors get.
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/filter_errors.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space {
namespace {

void check(const char* how, const FilterErrors& most) {
    fmt::print("  largest error / bound, {}: volumes {:.2f}, late {:.2f}, early {:.2f}\n", how,
               most.volumes, most.late, most.early);
    for (const double share : {most.volumes, most.late, most.early}) {
        CHECK(share > 0.2);
        CHECK(share < 0.95);  // what is compared is rounded, too
    }
}

}  // namespace

TEST_CASE("of the filter's bounds a fifth is used by some lane, and by none all") {
    const int blocks = sized(200'000, 5'000);
    check("products and sums rounded", plain_filter_errors(1, blocks));
    if (std::ranges::count(usable_instruction_sets(), InstructionSet::avx2) > 0)
        check("fused", fused_filter_errors(1, blocks));
}

}  // namespace space
