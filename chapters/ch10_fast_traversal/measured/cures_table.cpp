#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/ratios.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

/// What was tried for one goal, and how many times as fast it was, over scenes and kinds of rays.
struct Cure {
    std::string goal, name;
    Ratios gains;
};

/// In the order in which they are first told.
Ratios& gains_of(std::vector<Cure>& cures, std::string_view goal, std::string_view name) {
    for (Cure& cure : cures)
        if (cure.goal == goal && cure.name == name) return cure.gains;
    return cures.emplace_back(Cure{std::string(goal), std::string(name), {}}).gains;
}

/// Each choice beside one of them.
void add_choices(const std::vector<ChoicePoint>& choices, std::string_view goal,
                 std::string_view usual, std::string_view what, std::vector<Cure>& cures) {
    for (const ChoicePoint& p : choices)
        for (const ChoicePoint& base : choices)
            if (base.scene == p.scene && base.choice == usual && p.choice != usual)
                for (std::size_t kind = 0; kind < ray_kinds.size(); ++kind)
                    gains_of(cures, goal, fmt::format(fmt::runtime(what), p.choice))
                        .add(base.ns[kind], p.ns[kind]);
}

void add_rungs(const std::vector<RungPoint>& ladder, std::vector<Cure>& cures) {
    for (const RungPoint& p : ladder)
        for (const RungPoint& base : ladder)
            if (p.rung == "eight, avx512" && base.rung == "eight, avx2" && base.scene == p.scene &&
                base.kind == p.kind)
                gains_of(cures, "one ray", "AVX-512, beside AVX2").add(base.ns, p.ns);
}

std::vector<Cure> cures_of(const FastMeasurements& m) {
    constexpr std::string_view one = "one ray", better = "better tree", many = "camera rays";
    std::vector<Cure> cures;
    add_choices(m.widths, one, "four", "{} children, beside four", cures);
    add_rungs(m.ladder, cures);
    add_choices(m.leaf_sizes, one, "at most 4", "leaves of {}, beside 4", cures);
    for (const PeerPoint& p : m.peers)
        gains_of(cures, one, "compressed nodes").add(p.ours_ns, p.compressed_ns);
    add_choices(m.high, better, "quick", "{}, beside the quick builder", cures);
    for (const PeerPoint& p : m.peers)
        if (p.is_long)
            gains_of(cures, better, "Embree's high quality, beside its default")
                .add(p.embree_ns, p.embree_high_ns);
    for (const ModePoint& p : m.modes)
        if (p.kind == camera_kind && p.mode != "single")
            gains_of(cures, many, p.mode).add(p.single_ns, p.ns);
    for (const PeerPoint& p : m.peers)
        gains_of(cures, "two threads", "Embree's, beside its one thread")
            .add(p.embree_ns, p.embree_two_threads_ns);
    for (const CurePoint& p : m.cures) gains_of(cures, p.goal, p.cure).add(p.gain, 1.0);
    return cures;
}

}  // namespace

Table profile_table(const std::vector<WorkPoint>& work) {
    Table table({"scene", "rays", "nodes", "blocks", "measured, ns", "nodes, one by one",
                 "blocks, one by one", "lines", "the rest"});
    for (const WorkPoint& p : work) {
        if (!(p.ns > 0.0) || p.structure != "wide") continue;
        const auto share = [&](double ns) { return fmt::format("{:.0f} %", 100.0 * ns / p.ns); };
        table.row({p.scene, std::string(ray_kinds[p.kind]), fixed(p.per_ray(p.nodes), 1),
                   fixed(p.per_ray(p.blocks), 1), fixed(p.ns, 0), share(p.nodes_ns),
                   share(p.blocks_ns), share(p.latency_ns - p.nodes_ns - p.blocks_ns),
                   share(p.ns - p.latency_ns)});
    }
    return table;
}

Table cures_table(const FastMeasurements& measured) {
    Table table({"goal", "tried", "worst gain", "median", "best"});
    for (const Cure& cure : cures_of(measured))
        if (!cure.gains.all.empty())
            table.row({cure.goal, cure.name, fixed(cure.gains.least(), 2),
                       fixed(cure.gains.middle(), 2), fixed(cure.gains.most(), 2)});
    return table;
}

}  // namespace space::ch10
