/// @file
/// Exercise 8.5: An APIC id
/// Difficulty 1 of 3, about 25 minutes.
///
/// A logical processor's APIC id has three fields: the lowest bits, below `shifts.core`, tell the
/// thread in its core; those from there to below `shifts.package` the core in its package; the rest
/// the package. `parts_of` takes an id apart. `counts_of` counts the packages, cores and threads of
/// a machine whose ids are given, each once, in any order. `one_a_core` returns one id of each
/// core, the smallest that is there, in ascending order: work that is limited by memory gains
/// nothing from a core's second thread. Makers leave out ids, and a process may not be allowed to
/// use every processor: no field need count from 0, or without holes. The check knows real
/// machines.
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

inline IdParts parts_of(std::uint32_t id, IdShifts) {
    return {0, 0, id};  // TODO
}

inline IdCounts counts_of(std::span<const std::uint32_t> ids, IdShifts) {
    return {1, 1, ids.size()};  // TODO
}

inline std::vector<std::uint32_t> one_a_core(std::span<const std::uint32_t> ids, IdShifts) {
    return {ids.begin(), ids.end()};  // TODO
}

}  // namespace space
