/// @file
/// nanoflann, the k-d tree that many programs use, behind what is measured of it. Without the
/// package libnanoflann-dev it is not `available`, and does nothing.
#pragma once

#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#if __has_include(<nanoflann.hpp>)
#include <nanoflann.hpp>
#define BOOK_HAS_NANOFLANN 1
#endif

namespace space::ch04 {

#ifdef BOOK_HAS_NANOFLANN

/// Its tree over points that stay where they are, with its default of ten points a leaf.
template <int D>
class NanoflannPoints {
  public:
    static constexpr bool available = true;

    explicit NanoflannPoints(std::span<const Point<D>> points)
        : cloud_{points},
          tree_(std::make_unique<Tree>(D, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams())) {
        tree_->buildIndex();
    }
    NanoflannPoints(const NanoflannPoints&) = delete;  // its tree refers to the cloud
    NanoflannPoints& operator=(const NanoflannPoints&) = delete;

    void nearest(const Point<D>& query, std::span<std::uint32_t> indices,
                 std::span<float> squared_distances) const {
        tree_->knnSearch(&query[0], indices.size(), indices.data(), squared_distances.data());
    }

  private:
    /// The functions that nanoflann asks its points by.
    struct Cloud {
        std::span<const Point<D>> points;

        std::size_t kdtree_get_point_count() const { return points.size(); }
        float kdtree_get_pt(std::size_t index, std::size_t axis) const {
            return points[index][static_cast<int>(axis)];
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud>;
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, D, std::uint32_t>;

    Cloud cloud_;
    std::unique_ptr<Tree> tree_;
};

#else

/// What stands here without the package.
template <int D>
class NanoflannPoints {
  public:
    static constexpr bool available = false;

    explicit NanoflannPoints(std::span<const Point<D>>) {}
    void nearest(const Point<D>&, std::span<std::uint32_t>, std::span<float>) const {}
};

#endif

}  // namespace space::ch04
