#include "chapters/ch10_fast_traversal/instruction_set.hpp"

#include "chapters/ch08_parallel_builds/cpuid.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "common/program/error.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cstdint>
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

/// A processor that has all that kernels are compiled for, but for what is taken away.
struct Without {
    std::uint32_t one_ecx = 0, seven_ebx = 0, extended_ecx = 0;
    std::uint64_t xcr0 = 0;
};
InstructionSet best_of(const Without& without) {
    const std::uint32_t osxsave = 1u << 27, avx = 1u << 28, fma = 1u << 12, popcnt = 1u << 23;
    const std::uint32_t avx2 = 1u << 5, bmi1 = 1u << 3, bmi2 = 1u << 8, avx512_f_dq = 3u << 16,
                        avx512_bw_vl = 3u << 30, lzcnt = 1u << 5;
    CpuidLeaves cpu{.xcr0 = 0xe7 & ~without.xcr0};
    cpu.leaves = {
        {0x0, 0, {.eax = 7}},
        {0x1, 0, {.ecx = (osxsave | avx | fma | popcnt) & ~without.one_ecx}},
        {0x7, 0, {.ebx = (avx2 | bmi1 | bmi2 | avx512_f_dq | avx512_bw_vl) & ~without.seven_ebx}},
        {0x80000000u, 0, {.eax = 0x80000008u}},
        {0x80000001u, 0, {.ecx = lzcnt & ~without.extended_ecx}}};
    return instruction_sets_of(cpu).back();
}

}  // namespace

TEST_CASE("kernels are for processors that have every instruction they are compiled for") {
    CHECK(best_of({}) == InstructionSet::avx512);
    for (const unsigned bit : {16u, 17u, 30u, 31u})  // AVX-512 F, DQ, BW, VL
        CHECK(best_of({.seven_ebx = 1u << bit}) == InstructionSet::avx2);
    CHECK(best_of({.xcr0 = 0xe0}) == InstructionSet::avx2);  // the system does not save them
    for (const unsigned bit : {12u, 23u, 27u})               // FMA, POPCNT, OSXSAVE
        CHECK(best_of({.one_ecx = 1u << bit}) == InstructionSet::sse2);
    for (const unsigned bit : {3u, 5u, 8u})  // BMI1, AVX2, BMI2
        CHECK(best_of({.seven_ebx = 1u << bit}) == InstructionSet::sse2);
    CHECK(best_of({.extended_ecx = 1u << 5}) == InstructionSet::sse2);  // LZCNT
    CHECK(best_of({.xcr0 = 0x4}) == InstructionSet::sse2);
    CHECK(instruction_sets_of(CpuidLeaves{}).back() == InstructionSet::sse2);
}

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
