/// @file
/// The chapter's builders as values: a loop can go over them, and all trees are walked by the same
/// machine code.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace space::ch07 {

using BuildNodes = std::function<BvhNodes<3>(std::span<const Triangle>)>;

/// A builder that is chosen when the program runs.
struct AnyBuilder {
    /// What builds the tree.
    struct Config {
        BvhCosts costs = {};
        BuildNodes build = {};
    };
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Triangle> triangles, const Config& config = {},
                             Observer&& = {}) {
        return config.build(triangles);
    }
};

template <class Builder>
AnyBuilder::Config any(const typename Builder::Config& config = {}) {
    return {.costs = config.costs, .build = [config](std::span<const Triangle> triangles) {
                return Builder::template build<3>(triangles, config);
            }};
}

/// One of the chapter's builders with its defaults.
struct NamedBuilder {
    std::string_view name;
    AnyBuilder::Config config;
    std::size_t most_triangles = std::numeric_limits<std::size_t>::max();  ///< or it takes too long
};
const std::vector<NamedBuilder>& builders();

}  // namespace space::ch07
