#include "chapters/ch10_fast_traversal/instruction_set.hpp"

#include "chapters/ch08_parallel_builds/cpuid.hpp"
#include "chapters/ch08_parallel_builds/this_processor.hpp"
#include "common/program/error.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>

namespace space {
namespace {

/// Those that kernel_avx2.cpp is compiled for beside AVX2 and FMA: the compiler takes their
/// instructions wherever they are shorter. A hypervisor may hide any of them.
bool has_bit_instructions(const CpuidLeaves& cpu) {
    const CpuidRegisters one = cpu.at(1), seven = cpu.has(7) ? cpu.at(7) : CpuidRegisters{},
                         extended = cpu.has(0x80000001u) ? cpu.at(0x80000001u) : CpuidRegisters{};
    const bool popcnt = bits_of(one.ecx, 23, 23), bmi1 = bits_of(seven.ebx, 3, 3),
               bmi2 = bits_of(seven.ebx, 8, 8), lzcnt = bits_of(extended.ecx, 5, 5);
    return popcnt && bmi1 && bmi2 && lzcnt;
}

std::string listed(std::span<const std::string_view> names) {
    std::string list;
    for (const std::string_view name : names) list.append(list.empty() ? "" : ", ").append(name);
    return list;
}

}  // namespace

std::vector<InstructionSet> instruction_sets_of(const CpuidLeaves& cpu) {
    std::vector<InstructionSet> sets{InstructionSet::scalar, InstructionSet::portable,
                                     InstructionSet::sse2};  // every processor of 64 bits has it
    const std::vector<SimdSet> simd = simd_sets(cpu);
    const auto has = [&](std::string_view name) {
        return std::ranges::any_of(simd,
                                   [&](const SimdSet& s) { return s.name == name && s.usable; });
    };
    if (!has("AVX2") || !has("FMA") || !has_bit_instructions(cpu)) return sets;
    sets.push_back(InstructionSet::avx2);
    if (has("AVX-512F") && has("AVX-512DQ") && has("AVX-512BW") && has("AVX-512VL"))
        sets.push_back(InstructionSet::avx512);
    return sets;
}

const std::vector<InstructionSet>& usable_instruction_sets() {
    // Of the processor on which this thread runs: kernels of different kinds in one machine that
    // have different instructions are not known.
#if defined(SPACE_HAS_CPUID) && defined(__x86_64__)
    static const std::vector<InstructionSet> sets = instruction_sets_of(record_leaves());
#else
    static const std::vector<InstructionSet> sets{InstructionSet::scalar, InstructionSet::portable};
#endif
    return sets;
}

// [chosen_instruction_set]
InstructionSet instruction_set_named(std::string_view name) {
    const std::vector<InstructionSet>& usable = usable_instruction_sets();
    if (name.empty()) return usable.back();
    const auto place = std::ranges::find(instruction_set_names, name);
    const std::string asked = "BOOK_ISA=" + std::string(name);
    if (place == instruction_set_names.end())
        throw usage_error(asked + ": not one of " + listed(instruction_set_names));
    const auto set = static_cast<InstructionSet>(place - instruction_set_names.begin());
    if (std::ranges::find(usable, set) == usable.end())
        throw usage_error(asked + ": this processor has not got it; it has " +
                          listed(std::span(instruction_set_names).first(usable.size())));
    return set;
}

InstructionSet chosen_instruction_set() {
    const char* const asked = std::getenv("BOOK_ISA");
    return instruction_set_named(asked != nullptr ? asked : "");
}
// [chosen_instruction_set]

}  // namespace space
