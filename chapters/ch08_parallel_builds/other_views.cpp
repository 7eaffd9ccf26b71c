#include "chapters/ch08_parallel_builds/other_views.hpp"

#ifdef BOOK_HAS_HWLOC
#include <hwloc.h>
#endif

#include <charconv>
#include <fstream>
#include <optional>

namespace space {
namespace {

std::optional<std::uint32_t> number_in(const std::filesystem::path& file) {
    std::ifstream in(file);
    long long value = -1;
    if (!(in >> value) || value < 0 || value > 0xffffffffLL) return {};
    return std::uint32_t(value);
}

/// Numbers the threads of each core, in the order of the system's numbers.
void number_threads(MachineView& view) {
    std::sort(view.processors.begin(), view.processors.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> seen;
    for (LogicalProcessor& each : view.processors)
        each.place.thread = seen[{each.place.package, each.place.core}]++;
}

/// "cpu12" -> 12.
std::optional<unsigned> processor_number(const std::string& name) {
    unsigned number = 0;
    if (!name.starts_with("cpu") || name.size() == 3) return {};
    const char* const end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + 3, end, number);
    if (error != std::errc{} || stop != end) return {};
    return number;
}

#ifdef BOOK_HAS_HWLOC
/// The number of the object of this type around a processing unit; of one that hwloc does not know,
/// 0.
std::uint32_t above(hwloc_topology_t topology, hwloc_obj_t unit, hwloc_obj_type_t type) {
    const hwloc_obj_t object = hwloc_get_ancestor_obj_by_type(topology, type, unit);
    return object ? object->logical_index : 0;
}
#endif

}  // namespace

MachineView view_by_kernel(const std::filesystem::path& folder) {
    MachineView view{.source = "kernel"};
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        const auto number = processor_number(entry.path().filename().string());
        if (!number) continue;
        const auto package = number_in(entry.path() / "topology/physical_package_id");
        const auto core = number_in(entry.path() / "topology/core_id");
        if (package && core) view.processors.push_back({*number, {*package, *core, 0}});
    }
    number_threads(view);
    return view;
}

#ifdef BOOK_HAS_HWLOC
MachineView view_by_hwloc() {
    MachineView view{.source = "hwloc"};
    hwloc_topology_t topology = nullptr;
    if (hwloc_topology_init(&topology) != 0) return view;
    if (hwloc_topology_load(topology) == 0) {
        hwloc_obj_t unit = nullptr;
        while ((unit = hwloc_get_next_obj_by_type(topology, HWLOC_OBJ_PU, unit)) != nullptr)
            view.processors.push_back({unit->os_index,
                                       {above(topology, unit, HWLOC_OBJ_PACKAGE),
                                        above(topology, unit, HWLOC_OBJ_CORE), 0}});
    }
    hwloc_topology_destroy(topology);
    number_threads(view);
    return view;
}
#else
MachineView view_by_hwloc() {
    return {.source = "hwloc"};
}
#endif

}  // namespace space
