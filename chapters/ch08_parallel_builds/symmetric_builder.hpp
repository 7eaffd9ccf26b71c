/// @file
/// The symmetric method of [BvhThesis13], section 4.3: both sides of a cut may start threads, half
/// as many each.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/forked_build.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <cstddef>
#include <span>

namespace space {

/// The sequential builder's, and how many threads.
struct SymmetricConfig : BinnedBuilder::Config {
    unsigned threads = 1;
};

/// Good where cuts halve the work; whatever the sides' sizes, they get as many threads.
struct SymmetricBuilder {
    using Config = SymmetricConfig;

    // [symmetric]
    /// One of the budget is the thread that is started here.
    static ThreadBudgets divide(unsigned budget) {
        if (budget % 2 == 1) return {budget / 2, budget / 2};
        return {budget / 2 - 1, budget / 2};
    }
    // [symmetric]

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const auto halve = [](unsigned budget, std::size_t, std::size_t) { return divide(budget); };
        return ForkedBuild<D, decltype(halve), Observer>(config, halve, observer)
            .build(polygons, build_threads(config.threads));
    }
};

}  // namespace space
