// What it costs a ray that a leaf's triangles lie all over the memory (Johnston06's first attempt
// at lazy geometry).

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace space::ch05 {
namespace {

/// The same tree; for each leaf a list of its own, and for each triangle a place of its own, each
/// taken from the heap in random order.
class ScatteredLists {
  public:
    ScatteredLists(const KdNodes<3>& tree, const std::vector<Triangle>& triangles) : tree_(tree) {
        places_.resize(triangles.size());
        for (const std::uint32_t i : shuffled(triangles.size()))
            places_[i] = std::make_unique<Triangle>(triangles[i]);
        lists_.resize(tree.nodes.size());
        for (const std::uint32_t node : shuffled(tree.nodes.size()))
            if (tree.nodes[node].is_leaf())
                for (const std::uint32_t triangle : tree.own(node))
                    lists_[node].push_back(places_[triangle].get());
    }

    /// What the leaf names, as pairs of number and triangle.
    template <class Visit>
    void for_each(std::uint32_t leaf, const Visit& visit) const {
        const std::span<const std::uint32_t> names = tree_.own(leaf);
        for (std::size_t i = 0; i < names.size(); ++i) visit(names[i], *lists_[leaf][i]);
    }

  private:
    static std::vector<std::uint32_t> shuffled(std::size_t size) {
        std::vector<std::uint32_t> order(size);
        std::iota(order.begin(), order.end(), 0u);
        Pcg32 random(size);
        for (std::size_t i = size; i > 1; --i)
            std::swap(order[i - 1], order[random.below(std::uint32_t(i))]);
        return order;
    }

    const KdNodes<3>& tree_;
    std::vector<std::unique_ptr<Triangle>> places_;
    std::vector<std::vector<const Triangle*>> lists_;  ///< by node
};

/// All lists in one, and the triangles as the scene has them.
class OneList {
  public:
    OneList(const KdNodes<3>& tree, const std::vector<Triangle>& triangles)
        : tree_(tree), triangles_(triangles) {}
    template <class Visit>
    void for_each(std::uint32_t leaf, const Visit& visit) const {
        for (const std::uint32_t triangle : tree_.own(leaf)) visit(triangle, triangles_[triangle]);
    }

  private:
    const KdNodes<3>& tree_;
    const std::vector<Triangle>& triangles_;
};

/// A copy of the triangles for each leaf, in the order of the leaves.
class PlacedLists {
  public:
    PlacedLists(const KdNodes<3>& tree, const std::vector<Triangle>& triangles) : tree_(tree) {
        for (const std::uint32_t triangle : tree.references) copies_.push_back(triangles[triangle]);
    }
    template <class Visit>
    void for_each(std::uint32_t leaf, const Visit& visit) const {
        const auto [first, count] = tree_.own_range(leaf);
        for (std::uint32_t i = first; i < first + count; ++i)
            visit(tree_.references[i], copies_[i]);
    }

  private:
    const KdNodes<3>& tree_;
    std::vector<Triangle> copies_;
};

template <class Lists>
std::optional<Hit> nearest_in(const KdNodes<3>& tree, const Lists& lists, const Ray& ray) {
    NoCounts none;
    Mailbox mailbox(true);
    double limit = infinity;
    return nearest_found([&](const auto& found) {
        walk_cells(tree, ray, none, [&](std::uint32_t leaf) {
            lists.for_each(leaf, [&](std::uint32_t number, const Triangle& triangle) {
                if (mailbox.remembers(number)) return;
                if (auto hit = FilteredExact::intersect(ray, triangle)) {
                    hit->triangle = number;
                    limit = found(*hit);
                }
            });
            return limit;
        });
    });
}

/// Timed are so many times fewer rays.
constexpr std::size_t timed_share = 5;

}  // namespace

std::vector<ListPoint> measure_lists(const Options& options) {
    const Limits limit = limits(options);
    std::vector<ListPoint> points;
    Progress progress("lists", limit.list_sizes);
    std::size_t size = 1'000;
    for (std::size_t i = 0; i < limit.list_sizes; ++i, size *= 10) {
        const std::vector<Triangle> triangles =
            make_scene(fmt::format("soup:{}", size), options.seed).mesh.triangles();
        const KdNodes<3> tree = KdBuilder<3>::build(triangles);
        const PlacedLists placed(tree, triangles);
        const OneList listed(tree, triangles);
        const ScatteredLists scattered(tree, triangles);
        const std::vector<Ray> rays = rays_within(triangles, limit.rays, options.seed);
        ListPoint point{.triangles = triangles.size(),
                        .references = tree.references.size(),
                        .rays = rays.size()};
        for (const Ray& ray : rays) {
            const auto hit = nearest_in(tree, placed, ray);
            point.different += hit != nearest_in(tree, listed, ray);
            point.different += hit != nearest_in(tree, scattered, ray);
        }
        if (!options.small && limit.rounds > 0) {
            const auto trace = [&](const auto& lists) {
                return [&] {
                    for (std::size_t r = 0; r < rays.size(); r += timed_share)
                        do_not_optimize(nearest_in(tree, lists, rays[r]));
                };
            };
            const std::vector<std::function<void()>> runs{trace(placed), trace(listed),
                                                          trace(scattered)};
            const std::vector<double> ms = interleaved_medians(runs, limit.rounds);
            const double ns = 1e6 * timed_share / double(rays.size());
            point.placed_ns = ns * ms[0];
            point.listed_ns = ns * ms[1];
            point.scattered_ns = ns * ms[2];
        }
        points.push_back(point);
        progress.step();
    }
    return points;
}

}  // namespace space::ch05
