/// @file
/// What the instruction cpuid tells of a processor: recorded answers, and how they are read. The
/// bits are those of Intel's and AMD's manuals (Intel 64 SDM, volume 2A, CPUID; AMD64 APM, volume
/// 3, appendix E).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space {

/// What cpuid leaves in the four registers.
struct CpuidRegisters {
    std::uint32_t eax = 0, ebx = 0, ecx = 0, edx = 0;
    bool operator==(const CpuidRegisters&) const = default;
};

/// One question to cpuid (eax is the leaf, ecx the subleaf) and its answer.
struct CpuidLeaf {
    std::uint32_t leaf = 0, subleaf = 0;
    CpuidRegisters registers = {};
};

/// What one logical processor has answered. Everything else is computed from such a record, so that
/// a machine that is not at hand can be read as well as this one.
struct CpuidLeaves {
    std::vector<CpuidLeaf> leaves = {};
    std::uint64_t xcr0 =
        0;  ///< by xgetbv: the registers that the operating system saves; 0 where it can't be asked

    /// Zeros where nothing is recorded, as a processor answers for most leaves that it has not.
    CpuidRegisters at(std::uint32_t leaf, std::uint32_t subleaf = 0) const {
        for (const CpuidLeaf& each : leaves)
            if (each.leaf == leaf && each.subleaf == subleaf) return each.registers;
        return {};
    }
    /// Leaf 0 tells the highest basic leaf, leaf 0x80000000 the highest extended one. Above it an
    /// Intel processor answers with the highest basic leaf, so one has to look before.
    bool has(std::uint32_t leaf) const { return leaf <= at(leaf & 0x80000000u).eax; }
};

/// The bits `low` to `high` of a word, both included.
constexpr std::uint32_t bits_of(std::uint32_t word, unsigned high, unsigned low) {
    return std::uint32_t((std::uint64_t{word} >> low) &
                         ((std::uint64_t{1} << (high - low + 1)) - 1));
}

/// The four characters in a register, the lowest byte first, without the zeros that pad the text.
inline void append_characters(std::string& text, std::uint32_t word) {
    for (unsigned byte = 0; byte < 4; ++byte)
        if (const char c = char(bits_of(word, 8 * byte + 7, 8 * byte)); c != '\0') text += c;
}

/// "GenuineIntel": in leaf 0, in the order ebx, edx, ecx.
inline std::string vendor(const CpuidLeaves& cpu) {
    const CpuidRegisters r = cpu.at(0);
    std::string text;
    for (const std::uint32_t word : {r.ebx, r.edx, r.ecx}) append_characters(text, word);
    return text;
}

/// The name that the vendor sells it by; empty where it has none.
inline std::string brand(const CpuidLeaves& cpu) {
    std::string text;
    for (const std::uint32_t leaf : {0x80000002u, 0x80000003u, 0x80000004u}) {
        const CpuidRegisters r = cpu.at(leaf);
        for (const std::uint32_t word : {r.eax, r.ebx, r.ecx, r.edx}) append_characters(text, word);
    }
    text.erase(0, text.find_first_not_of(' '));
    return text.erase(text.find_last_not_of(' ') + 1);
}

/// One of the extensions that work on several numbers at once.
struct SimdSet {
    std::string_view name;
    bool present = false;  ///< the processor has it
    bool usable = false;   ///< and the operating system saves its registers when it changes threads
};

// [simd]
/// From SSE to AVX-512. A program may use AVX only if the processor has it *and* the system has set
/// the bits of its registers in XCR0: 1 (xmm) and 2 (ymm), for AVX-512 also 5, 6 and 7 (masks, and
/// both halves of zmm).
inline std::vector<SimdSet> simd_sets(const CpuidLeaves& cpu) {
    const CpuidRegisters one = cpu.at(1), seven = cpu.has(7) ? cpu.at(7) : CpuidRegisters{};
    const bool asks = bits_of(one.ecx, 27, 27);  // OSXSAVE: xgetbv may be asked
    const auto saves = [&](std::uint64_t registers) {
        return asks && (cpu.xcr0 & registers) == registers;
    };
    const bool sse = true, avx = saves(0x06), avx512 = saves(0xe6);
    std::vector<SimdSet> sets;
    const auto add = [&](std::string_view name, std::uint32_t word, unsigned bit, bool saved) {
        const bool present = bits_of(word, bit, bit);
        sets.push_back({name, present, present && saved});
    };
    add("SSE", one.edx, 25, sse);
    add("SSE2", one.edx, 26, sse);
    add("SSE3", one.ecx, 0, sse);
    add("SSSE3", one.ecx, 9, sse);
    add("SSE4.1", one.ecx, 19, sse);
    add("SSE4.2", one.ecx, 20, sse);
    add("AVX", one.ecx, 28, avx);
    add("FMA", one.ecx, 12, avx);
    add("AVX2", seven.ebx, 5, avx);
    add("AVX-512F", seven.ebx, 16, avx512);
    add("AVX-512DQ", seven.ebx, 17, avx512);
    add("AVX-512BW", seven.ebx, 30, avx512);
    add("AVX-512VL", seven.ebx, 31, avx512);
    return sets;
}
// [simd]

/// Does a hypervisor run this system? Then cpuid says what the hypervisor wants it to say.
inline bool is_virtual(const CpuidLeaves& cpu) {
    return bits_of(cpu.at(1).ecx, 31, 31);
}

}  // namespace space
