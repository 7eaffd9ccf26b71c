/// @file
/// The asymmetric method of [BvhThesis13], section 4.2: only one side of a cut may start threads.
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
struct AsymmetricConfig : BinnedBuilder::Config {
    unsigned threads = 1;
};

/// Good where one side is nearly all, and the same one at each level.
struct AsymmetricBuilder {
    using Config = AsymmetricConfig;

    // [asymmetric]
    /// Which side it is the root's cut decides, for all cuts: the one with more triangles.
    class Divide {
      public:
        ThreadBudgets operator()(unsigned budget, std::size_t first, std::size_t second) {
            if (side_ == Side::unknown) side_ = first > second ? Side::first : Side::second;
            if (side_ == Side::first) return {budget - 1, 0};
            return {0, budget - 1};
        }

      private:
        enum class Side { unknown, first, second };
        Side side_ = Side::unknown;  ///< known before the first thread starts, and so never raced
    };
    // [asymmetric]

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        return ForkedBuild<D, Divide, Observer>(config, {}, observer)
            .build(polygons, build_threads(config.threads));
    }
};

}  // namespace space
