/// @file
/// The structures of the book as the lab sees them: a name, and a function that builds one and
/// traces whole batches of rays through it. A structure's type is erased at the batch: no ray pays
/// for an indirect call.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "chapters/ch12_comparison/rays.hpp"
#include "common/accelerator.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace space {

/// The two questions of the concept Accelerator.
enum class Query { closest, any };

/// Rays to trace and where the answers go: hits[i] is that of rays[i].
struct Batch {
    std::span<const Ray> rays;
    std::span<HitRecord> hits;
    Query query = Query::closest;
    unsigned threads = 1;
    Progress* progress = nullptr;  ///< stepped once for each ray
};

/// A structure that stands, whatever its type.
struct BuiltStructure {
    std::function<TreeShape()> shape;
    std::function<void(const Batch&)> trace;  ///< without counting: what is timed
    /// The same answers by rays in packets, which few structures know.
    std::function<void(const Batch&)> trace_packets = {};
    /// The same answers, and the work behind them. A peer does not tell.
    std::function<TraversalCounts(const Batch&)> count = {};
    unsigned build_threads = 1;      ///< that the builder could use
    std::string configuration = {};  ///< version and flags of a peer
};

/// Where a builder must give up rather than take all memory or an evening: in counts, so that it
/// does so on every machine or on none. Some 3 GB and a minute.
struct Limits {
    std::size_t references = 10'000'000;     ///< entries of triangles or pieces of them, in all
    std::uint64_t placements = 100'000'000;  ///< how often an entry is put somewhere, by all nodes
};

/// What a builder may use.
struct BuildOptions {
    unsigned threads = 1;
    Limits limits = {};
};

/// What rays are traced through: triangles; or a scene graph, and its triangles where somebody
/// wants them flattened.
struct Geometry {
    std::span<const Triangle> triangles;
    const SceneGraph* graph = nullptr;
};

/// A structure with one of the triangle tests. Builders throw where they give up.
struct StructureVariant {
    std::string_view triangle_test, about_test;
    std::function<BuiltStructure(std::span<const Triangle> triangles, const BuildOptions& options)>
        build_from_triangles;
    /// Of those that know instances.
    std::function<BuiltStructure(const SceneGraph& graph, const BuildOptions& options)>
        build_from_graph = {};

    BuiltStructure build(const Geometry& geometry, const BuildOptions& options) const {
        return geometry.graph && build_from_graph
                   ? build_from_graph(*geometry.graph, options)
                   : build_from_triangles(geometry.triangles, options);
    }
};

/// An entry of the lab, in the variants that can be asked for.
struct Structure {
    std::string_view name, about;
    std::vector<StructureVariant> variants;  ///< the first is the default
    std::string_view home = "";              ///< "chapter 3", or the library that it comes from
    bool by_default = false;                 ///< measured where no structure is named
    bool is_peer = false;  ///< others' code, with a test of its own, whose answers may be wrong
};

/// The structures of a chapter or of another library; the first is measured by default.
struct Home {
    std::string_view name;
    std::vector<Structure> structures;
    bool is_peer = false;
};
std::vector<Structure> joined(std::vector<Home> homes);

/// Every structure of the book, in its order; the first is naive tracing, which --check trusts.
const std::vector<Structure>& structures();

// [batch]
/// Answers the query for each ray of the batch; the answers do not depend on the number of threads.
/// A has closest_hit and any_hit, as an Accelerator has; its hits may have other numbers.
template <class Counts, class A>
Counts trace(const A& accelerator, const Batch& batch) {
    // Rays that a thread takes at a time: many enough to hide the taking, few enough to share out a
    // short batch.
    constexpr std::size_t block_size = 128;
    Counts total;
    std::mutex total_lock;
    parallel_for((batch.rays.size() + block_size - 1) / block_size, batch.threads, 1,
                 [&](std::size_t block) {
                     const std::size_t first = block * block_size,
                                       last = std::min(first + block_size, batch.rays.size());
                     Counts counts;
                     if (batch.query == Query::closest)
                         for (std::size_t i = first; i < last; ++i)
                             batch.hits[i] =
                                 HitRecord::closest(accelerator.closest_hit(batch.rays[i], counts));
                     else
                         for (std::size_t i = first; i < last; ++i)
                             batch.hits[i] =
                                 HitRecord::any(accelerator.any_hit(batch.rays[i], counts));
                     if (batch.progress) batch.progress->step(last - first);
                     if constexpr (std::is_same_v<Counts, TraversalCounts>) {
                         const std::lock_guard guard(total_lock);
                         total += counts;
                     }
                 });
    return total;
}
// [batch]

/// A structure that stands, without its type.
template <class A>
BuiltStructure erased(A accelerator, unsigned build_threads = 1) {
    const auto structure = std::make_shared<const A>(std::move(accelerator));
    return {.shape = [structure] { return structure->shape(); },
            .trace = [structure](const Batch& batch) { trace<NoCounts>(*structure, batch); },
            .count = [structure](
                         const Batch& batch) { return trace<TraversalCounts>(*structure, batch); },
            .build_threads = build_threads};
}

/// Builds an A; the number of threads matters to a Config that has a field `threads`.
template <Accelerator A>
BuiltStructure build_configured(std::span<const Triangle> triangles, const BuildOptions& options,
                                typename A::Config config) {
    unsigned build_threads = 1;
    if constexpr (requires { config.threads = options.threads; })
        config.threads = build_threads = options.threads;
    return erased(A::build(triangles, config), build_threads);
}

/// The same with the default Config.
template <Accelerator A>
BuiltStructure build_structure(std::span<const Triangle> triangles, const BuildOptions& options) {
    return build_configured<A>(triangles, options, {});
}

}  // namespace space
