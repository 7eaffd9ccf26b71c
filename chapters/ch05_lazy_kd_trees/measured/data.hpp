/// @file
/// What chapter 5 counts and times, as plain values: enough for its tables, charts and verdicts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch05 {

// --- Johnston06's table ---

/// A row of the table in Johnston06: seconds, nodes, and intersections, the same for both trees.
struct PublishedRow {
    std::string_view scene, view;
    double eager_build, lazy_build, eager_total, lazy_total;
    double eager_nodes, lazy_nodes;
    double intersections;

    double build_share() const { return lazy_build / eager_build; }
    double total_share() const { return lazy_total / eager_total; }
    double node_share() const { return lazy_nodes / eager_nodes; }
    /// Microseconds for a node: while the tree is built, and while rays need it.
    double eager_node_us() const { return 1e6 * (eager_build - lazy_build) / eager_nodes; }
    double lazy_node_us() const {
        return 1e6 * ((lazy_total - lazy_build) - (eager_total - eager_build)) / lazy_nodes;
    }
};
inline constexpr std::string_view seen = "visible", unseen = "out of view", close_up = "close-up",
                                  first_view = "view 1", second_view = "view 2";
/// The row of the plants' second view is empty there.
inline constexpr std::array published_rows{
    PublishedRow{"killeroos", seen, 41.57, 7.4, 70.07, 50.2, 2.752e6, 1.06e6, 673.2e3},
    PublishedRow{"killeroos", unseen, 41.4, 7.4, 64.9, 32.16, 2.752e6, 97, 758.4e3},
    PublishedRow{"killeroos", close_up, 41.11, 7.6, 72.91, 41.17, 2.752e6, 272.9e3, 644.1e3},
    PublishedRow{"plants", first_view, 105.497, 56.75, 727.5, 933.25, 14.86e6, 7.46e6, 20.29e6}};
/// What stands there for 97 of 2.752 million nodes.
inline constexpr double printed_share = 0.00001 / 100;

/// One picture by one of the two trees.
struct Drawn {
    std::uint64_t nodes = 0, bytes = 0;
    std::uint64_t visited = 0, tests = 0;
    std::uint64_t hits = 0;  ///< of camera rays, and shadow rays that are stopped
    double build_ms = 0.0, total_ms = 0.0;

    bool same_work(const Drawn& other) const {
        return visited == other.visited && tests == other.tests && hits == other.hits;
    }
};

/// One view of a scene by both trees.
struct ViewPoint {
    std::string scene, view;
    std::uint64_t triangles = 0, rays = 0;
    Drawn eager, lazy;
    std::uint64_t nodes_singly = 0;  ///< of a lazy tree that makes nothing but what is entered
    std::uint64_t other_pixels = 0;  ///< in which the pictures differ

    bool is_plants() const { return scene == plants_name; }
    double node_share() const { return double(nodes_singly) / double(eager.nodes); }
    double build_share() const { return lazy.build_ms / eager.build_ms; }
    double total_share() const { return lazy.total_ms / eager.total_ms; }

    static constexpr std::string_view plants_name = "plants";
};

// --- how much rays reach ---

/// Rays that reach one part of a scene, by both trees.
struct ReachPoint {
    double share = 0.0;  ///< of the triangles that rays are aimed at; above 1: all nodes are made
    std::uint64_t rays = 0;
    std::uint64_t nodes = 0, all_nodes = 0;
    std::uint64_t different = 0;  ///< answers
    double eager_ms = 0.0, lazy_ms = 0.0;

    bool is_everything() const { return share > 1.0; }
    double node_share() const { return double(nodes) / double(all_nodes); }
    double time_share() const { return lazy_ms / eager_ms; }
};

/// What the trees hold after a part of a picture.
struct MemoryPoint {
    double picture = 0.0;  ///< the part of its rows
    std::uint64_t lazy_bytes = 0, eager_bytes = 0;
};

// --- lists ---

/// One tree over a scene, whose leaves find their triangles in three ways.
struct ListPoint {
    std::uint64_t triangles = 0, references = 0, rays = 0;
    std::uint64_t different = 0;  ///< answers
    double placed_ns = 0.0;       ///< a ray, with copies in the order of the leaves
    double listed_ns = 0.0;       ///< with indices in one list, and the triangles in theirs
    double scattered_ns = 0.0;    ///< with a list for each leaf and a place for each triangle
};

// --- lazy geometry ---

/// A view of a scene that is made where rays go.
struct GeometryPoint {
    std::string source, view;
    std::uint64_t patches = 0, triangles = 0;  ///< that there are
    std::uint64_t made_patches = 0, made_triangles = 0, nodes = 0;
    std::uint64_t bytes = 0;
    double bytes_if_all = 0.0;  ///< of an eager tree, by what one takes for a small part
    std::uint64_t rays = 0, hits = 0;
    std::optional<std::uint64_t> different =
        {};  ///< answers unlike an eager tree's, where one fits
    double build_ms = 0.0, total_ms = 0.0;
};

/// One way to a picture of a subdivided mesh: how long it takes, and how far off it is.
struct FirstPicture {
    std::string way;
    std::uint32_t levels = 0;  ///< of subdivision
    std::uint64_t triangles = 0;
    double error = 0.0;        ///< mean of |t - true t| / true t
    std::uint64_t missed = 0;  ///< rays that hit where they should not, or the other way round
    std::uint64_t rays = 0;
    double ms = 0.0;
};

/// All of it. With --counts every time is 0 or no number.
struct Measurements {
    std::vector<ViewPoint> views;
    std::vector<ReachPoint> reach;
    std::vector<MemoryPoint> memory;
    std::vector<ListPoint> lists;
    std::vector<GeometryPoint> geometry;
    std::vector<FirstPicture> first_pictures;
};

/// Answers, or pixels, that are not those of an eager tree.
std::uint64_t wrong_answers(const Measurements& measured);

}  // namespace space::ch05
