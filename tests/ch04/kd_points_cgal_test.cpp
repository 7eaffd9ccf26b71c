// Searches among points against CGAL's, 120,000 queries. CGAL counts in doubles; here these are
// exact: all coordinates of a set are multiples of one unit, and at most 2^24 of them apart.
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <CGAL/Fuzzy_iso_box.h>
#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_2.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>

#include <iterator>
#include <type_traits>
#include <utility>

namespace space {
namespace {

#ifdef BOOK_SANITIZED
constexpr int queries_of_a_set = 200;
#else
constexpr int queries_of_a_set = 1'500;
#endif
constexpr std::size_t points_of_a_set = 5'000;

/// CGAL's types for points that carry their index.
template <int D>
struct Cgal {
    using Kernel = CGAL::Simple_cartesian<double>;
    using Point = std::conditional_t<D == 2, Kernel::Point_2, Kernel::Point_3>;
    using Plain =
        std::conditional_t<D == 2, CGAL::Search_traits_2<Kernel>, CGAL::Search_traits_3<Kernel>>;
    using Indexed = std::pair<Point, std::uint32_t>;
    using Map = CGAL::First_of_pair_property_map<Indexed>;
    using Traits = CGAL::Search_traits_adapter<Indexed, Map, Plain>;
    using Nearest = CGAL::Orthogonal_k_neighbor_search<Traits>;
    using Tree = typename Nearest::Tree;

    static Point point(const space::Point<D>& p) {
        if constexpr (D == 2)
            return {p.x, p.y};
        else
            return {p.x, p.y, p.z};
    }
};

/// How the points of a set lie. Coordinates are whole multiples of 2^-20.
enum class Places { uniform, clustered, grid, duplicates, far_away };

float rounded(float x) {
    return std::round(x * 0x1p20f) * 0x1p-20f;
}
template <int D>
Point<D> drawn(Pcg32& random, Places places) {
    const BasicAabb<D> unit{Point<D>(0.0f), Point<D>(1.0f)};
    Point<D> p = random_point(random, unit);
    if (places == Places::clustered) {
        Pcg32 centres(random.below(20));
        p = 4.0f * random_point(centres, unit) + 0.01f * (p - 0.5f);
    }
    for (int axis = 0; axis < D; ++axis) {
        if (places == Places::grid) p[axis] = std::floor(16.0f * p[axis]);
        if (places == Places::duplicates) p[axis] = std::floor(4.0f * p[axis]) / 8.0f;
        if (places == Places::far_away) p[axis] += 1000.0f;
        p[axis] = rounded(p[axis]);
    }
    return p;
}

using Indices = std::vector<std::uint32_t>;
Indices sorted(Indices indices) {
    std::ranges::sort(indices);
    return indices;
}
Indices indices_of(std::span<const Neighbour> neighbours) {
    Indices indices;
    for (const Neighbour& neighbour : neighbours) indices.push_back(neighbour.index);
    return sorted(std::move(indices));
}

/// One set of points in both trees.
template <int D>
struct Both {
    using C = Cgal<D>;
    std::vector<Point<D>> points;
    KdPoints<D> ours;
    typename C::Tree cgal;

    Both(Pcg32& random, Places places) {
        for (std::size_t i = 0; i < points_of_a_set; ++i)
            points.push_back(drawn<D>(random, places));
        ours = KdPoints<D>::build(points);
        for (std::uint32_t i = 0; i < points.size(); ++i) cgal.insert({C::point(points[i]), i});
        cgal.build();
    }

    /// The same distances: which of equally far points CGAL takes is its own choice.
    void compare_nearest(const Point<D>& query, std::size_t k) const {
        const auto best = k_nearest<D>(ours, query, k);
        typename C::Nearest search(cgal, C::point(query), static_cast<unsigned>(k));
        REQUIRE(std::size_t(std::distance(search.begin(), search.end())) == best.size());
        std::size_t i = 0;
        for (const auto& [point, squared_distance] : search) {
            REQUIRE(squared_distance == best[i].squared_distance);
            if (i + 1 < best.size() && best[i].squared_distance == best[i + 1].squared_distance)
                REQUIRE(best[i].index < best[i + 1].index);
            ++i;
        }
    }
    /// CGAL's sphere is closed for some of its points and open for others (contains and
    /// contains_point_given_as_coordinates of Fuzzy_sphere.h, CGAL 5.5): those on its surface may
    /// be missing. Returns how many there are.
    std::size_t compare_radius(const Point<D>& query, float radius) const {
        std::vector<Neighbour> found;
        within_radius<D>(ours, query, radius, found);
        std::vector<typename C::Indexed> theirs;
        cgal.search(std::back_inserter(theirs),
                    CGAL::Fuzzy_sphere<typename C::Traits>(C::point(query), double(radius), 0.0));
        Indices within;
        for (const auto& [point, index] : theirs) within.push_back(index);
        const double square = double(radius) * double(radius);
        std::size_t on_surface = 0;
        for (const Neighbour& neighbour : found)
            if (neighbour.squared_distance == square &&
                std::ranges::find(within, neighbour.index) == within.end())
                within.push_back(neighbour.index), ++on_surface;
        REQUIRE(indices_of(found) == sorted(within));
        return on_surface;
    }
    std::size_t compare_box(const BasicAabb<D>& box) const {
        Indices found, theirs;
        within_box<D>(ours, box, found);
        std::vector<typename C::Indexed> inside;
        cgal.search(std::back_inserter(inside),
                    CGAL::Fuzzy_iso_box<typename C::Traits>(C::point(box.min), C::point(box.max)));
        for (const auto& [point, index] : inside) theirs.push_back(index);
        REQUIRE(found == sorted(theirs));
        return found.size();
    }
};

template <int D>
int compare_with_cgal() {
    int queries = 0;
    for (const Places places :
         {Places::uniform, Places::clustered, Places::grid, Places::duplicates, Places::far_away}) {
        Pcg32 random(100 * D + int(places));
        const Both<D> both(random, places);
        std::size_t in_boxes = 0;
        for (int i = 0; i < queries_of_a_set; ++i) {
            const Point<D> query = drawn<D>(random, places), other = drawn<D>(random, places);
            CAPTURE(int(places), i);
            const std::size_t k = 1 + random.below(20);
            both.compare_nearest(query, k);
            const float reach = places == Places::grid ? 1.0f + float(random.below(3)) : 0.125f;
            both.compare_radius(query, reach);
            BasicAabb<D> box;
            box.extend(query);
            box.extend(query + 0.25f * (other - query));
            in_boxes += both.compare_box(box);
            queries += 3;
        }
        CHECK(in_boxes > std::size_t(queries_of_a_set));
    }
    return queries;
}

}  // namespace

TEST_CASE("every search finds what CGAL's finds") {
    SECTION("in the plane") {
        CHECK(compare_with_cgal<2>() == 15 * queries_of_a_set);
    }
    SECTION("in space") {
        CHECK(compare_with_cgal<3>() == 15 * queries_of_a_set);
    }
}

}  // namespace space
