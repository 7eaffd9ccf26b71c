// A ray's walk through a tree of segments, step by step.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/drawn_walk.hpp"

#include <vector>

namespace space::ch07 {
namespace {

/// Long ones and short ones, so that boxes overlap.
std::vector<Segment> segments() {
    return {{{1.5f, 2.5f}, {12.0f, 9.5f}},   {{2.0f, 1.0f}, {5.0f, 2.0f}},
            {{6.0f, 12.0f}, {7.5f, 6.0f}},   {{6.5f, 13.5f}, {9.0f, 14.5f}},
            {{13.5f, 4.0f}, {14.5f, 10.0f}}, {{12.5f, 12.0f}, {15.0f, 13.5f}},
            {{13.0f, 1.5f}, {15.0f, 2.5f}}};
}

}  // namespace

Svg fig_07_17(const Options&) {
    const Story story =
        watched_build<BinnedBuilder>(segments(), {.costs = {1.0, 1.0}, .max_leaf_size = 1});
    return drawn_walk(
        "A ray's walk through a tree of seven segments, step by step, with what waits", story,
        {.origin = {0.5f, 7.5f}, .direction = {1.0f, 0.0625f}});
}

}  // namespace space::ch07
