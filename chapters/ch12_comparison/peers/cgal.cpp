// CGAL's assertions would be timed.
#define CGAL_NDEBUG 1
// CGAL 6 calls these headers AABB_..._3.h and warns of their old names, the ones that both have.
#define CGAL_NO_DEPRECATION_WARNINGS 1
#include "chapters/ch12_comparison/peers/peers.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
#include <fmt/format.h>

#include <cmath>

namespace space::ch12 {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::iterator>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
using Tree = CGAL::AABB_tree<Traits>;

// CGAL 6 took std::variant for boost's.
template <class Meeting>
const Kernel::Point_3* point_in(const Meeting& meeting) {
#if CGAL_VERSION_MAJOR >= 6
    return std::get_if<Kernel::Point_3>(&meeting);
#else
    return boost::get<Kernel::Point_3>(&meeting);
#endif
}
template <class Meeting>
const Kernel::Segment_3& segment_in(const Meeting& meeting) {
#if CGAL_VERSION_MAJOR >= 6
    return std::get<Kernel::Segment_3>(meeting);
#else
    return boost::get<Kernel::Segment_3>(meeting);
#endif
}

Kernel::Point_3 point(const Double3& p) {
    return {p.x, p.y, p.z};
}

/// The triangles with an area (CGAL's contract), their places in the mesh, and the tree over them.
class CgalTree {
  public:
    explicit CgalTree(std::span<const Triangle> triangles)
        : triangles_(triangles.begin(), triangles.end()) {
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const auto& [a, b, c] = triangles[i];
            const Kernel::Triangle_3 solid(point(Double3(a)), point(Double3(b)), point(Double3(c)));
            if (solid.is_degenerate()) continue;
            solids_.push_back(solid);
            indices_.push_back(i);
        }
        tree_.insert(solids_.begin(), solids_.end());
        tree_.build();
    }
    CgalTree(const CgalTree&) = delete;  // the tree points at the triangles
    CgalTree& operator=(const CgalTree&) = delete;

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts&) const {
        if (!is_valid(ray) || !(ray.tmin < infinity) || tree_.empty()) return std::nullopt;
        const Double3 origin(ray.origin), d(ray.direction);
        const Double3 start = origin + std::max(double{ray.tmin}, -1e30) * d;
        const auto found =
            tree_.first_intersection(Kernel::Ray_3(point(start), Kernel::Vector_3(d.x, d.y, d.z)));
        if (!found) return std::nullopt;
        const auto* const at = point_in(found->first);
        const Kernel::Point_3 place = at ? *at : segment_in(found->first).source();
        const Double3 hit(place.x(), place.y(), place.z());
        const auto t = static_cast<float>(glm::dot(hit - origin, d) / glm::dot(d, d));
        if (!(t <= ray.tmax)) return std::nullopt;
        const std::uint32_t triangle =
            indices_[static_cast<std::size_t>(found->second - solids_.begin())];
        return with_weights(hit, triangle, t);
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts&) const {
        if (!is_valid(ray) || !(ray.tmin < infinity) || tree_.empty()) return false;
        const Double3 origin(ray.origin), d(ray.direction);
        const Double3 start = origin + std::max(double{ray.tmin}, -1e30) * d;
        if (ray.tmax < infinity)
            return tree_.do_intersect(
                Kernel::Segment_3(point(start), point(origin + double{ray.tmax} * d)));
        return tree_.do_intersect(Kernel::Ray_3(point(start), Kernel::Vector_3(d.x, d.y, d.z)));
    }
    /// Its nodes have two children and leaves none of their own. The library does not tell its
    /// size: a node is a box of six doubles and two pointers, and a primitive holds an iterator.
    TreeShape shape() const {
        const std::size_t count = solids_.size(), nodes = count > 1 ? count - 1 : 0;
        return {.references = count,
                .bytes = triangles_.capacity() * sizeof(Triangle) +
                         solids_.capacity() * sizeof(Kernel::Triangle_3) +
                         indices_.capacity() * sizeof(std::uint32_t) + count * sizeof(Primitive) +
                         nodes * sizeof(CGAL::AABB_node<Traits>)};
    }

  private:
    /// CGAL gives the point, and the book's hit has its weights.
    Hit with_weights(const Double3& place, std::uint32_t triangle, float t) const {
        const auto& [a, b, c] = triangles_[triangle];
        const Double3 e1 = Double3(b) - Double3(a), e2 = Double3(c) - Double3(a),
                      s = place - Double3(a), n = glm::cross(e1, e2);
        const double size = glm::dot(n, n);
        return {.t = t,
                .triangle = triangle,
                .u = static_cast<float>(glm::dot(glm::cross(s, e2), n) / size),
                .v = static_cast<float>(glm::dot(glm::cross(e1, s), n) / size)};
    }

    std::vector<Triangle> triangles_;
    std::vector<Kernel::Triangle_3> solids_;
    std::vector<std::uint32_t> indices_;
    Tree tree_;
};

BuiltStructure build(std::span<const Triangle> triangles, const BuildOptions&) {
    const auto tree = std::make_shared<const CgalTree>(triangles);
    return {.shape = [tree] { return tree->shape(); },
            .trace = [tree](const Batch& batch) { trace<NoCounts>(*tree, batch); },
            .configuration =
                fmt::format("CGAL {}, AABB_tree over Simple_cartesian<double>, first_intersection "
                            "and do_intersect, CGAL_NDEBUG",
                            CGAL_VERSION_STR)};
}

}  // namespace

Home cgal() {
    return {"CGAL " CGAL_VERSION_STR,
            {{.name = "cgal",
              .about = "a binary tree of boxes over doubles (AABB_tree)",
              .variants = {{"its own", "", build}}}},
            true};
}

}  // namespace space::ch12
