/// @file
/// Geometry that is made where rays go (Johnston06, "making the geometry lazier"): patches whose
/// bounds are known, and whose triangles are not, until a ray comes into one.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "common/accelerator.hpp"
#include "common/limit_error.hpp"

#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace space {

// [source]
/// What LazyGeometry can hold: so many patches, each with a box that holds all its triangles, and
/// with the triangles themselves, the same ones whenever they are asked for. The triangles of all
/// patches are numbered; those of one patch follow each other from first_triangle(patch) on.
template <class S>
concept PatchSource = std::movable<S> && requires(const S& source, std::uint32_t patch) {
    { source.patches() } -> std::same_as<std::uint32_t>;
    { source.bounds(patch) } -> std::same_as<Aabb>;
    { source.triangles(patch) } -> std::same_as<std::vector<Triangle>>;
    { source.first_triangle(patch) } -> std::same_as<std::uint32_t>;
};
// [source]

/// A k-d tree over the patches' boxes. A patch is made, with a lazy tree over its triangles, when a
/// ray first meets its box; once, however many threads bring rays.
template <PatchSource Source, TriangleTest Test = FilteredExact>
class LazyGeometry {
  public:
    using Tree = LazyKdTree<Test>;
    using Config = typename Tree::Config;

    /// What has been made so far.
    struct Made {
        std::size_t patches = 0, triangles = 0;
        std::size_t nodes = 0;  ///< of the patches' trees
        std::size_t bytes = 0;  ///< of all that is held
    };

    /// @throws LimitError where triangles have numbers beyond 2^32
    static LazyGeometry build(Source source, const Config& config = {}) {
        LazyGeometry geometry(std::move(source), config);
        std::vector<Triangle> diagonals;  // what has the same bounding box
        for (const Aabb& box : geometry.boxes_) diagonals.push_back({box.min, box.max, box.max});
        geometry.cells_ =
            KdBuilder<3>::build(diagonals, {.straddlers = KdTreeConfig::Straddlers::duplicate,
                                            .costs = {.intersection = patch_cost}});
        return geometry;
    }
    const Source& source() const { return source_; }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        Ray rest = ray;
        double limit = infinity;
        return nearest_found([&](const auto& found) {
            for_each_patch(rest, counts, [&](std::uint32_t patch) {
                if (std::optional<Hit> hit = tree(patch).closest_hit(rest, counts)) {
                    rest.tmax = hit->t;  // closed: an equal hit of a smaller index still counts
                    hit->triangle += source_.first_triangle(patch);
                    limit = found(*hit);
                }
                return limit;
            });
        });
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return is_any_found([&](const auto& found) {
            for_each_patch(ray, counts, [&](std::uint32_t patch) {
                return tree(patch).any_hit(ray, counts) ? found(Hit{}) : double{infinity};
            });
        });
    }

    /// Not while other threads trace rays: the patches' trees are looked through.
    Made made() const {
        Made made{.bytes = sizeof *this + boxes_.size() * (sizeof(Aabb) + sizeof(Slot)) +
                           cells_.nodes.size() * sizeof(KdNode) +
                           cells_.references.size() * sizeof(std::uint32_t)};
        for (std::uint32_t patch = 0; patch < boxes_.size(); ++patch) {
            if (!is_made(patch)) continue;
            const TreeShape shape = slots_[patch].tree->shape();
            ++made.patches;
            made.triangles += slots_[patch].triangles;
            made.nodes += shape.nodes.value_or(0);
            made.bytes += shape.bytes;
        }
        return made;
    }
    bool is_made(std::uint32_t patch) const {
        return slots_[patch].made.load(std::memory_order_acquire);
    }

    TreeShape shape() const {
        const Made all = made();
        return {.nodes = all.nodes + cells_.nodes.size(),
                .references = all.triangles,
                .bytes = all.bytes};
    }

  private:
    /// A patch, or the place for it.
    struct Slot {
        std::once_flag once;
        std::atomic<bool> made = false;  ///< for those who only look
        std::unique_ptr<Tree> tree;
        std::size_t triangles = 0;
    };

    LazyGeometry(Source source, const Config& config)
        : source_(std::move(source)), config_(config) {
        for (std::uint32_t patch = 0; patch < source_.patches(); ++patch) {
            if (patch > 0 && source_.first_triangle(patch) < source_.first_triangle(patch - 1))
                throw LimitError("lazy geometry: more triangles than 32 bits can number");
            boxes_.push_back(source_.bounds(patch));
        }
        slots_ = std::make_unique<Slot[]>(boxes_.size());
    }

    // [for_each_patch]
    /// Calls visit(patch) for each patch whose box the ray meets, cell by cell; it returns the t
    /// beyond which nothing matters any more (NaN: nothing at all). A patch that only shares a cell
    /// with the ray is not asked for: it would be made. The visit may shorten the ray.
    template <class Counts, class Visit>
    void for_each_patch(const Ray& rest, Counts& counts, const Visit& visit) const {
        Mailbox mailbox(true);
        const KdRay<3> prepared(rest);
        double limit = infinity;
        walk_cells(cells_, Ray(rest), counts, [&](std::uint32_t cell) {
            for (const std::uint32_t patch : cells_.own(cell)) {
                if (std::isnan(limit)) break;
                if (part_in(boxes_[patch], prepared, RayPart::all_of(rest)) &&
                    !mailbox.remembers(patch))
                    limit = visit(patch);
            }
            return limit;
        });
    }
    // [for_each_patch]

    // [tree]
    /// The patch's tree. The first ray makes it; others that come meanwhile wait.
    const Tree& tree(std::uint32_t patch) const {
        Slot& slot = slots_[patch];
        std::call_once(slot.once, [&] {
            const std::vector<Triangle> triangles = source_.triangles(patch);
            slot.tree = std::make_unique<Tree>(Tree::build(triangles, config_));
            slot.triangles = triangles.size();
            slot.made.store(true, std::memory_order_release);
        });
        return *slot.tree;
    }
    // [tree]

    /// To make a patch costs far more than to cross a plane: one patch a cell, where it is
    /// possible.
    static constexpr double patch_cost = 1'000.0;

    Source source_;
    Config config_;
    std::vector<Aabb> boxes_;
    KdNodes<3> cells_;  ///< its leaves name patches
    std::unique_ptr<Slot[]> slots_;
};

}  // namespace space
