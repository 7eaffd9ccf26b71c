// The one file of chapter 3's tests that includes CGAL.
#include "tests/ch03/cgal_fragments.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace space {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Exact2 = Kernel::Point_2;
using Exact3d = Kernel::Point_3;

Exact2 exact(const DoublePoint<2>& p) {
    return {p.x, p.y};
}
Exact3d exact(const DoublePoint<3>& p) {
    return {p.x, p.y, p.z};
}
Exact2 exact(const Point<2>& p) {
    return exact(DoublePoint<2>(p));
}
Exact3d exact(const Point<3>& p) {
    return exact(DoublePoint<3>(p));
}

Kernel::Plane_3 exact_plane(const Corners<3>& p) {
    return {exact(p[0]), exact(p[1]), exact(p[2])};
}
Kernel::Line_2 exact_line(const Corners<2>& p) {
    return {exact(p[0]), exact(p[1])};
}
Kernel::Line_3 exact_edge(const Corners<3>& p, int edge) {
    return {exact(p[static_cast<std::size_t>(edge)]),
            exact(p[static_cast<std::size_t>((edge + 1) % 3)])};
}

template <class Point, class Intersection>
std::optional<Point> single_point(const Intersection& intersection) {
    if (!intersection) return std::nullopt;
    const Point* point = boost::get<Point>(&*intersection);
    return point ? std::optional(*point) : std::nullopt;
}

std::optional<Exact3d> exact_meet(const Meet3& m) {
    const Corners<3>& polygon = *m.polygon;
    const auto line_meets = [&](int edge, const Corners<3>& plane) -> std::optional<Exact3d> {
        if (CGAL::collinear(exact(plane[0]), exact(plane[1]), exact(plane[2]))) return std::nullopt;
        const auto e = static_cast<std::size_t>(edge);
        if (polygon[e] == polygon[(e + 1) % 3]) return std::nullopt;
        return single_point<Exact3d>(
            CGAL::intersection(exact_edge(polygon, edge), exact_plane(plane)));
    };
    if (m.first_edge >= 0 && m.second_edge >= 0) {
        if (m.first_edge == m.second_edge) return std::nullopt;
        const int after = (m.first_edge + 1) % 3 == m.second_edge ? m.second_edge : m.first_edge;
        return exact(polygon[static_cast<std::size_t>(after)]);
    }
    if (m.first_edge >= 0) return line_meets(m.first_edge, *m.second_plane);
    if (m.second_edge >= 0) return line_meets(m.second_edge, *m.first_plane);
    for (const Corners<3>* p : {m.polygon, m.first_plane, m.second_plane})
        if (CGAL::collinear(exact((*p)[0]), exact((*p)[1]), exact((*p)[2]))) return std::nullopt;
    return single_point<Exact3d>(CGAL::intersection(
        exact_plane(polygon), exact_plane(*m.first_plane), exact_plane(*m.second_plane)));
}
std::optional<Exact2> exact_meet(const Meet2& m) {
    const Corners<2>&polygon = *m.polygon, &line = *m.line;
    if (polygon[0] == polygon[1] || line[0] == line[1]) return std::nullopt;
    return single_point<Exact2>(CGAL::intersection(exact_line(polygon), exact_line(line)));
}

int side_of(const Corners<3>& plane, const Exact3d& p) {
    return CGAL::orientation(exact(plane[0]), exact(plane[1]), exact(plane[2]), p);
}
int side_of(const Corners<2>& line, const Exact2& p) {
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
std::optional<Exact3d> exact_corner(const FragmentsView<3>& view, const Fragment<3>& fragment,
                                    std::size_t i) {
    const Corner<3>& corner = fragment.corners[i];
    if (view.grade != Grade::exact) return exact(corner.at);
    const std::size_t count = fragment.corners.size();
    const Carrier before = fragment.corners[(i + count - 1) % count].carrier,
                  after = corner.carrier;
    const auto edge = [](Carrier c) { return c.is_original() ? c.edge() : -1; };
    const auto plane = [&](Carrier c) {
        return c.is_original() ? nullptr : &view.planes[c.number()].through;
    };
    const auto point = exact_meet(Meet3{&view.polygons[fragment.polygon], edge(before), edge(after),
                                        plane(before), plane(after)});
    if (!point || !encloses(corner, *point, 3)) return std::nullopt;
    return point;
}
std::optional<Exact2> exact_corner(const FragmentsView<2>& view, const Fragment<2>& fragment,
                                   std::size_t i) {
    const Corner<2>& corner = fragment.corners[i];
    if (view.grade != Grade::exact) return exact(corner.at);
    const Corners<2>& polygon = view.polygons[fragment.polygon];
    if (corner.carrier.is_original()) {
        const Exact2 point = exact(polygon[static_cast<std::size_t>(corner.carrier.edge())]);
        return encloses(corner, point, 2) ? std::optional(point) : std::nullopt;
    }
    const auto point = exact_meet(Meet2{&polygon, &view.planes[corner.carrier.number()].through});
    if (!point || !encloses(corner, *point, 2)) return std::nullopt;
    return point;
}

Kernel::Vector_3 normal_of(const Corners<3>& polygon) {
    return CGAL::cross_product(exact(polygon[1]) - exact(polygon[0]),
                               exact(polygon[2]) - exact(polygon[0]));
}

/// Of the polygon's normal: drawn onto the plane across it, the polygon keeps an area.
int dominant_axis(const Corners<3>& polygon) {
    const Kernel::Vector_3 normal = normal_of(polygon);
    int best = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (CGAL::abs(normal.cartesian(axis)) > CGAL::abs(normal.cartesian(best))) best = axis;
    return best;
}
/// Drops the axis; the polygon turns left.
class Projection {
  public:
    explicit Projection(const Corners<3>& polygon) : drop_(dominant_axis(polygon)) {
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
                auto& path = all[static_cast<std::size_t>(child)];
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

int cgal_side(const Corners<3>& plane, const DoublePoint<3>& point) {
    return side_of(plane, exact(point));
}
int cgal_side(const Corners<2>& line, const DoublePoint<2>& point) {
    return side_of(line, exact(point));
}
std::optional<int> cgal_side(const Corners<3>& plane, const Meet3& meet) {
    const auto point = exact_meet(meet);
    return point ? std::optional(side_of(plane, *point)) : std::nullopt;
}
std::optional<int> cgal_side(const Corners<2>& line, const Meet2& meet) {
    const auto point = exact_meet(meet);
    return point ? std::optional(side_of(line, *point)) : std::nullopt;
}

bool cgal_encloses(const Approximation<3>& approximation, const Meet3& meet) {
    return encloses(approximation, *exact_meet(meet), 3);
}
bool cgal_encloses(const Approximation<2>& approximation, const Meet2& meet) {
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
        const Corners<3>& polygon = tree.polygons[number];
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
            const Corners<2>& polygon = tree.polygons[fragment.polygon];
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
        const Corners<2>& polygon = tree.polygons[number];
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
    for (const Corners<3>& polygon : all.polygons) {
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
    const Corner<3>&p = view_.fragments[fragment].corners[corner],
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
