/// @file
/// Where a logical processor is: each has a number, its APIC id, whose lowest bits tell the thread
/// in its core, the next the core in its package, and the rest the package. How many bits belong to
/// each, cpuid tells in three ways, by age: leaves 1 and 4 (Intel), leaves 0x80000008 and
/// 0x8000001E (AMD), leaf 0xB or 0x1F (both).
#pragma once

#include "chapters/ch08_parallel_builds/cpuid.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>

namespace space {

/// Where the fields of an APIC id begin, the package's no earlier than the core's, whatever a
/// hypervisor says. A field of w bits has room for 2^w; it says not how many there are.
struct ApicIdFields {
    unsigned core_shift = 0;     ///< the width of the thread's field
    unsigned package_shift = 0;  ///< that and the width of the core's
    bool operator==(const ApicIdFields&) const = default;
};

/// An APIC id taken apart.
struct ApicPlace {
    std::uint32_t package = 0;
    std::uint32_t core = 0;    ///< in its package
    std::uint32_t thread = 0;  ///< in its core
    bool operator==(const ApicPlace&) const = default;
};

// [place_of]
/// The bits from `begin` to below `end`; none is 0.
constexpr std::uint32_t field_of(std::uint32_t id, unsigned begin, unsigned end) {
    const std::uint64_t mask = (std::uint64_t{1} << end) - 1;
    return std::uint32_t((id & mask) >> begin);
}

constexpr ApicPlace place_of(std::uint32_t id, ApicIdFields fields) {
    return {field_of(id, fields.package_shift, 32),
            field_of(id, fields.core_shift, fields.package_shift),
            field_of(id, 0, fields.core_shift)};
}
// [place_of]

/// How many bits count to n: the least w with 2^w >= n.
constexpr unsigned bits_for(std::uint32_t n) {
    return n <= 1 ? 0 : unsigned(std::bit_width(n - 1));
}

/// A logical processor's APIC id, its fields, and the leaves that told.
struct ApicReading {
    std::uint32_t id = 0;
    ApicIdFields fields = {};
    std::string_view from;
};

// [old_leaves]
/// By leaves 1 and 4: leaf 1 has room for how many ids a package takes, leaf 4 for how many of its
/// cores. The id has 8 bits, so no more than 256 processors can be told apart.
inline ApicReading apic_by_leaves_1_and_4(const CpuidLeaves& cpu) {
    const CpuidRegisters one = cpu.at(1);
    const bool has_several = bits_of(one.edx, 28, 28);
    const unsigned package_bits = has_several ? bits_for(bits_of(one.ebx, 23, 16)) : 0;
    const std::uint32_t caches = cpu.has(4) ? cpu.at(4).eax : 0;
    const bool has_leaf_4 = bits_of(caches, 4, 0) != 0;
    const unsigned core_bits = has_leaf_4 ? bits_for(bits_of(caches, 31, 26) + 1) : 0;
    const unsigned thread_bits = package_bits > core_bits ? package_bits - core_bits : 0;
    return {bits_of(one.ebx, 31, 24), {thread_bits, thread_bits + core_bits}, "leaves 1 and 4"};
}
// [old_leaves]

// [levels]
/// By leaf 0xB or 0x1F: a subleaf for each level, from the threads up, each with the shift that
/// leads to the next. Level 1 is the thread, 2 the core; 0x1F knows modules, tiles and dies between
/// core and package. Nothing where the processor has no such leaf, or one without levels.
inline std::optional<ApicReading> apic_by_levels(const CpuidLeaves& cpu, std::uint32_t leaf) {
    constexpr std::uint32_t thread_level = 1, most_levels = 8;
    if (!cpu.has(leaf) || bits_of(cpu.at(leaf).ebx, 15, 0) == 0) return {};
    if (bits_of(cpu.at(leaf).ecx, 15, 8) == 0) return {};
    ApicReading reading{.id = cpu.at(leaf).edx, .from = leaf == 0x1f ? "leaf 0x1F" : "leaf 0xB"};
    for (std::uint32_t subleaf = 0; subleaf < most_levels; ++subleaf) {
        const CpuidRegisters r = cpu.at(leaf, subleaf);
        const std::uint32_t level = bits_of(r.ecx, 15, 8);
        if (level == 0) break;
        const unsigned shift = bits_of(r.eax, 4, 0);
        if (level == thread_level) reading.fields.core_shift = shift;
        reading.fields.package_shift = std::max(reading.fields.package_shift, shift);
    }
    return reading;
}
// [levels]

/// By AMD's leaf 0x80000008, how many bits a package takes, and 0x8000001E, how many threads a core
/// has.
inline std::optional<ApicReading> apic_by_amd(const CpuidLeaves& cpu) {
    if (!cpu.has(0x80000008u)) return {};
    ApicReading reading{.id = bits_of(cpu.at(1).ebx, 31, 24), .from = "leaf 0x80000008"};
    const std::uint32_t sizes = cpu.at(0x80000008u).ecx;
    const unsigned width = bits_of(sizes, 15, 12);
    reading.fields.package_shift = width != 0 ? width : bits_for(bits_of(sizes, 7, 0) + 1);
    const bool tells_threads = bits_of(cpu.at(0x80000001u).ecx, 22, 22) && cpu.has(0x8000001eu);
    if (tells_threads) {
        const CpuidRegisters r = cpu.at(0x8000001eu);
        reading.id = r.eax;
        reading.fields.core_shift = bits_for(bits_of(r.ebx, 15, 8) + 1);
        reading.fields.package_shift =
            std::max(reading.fields.package_shift, reading.fields.core_shift);
        reading.from = "leaves 0x80000008 and 0x8000001E";
    }
    return reading;
}

/// By the newest way that the processor knows.
inline ApicReading apic_of(const CpuidLeaves& cpu) {
    if (const auto reading = apic_by_levels(cpu, 0x1f)) return *reading;
    if (const auto reading = apic_by_levels(cpu, 0xb)) return *reading;
    const std::string name = vendor(cpu);
    if (name == "AuthenticAMD" || name == "HygonGenuine")
        if (const auto reading = apic_by_amd(cpu)) return *reading;
    return apic_by_leaves_1_and_4(cpu);
}

}  // namespace space
