/// @file
/// What chapter 10 counts and times, as plain values: enough for its tables and charts. With
/// --counts every time is 0.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch10 {

/// Shadow rays ask whether there is any hit; diffuse ones leave surfaces in all directions.
enum RayKind : std::size_t { camera_kind, shadow_kind, diffuse_kind };
inline constexpr std::array<std::string_view, 3> ray_kinds{"camera", "shadow", "diffuse"};

// --- rung 1: what the machine can do ---

/// Reading from a working set: a chain of dependent loads, and all lines in order.
struct MemoryPoint {
    std::uint64_t bytes = 0;
    double latency_ns = 0.0;       ///< of one load that waits for the one before
    double small_pages_ns = 0.0;   ///< the same in pages of 4 KB
    double many_latency_ns = 0.0;  ///< of one load where eight chains are followed at once
    double gigabytes_per_second = 0.0;
};

/// Slab tests of one ray against boxes that are in the first cache.
struct SlabPoint {
    std::string instruction_set;  ///< "scalar", "sse2", "avx2", "avx512"
    std::uint64_t boxes_at_once = 1;
    double ns_per_box = 0.0;
};

/// What one of a walk's steps takes, by itself: of a node of eight boxes, of a block of four
/// triangles.
struct StepPoint {
    std::string instruction_set;
    double node_latency_ns = 0.0, node_ns = 0.0;  ///< one after the other; all by themselves
    double block_latency_ns = 0.0, block_ns = 0.0;
};

/// What a ray does in one tree, and where its time goes.
struct WorkPoint {
    std::string scene, structure;
    RayKind kind = camera_kind;
    std::uint64_t triangles = 0, bytes = 0, rays = 0;
    std::uint64_t nodes = 0, boxes = 0, blocks = 0, tests = 0;  ///< of all rays
    std::uint64_t lines = 0;                                    ///< cache lines asked for
    std::array<std::uint64_t, 3> misses = {};  ///< of the model's caches, the smallest first
    double mispredicted = 0.0, cycles = 0.0, instructions = 0.0;  ///< of a ray; 0: no counters here
    double ns = 0.0;                                              ///< of a ray, measured
    double compute_ns = 0.0, latency_ns = 0.0, bandwidth_ns = 0.0;  ///< bounds of a ray
    double nodes_ns = 0.0, blocks_ns = 0.0;  ///< what nodes and blocks have of latency_ns

    /// No ray of this tree by one thread is quicker, whatever its kernel does.
    double bound_ns() const { return compute_ns > bandwidth_ns ? compute_ns : bandwidth_ns; }
    double per_ray(std::uint64_t all) const { return double(all) / double(rays); }
};

// --- the ladder ---

/// One rung on one scene by one kind of rays. The rungs stand in the order in which they are
/// climbed; Embree's two modes are the last ones.
struct RungPoint {
    std::string scene, rung;
    RayKind kind = camera_kind;
    std::uint64_t triangles = 0, bytes = 0, rays = 0, nodes = 0, tests = 0;
    double ns = 0.0;                     ///< of a ray
    double bound_ns = 0.0;               ///< by WorkPoint::bound_ns of the last rung's tree
    std::uint64_t aimed = 0, wrong = 0;  ///< rays at edges and vertices, and wrong answers to them

    double rays_per_second() const { return 1e9 / ns; }
    double wrong_per_million() const { return 1e6 * double(wrong) / double(aimed); }
};

// --- beside Embree ---

/// One scene, one kind of rays: nanoseconds of a ray.
struct PeerPoint {
    std::string scene;
    bool is_long = false;  ///< whether the scene has triangles as long as itself
    RayKind kind = camera_kind;
    std::uint64_t triangles = 0, rays = 0;
    std::uint64_t differ = 0;  ///< answers of ours that are not the naive loop's or another tree's
    double ours_ns = 0.0, ours_high_ns = 0.0, compressed_ns = 0.0;
    double embree_ns = 0.0, robust_ns = 0.0, embree_high_ns = 0.0;
    double two_threads_ns = 0.0,
           embree_two_threads_ns = 0.0;  ///< of a ray, by two threads together

    double beside_embree() const { return embree_ns / ours_ns; }
    double beside_robust() const { return robust_ns / ours_ns; }
    double high_beside_embree() const { return embree_ns / ours_high_ns; }
    double two_threads() const { return ours_ns / two_threads_ns; }
};

/// What a tree takes to be made, and to be kept.
struct BuildPoint {
    std::string scene, structure;
    std::uint64_t triangles = 0, nodes = 0, blocks = 0, bytes = 0, depth = 0;
    double cost = 0.0;  ///< expected of a ray through the root, by the chapter's constants
    double ms = 0.0;

    double bytes_per_triangle() const { return double(bytes) / double(triangles); }
};

// --- as scenes grow ---

/// One structure, one size of a scene.
struct SizePoint {
    std::string scene, structure;
    RayKind kind = diffuse_kind;
    std::uint64_t triangles = 0, bytes = 0, rays = 0, nodes = 0, tests = 0;
    std::array<std::uint64_t, 3> misses = {};  ///< of the model's caches
    double ns = 0.0;
};

// --- several rays at once ---

/// One way to trace a span of rays.
struct ModePoint {
    std::string scene, mode;  ///< "single", "interleaved 4", "packets 16", "sorted stream" ...
    RayKind kind = camera_kind;
    std::uint64_t triangles = 0, bytes = 0, rays = 0, nodes = 0, tests = 0;
    std::uint64_t differ = 0;  ///< answers that are not those of single rays, in any bit
    double ns = 0.0, single_ns = 0.0;

    double gain() const { return single_ns / ns; }
};

// --- answers ---

/// Rays that are aimed at edges and vertices, by one tracer, held against the exact answer.
struct AimedPoint {
    std::string scene, tracer;
    std::uint64_t triangles = 0, rays = 0;
    std::uint64_t wrong = 0;  ///< a hit where there is none, none where there is one, a farther one
    double ns = 0.0;

    double wrong_per_million() const { return 1e6 * double(wrong) / double(rays); }
};

/// Kernels beside the naive loop: answers of all rays to both questions.
struct KernelPoint {
    std::string scene, instruction_set;
    std::uint64_t width = 0, triangles = 0, rays = 0;
    std::uint64_t differ = 0;  ///< in any bit
};

/// One choice for the tree under the same kernel.
struct ChoicePoint {
    std::string scene, choice;
    std::uint64_t triangles = 0, nodes = 0, blocks = 0, bytes = 0, rays = 0, visits = 0, tests = 0;
    double cost = 0.0;
    std::array<double, 3> ns = {};  ///< of a ray, by kind
};

/// What was tried where a goal is missed, on one scene: how many times as fast it is as what it was
/// tried on.
struct CurePoint {
    std::string goal, cure, scene;
    double gain = 0.0;
};

/// All of it.
struct FastMeasurements {
    std::vector<MemoryPoint> memory;  ///< none where nothing is timed
    std::vector<SlabPoint> slabs;     ///< none where nothing is timed
    std::vector<StepPoint> steps;     ///< none where nothing is timed
    std::vector<WorkPoint> work;
    std::vector<RungPoint> ladder;
    std::vector<PeerPoint> peers;
    std::vector<BuildPoint> builds;
    std::vector<SizePoint> sizes;
    std::vector<ModePoint> modes;
    std::vector<AimedPoint> aimed;
    std::vector<KernelPoint> kernels;
    std::vector<ChoicePoint> widths, leaf_sizes, high;
    std::vector<CurePoint> cures;  ///< none where nothing is timed
};

}  // namespace space::ch10
