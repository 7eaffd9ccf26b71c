#include "ex05_apic_id.hpp"

#include "chapters/ch08_parallel_builds/recorded_machines.hpp"
#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <array>
#include <set>
#include <vector>

using namespace space;

namespace {

/// What a machine's ids are, and where their fields begin.
struct MachineIds {
    std::vector<std::uint32_t> ids;
    IdShifts shifts;
};

MachineIds ids_of(const RecordedMachine& machine) {
    MachineIds all{};
    for (const RecordedProcessor& each : machine.processors) {
        const ApicReading apic = apic_of(each.leaves);
        all.ids.push_back(apic.id);
        all.shifts = {apic.fields.core_shift, apic.fields.package_shift};
    }
    return all;
}

void check_parts(std::uint32_t id, IdShifts shifts, std::array<std::uint32_t, 3> expected) {
    CAPTURE(id, shifts.core, shifts.package);
    const IdParts parts = parts_of(id, shifts);
    REQUIRE(parts.package == expected[0]);
    REQUIRE(parts.core == expected[1]);
    REQUIRE(parts.thread == expected[2]);
}

void check_counts(const MachineIds& machine, MachineCounts expected) {
    const IdCounts counts = counts_of(machine.ids, machine.shifts);
    REQUIRE(counts.packages == expected.packages);
    REQUIRE(counts.cores == expected.cores);
    REQUIRE(counts.threads == expected.threads);
}

using List = std::vector<std::uint32_t>;

void check_chosen(const MachineIds& machine, const List& expected) {
    CAPTURE(machine.ids, machine.shifts.core, machine.shifts.package);
    const List chosen = one_a_core(machine.ids, machine.shifts);
    REQUIRE(chosen == expected);
}

}  // namespace

TEST_CASE("an id of 1 1010 1 in two is package 1, core 10, thread 1") {
    check_parts(0b1'1010'1, {1, 5}, {1, 10, 1});
}

TEST_CASE("fields without bits are 0, and the package takes all the rest") {
    check_parts(3, {0, 2}, {0, 3, 0});
    check_parts(7, {0, 0}, {7, 0, 0});
    check_parts(7, {2, 2}, {1, 0, 3});
    check_parts(0xffffffffu, {1, 5}, {0x7ffffff, 15, 1});
    check_parts(0xffffffffu, {2, 31}, {1, 0x1fffffff, 3});
}

TEST_CASE("a machine has the packages, cores and threads that its maker says, holes or not") {
    for (const RecordedMachine& machine : recorded_machines()) {
        CAPTURE(machine.name);
        check_counts(ids_of(machine), machine.known);
    }
}

TEST_CASE("packages far apart, with no package 0, are counted, and their cores each by itself") {
    check_counts({{48, 49, 50, 112, 113, 115}, {1, 4}}, {2, 4, 6});
    check_counts({{64, 256}, {1, 4}}, {2, 2, 2});
    check_counts({{5}, {1, 4}}, {1, 1, 1});
    check_counts({{}, {1, 4}}, {0, 0, 0});
}

TEST_CASE("ids are numbers of 32 bits, without a sign") {
    const MachineIds large{{0xffffffff, 0x80000001, 7, 0x80000000, 6, 0x7fffffff}, {1, 31}};
    check_counts(large, {2, 4, 6});
    check_chosen(large, {6, 0x7fffffff, 0x80000000, 0xffffffff});
}

TEST_CASE("one of each core is chosen: the smallest id that is there, in ascending order") {
    check_chosen({{0, 1, 4, 5}, {1, 4}}, {0, 4});
    check_chosen({{5, 4, 1, 0}, {1, 4}}, {0, 4});
    check_chosen({{3, 0, 2, 1}, {0, 2}}, {0, 1, 2, 3});
    check_chosen({{20, 1, 21, 4, 0}, {1, 4}}, {0, 4, 20});
    check_chosen({{}, {1, 4}}, {});
}

TEST_CASE("a core whose first thread this process may not use is chosen by its second") {
    check_chosen({{1, 4, 5, 9}, {1, 4}}, {1, 4, 9});
}

TEST_CASE("2,000 machines with ids left out at random are read and counted right") {
    Pcg32 random(8);
    for (int i = 0; i < 2'000; ++i) {
        const unsigned core = random.below(4), package = core + random.below(5);
        const std::uint32_t package_size = 1u << package, core_size = 1u << core,
                            count = 1 + random.below(24);
        std::set<std::uint32_t> ids, packages, cores;
        for (std::uint32_t n = 0; n < count; ++n) ids.insert(random.below(4 * package_size));
        List firsts;
        for (const std::uint32_t id : ids) {
            packages.insert(id / package_size);
            if (cores.insert(id / core_size).second) firsts.push_back(id);
            check_parts(id, {core, package},
                        {id / package_size, id % package_size / core_size, id % core_size});
        }
        const MachineIds machine{List(ids.rbegin(), ids.rend()), {core, package}};
        CAPTURE(core, package, machine.ids);
        check_counts(machine, {packages.size(), cores.size(), ids.size()});
        check_chosen(machine, firsts);
    }
}
