/// @file
/// What fragments are and what they cover, in CGAL's exact kernel: made from the input polygons and
/// planes alone, with none of the chapter's arithmetic. The judge of chapter 3.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace space {

/// 1 in front of the plane, 0 on it, -1 behind. The corners of the plane may lie on a line: then 0.
int cgal_side(const Triangle& plane, const Double3& point);
int cgal_side(const Segment& line, const Double2& point);
/// Nothing where the meet is no single point.
std::optional<int> cgal_side(const Triangle& plane, const Meet<3>& meet);
std::optional<int> cgal_side(const Segment& line, const Meet<2>& meet);

/// Every coordinate of the exact meet lies within the approximation's error. Asked of single points
/// only.
bool cgal_encloses(const Approximation<3>& approximation, const Meet<3>& meet);
bool cgal_encloses(const Approximation<2>& approximation, const Meet<2>& meet);

/// The point lies in the closed triangle.
bool cgal_has_on(const Triangle& triangle, const Point3& point);

/// Fragments with what they are made of. In the exact grade a corner is the meet of its carriers,
/// in the others it is its double coordinates as they stand.
template <int D>
struct FragmentsView {
    std::span<const Simplex<D>> polygons;
    std::span<const SplitPlane<D>> planes;
    std::span<const Fragment<D>> fragments;
    Grade grade;
};
template <int D>
FragmentsView<D> view(const BspTree<D>& tree, Grade grade) {
    return {tree.polygons, tree.planes, tree.fragments, grade};
}

/// How fragments tile their polygons, each fault counted; all zero for an exact tiling.
struct TilingReport {
    std::uint64_t polygons = 0;  ///< that have an extent
    std::uint64_t fragments = 0;
    std::uint64_t most = 0;       ///< fragments of one polygon
    std::uint64_t no_corner = 0;  ///< carriers that don't meet in one point, or a double corner
                                  ///< farther off than its error
    std::uint64_t off_plane = 0;  ///< corners not in the plane of their polygon
    std::uint64_t outside = 0;    ///< corners outside of their polygon
    std::uint64_t not_convex =
        0;  ///< fragments that don't turn left (as their polygon does) at every corner
    std::uint64_t overlaps =
        0;  ///< pairs of fragments of one polygon whose interiors no edge of theirs separates
    std::uint64_t wrong_side =
        0;  ///< corners on the wrong side of a plane of their path, or off the plane of their node
    std::uint64_t wrong_area =
        0;  ///< polygons whose fragments' areas don't add up to theirs, exactly
    std::uint64_t too_small = 0, too_large = 0;  ///< of these
    double worst_area = 0.0;                     ///< the largest |sum - area| / area

    /// Nothing wrong at all.
    bool is_exact() const {
        return no_corner + off_plane + outside + not_convex + overlaps + wrong_side + wrong_area ==
               0;
    }
    std::string text() const;
    TilingReport& operator+=(const TilingReport& other);
};
/// Of every `every`-th polygon.
TilingReport examine_tiling(const BspTree<3>& tree, Grade grade, std::uint32_t every = 1);
TilingReport examine_tiling(const BspTree<2>& tree, Grade grade);

/// |sum of the fragments' areas - area| of each polygon, computed exactly and rounded once; 0 is
/// exactly 0.
std::vector<double> area_errors(const FragmentsView<3>& view);

/// Rays against fragments, decided exactly.
class CgalFragments {
  public:
    explicit CgalFragments(const FragmentsView<3>& view);
    CgalFragments(CgalFragments&&) noexcept;
    ~CgalFragments();

    /// The ray's line meets the fragment, its border included. (p - o) x (q - o) . d has one sign
    /// for all its edges: in double, where the error bound allows, else exactly. A fragment whose
    /// corners are off its plane is judged as the ray sees it. Edge-on fragments are not met.
    bool meets(const Ray& ray, std::uint32_t fragment) const;
    /// How many sides of edges needed exact numbers so far.
    std::uint64_t exact_decisions() const { return exact_decisions_; }

  private:
    struct Exact;
    int side_of_edge(const Ray& ray, std::uint32_t fragment, std::size_t corner,
                     std::size_t next) const;

    FragmentsView<3> view_;
    mutable std::uint64_t exact_decisions_ = 0;
    std::unique_ptr<Exact> exact_;
};

}  // namespace space
