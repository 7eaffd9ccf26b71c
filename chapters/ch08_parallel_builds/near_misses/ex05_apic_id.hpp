/// @file
/// Exercise 8.5, a near miss: one thread of each core is that with the number 0. Where a process
/// may not use that one, the core is left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace space {

/// Where the fields of an APIC id begin: the thread at bit 0, the core and the package at these.
struct IdShifts {
    unsigned core, package;  ///< core <= package < 32
};
/// An APIC id taken apart.
struct IdParts {
    std::uint32_t package, core, thread;
};
/// How many of each there are.
struct IdCounts {
    std::size_t packages, cores, threads;
};

inline IdParts parts_of(std::uint32_t id, IdShifts shifts) {
    const auto below = [&](unsigned bit) { return id & ((std::uint32_t{1} << bit) - 1); };
    return {id >> shifts.package, below(shifts.package) >> shifts.core, below(shifts.core)};
}

/// Package and core together tell a core: two packages both have a core 0.
inline IdCounts counts_of(std::span<const std::uint32_t> ids, IdShifts shifts) {
    std::set<std::uint32_t> packages, cores;
    for (const std::uint32_t id : ids) {
        packages.insert(id >> shifts.package);
        cores.insert(id >> shifts.core);
    }
    return {packages.size(), cores.size(), ids.size()};
}

inline std::vector<std::uint32_t> one_a_core(std::span<const std::uint32_t> ids, IdShifts shifts) {
    std::vector<std::uint32_t> chosen;
    for (const std::uint32_t id : std::set<std::uint32_t>(ids.begin(), ids.end()))
        if (parts_of(id, shifts).thread == 0) chosen.push_back(id);
    return chosen;
}

}  // namespace space
