#include "chapters/ch03_bsp_trees/tiling.hpp"

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch03_bsp_trees/exact_point.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace space {
namespace {

using ExactPoint = std::array<mpq_class, 3>;

ExactPoint exact(const Double3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

ExactPoint exact_corner(const BspTree<3>& tree, Grade grade, const Fragment<3>& fragment,
                        const Fragment<3>::Corner& corner) {
    if (grade != Grade::exact) return exact(corner.at);
    return exact_point({tree.polygons[fragment.polygon], corner.carriers, tree.planes});
}

ExactPoint operator-(const ExactPoint& a, const ExactPoint& b) {
    return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
    return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
            mpq_class(a[0] * b[1] - a[1] * b[0])};
}
mpq_class dot(const ExactPoint& a, const ExactPoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Twice the area, as a vector along the normal.
ExactPoint doubled_area(const std::vector<ExactPoint>& corners) {
    ExactPoint sum{0, 0, 0};
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const ExactPoint part = cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
        for (int axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
    }
    return sum;
}

double worst_area_error(const BspTree<3>& tree, Grade grade) {
    std::vector<ExactPoint> normals;
    for (const Triangle& polygon : tree.polygons)
        normals.push_back(doubled_area(
            {exact(Double3(polygon[0])), exact(Double3(polygon[1])), exact(Double3(polygon[2]))}));
    std::vector<mpq_class> sums(tree.polygons.size());
    for (const Fragment<3>& fragment : tree.fragments) {
        std::vector<ExactPoint> corners;
        for (const auto& corner : fragment.corners)
            corners.push_back(exact_corner(tree, grade, fragment, corner));
        sums[fragment.polygon] += dot(doubled_area(corners), normals[fragment.polygon]);
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const mpq_class all = dot(normals[i], normals[i]);
        if (all == 0) continue;  // without area, and so without fragments
        worst = std::max(worst, std::abs(mpq_class((sums[i] - all) / all).get_d()));
    }
    return worst;
}

void count_cracks(const BspTree<3>& tree, Grade grade, Tiling& tiling) {
    struct Cut {
        std::uint32_t polygon;
        ExactPoint at;
    };
    std::map<std::pair<EdgeKey, std::uint32_t>, std::vector<Cut>> cuts;  // by edge and plane
    for (const Fragment<3>& fragment : tree.fragments)
        for (const auto& corner : fragment.corners) {
            auto [edge, plane] = corner.carriers;
            if (plane.is_original()) std::swap(edge, plane);
            if (!edge.is_original() || plane.is_original()) continue;
            auto& here = cuts[{edge_key(tree.polygons[fragment.polygon], edge.edge()), plane.id}];
            const auto same = [&](const Cut& cut) { return cut.polygon == fragment.polygon; };
            if (std::none_of(here.begin(), here.end(), same))
                here.push_back({fragment.polygon, exact_corner(tree, grade, fragment, corner)});
        }
    for (const auto& [where, of] : cuts)
        for (std::size_t i = 1; i < of.size(); ++i) {
            ++tiling.cuts;
            tiling.cracks += of[i].at != of[0].at;
        }
}

int sign(double value) {
    return (value > 0.0) - (value < 0.0);
}

}  // namespace

EdgeKey edge_key(const Triangle& polygon, int edge) {
    const Point3 &a = polygon[edge], &b = polygon[(edge + 1) % 3];
    return std::min(EdgeKey{a.x, a.y, a.z, b.x, b.y, b.z}, EdgeKey{b.x, b.y, b.z, a.x, a.y, a.z});
}

Tiling measure_tiling(const BspTree<3>& tree, Grade grade) {
    Tiling tiling{.area_error = worst_area_error(tree, grade)};
    count_cracks(tree, grade, tiling);
    return tiling;
}

FragmentRays::FragmentRays(const BspTree<3>& tree, Grade grade)
    : tree_(tree), grade_(grade), fragments_(tree.polygons.size()) {
    for (std::uint32_t i = 0; i < tree.fragments.size(); ++i)
        fragments_[tree.fragments[i].polygon].push_back(i);
}

bool FragmentRays::meets(const Ray& ray, std::uint32_t polygon) const {
    const auto& of_polygon = fragments_[polygon];
    return std::any_of(of_polygon.begin(), of_polygon.end(),
                       [&](std::uint32_t i) { return meets(ray, tree_.fragments[i]); });
}

bool FragmentRays::meets(const Ray& ray, const Fragment<3>& fragment) const {
    for (std::size_t i = 2; i < fragment.corners.size(); ++i) {
        const int a = side_of_edge(ray, fragment, 0, i - 1),
                  b = side_of_edge(ray, fragment, i - 1, i), c = side_of_edge(ray, fragment, i, 0);
        if (a == 0 && b == 0 && c == 0) continue;  // seen edge-on
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return true;
    }
    return false;
}

// [side_of_edge]
/// In double, a term carries at most six roundings and the errors of two corners: sum_roundings
/// times the product of the three lengths covers the former, and (|d| times an error of 3 e
/// in one-norm) times the other length the latter.
int FragmentRays::side_of_edge(const Ray& ray, const Fragment<3>& fragment, std::size_t p,
                               std::size_t q) const {
    const Double3 origin(ray.origin), direction(ray.direction);
    const Fragment<3>::Corner &to_p = fragment.corners[p], &to_q = fragment.corners[q];
    const Double3 op = to_p.at - origin, oq = to_q.at - origin;
    const auto length = [](const Double3& v) { return one_norm<3>(v); };
    const double volume = glm::dot(glm::cross(op, oq), direction);
    const double bound = length(direction) *
                         (sum_roundings * length(op) * length(oq) + 4.0 * to_p.error * length(oq) +
                          4.0 * to_q.error * length(op) + 16.0 * to_p.error * to_q.error);
    if (std::abs(volume) > bound) return sign(volume);

    const ExactPoint from = exact(origin);
    return sgn(dot(cross(exact_corner(tree_, grade_, fragment, to_p) - from,
                         exact_corner(tree_, grade_, fragment, to_q) - from),
                   exact(direction)));
}
// [side_of_edge]

SlippedRays FragmentRays::at_old_edges(std::uint64_t count, std::uint64_t seed) const {
    std::map<EdgeKey, std::vector<std::uint32_t>> edges;
    for (std::uint32_t i = 0; i < tree_.polygons.size(); ++i)
        for (int edge = 0; edge < 3; ++edge) edges[edge_key(tree_.polygons[i], edge)].push_back(i);
    std::vector<Target> targets;
    for (const auto& [edge, of] : edges)
        if (of.size() == 2)
            targets.push_back(
                {{edge[0], edge[1], edge[2]}, {edge[3], edge[4], edge[5]}, {of[0], of[1]}});
    return slipped(targets, count, seed);
}

SlippedRays FragmentRays::at_cuts(std::uint64_t count, std::uint64_t seed) const {
    std::vector<Target> targets;
    for (const Fragment<3>& fragment : tree_.fragments)
        for (std::size_t i = 0; i < fragment.corners.size(); ++i)
            if (!fragment.corners[i].carriers.back().is_original())
                targets.push_back({fragment.corners[i].at,
                                   fragment.corners[(i + 1) % fragment.corners.size()].at,
                                   {fragment.polygon, fragment.polygon}});
    return slipped(targets, count, seed);
}

SlippedRays FragmentRays::slipped(const std::vector<Target>& targets, std::uint64_t count,
                                  std::uint64_t seed) const {
    SlippedRays result;
    if (targets.empty()) return result;
    Aabb box;
    for (const Triangle& polygon : tree_.polygons) box.extend(bounds(polygon));
    const Point3 centre = box.centroid();
    const float radius = 1.5f * glm::length(box.max - centre);  // from outside, with room between

    Pcg32 random(seed);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Target& target = targets[random.below(static_cast<std::uint32_t>(targets.size()))];
        const double s = random.uniform_double();
        const Point3 aim(target.from + s * (target.to - target.from));
        const Point3 origin = centre + radius * Vector3(random_direction(random));
        const Ray ray{origin, aim - origin};
        const auto hits = [&](std::uint32_t polygon) {
            return FilteredExact::intersect(ray, tree_.polygons[polygon]).has_value();
        };
        const auto [a, b] = target.polygons;
        if (!hits(a) && !hits(b)) continue;
        ++result.rays;
        result.slipped += !meets(ray, a) && !meets(ray, b);
    }
    return result;
}

}  // namespace space
