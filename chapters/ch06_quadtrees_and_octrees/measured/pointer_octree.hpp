/// @file
/// The octree whose nodes have pointers, as a structure of its own: what rays pay for the layout.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "chapters/ch04_kd_trees/placed_triangles.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/pointer_orthtree.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace space::ch06 {

/// The octree with a pointer to each child, as a structure that rays can be shot at.
class PointerOctree {
  public:
    explicit PointerOctree(std::span<const Triangle> triangles) {
        const auto nodes = OrthtreeBuilder<3>::build(triangles);
        nodes_ = std::make_unique<PointerOrthtree<3>>(nodes);
        placed_ = PlacedTriangles::of(triangles, nodes.references);
        references_ = nodes.references;
        shape_ = {.nodes = nodes.nodes.size(), .depth = nodes.depth};
        shape_.references = references_.size();
        shape_.bytes = sizeof *this + nodes_->bytes() + references_.size() * sizeof(std::uint32_t) +
                       placed_.bytes();
    }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        return nearest_found([&](const auto& found) { search(ray, counts, found); });
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return is_any_found([&](const auto& found) { search(ray, counts, found); });
    }
    TreeShape shape() const { return shape_; }

  private:
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        PlacedTests<FilteredExact, Counts, Found> tests{placed_, references_, ray,
                                                        counts,  found,       Mailbox(true)};
        const auto own = [&](const PointerNode<3>* node) {
            return tests.in(node->first, node->count);
        };
        walk_orthtree(*nodes_, OctreeConfig::Walk::parametric, ray, counts, own);
    }

    std::unique_ptr<PointerOrthtree<3>> nodes_;
    PlacedTriangles placed_;
    std::vector<std::uint32_t> references_;
    TreeShape shape_;
};

}  // namespace space::ch06
