/// @file
/// Which instructions the kernels may use: the best that this processor has, unless BOOK_ISA names
/// another.
#pragma once

#include "chapters/ch08_parallel_builds/cpuid.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace space {

/// What a kernel is compiled for.
enum class InstructionSet {
    scalar,    ///< no kernel: the walk in plain C++
    portable,  ///< the kernels' text with the compiler's own vectors, for any processor
    sse2,
    avx2,    ///< with fused multiply-add
    avx512,  ///< with VL, DQ and BW
};
inline constexpr std::array<std::string_view, 5> instruction_set_names{"scalar", "portable", "sse2",
                                                                       "avx2", "avx512"};

inline std::string_view name_of(InstructionSet set) {
    return instruction_set_names[static_cast<std::size_t>(set)];
}

/// Those of an x86 processor of 64 bits that has answered so, from the plainest to the best.
std::vector<InstructionSet> instruction_sets_of(const CpuidLeaves& cpu);

/// Those that this processor, its system and this program have, from the plainest to the best.
const std::vector<InstructionSet>& usable_instruction_sets();

/// What a name asks for; the best usable one where it is empty.
/// @throws Error (usage) for a name that is none, or an instruction set that is not usable here
InstructionSet instruction_set_named(std::string_view name);

/// By the environment's BOOK_ISA. @throws as instruction_set_named
InstructionSet chosen_instruction_set();

}  // namespace space
