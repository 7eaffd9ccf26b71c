/// @file
/// The one interface of every structure of the book, and what a structure tells about itself.
#pragma once

#include "common/geometry.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace space {

/// Where a ray meets a triangle: the point origin + t direction = (1 - u - v) a + u b + v c.
struct Hit {
    float t = infinity;
    std::uint32_t triangle = 0;  ///< index into the span that the structure was built from
    float u = 0.0f, v = 0.0f;

    bool operator==(const Hit&) const = default;
};

/// The order of hits along a ray: of equal t the smaller triangle index wins, so that every
/// structure returns the same triangle, whatever the order in which it looks.
inline bool nearer(const Hit& hit, const Hit& other) {
    return hit.t < other.t || (hit.t == other.t && hit.triangle < other.triangle);
}

// [found]
/// The nearest of the hits that a search comes to: `search(found)` calls found(hit) for each, which
/// returns the t beyond which nothing matters any more.
template <class Search>
std::optional<Hit> nearest_found(const Search& search) {
    std::optional<Hit> nearest;
    search([&](const Hit& hit) {
        if (!nearest || nearer(hit, *nearest)) nearest = hit;
        // A hit half a place farther may round to the same t and have the smaller index.
        return double{std::nextafter(nearest->t, infinity)};
    });
    return nearest;
}
/// Whether it comes to any.
template <class Search>
bool is_any_found(const Search& search) {
    bool is_found = false;
    search([&](const Hit&) {
        is_found = true;
        return std::nan("");  // nothing is nearer than this, and nothing matters any more
    });
    return is_found;
}
// [found]

/// Counting is a policy: a query with NoCounts compiles to the same code as one that never counts.
struct NoCounts {
    static constexpr void visit_node() {}
    static constexpr void test_triangle() {}
};

/// What a query did, in numbers that are the same on every machine.
struct TraversalCounts {
    std::uint64_t nodes_visited = 0;
    std::uint64_t triangles_tested = 0;

    void visit_node() { ++nodes_visited; }
    void test_triangle() { ++triangles_tested; }
    TraversalCounts& operator+=(const TraversalCounts& other) {
        nodes_visited += other.nodes_visited;
        triangles_tested += other.triangles_tested;
        return *this;
    }
    bool operator==(const TraversalCounts&) const = default;
};

/// Size and shape of a structure; a field without a meaning for it stays empty.
struct TreeShape {
    std::optional<std::size_t> nodes = {};  ///< inner nodes and leaves
    std::optional<std::size_t> leaves = {};
    std::optional<std::size_t> depth = {};  ///< edges from the root to the deepest leaf
    std::size_t references = 0;  ///< triangle entries over all leaves, duplicates counted
    std::size_t bytes = 0;       ///< memory that the structure holds
    std::optional<double> sah_cost =
        {};  ///< expected cost of a random ray, by the structure's own constants
};

/// What can be asked of any structure. closest_hit: the hit with the smallest t in [tmin, tmax];
/// any_hit: whether there is one. Structures also have a static build(std::span<const Triangle>,
/// Config) and are plain values.
template <class A>
concept Accelerator = requires(const A& accelerator, const Ray& ray, NoCounts& none,
                               TraversalCounts& counts) {
    { accelerator.closest_hit(ray, none) } -> std::same_as<std::optional<Hit>>;
    { accelerator.closest_hit(ray, counts) } -> std::same_as<std::optional<Hit>>;
    { accelerator.any_hit(ray, none) } -> std::same_as<bool>;
    { accelerator.any_hit(ray, counts) } -> std::same_as<bool>;
    { accelerator.shape() } -> std::same_as<TreeShape>;
};

/// The queries without counting.
template <Accelerator A>
std::optional<Hit> closest_hit(const A& accelerator, const Ray& ray) {
    NoCounts none;
    return accelerator.closest_hit(ray, none);
}
template <Accelerator A>
bool any_hit(const A& accelerator, const Ray& ray) {
    NoCounts none;
    return accelerator.any_hit(ray, none);
}

}  // namespace space
