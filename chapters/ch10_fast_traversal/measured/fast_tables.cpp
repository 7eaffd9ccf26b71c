#include "chapters/ch10_fast_traversal/measured/fast.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/ratios.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

std::string mega(double ns) {
    return ns > 0.0 ? fixed(1e3 / ns, 2) : "";
}
std::string times(double over, double under) {
    return over > 0.0 && under > 0.0 ? fixed(over / under, 2) : "";
}
std::string per(std::uint64_t count, std::uint64_t of, int digits = 1) {
    return of > 0 ? fixed(double(count) / double(of), digits) : "";
}
std::string size_of_memory(std::uint64_t bytes) {
    return bytes < (1u << 20) ? fmt::format("{} KB", bytes >> 10)
                              : fmt::format("{} MB", bytes >> 20);
}

// --- rung 1 ---

Table memory_table(const std::vector<MemoryPoint>& memory) {
    Table table({"working set", "a load, ns", "of eight chains, ns", "in order, GB/s"});
    for (const MemoryPoint& p : memory)
        table.row({size_of_memory(p.bytes), fixed(p.latency_ns, 1), fixed(p.many_latency_ns, 1),
                   fixed(p.gigabytes_per_second, 1)});
    return table;
}

Table pages_table(const std::vector<MemoryPoint>& memory) {
    Table table({"working set", "2 MB pages, ns", "4 KB pages, ns", "ratio"});
    for (const MemoryPoint& p : memory)
        if (p.bytes >= (2u << 20))
            table.row({size_of_memory(p.bytes), fixed(p.latency_ns, 1), fixed(p.small_pages_ns, 1),
                       times(p.small_pages_ns, p.latency_ns)});
    return table;
}

Table slabs_table(const std::vector<SlabPoint>& slabs) {
    Table table({"instructions", "boxes at once", "ns a box"});
    for (const SlabPoint& p : slabs)
        table.row({p.instruction_set, with_commas(p.boxes_at_once), fixed(p.ns_per_box, 2)});
    return table;
}

Table costs_table(const std::vector<StepPoint>& steps) {
    Table table({"instructions", "node in a chain, ns", "node by itself", "block in a chain",
                 "block by itself", "block / node"});
    for (const StepPoint& p : steps)
        table.row({p.instruction_set, fixed(p.node_latency_ns, 1), fixed(p.node_ns, 1),
                   fixed(p.block_latency_ns, 1), fixed(p.block_ns, 1),
                   times(p.block_latency_ns, p.node_latency_ns)});
    return table;
}

Table work_table(const std::vector<WorkPoint>& work) {
    Table table({"scene", "rays", "tree", "nodes", "boxes", "blocks", "triangles", "lines",
                 "not in 32 KB", "not in 1 MB", "not in 36 MB"});
    for (const WorkPoint& p : work)
        table.row({p.scene, std::string(ray_kinds[p.kind]), p.structure, per(p.nodes, p.rays),
                   per(p.boxes, p.rays), per(p.blocks, p.rays), per(p.tests, p.rays),
                   per(p.lines, p.rays), per(p.misses[0], p.rays, 2), per(p.misses[1], p.rays, 2),
                   per(p.misses[2], p.rays, 2)});
    return table;
}

Table bounds_table(const std::vector<WorkPoint>& work) {
    Table table({"scene", "rays", "tree", "one by one, ns", "to compute", "to fetch",
                 "measured, ns", "measured / bound"});
    for (const WorkPoint& p : work)
        if (p.ns > 0.0)
            table.row({p.scene, std::string(ray_kinds[p.kind]), p.structure, fixed(p.latency_ns, 0),
                       fixed(p.compute_ns, 0), fixed(p.bandwidth_ns, 0), fixed(p.ns, 0),
                       times(p.ns, p.bound_ns())});
    return table;
}

// --- the ladder ---

Table ladder_table(const std::vector<RungPoint>& ladder, bool timed) {
    TimedTable table({"scene", "rung", "nodes a diffuse ray", "tests", "wrong a million aimed"},
                     {"camera, Mray/s", "shadow", "diffuse"}, timed);
    for (const RungPoint& p : ladder) {
        if (p.kind != diffuse_kind) continue;
        std::vector<std::string> speeds;
        for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind}) {
            std::string speed;
            for (const RungPoint& q : ladder)
                if (q.scene == p.scene && q.rung == p.rung && q.kind == kind) speed = mega(q.ns);
            speeds.push_back(speed);
        }
        table.row({p.scene, p.rung, p.nodes > 0 ? per(p.nodes, p.rays) : "",
                   p.nodes > 0 ? per(p.tests, p.rays) : "", fixed(p.wrong_per_million(), 0)},
                  speeds);
    }
    return table.table();
}

// --- beside Embree ---

Table peers_table(const std::vector<PeerPoint>& peers) {
    Table table({"scene", "rays", "Embree, Mray/s", "ours / Embree", "ours / robust",
                 "high / Embree", "compressed / Embree", "Embree high / Embree", "two threads",
                 "Embree's"});
    for (const PeerPoint& p : peers)
        table.row({p.scene, std::string(ray_kinds[p.kind]), mega(p.embree_ns),
                   times(p.embree_ns, p.ours_ns), times(p.robust_ns, p.ours_ns),
                   times(p.embree_ns, p.ours_high_ns), times(p.embree_ns, p.compressed_ns),
                   times(p.embree_ns, p.embree_high_ns), times(p.ours_ns, p.two_threads_ns),
                   times(p.embree_ns, p.embree_two_threads_ns)});
    return table;
}

Table answers_table(const std::vector<PeerPoint>& peers) {
    Table table({"scene", "rays", "triangles", "traced", "other answers"});
    for (const PeerPoint& p : peers)
        table.row({p.scene, std::string(ray_kinds[p.kind]), with_commas(p.triangles),
                   with_commas(p.rays), with_commas(p.differ)});
    return table;
}

const BuildPoint* build_of(const std::vector<BuildPoint>& builds, std::string_view scene,
                           std::string_view structure) {
    const auto found = std::ranges::find_if(
        builds, [&](const BuildPoint& p) { return p.scene == scene && p.structure == structure; });
    return found == builds.end() ? nullptr : &*found;
}

Table builds_table(const std::vector<BuildPoint>& builds, bool timed) {
    TimedTable table({"scene", "tree", "triangles", "inner nodes", "leaves", "bytes a triangle"},
                     {"ms", "beside Embree"}, timed);
    for (const BuildPoint& p : builds) {
        const BuildPoint* const embree = build_of(builds, p.scene, "Embree");
        const bool is_embree = p.structure == "Embree";
        table.row(
            {p.scene, p.structure, with_commas(p.triangles), is_embree ? "" : with_commas(p.nodes),
             is_embree ? "" : with_commas(p.blocks), fixed(p.bytes_per_triangle(), 1)},
            {fixed(p.ms, 1), embree ? times(p.ms, embree->ms) : ""});
    }
    return table.table();
}

Table compressed_table(const FastMeasurements& measured, bool timed) {
    TimedTable table({"triangles", "wide: bytes", "nodes", "compressed: bytes", "nodes"},
                     {"wide, ns", "compressed, ns", "gain"}, timed);
    for (const SizePoint& wide : measured.sizes) {
        if (wide.structure != "wide" || wide.kind != diffuse_kind) continue;
        for (const SizePoint& p : measured.sizes)
            if (p.structure == "compressed" && p.kind == diffuse_kind &&
                p.triangles == wide.triangles)
                table.row(
                    {with_commas(p.triangles), per(wide.bytes, wide.triangles),
                     per(wide.nodes, wide.rays), per(p.bytes, p.triangles), per(p.nodes, p.rays)},
                    {fixed(wide.ns, 0), fixed(p.ns, 0), times(wide.ns, p.ns)});
    }
    return table.table();
}

Table sizes_table(const std::vector<SizePoint>& sizes, bool timed) {
    TimedTable table({"triangles", "rays", "structure", "bytes a triangle", "nodes", "tests"},
                     {"ns", "Mray/s"}, timed);
    for (const SizePoint& p : sizes)
        table.row({with_commas(p.triangles), std::string(ray_kinds[p.kind]), p.structure,
                   per(p.bytes, p.triangles), p.nodes > 0 ? per(p.nodes, p.rays) : "",
                   p.nodes > 0 ? per(p.tests, p.rays) : ""},
                  {fixed(p.ns, 0), mega(p.ns)});
    return table.table();
}

Table choices_table(const std::vector<ChoicePoint>& choices, std::string_view heading, bool timed) {
    TimedTable table({"scene", std::string(heading), "inner nodes", "bytes a triangle",
                      "expected cost", "visits a diffuse ray", "tests"},
                     {"camera, Mray/s", "shadow", "diffuse"}, timed);
    for (const ChoicePoint& p : choices)
        table.row({p.scene, p.choice, with_commas(p.nodes), per(p.bytes, p.triangles),
                   fixed(p.cost, 2), per(p.visits, p.rays), per(p.tests, p.rays)},
                  {mega(p.ns[0]), mega(p.ns[1]), mega(p.ns[2])});
    return table.table();
}

// --- many rays, and answers ---

Table modes_table(const std::vector<ModePoint>& modes, bool timed) {
    TimedTable table({"scene", "rays", "mode", "traced", "other answers"}, {"ns", "gain"}, timed);
    for (const ModePoint& p : modes)
        table.row({p.scene, std::string(ray_kinds[p.kind]), p.mode, with_commas(p.rays),
                   with_commas(p.differ)},
                  {fixed(p.ns, 0), times(p.single_ns, p.ns)});
    return table.table();
}

Table aimed_table(const std::vector<AimedPoint>& aimed, bool timed) {
    TimedTable table({"scene", "tracer", "aimed rays", "wrong", "a million"}, {"Mray/s"}, timed);
    for (const AimedPoint& p : aimed)
        table.row({p.scene, p.tracer, with_commas(p.rays), with_commas(p.wrong),
                   fixed(p.wrong_per_million(), 0)},
                  {mega(p.ns)});
    return table.table();
}

Table exact_table(const std::vector<KernelPoint>& kernels) {
    Table table({"scene", "children", "instructions", "rays", "other bits"});
    for (const KernelPoint& p : kernels)
        table.row({p.scene, with_commas(p.width), p.instruction_set, with_commas(p.rays),
                   with_commas(p.differ)});
    return table;
}

// --- goals ---

/// What the chapter wants, and what is there.
struct Goal {
    std::string name, number;  ///< number: as pages quote the one that counts
    double wanted;
    bool at_least;
    Ratios ratios;
    bool by_median = false;  ///< that counts; else the worst

    double counts() const {
        return by_median ? ratios.middle() : at_least ? ratios.least() : ratios.most();
    }
    bool is_met() const { return at_least ? counts() >= wanted : counts() <= wanted; }
};

void add_peer_goals(const FastMeasurements& measured, std::vector<Goal>& goals) {
    Goal embree{"rays/s beside Embree", "beside_embree", 1.1, true, {}},
        robust{"rays/s beside Embree robust", "beside_robust", 1.25, true, {}},
        threads{"two threads beside one", "two_threads_gain", 1.9, true, {}, true};
    std::vector<Goal> high;
    for (const auto& [kind, wanted] :
         {std::pair{camera_kind, 1.6}, {shadow_kind, 1.9}, {diffuse_kind, 1.35}})
        high.push_back(
            {fmt::format("better tree, long triangles, {}: beside Embree", ray_kinds[kind]),
             fmt::format("high_beside_embree_{}", ray_kinds[kind]),
             wanted,
             true,
             {},
             true});
    for (const PeerPoint& p : measured.peers) {
        embree.ratios.add(p.embree_ns, p.ours_ns);
        robust.ratios.add(p.robust_ns, p.ours_ns);
        threads.ratios.add(p.ours_ns, p.two_threads_ns);
        if (p.is_long) high[p.kind].ratios.add(p.embree_ns, p.ours_high_ns);
    }
    goals.push_back(std::move(embree));
    goals.push_back(std::move(robust));
    for (Goal& goal : high) goals.push_back(std::move(goal));
    goals.push_back(std::move(threads));
}

void add_tree_goals(const FastMeasurements& measured, std::vector<Goal>& goals) {
    Goal build{"build time beside Embree", "build_beside_embree", 1.0, false, {}, true},
        bytes{"bytes a triangle", "bytes_per_triangle", 70.0, false, {}, true},
        compressed{
            "bytes a triangle, compressed", "bytes_per_triangle_compressed", 40.0, false, {}, true};
    for (const BuildPoint& p : measured.builds) {
        if (p.structure == "fast") {
            if (const BuildPoint* const embree = build_of(measured.builds, p.scene, "Embree"))
                build.ratios.add(p.ms, embree->ms);
            bytes.ratios.add(p.bytes_per_triangle(), 1.0);
        }
        if (p.structure == "compressed") compressed.ratios.add(p.bytes_per_triangle(), 1.0);
    }
    goals.push_back(std::move(build));
    goals.push_back(std::move(bytes));
    goals.push_back(std::move(compressed));
}

void add_mode_goals(const FastMeasurements& measured, std::vector<Goal>& goals) {
    Goal packets{
        "best mode beside single rays, camera", "packets_camera_gain", 3.0, true, {}, true},
        interleaved{"best mode beside single rays, diffuse, large scenes",
                    "interleaved_diffuse_gain",
                    1.5,
                    true,
                    {},
                    true};
    const auto best = [&](const ModePoint& single, std::string_view suffix) {
        double gain = 0.0;
        for (const ModePoint& p : measured.modes)
            if (p.scene == single.scene && p.kind == single.kind && p.mode.ends_with(suffix) &&
                p.ns > 0.0)
                gain = std::max(gain, p.gain());
        return gain;
    };
    for (const ModePoint& p : measured.modes) {
        if (p.mode == "single" && p.kind == camera_kind) packets.ratios.add(best(p, ""), 1.0);
        if (p.mode == "single, by chance" && p.triangles >= 500'000)
            interleaved.ratios.add(best(p, ", by chance"), 1.0);
    }
    goals.push_back(std::move(packets));
    goals.push_back(std::move(interleaved));
}

std::vector<Goal> goals_of(const FastMeasurements& measured) {
    std::vector<Goal> goals;
    add_peer_goals(measured, goals);
    add_tree_goals(measured, goals);
    add_mode_goals(measured, goals);
    return goals;
}

Table goals_table(const std::vector<Goal>& goals) {
    Table table({"what", "wanted", "worst", "median", "best", "that counts", "met"});
    for (const Goal& goal : goals) {
        if (goal.ratios.all.empty()) continue;
        table.row({goal.name, fmt::format("{} {}", goal.at_least ? "≥" : "≤", goal.wanted),
                   fixed(goal.at_least ? goal.ratios.least() : goal.ratios.most(), 2),
                   fixed(goal.ratios.middle(), 2),
                   fixed(goal.at_least ? goal.ratios.most() : goal.ratios.least(), 2),
                   goal.by_median ? "median" : "worst", goal.is_met() ? "yes" : "no"});
    }
    return table;
}

/// A table that is printed and quoted.
struct NamedTable {
    std::string name, heading;
    Table table;
};

std::vector<NamedTable> all_tables(const FastMeasurements& m, bool timed) {
    std::vector<NamedTable> all;
    const auto add = [&](std::string name, std::string heading, Table table) {
        all.push_back({std::move(name), std::move(heading), std::move(table)});
    };
    const auto time = [&](std::string name, std::string heading, Table table) {
        if (timed) add(std::move(name), std::move(heading), std::move(table));
    };
    time("memory", "What a load takes", memory_table(m.memory));
    time("pages", "What pages cost", pages_table(m.memory));
    time("slabs", "A box by itself", slabs_table(m.slabs));
    time("costs", "A node of eight boxes, a block of four triangles", costs_table(m.steps));
    add("work", "What a ray does, and what a model of caches says of it", work_table(m.work));
    time("bounds", "What a ray must take, and what it takes", bounds_table(m.work));
    time("profile", "Where the time of a ray goes", profile_table(m.work));
    add("ladder", "The ladder", ladder_table(m.ladder, timed));
    time("peers", "Beside Embree, one thread, one ray at a time", peers_table(m.peers));
    add("answers", "The same rays: answers that are not the binary tree's", answers_table(m.peers));
    add("builds", "Builds and memory", builds_table(m.builds, timed));
    add("sizes", "One scene as it grows", sizes_table(m.sizes, timed));
    add("compressed", "Compressed nodes, diffuse rays", compressed_table(m, timed));
    add("widths", "Four or eight children", choices_table(m.widths, "children", timed));
    add("leaf_sizes", "Triangles of a leaf", choices_table(m.leaf_sizes, "leaves", timed));
    add("high", "Better binary trees", choices_table(m.high, "builder", timed));
    add("modes", "Several rays at once", modes_table(m.modes, timed));
    add("aimed", "Rays at edges and vertices", aimed_table(m.aimed, timed));
    add("exact", "Kernels beside the naive loop", exact_table(m.kernels));
    time("goals", "What was wanted", goals_table(goals_of(m)));
    time("cures", "What was tried where a goal is missed", cures_table(m));
    return all;
}

void quote_memory(const std::vector<MemoryPoint>& memory, Numbers& numbers) {
    for (const auto& [name, bytes] : {std::pair{"latency_l1", 16u << 10},
                                      {"latency_l2", 512u << 10},
                                      {"latency_l3", 8u << 20},
                                      {"latency_memory", 256u << 20}})
        for (const MemoryPoint& p : memory)
            if (p.bytes == bytes)
                numbers.time(name, p.latency_ns, fixed(p.latency_ns, p.latency_ns < 10 ? 1 : 0));
    numbers.time("bandwidth", memory.back().gigabytes_per_second,
                 fixed(memory.back().gigabytes_per_second, 0));
}

/// How much faster the last rung that is ours is than the binary tree, in diffuse rays.
void quote_ladder(const std::vector<RungPoint>& ladder, Numbers& numbers) {
    std::vector<std::string> scenes;
    for (const RungPoint& p : ladder)
        if (std::ranges::count(scenes, p.scene) == 0) scenes.push_back(p.scene);
    const std::vector<std::string> names{"small", "large", "long"};
    for (std::size_t i = 0; i < std::min(scenes.size(), names.size()); ++i) {
        double binary = 0.0, best = infinity;
        for (const RungPoint& p : ladder) {
            if (p.scene != scenes[i] || p.kind != diffuse_kind) continue;
            if (p.rung == "binary") binary = p.ns;
            if (!p.rung.starts_with("Embree")) best = std::min(best, p.ns);
        }
        numbers.time("ladder_gain_" + names[i], binary / best, fixed(binary / best, 1));
    }
}

}  // namespace

void print_fast(const FastMeasurements& measured, bool times) {
    for (const NamedTable& each : all_tables(measured, times)) {
        print_heading(each.heading);
        each.table.print();
    }
}

void quote_fast(const FastMeasurements& measured, bool times, Numbers& numbers) {
    const auto sum = [](const auto& points, const auto& of) {
        std::uint64_t all = 0;
        for (const auto& p : points) all += of(p);
        return all;
    };
    numbers.count("exact_wrong", wrong_answers(measured));
    // The rest hangs on the machine: its instruction sets, its scenes, or its times.
    if (!times) return;
    for (const NamedTable& each : all_tables(measured, times))
        numbers.time_table(each.name, each.table);
    for (const auto& [name, count] :
         {std::pair{"modes_rays", sum(measured.modes, [](const ModePoint& p) { return p.rays; })},
          {"modes_differ", sum(measured.modes, [](const ModePoint& p) { return p.differ; })}})
        numbers.time(name, double(count), with_commas(count));
    numbers.time("kernel_rays", 0.0,
                 with_commas(sum(measured.kernels, [](const KernelPoint& p) { return p.rays; })));
    numbers.time("kernel_differ", 0.0,
                 with_commas(sum(measured.kernels, [](const KernelPoint& p) { return p.differ; })));
    quote_memory(measured.memory, numbers);
    quote_ladder(measured.ladder, numbers);
    for (const Goal& goal : goals_of(measured)) {
        const bool is_share = goal.number.starts_with("beside");
        numbers.time(goal.number + (is_share ? "_least" : ""), goal.counts(),
                     fixed(goal.counts(), goal.counts() < 10.0 ? 2 : 0));
    }
}

}  // namespace space::ch10
