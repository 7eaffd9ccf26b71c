/// What processors there are, by cpuid, the kernel and hwloc, and how many of them this process may
/// use.
///     topology --out pictures
///     topology --machine two-xeons
#include "chapters/ch08_parallel_builds/figures/topology_drawing.hpp"
#include "chapters/ch08_parallel_builds/other_views.hpp"
#include "chapters/ch08_parallel_builds/recorded_machines.hpp"
#include "chapters/ch08_parallel_builds/this_processor.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/options.hpp"
#include "common/program/report.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <string>
#include <vector>

namespace space::ch08 {
namespace {

/// What the command line says.
struct TopologyOptions {
    std::string machine = "this", out;
    bool leaves = false;
};

TopologyOptions read_options(int argc, char** argv) {
    TopologyOptions options;
    std::vector<std::string> names{"this"};
    for (const RecordedMachine& machine : recorded_machines()) names.emplace_back(machine.name);
    CLI::App app("Packages, cores and threads of this machine or of a recorded one", "topology");
    add_choice(app, "--machine", names, options.machine, "this one, or one of chapter 8's records");
    app.add_option("--out", options.out, "draw it into DIR/topology.svg")->type_name("DIR");
    app.add_flag("--leaves", options.leaves, "print what cpuid answered, too");
    app.footer(
        "Examples:\n  topology --out pictures\n  topology --machine two-xeons\n"
        "  taskset --cpu-list 0 topology");
    parse_command_line(app, argc, argv);
    return options;
}

void print_processor(const CpuidLeaves& cpu) {
    std::string usable, unusable;
    for (const SimdSet& set : simd_sets(cpu))
        if (set.present) (set.usable ? usable : unusable) += fmt::format(" {}", set.name);
    const std::string name = brand(cpu);
    fmt::print("{}{}{}{}\n", vendor(cpu), name.empty() ? "" : ", ", name,
               is_virtual(cpu) ? " (a virtual machine: this is what its hypervisor says)" : "");
    fmt::print("{}\n", wrapped("SIMD:" + (usable.empty() ? " none" : usable), 6));
    if (!unusable.empty())
        fmt::print("{}\n",
                   wrapped("Has, but the system does not save its registers:" + unusable, 6));
}

void print_leaves(const std::vector<RecordedProcessor>& recorded) {
    for (const RecordedProcessor& each : recorded) {
        fmt::print("\nprocessor {}, xcr0 {:#x}\n", each.number, each.leaves.xcr0);
        for (const CpuidLeaf& leaf : each.leaves.leaves)
            fmt::print("  {:08x}.{}  {:08x} {:08x} {:08x} {:08x}\n", leaf.leaf, leaf.subleaf,
                       leaf.registers.eax, leaf.registers.ebx, leaf.registers.ecx,
                       leaf.registers.edx);
    }
}

void print_view(const MachineView& view) {
    const MachineCounts counts = count_of(view);
    fmt::print("By {}: {}, {}, {}.\n", view.source, counted(counts.packages, "package"),
               counted(counts.cores, "core"), counted(counts.threads, "thread"));
}

void print_places(const MachineView& view) {
    const auto [core, package] = view.fields;
    fmt::print("\nFields of an APIC id: thread {} bits, core {}, package the rest.\n", core,
               package - core);
    Table table({"processor", "APIC id", "package", "core", "thread"});
    for (const LogicalProcessor& each : view.processors)
        table.row({fmt::format("{}", each.number), fmt::format("{:#x}", *each.apic_id),
                   fmt::format("{}", each.place.package), fmt::format("{}", each.place.core),
                   fmt::format("{}", each.place.thread)});
    table.print();
}

/// How many threads to start, and what the thesis's class would have said.
void print_allowed(const std::vector<unsigned>& allowed) {
    const std::size_t online = online_processors();
    fmt::print("This process may use {} of {}.\n", allowed.size(), counted(online, "processor"));
    if (const std::size_t told = processors_by_cpu_info(allowed.size(), online);
        told != allowed.size())
        fmt::print("The class CPUInfo of [BvhThesis13] would report {}.\n", told);
}

/// @return the view to draw: cpuid's, or hwloc's where there is no cpuid
MachineView print_this_machine(const std::vector<RecordedProcessor>& recorded) {
    const std::vector<unsigned> allowed = allowed_processors();
    print_allowed(allowed);
    const MachineView by_cpuid = view_by_cpuid(recorded);
    const MachineView by_kernel = part_of(view_by_kernel(), allowed),
                      by_hwloc = part_of(view_by_hwloc(), allowed);
    for (const MachineView* view : {&by_cpuid, &by_kernel, &by_hwloc}) {
        if (view->processors.empty())
            fmt::print("By {}: nothing.\n", view->source);
        else
            print_view(*view);
    }
    const MachineView& first = by_cpuid.processors.empty() ? by_hwloc : by_cpuid;
    for (const MachineView* other : {&by_kernel, &by_hwloc})
        if (other != &first && !other->processors.empty())
            for (const std::string& line : view_differences(first, *other))
                fmt::print("{}\n", line);
    return first;
}

int run(int argc, char** argv) {
    const TopologyOptions options = read_options(argc, argv);
    const std::filesystem::path file = std::filesystem::path(options.out) / "topology.svg";
    if (!options.out.empty()) check_writable(file);
    std::vector<RecordedProcessor> recorded;
    MachineView view;
    if (options.machine == "this") {
        recorded = record_this_machine();
        if (!recorded.empty()) print_processor(recorded.front().leaves);
        view = print_this_machine(recorded);
    } else
        for (const RecordedMachine& machine : recorded_machines())
            if (machine.name == options.machine) {
                recorded = machine.processors;
                fmt::print("{}: {}\n", machine.name, machine.about);
                print_view(view = view_by_cpuid(recorded));
            }
    if (!recorded.empty()) print_places(view);
    if (options.leaves) print_leaves(recorded);
    if (!options.out.empty()) {
        write_file(file, topology_drawing(view).document("topology"));
        fmt::print("Drawn into {}.\n", file.string());
    }
    return 0;
}

}  // namespace
}  // namespace space::ch08

int main(int argc, char** argv) {
    return space::run_program("topology", space::ch08::run, argc, argv);
}
