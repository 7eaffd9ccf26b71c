/// @file
/// Chapter 7's tree by any builder. Whoever built it, the same code traces it, which is compiled
/// once for all.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/geometry.hpp"

#include <functional>
#include <span>
#include <string_view>

namespace space {

/// A builder without its type.
struct AnyBvhBuilder {
    /// The builder with its own Config, and what its tree's cost is counted by.
    struct Config {
        std::function<BvhNodes<3>(std::span<const Triangle>)> make;
        BvhCosts costs;
        unsigned threads;
    };
    template <int D, class Observer>
    static BvhNodes<D> build(std::span<const Triangle> triangles, const Config& config,
                             const Observer&) {
        return config.make(triangles);
    }
};
using ConfiguredBvhBuilder = std::function<AnyBvhBuilder::Config(const BuildOptions&)>;

Structure offer_any_bvh(std::string_view name, std::string_view about,
                        const ConfiguredBvhBuilder& builder);

/// `configure(config, limits)` may change what the builder's Config has by default.
template <class Builder, class Configure>
Structure offer_bvh(std::string_view name, std::string_view about, const Configure& configure) {
    return offer_any_bvh(name, about, [configure](const BuildOptions& options) {
        typename Builder::Config config;
        configure(config, options.limits);
        unsigned threads = 1;
        if constexpr (requires { config.threads = options.threads; })
            config.threads = threads = options.threads;
        return AnyBvhBuilder::Config{[config](std::span<const Triangle> triangles) {
                                         return Builder::template build<3>(triangles, config);
                                     },
                                     config.costs, threads};
    });
}
template <class Builder>
Structure offer_bvh(std::string_view name, std::string_view about) {
    return offer_bvh<Builder>(name, about, [](auto&, const Limits&) {});
}

}  // namespace space
