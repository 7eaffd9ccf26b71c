#include "chapters/ch10_fast_traversal/instruction_set.hpp"

#include "chapters/ch08_parallel_builds/cpuid.hpp"
#include "chapters/ch08_parallel_builds/this_processor.hpp"
#include "common/program/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>

namespace space {
namespace {

#if defined(SPACE_HAS_CPUID) && defined(__x86_64__)
/// Of the processor on which this thread runs: kernels of different kinds in one machine that have
/// different instructions are not known.
void add_x86(std::vector<InstructionSet>& sets) {
    const std::vector<SimdSet> simd = simd_sets(record_leaves());
    const auto has = [&](std::string_view name) {
        return std::ranges::any_of(simd,
                                   [&](const SimdSet& s) { return s.name == name && s.usable; });
    };
    sets.push_back(InstructionSet::sse2);  // every processor of 64 bits has it
    if (!has("AVX2") || !has("FMA")) return;
    sets.push_back(InstructionSet::avx2);
    if (has("AVX-512F") && has("AVX-512DQ") && has("AVX-512BW") && has("AVX-512VL"))
        sets.push_back(InstructionSet::avx512);
}
#else
void add_x86(std::vector<InstructionSet>&) {}
#endif

}  // namespace

const std::vector<InstructionSet>& usable_instruction_sets() {
    static const std::vector<InstructionSet> sets = [] {
        std::vector<InstructionSet> found{InstructionSet::scalar, InstructionSet::portable};
        add_x86(found);
        return found;
    }();
    return sets;
}

// [chosen_instruction_set]
InstructionSet instruction_set_named(std::string_view name) {
    const std::vector<InstructionSet>& usable = usable_instruction_sets();
    if (name.empty()) return usable.back();
    const auto place = std::ranges::find(instruction_set_names, name);
    if (place == instruction_set_names.end())
        throw usage_error(fmt::format("BOOK_ISA={}: not one of {}", name,
                                      fmt::join(instruction_set_names, ", ")));
    const auto set = static_cast<InstructionSet>(place - instruction_set_names.begin());
    if (std::ranges::find(usable, set) == usable.end())
        throw usage_error(fmt::format(
            "BOOK_ISA={}: this processor has not got it; it has {}", name,
            fmt::join(instruction_set_names.begin(),
                      instruction_set_names.begin() + std::ptrdiff_t(usable.size()), ", ")));
    return set;
}

InstructionSet chosen_instruction_set() {
    const char* const asked = std::getenv("BOOK_ISA");
    return instruction_set_named(asked != nullptr ? asked : "");
}
// [chosen_instruction_set]

}  // namespace space
