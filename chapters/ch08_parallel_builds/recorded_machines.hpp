/// @file
/// Machines as cpuid describes them, for drawings, tests and exercises: the two of [BvhThesis13]'s
/// tables and its example, and others that teach something. All but the virtual one are made by
/// hand, after what such processors answer, and hold no more than a topology needs.
#pragma once

#include "chapters/ch08_parallel_builds/topology.hpp"

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace space {

/// A machine, and what it has by its makers' data sheets.
struct RecordedMachine {
    std::string_view name, about;
    std::vector<RecordedProcessor> processors;
    MachineCounts known;
};

/// Leaf 0 or 0x80000000: the highest leaf, and the vendor in its odd order.
constexpr CpuidRegisters intel_leaf_0(std::uint32_t highest) {
    return {highest, 0x756e6547, 0x6c65746e, 0x49656e69};
}
constexpr CpuidRegisters amd_leaf_0(std::uint32_t highest) {
    return {highest, 0x68747541, 0x444d4163, 0x69746e65};
}

/// Leaf 1 as far as it tells of the topology: the id in 8 bits, room for ids in a package, and that
/// there are several.
constexpr CpuidRegisters topology_leaf_1(std::uint32_t id, std::uint32_t room) {
    return {.ebx = (id << 24) | (room << 16), .ecx = 0, .edx = (1u << 28) | (3u << 25)};
}

/// One processor for each APIC id, by what the leaves of that id are.
template <class Leaves>
std::vector<RecordedProcessor> recorded_by_ids(std::initializer_list<std::uint32_t> ids,
                                               const Leaves& leaves_of) {
    std::vector<RecordedProcessor> processors;
    for (const std::uint32_t id : ids)
        processors.push_back({unsigned(processors.size()), {leaves_of(id)}});
    return processors;
}

/// The subleaves of leaf 0xB or 0x1F: each level's kind and shift.
inline void append_levels(std::vector<CpuidLeaf>& leaves, std::uint32_t leaf, std::uint32_t id,
                          std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> levels) {
    std::uint32_t subleaf = 0;
    for (const auto& [kind, shift] : levels) {
        leaves.push_back({leaf, subleaf, {shift, 1, (kind << 8) | subleaf, id}});
        ++subleaf;
    }
    leaves.push_back({leaf, subleaf, {0, 0, subleaf, id}});
}

/// Core 2: no leaf 0xB yet, no second thread in a core.
inline std::vector<CpuidLeaf> core_2_leaves(std::uint32_t id, std::uint32_t cores) {
    return {{0, 0, intel_leaf_0(0xa)},
            {1, 0, topology_leaf_1(id, cores)},
            {4, 0, {.eax = ((cores - 1) << 26) | 0x121}}};
}

/// From Nehalem on: leaf 0xB, two threads in a core.
inline std::vector<CpuidLeaf> nehalem_leaves(std::uint32_t id, std::uint32_t package_shift) {
    const std::uint32_t room = 1u << package_shift;
    std::vector<CpuidLeaf> leaves{{0, 0, intel_leaf_0(0xb)},
                                  {1, 0, topology_leaf_1(id, room)},
                                  {4, 0, {.eax = ((room / 2 - 1) << 26) | 0x121}}};
    append_levels(leaves, 0xb, id, {{1, 1}, {2, package_shift}});
    return leaves;
}

/// Two kinds of cores, and a level between core and package, which leaf 0xB can't tell.
inline std::vector<CpuidLeaf> hybrid_leaves(std::uint32_t id, bool is_efficient) {
    std::vector<CpuidLeaf> leaves{{0, 0, intel_leaf_0(0x1f)},
                                  {1, 0, topology_leaf_1(id, 128)},
                                  {4, 0, {.eax = (63u << 26) | 0x121}},
                                  {7, 0, {.edx = 1u << 15}},
                                  {0x1a, 0, {.eax = is_efficient ? 0x20000001u : 0x40000001u}}};
    append_levels(leaves, 0xb, id, {{1, 1}, {2, 7}});
    append_levels(leaves, 0x1f, id, {{1, 1}, {2, 3}, {3, 7}});
    return leaves;
}

/// `sizes` is leaf 0x80000008's ecx; leaf 0x8000001E is there where a core has several threads.
inline std::vector<CpuidLeaf> amd_leaves(std::uint32_t id, std::uint32_t highest,
                                         std::uint32_t sizes, std::uint32_t threads) {
    std::vector<CpuidLeaf> leaves{
        {0, 0, amd_leaf_0(highest)},
        {1, 0, topology_leaf_1(id, bits_of(sizes, 7, 0) + 1)},
        {0x80000000, 0, amd_leaf_0(threads > 1 ? 0x8000001e : 0x8000001b)},
        {0x80000008, 0, {.ecx = sizes}}};
    if (threads > 1) {
        leaves.push_back({0x80000001, 0, {.ecx = 1u << 22}});
        leaves.push_back(
            {0x8000001e, 0, {.eax = id, .ebx = ((threads - 1) << 8) | (id / threads)}});
    }
    return leaves;
}

/// Recorded on a virtual machine: leaf 0xB has five bits for the cores of a package, leaves 1 and 4
/// one, and of the threads of its cores the hypervisor says nothing.
inline std::vector<CpuidLeaf> virtual_leaves(std::uint32_t id) {
    return {{0, 0, intel_leaf_0(0x1c)},
            {1, 0, {0x000c06f2, 0x00020800 | (id << 24), 0xfffa3203, 0x1f8bfbff}},
            {4, 0, {0x04000121, 0x02c0003f, 0x0000003f, 0}},
            {7, 0, {0, 0xf1bf2ffb, 0x00415f46, 0x20000010}},
            {0xb, 0, {0, 1, 0x100, id}},
            {0xb, 1, {5, 2, 0x201, id}},
            {0xb, 2, {0, 0, 2, id}}};
}

inline std::vector<RecordedMachine> recorded_machines() {
    const auto core_2 = [](std::uint32_t cores) {
        return [cores](std::uint32_t id) { return core_2_leaves(id, cores); };
    };
    const auto nehalem = [](std::uint32_t shift) {
        return [shift](std::uint32_t id) { return nehalem_leaves(id, shift); };
    };
    const auto hybrid = [](std::uint32_t id) { return hybrid_leaves(id, id >= 64); };
    const auto phenom = [](std::uint32_t id) { return amd_leaves(id, 0x6, 0x3005, 1); };
    const auto ryzen_1 = [](std::uint32_t id) { return amd_leaves(id, 0xd, 0x400f, 2); };
    const auto ryzen_2 = [](std::uint32_t id) {
        std::vector<CpuidLeaf> leaves = amd_leaves(id, 0x10, 0x400f, 2);
        append_levels(leaves, 0xb, id, {{1, 1}, {2, 4}});
        return leaves;
    };
    return {
        {"core-2-duo",
         "T7200, of [BvhThesis13]'s table 3",
         recorded_by_ids({0, 1}, core_2(2)),
         {1, 2, 2}},
        {"core-2-quad",
         "Q9550, of [BvhThesis13]'s table 4",
         recorded_by_ids({0, 1, 2, 3}, core_2(4)),
         {1, 4, 4}},
        {"core-i3",
         "i3-540, [BvhThesis13]'s example: hyper-threading, and ids left out",
         recorded_by_ids({0, 1, 4, 5}, nehalem(4)),
         {1, 2, 4}},
        {"two-xeons",
         "two X5650: six cores in a field of four bits",
         recorded_by_ids({0, 2, 4, 16, 18, 20, 32, 34, 36, 48, 50, 52,
                          1, 3, 5, 17, 19, 21, 33, 35, 37, 49, 51, 53},
                         nehalem(5)),
         {2, 12, 24}},
        {"hybrid",
         "two fast cores with two threads each, four slow ones with one; leaf 0x1F",
         recorded_by_ids({0, 1, 8, 9, 64, 66, 68, 70}, hybrid),
         {1, 6, 8}},
        {"phenom",
         "AMD, six cores: leaf 0x80000008 alone",
         recorded_by_ids({0, 1, 2, 3, 4, 5}, phenom),
         {1, 6, 6}},
        {"ryzen-1",
         "AMD, six cores with two threads: leaf 0x8000001E, and ids left out",
         recorded_by_ids({0, 1, 2, 3, 4, 5, 8, 9, 10, 11, 12, 13}, ryzen_1),
         {1, 6, 12}},
        {"ryzen-2",
         "AMD, eight cores with two threads: leaf 0xB",
         recorded_by_ids({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, ryzen_2),
         {1, 8, 16}},
        {"virtual",
         "two processors as a hypervisor shows them; recorded, not made",
         recorded_by_ids({0, 1}, virtual_leaves),
         {1, 2, 2}},
    };
}

}  // namespace space
