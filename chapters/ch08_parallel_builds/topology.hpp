/// @file
/// A machine's packages, cores and hardware threads, whoever tells of them: cpuid, the kernel or
/// hwloc.
#pragma once

#include "chapters/ch08_parallel_builds/apic_id.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// One that runs a thread, as the operating system counts them, and where it is.
struct LogicalProcessor {
    /// Hybrid machines have cores of two kinds.
    enum class Core { any, performance, efficiency };

    unsigned number = 0;  ///< the operating system's
    ApicPlace place = {};
    std::optional<std::uint32_t> apic_id = {};  ///< where cpuid has told it
    Core core = Core::any;
};

/// What one source says of a machine.
struct MachineView {
    std::string source = {};
    ApicIdFields fields = {};  ///< where cpuid has told them
    std::vector<LogicalProcessor> processors = {};
};

/// How many of each.
struct MachineCounts {
    std::size_t packages = 0, cores = 0, threads = 0;
    bool operator==(const MachineCounts&) const = default;
};

// [count]
/// Counted, not computed from the widths of fields: ids may be left out.
inline MachineCounts count_of(const MachineView& view) {
    std::set<std::uint32_t> packages;
    std::set<std::pair<std::uint32_t, std::uint32_t>> cores;
    for (const LogicalProcessor& each : view.processors) {
        packages.insert(each.place.package);
        cores.insert({each.place.package, each.place.core});
    }
    return {packages.size(), cores.size(), view.processors.size()};
}
// [count]

/// What cpuid answered on one processor, under the operating system's number.
struct RecordedProcessor {
    unsigned number = 0;
    CpuidLeaves leaves = {};
};

/// Leaf 0x1A, on hybrid machines (leaf 7, edx, bit 15).
inline LogicalProcessor::Core core_kind(const CpuidLeaves& cpu) {
    using enum LogicalProcessor::Core;
    if (!cpu.has(0x1a) || !bits_of(cpu.at(7).edx, 15, 15)) return any;
    const std::uint32_t kind = bits_of(cpu.at(0x1a).eax, 31, 24);
    return kind == 0x40 ? performance : kind == 0x20 ? efficiency : any;
}

/// The machine as cpuid tells it.
inline MachineView view_by_cpuid(std::span<const RecordedProcessor> recorded) {
    MachineView view{.source = "cpuid"};
    for (const RecordedProcessor& each : recorded) {
        const ApicReading apic = apic_of(each.leaves);
        view.fields = apic.fields;
        view.processors.push_back(
            {each.number, place_of(apic.id, apic.fields), apic.id, core_kind(each.leaves)});
    }
    return view;
}

/// Those of a view's processors that are among `numbers`.
inline MachineView part_of(MachineView view, std::span<const unsigned> numbers) {
    std::erase_if(view.processors, [&](const LogicalProcessor& each) {
        return std::find(numbers.begin(), numbers.end(), each.number) == numbers.end();
    });
    return view;
}

/// What two views say differently, a sentence each. Sources number packages and cores in their own
/// ways, so what is compared is which processors share a package, and which a core.
inline std::vector<std::string> view_differences(const MachineView& a, const MachineView& b) {
    using Partner = std::map<unsigned, std::pair<std::set<unsigned>, std::set<unsigned>>>;
    const auto partners = [](const MachineView& view) {
        Partner found;
        for (const LogicalProcessor& one : view.processors)
            for (const LogicalProcessor& other : view.processors) {
                if (one.place.package != other.place.package) continue;
                found[one.number].first.insert(other.number);
                if (one.place.core == other.place.core)
                    found[one.number].second.insert(other.number);
            }
        return found;
    };
    const Partner by_a = partners(a), by_b = partners(b);
    std::vector<std::string> told;
    const auto tell = [&](unsigned number, const char* what) {
        told.push_back("processor " + std::to_string(number) + ": " + a.source + " and " +
                       b.source + what);
    };
    for (const auto& [number, by] : by_a)
        if (const auto other = by_b.find(number); other == by_b.end())
            told.push_back("processor " + std::to_string(number) + ": " + a.source +
                           " knows it, and " + b.source + " does not");
        else {
            if (by.first != other->second.first) tell(number, " put others into its package");
            if (by.second != other->second.second) tell(number, " put others into its core");
        }
    for (const auto& [number, by] : by_b)
        if (!by_a.contains(number))
            told.push_back("processor " + std::to_string(number) + ": " + b.source +
                           " knows it, and " + a.source + " does not");
    return told;
}

/// What the class CPUInfo of [BvhThesis13], section 3.3, takes for the machine's processors: all,
/// or 1 where the process may not use them all.
constexpr std::size_t processors_by_cpu_info(std::size_t allowed, std::size_t online) {
    return allowed == online ? online : 1;
}

}  // namespace space
