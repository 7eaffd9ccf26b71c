#include "chapters/ch10_fast_traversal/instruction_set.hpp"

#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "common/program/error.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace {

using namespace space;

std::string refusal(std::string_view name) {
    try {
        instruction_set_named(name);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::usage);
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("every instruction set that is usable here is found by its name, and has its kernels") {
    for (const InstructionSet set : usable_instruction_sets()) {
        CHECK(instruction_set_named(name_of(set)) == set);
        CHECK((kernel_table<4>(set) != nullptr) == (set != InstructionSet::scalar));
        CHECK((kernel_table<8>(set) != nullptr) == (set != InstructionSet::scalar));
    }
}

TEST_CASE("without a name the best one is taken") {
    CHECK(instruction_set_named("") == usable_instruction_sets().back());
}

TEST_CASE("a name that is none is refused in one line that has all names") {
    const std::string line = refusal("avx9");
    CHECK(line == "BOOK_ISA=avx9: not one of scalar, portable, sse2, avx2, avx512");
    CHECK(refusal("AVX2").find("BOOK_ISA=AVX2: not one of") == 0);
}

TEST_CASE("what this processor has not got is refused in one line") {
    const std::vector<InstructionSet>& usable = usable_instruction_sets();
    for (std::size_t i = 0; i < instruction_set_names.size(); ++i)
        if (std::ranges::find(usable, static_cast<InstructionSet>(i)) == usable.end())
            CHECK(refusal(instruction_set_names[i]).find("this processor has not got it") !=
                  std::string::npos);
}
