// The one file of chapter 3's tests that includes CGAL.
#include "tests/ch03/cgal_fragments.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <variant>

namespace space {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Exact2 = Kernel::Point_2;
using Exact3d = Kernel::Point_3;

Exact2 exact(const Double2& p) {
    return {p.x, p.y};
}
Exact3d exact(const Double3& p) {
    return {p.x, p.y, p.z};
}
Exact2 exact(const Point<2>& p) {
    return exact(Double2(p));
}
Exact3d exact(const Point<3>& p) {
    return exact(Double3(p));
}

Kernel::Plane_3 exact_plane(const Triangle& p) {
    return {exact(p[0]), exact(p[1]), exact(p[2])};
}
Kernel::Line_2 exact_line(const Segment& p) {
    return {exact(p[0]), exact(p[1])};
}
Kernel::Line_3 exact_edge(const Triangle& p, int edge) {
    return {exact(p[edge]), exact(p[(edge + 1) % 3])};
}

/// CGAL 6 gives an intersection as std::optional<std::variant<...>>, CGAL 5 as boost's two.
template <class Point, class Intersection>
std::optional<Point> single_point(const Intersection& intersection) {
    if (!intersection) return std::nullopt;
#if CGAL_VERSION_NR >= 1060000000
    const Point* point = std::get_if<Point>(&*intersection);
#else
    const Point* point = boost::get<Point>(&*intersection);
#endif
    return point ? std::optional(*point) : std::nullopt;
}

bool is_plane(const Triangle& p) {
    return !CGAL::collinear(exact(p[0]), exact(p[1]), exact(p[2]));
}

/// Nothing where the polygon and its carriers don't meet in one point.
std::optional<Exact3d> exact_meet(const Meet<3>& m) {
    auto [first, second] = m.carriers;
    const auto plane = [&](Carrier c) { return m.planes[c.number()].through; };
    if (first.is_original() && second.is_original()) {
        if (first == second) return std::nullopt;
        const bool in_order = (first.edge() + 1) % 3 == second.edge();
        return exact(m.polygon[in_order ? second.edge() : first.edge()]);
    }
    if (!first.is_original()) std::swap(first, second);
    if (!is_plane(plane(second))) return std::nullopt;
    if (first.is_original()) {
        if (m.polygon[first.edge()] == m.polygon[(first.edge() + 1) % 3]) return std::nullopt;
        return single_point<Exact3d>(
            CGAL::intersection(exact_edge(m.polygon, first.edge()), exact_plane(plane(second))));
    }
    if (!is_plane(plane(first)) || !is_plane(m.polygon)) return std::nullopt;
    return single_point<Exact3d>(CGAL::intersection(
        exact_plane(m.polygon), exact_plane(plane(first)), exact_plane(plane(second))));
}
std::optional<Exact2> exact_meet(const Meet<2>& m) {
    const Carrier end = m.carriers[0];
    if (end.is_original()) return exact(m.polygon[end.edge()]);
    const Segment& line = m.planes[end.number()].through;
    if (m.polygon.a == m.polygon.b || line.a == line.b) return std::nullopt;
    return single_point<Exact2>(CGAL::intersection(exact_line(m.polygon), exact_line(line)));
}

int side_of(const Triangle& plane, const Exact3d& p) {
    return CGAL::orientation(exact(plane[0]), exact(plane[1]), exact(plane[2]), p);
}
int side_of(const Segment& line, const Exact2& p) {
    return CGAL::orientation(exact(line[0]), exact(line[1]), p);
}

template <class Approx, class Point>
bool encloses(const Approx& approximation, const Point& p, int dimension) {
    for (int axis = 0; axis < dimension; ++axis) {
        const Number off = p.cartesian(axis) - Number(approximation.at[axis]);
        if (CGAL::abs(off) > Number(approximation.error)) return false;
    }
    return true;
}

double rounded(const Number& x) {
    x.exact();  // narrows the interval that to_double takes the middle of
    return CGAL::to_double(x);
}

/// The exact corner, or nothing where its carriers don't give one, or give one that its double is
/// too far from.
template <int D>
auto exact_corner(const FragmentsView<D>& view, const Fragment<D>& fragment, std::size_t i)
    -> std::optional<decltype(exact(Double<D>()))> {
    const auto& corner = fragment.corners[i];
    if (view.grade != Grade::exact) return exact(corner.at);
    const auto point =
        exact_meet(Meet<D>{view.polygons[fragment.polygon], corner.carriers, view.planes});
    if (!point || !encloses(corner, *point, D)) return std::nullopt;
    return point;
}

Kernel::Vector_3 normal_of(const Triangle& polygon) {
    return CGAL::cross_product(exact(polygon[1]) - exact(polygon[0]),
                               exact(polygon[2]) - exact(polygon[0]));
}

/// Of the polygon's normal: drawn onto the plane across it, the polygon keeps an area.
int dominant_axis(const Triangle& polygon) {
    const Kernel::Vector_3 normal = normal_of(polygon);
    int best = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (CGAL::abs(normal.cartesian(axis)) > CGAL::abs(normal.cartesian(best))) best = axis;
    return best;
}
/// Drops the axis; the polygon turns left.
class Projection {
  public:
    explicit Projection(const Triangle& polygon) : drop_(dominant_axis(polygon)) {
        mirrored_ = CGAL::orientation((*this)(exact(polygon[0])), (*this)(exact(polygon[1])),
                                      (*this)(exact(polygon[2]))) == CGAL::RIGHT_TURN;
    }
    Exact2 operator()(const Exact3d& p) const {
        const Exact2 result(p.cartesian((drop_ + 1) % 3), p.cartesian((drop_ + 2) % 3));
        return mirrored_ ? Exact2(result.y(), result.x()) : result;
    }

  private:
    int drop_;
    bool mirrored_ = false;
};

using Outline = std::vector<Exact2>;

/// Twice the area as seen along the normal, times the normal's length.
Number area_along(const Kernel::Vector_3& normal, const std::vector<Exact3d>& corners) {
    Number sum(0);
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += CGAL::cross_product(corners[i - 1] - corners[0], corners[i] - corners[0]) * normal;
    return sum;
}

bool turns_left(const Outline& outline) {
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i)
        if (CGAL::orientation(outline[i], outline[(i + 1) % count], outline[(i + 2) % count]) !=
            CGAL::LEFT_TURN)
            return false;
    return count >= 3;
}

/// All of the other lies to the right of, or on, one edge of the one: so it is for convex outlines
/// without a common inner point, for one edge of one of the two.
bool separated_by_edge_of(const Outline& one, const Outline& other) {
    for (std::size_t i = 0; i < one.size(); ++i) {
        const Exact2 &p = one[i], &q = one[(i + 1) % one.size()];
        if (p == q) continue;
        if (std::none_of(other.begin(), other.end(), [&](const Exact2& r) {
                return CGAL::orientation(p, q, r) == CGAL::LEFT_TURN;
            }))
            return true;
    }
    return false;
}

bool boxes_apart(const Outline& one, const Outline& other) {
    const auto apart = [&](int axis) {
        const auto less = [axis](const Exact2& p, const Exact2& q) {
            return p.cartesian(axis) < q.cartesian(axis);
        };
        const auto [low, high] = std::minmax_element(one.begin(), one.end(), less);
        const auto [other_low, other_high] = std::minmax_element(other.begin(), other.end(), less);
        return high->cartesian(axis) <= other_low->cartesian(axis) ||
               other_high->cartesian(axis) <= low->cartesian(axis);
    };
    return apart(0) || apart(1);
}

/// The planes above a node, and on which side of each it is.
struct Step {
    std::uint32_t plane;
    int side;
};
template <int D>
std::vector<std::vector<Step>> paths(const BspTree<D>& tree) {
    std::vector<std::vector<Step>> all(tree.nodes.size());
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        for (const auto& [child, side] :
             {std::pair{tree.nodes[i].front, 1}, {tree.nodes[i].back, -1}})
            if (child != BspTree<D>::none) {
                auto& path = all[child];
                path = all[i];
                path.push_back({tree.nodes[i].plane, side});
            }
    return all;
}

void add_area(TilingReport& report, const Number& sum, const Number& area) {
    const auto sign = CGAL::compare(sum, area);
    report.wrong_area += sign != CGAL::EQUAL;
    report.too_small += sign == CGAL::SMALLER;
    report.too_large += sign == CGAL::LARGER;
    if (sign != CGAL::EQUAL)
        report.worst_area = std::max(report.worst_area, rounded(CGAL::abs(sum - area) / area));
}

}  // namespace

int cgal_side(const Triangle& plane, const Double3& point) {
    return side_of(plane, exact(point));
}
int cgal_side(const Segment& line, const Double2& point) {
    return side_of(line, exact(point));
}
std::optional<int> cgal_side(const Triangle& plane, const Meet<3>& meet) {
    const auto point = exact_meet(meet);
    return point ? std::optional(side_of(plane, *point)) : std::nullopt;
}
std::optional<int> cgal_side(const Segment& line, const Meet<2>& meet) {
    const auto point = exact_meet(meet);
    return point ? std::optional(side_of(line, *point)) : std::nullopt;
}

bool cgal_encloses(const Approximation<3>& approximation, const Meet<3>& meet) {
    return encloses(approximation, *exact_meet(meet), 3);
}
bool cgal_encloses(const Approximation<2>& approximation, const Meet<2>& meet) {
    return encloses(approximation, *exact_meet(meet), 2);
}

bool cgal_has_on(const Triangle& triangle, const Point3& point) {
    return Kernel::Triangle_3(exact(triangle.a), exact(triangle.b), exact(triangle.c))
        .has_on(exact(point));
}

std::string TilingReport::text() const {
    return fmt::format(
        "{} polygons in {} fragments (at most {} of one): {} without a corner, {} off the plane, "
        "{} outside, {} not convex, "
        "{} overlaps, {} wrong sides, {} wrong areas ({} too small, {} too large, worst by {:.2g})",
        polygons, fragments, most, no_corner, off_plane, outside, not_convex, overlaps, wrong_side,
        wrong_area, too_small, too_large, worst_area);
}

TilingReport& TilingReport::operator+=(const TilingReport& other) {
    polygons += other.polygons;
    fragments += other.fragments;
    most = std::max(most, other.most);
    no_corner += other.no_corner;
    off_plane += other.off_plane;
    outside += other.outside;
    not_convex += other.not_convex;
    overlaps += other.overlaps;
    wrong_side += other.wrong_side;
    wrong_area += other.wrong_area;
    too_small += other.too_small;
    too_large += other.too_large;
    worst_area = std::max(worst_area, other.worst_area);
    return *this;
}

TilingReport examine_tiling(const BspTree<3>& tree, Grade grade, std::uint32_t every) {
    const FragmentsView<3> all = view(tree, grade);
    const auto path = paths(tree);
    std::vector<std::vector<std::pair<const Fragment<3>*, std::size_t>>> pieces(
        tree.polygons.size());  // with their nodes
    for (std::size_t node = 0; node < tree.nodes.size(); ++node)
        for (std::uint32_t i = 0; i < tree.nodes[node].count; ++i) {
            const Fragment<3>& fragment = tree.fragments[tree.nodes[node].first + i];
            pieces[fragment.polygon].emplace_back(&fragment, node);
        }

    TilingReport report;
    for (std::size_t number = 0; number < tree.polygons.size(); number += every) {
        const Triangle& polygon = tree.polygons[number];
        if (CGAL::collinear(exact(polygon[0]), exact(polygon[1]), exact(polygon[2]))) {
            report.wrong_area += !pieces[number].empty();
            continue;
        }
        ++report.polygons;
        report.fragments += pieces[number].size();
        report.most = std::max<std::uint64_t>(report.most, pieces[number].size());
        const Projection project(polygon);
        const Kernel::Vector_3 normal = normal_of(polygon);
        const Outline whole{project(exact(polygon[0])), project(exact(polygon[1])),
                            project(exact(polygon[2]))};
        std::vector<Outline> outlines;
        Number sum(0);
        for (const auto& [fragment, node] : pieces[number]) {
            Outline outline;
            std::vector<Exact3d> corners;
            for (std::size_t i = 0; i < fragment->corners.size(); ++i) {
                const auto corner = exact_corner(all, *fragment, i);
                if (!corner) {
                    ++report.no_corner;
                    continue;
                }
                report.off_plane += side_of(polygon, *corner) != 0;
                for (const Step& step : path[node])
                    report.wrong_side +=
                        side_of(tree.planes[step.plane].through, *corner) == -step.side;
                report.wrong_side +=
                    side_of(tree.planes[tree.nodes[node].plane].through, *corner) != 0;
                corners.push_back(*corner);
                outline.push_back(project(*corner));
                for (std::size_t e = 0; e < 3; ++e)
                    report.outside += CGAL::orientation(whole[e], whole[(e + 1) % 3],
                                                        outline.back()) == CGAL::RIGHT_TURN;
            }
            report.not_convex += !turns_left(outline);
            sum += area_along(normal, corners);
            for (const Outline& other : outlines)
                report.overlaps += !boxes_apart(outline, other) &&
                                   !separated_by_edge_of(outline, other) &&
                                   !separated_by_edge_of(other, outline);
            outlines.push_back(std::move(outline));
        }
        add_area(report, sum, normal.squared_length());
    }
    return report;
}

TilingReport examine_tiling(const BspTree<2>& tree, Grade grade) {
    const FragmentsView<2> all = view(tree, grade);
    const auto path = paths(tree);
    struct Piece {
        Number from, to;  ///< along the segment, times its squared length
    };
    std::vector<std::vector<Piece>> pieces(tree.polygons.size());
    TilingReport report;
    for (std::size_t node = 0; node < tree.nodes.size(); ++node)
        for (std::uint32_t f = 0; f < tree.nodes[node].count; ++f) {
            const Fragment<2>& fragment = tree.fragments[tree.nodes[node].first + f];
            const Segment& polygon = tree.polygons[fragment.polygon];
            const auto along = exact(polygon[1]) - exact(polygon[0]);
            ++report.fragments;
            std::vector<Number> ends;
            for (std::size_t i = 0; i < fragment.corners.size(); ++i) {
                const auto corner = exact_corner(all, fragment, i);
                if (!corner) {
                    ++report.no_corner;
                    continue;
                }
                report.off_plane += side_of(polygon, *corner) != 0;
                for (const Step& step : path[node])
                    report.wrong_side +=
                        side_of(tree.planes[step.plane].through, *corner) == -step.side;
                report.wrong_side +=
                    side_of(tree.planes[tree.nodes[node].plane].through, *corner) != 0;
                ends.push_back((*corner - exact(polygon[0])) * along);
            }
            if (ends.size() != 2 || !(ends[0] < ends[1])) {
                ++report.not_convex;
                continue;
            }
            report.outside += ends[0] < Number(0);
            report.outside += ends[1] > along.squared_length();
            pieces[fragment.polygon].push_back({ends[0], ends[1]});
        }
    for (std::size_t number = 0; number < tree.polygons.size(); ++number) {
        const Segment& polygon = tree.polygons[number];
        if (polygon[0] == polygon[1]) continue;
        ++report.polygons;
        auto& of = pieces[number];
        report.most = std::max<std::uint64_t>(report.most, of.size());
        std::sort(of.begin(), of.end(),
                  [](const Piece& a, const Piece& b) { return a.from < b.from; });
        Number sum(0);
        for (std::size_t i = 0; i < of.size(); ++i) {
            sum += of[i].to - of[i].from;
            report.overlaps += i > 0 && of[i].from < of[i - 1].to;
        }
        add_area(report, sum, (exact(polygon[1]) - exact(polygon[0])).squared_length());
    }
    return report;
}

std::vector<double> area_errors(const FragmentsView<3>& all) {
    std::vector<Kernel::Vector_3> normals;
    std::vector<Number> errors;
    for (const Triangle& polygon : all.polygons) {
        normals.push_back(normal_of(polygon));
        errors.push_back(-normals.back().squared_length());
    }
    for (const Fragment<3>& fragment : all.fragments) {
        std::vector<Exact3d> corners;
        for (std::size_t i = 0; i < fragment.corners.size(); ++i)
            corners.push_back(exact_corner(all, fragment, i).value());
        errors[fragment.polygon] += area_along(normals[fragment.polygon], corners);
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double length = std::sqrt(rounded(normals[i].squared_length()));
        result.push_back(length > 0.0 ? 0.5 * std::abs(rounded(errors[i])) / length : 0.0);
    }
    return result;
}

struct CgalFragments::Exact {
    std::map<std::pair<std::uint32_t, std::size_t>, Exact3d> corners;  // made when first asked for
};

CgalFragments::CgalFragments(const FragmentsView<3>& v)
    : view_(v), exact_(std::make_unique<Exact>()) {}
CgalFragments::CgalFragments(CgalFragments&&) noexcept = default;
CgalFragments::~CgalFragments() = default;

bool CgalFragments::meets(const Ray& ray, std::uint32_t fragment) const {
    const std::size_t count = view_.fragments[fragment].corners.size();
    bool left = false, right = false;
    for (std::size_t i = 0; i < count; ++i) {
        const int side = side_of_edge(ray, fragment, i, (i + 1) % count);
        left = left || side > 0;
        right = right || side < 0;
        if (left && right) return false;
    }
    return left || right;
}

int CgalFragments::side_of_edge(const Ray& ray, std::uint32_t fragment, std::size_t corner,
                                std::size_t next) const {
    // A term of the volume carries at most seven roundings; 1-norms bound the sums of the products'
    // sizes. A corner that is off by e in every coordinate moves it by at most 3 e times the other
    // factors; 2^-48 leaves room for the bound's own roundings.
    const auto &p = view_.fragments[fragment].corners[corner],
               &q = view_.fragments[fragment].corners[next];
    const auto size = [](const Double3& v) {
        return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    };
    const Double3 op = p.at - Double3(ray.origin), oq = q.at - Double3(ray.origin),
                  d(ray.direction);
    const double volume = glm::dot(glm::cross(op, oq), d);
    const double p_error = 4.0 * p.error, q_error = 4.0 * q.error;
    const double bound = size(d) * (0x1p-48 * size(op) * size(oq) + p_error * size(oq) +
                                    q_error * size(op) + p_error * q_error);
    if (volume > bound) return 1;
    if (volume < -bound) return -1;

    ++exact_decisions_;
    const auto point = [&](std::size_t i) {
        const auto [place, is_new] = exact_->corners.try_emplace({fragment, i});
        if (is_new) place->second = exact_corner(view_, view_.fragments[fragment], i).value();
        return place->second;
    };
    const Exact3d origin = exact(ray.origin);
    const Exact3d ahead =
        origin + Kernel::Vector_3(ray.direction.x, ray.direction.y, ray.direction.z);
    return CGAL::orientation(origin, ahead, point(corner), point(next));
}

}  // namespace space
