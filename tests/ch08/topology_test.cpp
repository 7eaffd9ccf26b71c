// The topology by cpuid: machines made by hand whose numbers are known, and this one, by three
// sources.
#include "chapters/ch08_parallel_builds/topology.hpp"

#include "chapters/ch08_parallel_builds/other_views.hpp"
#include "chapters/ch08_parallel_builds/recorded_machines.hpp"
#include "chapters/ch08_parallel_builds/this_processor.hpp"
#include "common/program/temporary.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace space {
namespace {

const RecordedMachine& machine(std::string_view name) {
    static const std::vector<RecordedMachine> all = recorded_machines();
    for (const RecordedMachine& each : all)
        if (each.name == name) return each;
    FAIL("no machine " << name);
    return all.front();
}

}  // namespace

TEST_CASE("each recorded machine has the packages, cores and threads of its data sheet") {
    for (const RecordedMachine& each : recorded_machines()) {
        CAPTURE(each.name);
        const MachineCounts counts = count_of(view_by_cpuid(each.processors));
        CHECK(counts.packages == each.known.packages);
        CHECK(counts.cores == each.known.cores);
        CHECK(counts.threads == each.known.threads);
    }
}

TEST_CASE("an APIC id falls apart at its shifts, by hand") {
    // 53 = 1 1010 1 in two: package 1, core 10, thread 1. 5 = 0 010 1 with four bits below the
    // package.
    CHECK(place_of(53, {1, 5}) == ApicPlace{1, 10, 1});
    CHECK(place_of(5, {1, 4}) == ApicPlace{0, 2, 1});
    CHECK(place_of(3, {0, 2}) == ApicPlace{0, 3, 0});  // no bit for threads
    CHECK(place_of(7, {0, 0}) == ApicPlace{7, 0, 0});  // nor for cores
    CHECK(place_of(0xffffffff, {1, 31}) == ApicPlace{1, 0x3fffffff, 1});
    CHECK(place_of(0xffffffff, {0, 32}) == ApicPlace{0, 0xffffffff, 0});
}

TEST_CASE(
    "each way to the fields is taken where it is the newest, and reads what the makers write") {
    struct Expected {
        std::string_view name, from;
        ApicIdFields fields;
    };
    for (const Expected& expected :
         {Expected{"core-2-duo", "leaves 1 and 4", {0, 1}},  // room for 2 ids, 2 of them cores
          {"core-2-quad", "leaves 1 and 4", {0, 2}},
          {"core-i3", "leaf 0xB", {1, 4}},
          {"two-xeons", "leaf 0xB", {1, 5}},
          {"hybrid", "leaf 0x1F", {1, 7}},
          {"phenom", "leaf 0x80000008", {0, 3}},  // ecx = 0x3005: 3 bits, 6 processors
          {"ryzen-1", "leaves 0x80000008 and 0x8000001E", {1, 4}},
          {"ryzen-2", "leaf 0xB", {1, 4}},
          {"virtual", "leaf 0xB", {0, 5}}}) {
        CAPTURE(expected.name);
        const ApicReading apic = apic_of(machine(expected.name).processors.back().leaves);
        CHECK(apic.from == expected.from);
        CHECK(apic.fields == expected.fields);
    }
}

TEST_CASE("old and new leaves agree on who shares a core, also where their widths differ") {
    for (const std::string_view name : {"core-i3", "two-xeons", "virtual"}) {
        CAPTURE(name);
        const auto& processors = machine(name).processors;
        MachineView old{.source = "leaves 1 and 4"};
        for (const RecordedProcessor& each : processors) {
            const ApicReading apic = apic_by_leaves_1_and_4(each.leaves);
            old.processors.push_back({each.number, place_of(apic.id, apic.fields), apic.id});
        }
        CHECK(view_differences(old, view_by_cpuid(processors)).empty());
    }
    const CpuidLeaves& cpu = machine("virtual").processors[1].leaves;
    CHECK(apic_by_leaves_1_and_4(cpu).fields == ApicIdFields{0, 1});
    CHECK(apic_of(cpu).fields == ApicIdFields{0, 5});
}

TEST_CASE("AMD without its width tells it by the number of processors") {
    // Two bits' worth of cores, and one too many: 5 processors take 3 bits.
    const CpuidLeaves cpu{amd_leaves(4, 0x6, 0x0004, 1)};
    CHECK(apic_of(cpu).fields == ApicIdFields{0, 3});
}

TEST_CASE("levels that never end are read no further than there can be") {
    std::vector<CpuidLeaf> leaves{{0, 0, intel_leaf_0(0xb)}};
    for (std::uint32_t i = 0; i < 40; ++i) leaves.push_back({0xb, i, {i, 1, 0x200 | i, 9}});
    CHECK(apic_of(CpuidLeaves{leaves}).fields.package_shift == 7);
}

TEST_CASE("a package's field begins no earlier than a core's, whatever a hypervisor says") {
    std::vector<CpuidLeaf> levels{{0, 0, intel_leaf_0(0xb)}};
    append_levels(levels, 0xb, 6, {{1, 2}, {2, 0}});
    CHECK(apic_of(CpuidLeaves{levels}).fields == ApicIdFields{2, 2});
    // AMD: no bit for the processors of a package, and two threads in each core.
    const CpuidLeaves amd{amd_leaves(1, 0x6, 0x0000, 2)};
    CHECK(apic_of(amd).fields == ApicIdFields{1, 1});
    CHECK(count_of(view_by_cpuid(std::vector<RecordedProcessor>{
              {0, {amd_leaves(0, 0x6, 0x0000, 2)}}, {1, amd}})) == MachineCounts{1, 1, 2});
}

TEST_CASE("a leaf of levels that tells none is passed over, be it all zeros or of no kind") {
    for (const CpuidRegisters& first : {CpuidRegisters{}, {4, 2, 0, 77}, {0, 0, 0x100, 77}})
        for (const std::uint32_t leaf : {0xbu, 0x1fu}) {
            CpuidLeaves cpu{core_2_leaves(3, 4)};
            cpu.leaves[0].registers.eax = 0x1f;
            cpu.leaves.push_back({leaf, 0, first});
            CAPTURE(leaf, first.eax, first.ebx, first.ecx);
            CHECK(apic_of(cpu).from == "leaves 1 and 4");
            CHECK(apic_of(cpu).id == 3);
        }
}

TEST_CASE("a leaf above the highest is not believed: Intel answers there with another leaf") {
    CpuidLeaves cpu = machine("core-2-duo").processors[1].leaves;
    for (const std::uint32_t leaf : {0xbu, 0x1fu, 0x1au})
        cpu.leaves.push_back({leaf, 0, {0x07280202, 1, 0x100, 77}});
    CHECK(apic_of(cpu).id == 1);
    CHECK(apic_of(cpu).from == "leaves 1 and 4");
    CHECK(core_kind(cpu) == LogicalProcessor::Core::any);
}

TEST_CASE("a processor that says it is alone is") {
    // The field for ids in leaf 1 has a meaning only where edx's bit 28 is set.
    const CpuidLeaves cpu{{{0, 0, intel_leaf_0(2)}, {1, 0, {.ebx = 0x05ff0000, .edx = 0}}}};
    CHECK(apic_of(cpu).fields == ApicIdFields{0, 0});
}

TEST_CASE("hybrid machines tell fast cores from slow ones") {
    std::size_t fast = 0, slow = 0;
    for (const LogicalProcessor& each : view_by_cpuid(machine("hybrid").processors).processors) {
        fast += each.core == LogicalProcessor::Core::performance;
        slow += each.core == LogicalProcessor::Core::efficiency;
    }
    CHECK(fast == 4);
    CHECK(slow == 4);
}

TEST_CASE("vendors: table 1 of BvhThesis13, in the order ebx, edx, ecx") {
    const auto word = [](const char* text) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t(text[i]) << (8 * i);
        return value;
    };
    for (const std::string name :
         {"GenuineIntel", "AuthenticAMD", "CyrixInstead", "VIA VIA VIA ", "NexGenDriven"}) {
        const char* c = name.c_str();
        const CpuidLeaves cpu{{{0, 0, {1, word(c), word(c + 8), word(c + 4)}}}};
        CHECK(vendor(cpu) == name);
    }
    CHECK(vendor({{{0, 0, intel_leaf_0(1)}}}) == "GenuineIntel");
    CHECK(vendor({{{0, 0, amd_leaf_0(1)}}}) == "AuthenticAMD");
}

TEST_CASE("AVX counts only where the system saves its registers, AVX-512 where it saves all") {
    const auto usable = [](CpuidLeaves cpu, std::uint64_t xcr0) {
        cpu.xcr0 = xcr0;
        std::string text;
        for (const SimdSet& set : simd_sets(cpu))
            if (set.usable) text += fmt::format("{} ", set.name);
        return text;
    };
    const std::string sse = "SSE SSE2 SSE3 SSSE3 SSE4.1 SSE4.2 ", avx = "AVX FMA AVX2 ",
                      avx512 = "AVX-512F AVX-512DQ AVX-512BW AVX-512VL ";
    const CpuidLeaves& cpu = machine("virtual").processors[0].leaves;
    CHECK(usable(cpu, 0) == sse);
    CHECK(usable(cpu, 0x3) == sse);
    CHECK(usable(cpu, 0x7) == sse + avx);
    CHECK(usable(cpu, 0x67) == sse + avx);  // half of AVX-512
    CHECK(usable(cpu, 0xe7) == sse + avx + avx512);
    CpuidLeaves asks_not = cpu;
    for (CpuidLeaf& leaf : asks_not.leaves)
        if (leaf.leaf == 1) leaf.registers.ecx &= ~(1u << 27);
    CHECK(usable(asks_not, 0xe7) == sse);
    CHECK(usable(machine("core-2-duo").processors[0].leaves, 0) == "SSE SSE2 ");
}

TEST_CASE("views differ where they put processors together differently, not where they count") {
    const MachineView a{"a", {}, {{0, {0, 0, 0}}, {1, {0, 1, 0}}}};
    const MachineView renamed{"b", {}, {{0, {3, 7, 0}}, {1, {3, 4, 0}}}};
    const MachineView one_core{"c", {}, {{0, {0, 0, 0}}, {1, {0, 0, 1}}}};
    const MachineView two_packages{"d", {}, {{0, {0, 0, 0}}, {1, {1, 0, 0}}}};
    const MachineView fewer{"e", {}, {{0, {0, 0, 0}}}};
    CHECK(view_differences(a, renamed).empty());
    CHECK(view_differences(a, one_core) ==
          std::vector<std::string>{"processor 0: a and c put others into its core",
                                   "processor 1: a and c put others into its core"});
    CHECK(view_differences(a, two_packages) ==
          std::vector<std::string>{"processor 0: a and d put others into its package",
                                   "processor 1: a and d put others into its package"});
    CHECK(view_differences(a, part_of(a, std::vector<unsigned>{1})).front() ==
          "processor 0: a knows it, and a does not");
    CHECK(view_differences(fewer, a).back() == "processor 1: a knows it, and e does not");
}

TEST_CASE("the class CPUInfo reports one processor wherever the process may not use all") {
    CHECK(processors_by_cpu_info(8, 8) == 8);
    CHECK(processors_by_cpu_info(7, 8) == 1);
    CHECK(processors_by_cpu_info(1, 8) == 1);
}

TEST_CASE("the kernel's files: threads of a core get numbers, what is switched off is left out") {
    const TemporaryDirectory folder;
    const auto add = [&](const std::string& name, const char* package, const char* core) {
        std::filesystem::create_directories(folder / name / "topology");
        std::ofstream(folder / name / "topology/physical_package_id") << package << "\n";
        std::ofstream(folder / name / "topology/core_id") << core << "\n";
    };
    add("cpu0", "0", "0"), add("cpu10", "0", "0"), add("cpu2", "1", "0"), add("cpu3", "-1", "0");
    std::filesystem::create_directories(folder / "cpu4");  // off: it has no topology
    for (const char* other : {"cpufreq", "cpuidle", "cpu", "cpu1x"}) add(other, "0", "0");
    const MachineView view = view_by_kernel(folder.path());
    REQUIRE(view.processors.size() == 3);
    CHECK(view.processors[1].number == 2);
    CHECK(view.processors[2].number == 10);
    CHECK(view.processors[2].place == ApicPlace{0, 0, 1});
    CHECK(count_of(view) == MachineCounts{2, 2, 3});
    CHECK(view_by_kernel(folder / "nothing").processors.empty());
}

// --- this machine ---

TEST_CASE("a thread that was on one processor may then run where it could before") {
    const std::vector<unsigned> before = allowed_processors();
    for (const unsigned number : before) {
        const OnProcessor here(number);
        REQUIRE(here.is_there());
        CHECK(allowed_processors() == std::vector<unsigned>{number});
        CHECK(sched_getcpu() == int(number));
    }
    CHECK(allowed_processors() == before);
    CHECK(!OnProcessor(100'000).is_there());
    CHECK(allowed_processors() == before);
}

TEST_CASE("all that this process may use is recorded, and no more") {
    const std::vector<unsigned> allowed = allowed_processors();
    REQUIRE(!allowed.empty());
    CHECK(allowed.size() <= online_processors());
#ifdef SPACE_HAS_CPUID
    CHECK(has_cpuid());
    CHECK(record_this_machine().size() == allowed.size());
    CHECK(vendor(record_leaves()).size() == 12);
    std::thread([&] {  // as taskset does for a process
        const OnProcessor here(allowed.back());
        const auto recorded = record_this_machine();
        REQUIRE(recorded.size() == 1);
        CHECK(recorded[0].number == allowed.back());
    })
        .join();
#else
    CHECK(record_this_machine().empty());
#endif
}

TEST_CASE("cpuid, the kernel and hwloc describe the same machine, unless a hypervisor made it up") {
    const std::vector<unsigned> allowed = allowed_processors();
    const std::vector<RecordedProcessor> recorded = record_this_machine();
    const MachineView by_kernel = part_of(view_by_kernel(), allowed),
                      by_hwloc = part_of(view_by_hwloc(), allowed);
    std::vector<const MachineView*> views;
    const MachineView by_cpuid = view_by_cpuid(recorded);
    for (const MachineView* view : {&by_cpuid, &by_kernel, &by_hwloc})
        if (!view->processors.empty()) views.push_back(view);
    const bool may_differ = recorded.empty() || is_virtual(recorded[0].leaves);
    for (const MachineView* other : views)
        for (const std::string& line : view_differences(*views.front(), *other)) {
            if (may_differ)
                fmt::print("  {}\n", line);
            else
                FAIL_CHECK(line);
        }
    CHECK(!views.empty());
}

}  // namespace space
