#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/kernels/many_table.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/pointer_chase.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace space::ch10 {
namespace {

/// Like CacheLineAllocator, but it asks for pages of 4 KB.
template <class T>
struct SmallPageAllocator {
    using value_type = T;

    T* allocate(std::size_t n) {
        void* const memory = ::operator new(n * sizeof(T), alignment);
#ifdef __linux__
        madvise(memory, n * sizeof(T), MADV_NOHUGEPAGE);
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) {
        ::operator delete(memory, alignment);
    }
    bool operator==(const SmallPageAllocator&) const = default;

  private:
    static constexpr std::align_val_t alignment{4096};
};

/// Median nanoseconds of each of so many steps that run() does.
double step_ns(std::size_t steps, int rounds, const std::function<void()>& run) {
    const std::vector<std::function<void()>> one{run};
    return 1e6 * thread_medians(one, rounds).front() / double(steps);
}

/// All lines in order, each of their words.
std::uint64_t sum_in_order(std::span<const ChaseLine> lines) {
    const auto* const words = reinterpret_cast<const std::uint32_t*>(lines.data());
    std::uint64_t sums[4] = {};
    for (std::size_t i = 0; i < lines.size() * 16; i += 8) {
        std::uint64_t two;
        for (std::size_t j = 0; j < 4; ++j) {
            std::memcpy(&two, words + i + 2 * j, sizeof two);
            sums[j] += two;
        }
    }
    return sums[0] + sums[1] + sums[2] + sums[3];
}

MemoryPoint memory_point(std::size_t bytes, int rounds) {
    const std::size_t lines = bytes / sizeof(ChaseLine), steps = std::size_t{1} << 19;
    MemoryPoint point{.bytes = bytes};
    {
        const auto circle = make_chase_circle(lines, 1);
        point.latency_ns = step_ns(steps, rounds, [&] { do_not_optimize(chase(circle, steps)); });
        point.many_latency_ns =
            step_ns(steps, rounds, [&] { do_not_optimize(chase_together<8>(circle, steps / 8)); });
        const std::size_t turns = std::max<std::size_t>(1, (std::size_t{1} << 25) / bytes);
        const double ns = step_ns(turns * bytes, rounds, [&] {
            for (std::size_t turn = 0; turn < turns; ++turn) do_not_optimize(sum_in_order(circle));
        });
        point.gigabytes_per_second = 1.0 / ns;
    }
    const auto circle = make_chase_circle(lines, 1, SmallPageAllocator<ChaseLine>());
    point.small_pages_ns = step_ns(steps, rounds, [&] { do_not_optimize(chase(circle, steps)); });
    return point;
}

constexpr std::uint32_t probed = 64;  // 16 KB of nodes, 10 KB of blocks: in the nearest cache
constexpr std::size_t probe_steps = 200'000;

/// Boxes and triangles at random, such that a ray through them meets some.
struct ProbedTree {
    WideTree<8> tree;

    explicit ProbedTree(std::uint64_t seed) {
        Pcg32 random(seed);
        tree.nodes.resize(probed);
        tree.blocks.resize(probed);
        for (std::uint32_t i = 0; i < probed; ++i) {
            for (std::size_t child = 0; child < 8; ++child) {
                const Point3 corner = random_point(random, -1.0f, 1.0f);
                Aabb box;
                box.extend(corner);
                box.extend(corner + 0.7f * random_vector(random));
                tree.nodes[i].put(child, box, WideChild::node(random.below(probed)));
            }
            for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
                Triangle triangle;
                triangle.a = random_point(random, -1.0f, 1.0f);
                triangle.b = triangle.a + 0.5f * random_vector(random);
                triangle.c = triangle.a + 0.5f * random_vector(random);
                tree.blocks[i].put(lane, triangle, i);
            }
        }
        tree.root = WideChild::node(0);
    }
    KernelTree kernel_tree() const {
        return {.nodes = reinterpret_cast<const char*>(tree.nodes.data()),
                .blocks = reinterpret_cast<const char*>(tree.blocks.data()),
                .root = 0,
                .stack_size = 8,
                .largest = 2.0f,
                .exact = exact_lane,
                .prepare = prepare_kernel_floats};
    }
};

const Ray probe_ray{.origin = {-2.0f, -1.9f, -1.8f}, .direction = {1.0f, 0.97f, 0.93f}};

/// The walk in plain C++, box by box.
double scalar_box_ns(const WideTree<8>& tree, int rounds) {
    const BvhRay<3> ray(probe_ray);
    return step_ns(8 * probe_steps, rounds, [&] {
        std::uint32_t met = 0;
        for (std::size_t i = 0; i < probe_steps; ++i)
            for (std::size_t child = 0; child < 8; ++child)
                met += ray.span_in(tree.nodes[i % probed].box(child), ray.limit()).is_met();
        do_not_optimize(met);
    });
}

StepPoint step_point(InstructionSet set, const ProbedTree& probe, int rounds) {
    const ManyKernels& kernels = *many_kernels(set);
    const KernelTree tree = probe.kernel_tree();
    const auto nodes = [&](bool is_chained) {
        return step_ns(probe_steps, rounds, [&, is_chained] {
            do_not_optimize(
                kernels.probe_nodes(tree, &probe_ray.origin.x, probed, probe_steps, is_chained));
        });
    };
    const auto blocks = [&](bool is_chained) {
        return step_ns(probe_steps, rounds, [&, is_chained] {
            do_not_optimize(
                kernels.probe_blocks(tree, &probe_ray.origin.x, probed, probe_steps, is_chained));
        });
    };
    StepPoint point{.instruction_set = std::string(name_of(set))};
    point.node_latency_ns = nodes(true);
    point.node_ns = nodes(false);
    point.block_latency_ns = blocks(true);
    point.block_ns = blocks(false);
    return point;
}

}  // namespace

void measure_probes(const FastEffort& effort, FastMeasurements& measured) {
    if (effort.rounds == 0) return;
    for (std::size_t bytes = std::size_t{16} << 10; bytes <= std::size_t{256} << 20; bytes *= 2)
        measured.memory.push_back(memory_point(bytes, effort.rounds));
    const ProbedTree probe(1);
    measured.slabs.push_back({.instruction_set = "scalar",
                              .boxes_at_once = 1,
                              .ns_per_box = scalar_box_ns(probe.tree, effort.rounds)});
    for (const InstructionSet set : usable_instruction_sets()) {
        if (!many_kernels(set)) continue;
        measured.steps.push_back(step_point(set, probe, effort.rounds));
        const StepPoint& point = measured.steps.back();
        measured.slabs.push_back({.instruction_set = point.instruction_set,
                                  .boxes_at_once = 8,
                                  .ns_per_box = point.node_ns / 8.0});
    }
}

MachineCosts machine_costs(const FastMeasurements& measured) {
    MachineCosts costs;
    if (measured.steps.empty() || measured.memory.empty()) return costs;
    const StepPoint& best = measured.steps.back();
    costs.node_latency = best.node_latency_ns;
    costs.block_latency = best.block_latency_ns;
    costs.node_throughput = best.node_ns;
    costs.block_throughput = best.block_ns;
    // Working sets that are well inside of one cache and well outside of the one before it.
    const auto at = [&](std::size_t bytes) {
        return *std::ranges::find_if(measured.memory,
                                     [&](const MemoryPoint& p) { return p.bytes >= bytes; });
    };
    const MemoryPoint nearest = at(std::size_t{16} << 10), second = at(std::size_t{512} << 10),
                      last = at(std::size_t{8} << 20), memory = at(std::size_t{256} << 20);
    const auto beyond = [&](double MemoryPoint::*ns) {
        return std::array{second.*ns - nearest.*ns, last.*ns - nearest.*ns,
                          memory.*ns - nearest.*ns};
    };
    costs.line_latency = beyond(&MemoryPoint::latency_ns);
    costs.line_throughput = beyond(&MemoryPoint::many_latency_ns);
    for (auto* const lines : {&costs.line_latency, &costs.line_throughput})
        for (double& ns : *lines) ns = std::max(ns, 0.0);
    return costs;
}

}  // namespace space::ch10
