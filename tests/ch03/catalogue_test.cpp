// Where BSP trees fail: of each failure a test in which the plain method fails, by how much, and
// the cure holds.
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"
#include "tests/ch03/gallery.hpp"
#include "tests/ch03/tiling_scenes.hpp"

#include <fmt/format.h>

#include <numbers>

namespace space {
namespace {

constexpr int points = 200'000, rays = 200'000;
constexpr std::uint32_t sizes[] = {100, 200, 400};
constexpr std::uint32_t rows = 24;
constexpr Grade grades[] = {Grade::thick_float, Grade::ordered_float, Grade::ordered_double,
                            Grade::exact};

/// Every polygon cut by every plane, one after the other, without a tree; of the polygons only
/// every `every`-th.
std::vector<Fragment<3>> cut_by_all(const std::vector<Triangle>& polygons,
                                    const std::vector<SplitPlane<3>>& planes, Grade grade,
                                    double thickness, std::uint32_t every = 1) {
    const Cutter<3> cutter(polygons, planes, grade, thickness);
    std::vector<Fragment<3>> all;
    std::vector<int> sides;
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
        std::vector<Fragment<3>> pieces{whole_polygon<3>(polygons[i], i)};
        for (std::uint32_t plane = 0; plane < planes.size() && i % every == 0; ++plane) {
            std::vector<Fragment<3>> finer;
            for (Fragment<3>& piece : pieces) {
                cutter.corner_sides(piece, planes[plane], sides);
                if (Cutter<3>::classify(sides) != PlaneSide::straddling) {
                    finer.push_back(std::move(piece));
                    continue;
                }
                auto [front, back] = cutter.split(piece, sides, plane);
                for (Fragment<3>* half : {&front, &back})
                    if (grade == Grade::exact || Cutter<3>::has_extent(*half))
                        finer.push_back(std::move(*half));
            }
            pieces = std::move(finer);
        }
        all.insert(all.end(), std::make_move_iterator(pieces.begin()),
                   std::make_move_iterator(pieces.end()));
    }
    return all;
}

std::vector<SplitPlane<3>> random_planes(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<SplitPlane<3>> planes;
    for (int i = 0; i < count; ++i) {
        const Point3 a = random_point(random, -0.5f, 0.5f), b = random_point(random, -1, 1);
        planes.emplace_back(Triangle{a, b, random_point(random, -1, 1)});
    }
    return planes;
}

constexpr double float_thickness(double largest) {
    return 8.0 * 0x1p-24 * largest;
}

}  // namespace

TEST_CASE(
    "P1: near a plane the sign of its float equation is a coin toss; thick planes and exact signs "
    "are not wrong") {
    Pcg32 random(1);
    int plain_wrong = 0, thick_wrong = 0, thick_on = 0, exact_wrong = 0, far = 0, filtered = 0;
    for (int i = 0; i < points; ++i) {
        const Point3 a = random_point(random, -1, 1), b = random_point(random, -1, 1),
                     c = random_point(random, -1, 1);
        const std::vector<SplitPlane<3>> planes{SplitPlane<3>({a, b, c})};
        const float u = random.uniform(), v = random.uniform();
        const std::vector<Triangle> polygons{{a + u * (b - a) + v * (c - a), a, b}};
        const Fragment<3> fragment = whole_polygon<3>(polygons[0], 0);
        const auto side = [&](Grade grade, double thickness) {
            std::vector<int> sides;
            Cutter<3>(polygons, planes, grade, thickness).corner_sides(fragment, planes[0], sides);
            return sides[0];
        };
        const int expected = cgal_side(planes[0].through, fragment.corners[0].at),
                  thick = side(Grade::ordered_float, float_thickness(2.0));
        const bool plain = side(Grade::thick_float, 0.0) == expected;
        plain_wrong += !plain;
        far += !plain &&
               std::abs(planes[0].distance(fragment.corners[0].at)) / planes[0].length > 1e-6;
        thick_wrong += thick != 0 && thick != expected;
        thick_on += thick == 0;
        exact_wrong += side(Grade::exact, 0.0) != expected;
        filtered += side_filter(planes[0], fragment.corners[0].at, 0.0).has_value();
    }
    const auto percent = [](int count) { return 100.0 * count / points; };
    fmt::print(
        "  P1: of {} points on planes rounded to float the plain sign is wrong for {:.1f} % ({} "
        "farther off than 1e-6); "
        "a thick plane has {:.1f} % on it and {} wrong; exact: {} wrong, {:.1f} % by the filter\n",
        with_commas(points), percent(plain_wrong), far, percent(thick_on), thick_wrong, exact_wrong,
        percent(filtered));
    CHECK(plain_wrong > points / 3);
    CHECK(far < points / 1000);
    CHECK(thick_wrong == 0);
    CHECK(thick_on > points / 2);
    CHECK(exact_wrong == 0);
}

TEST_CASE(
    "P2: a plane without thickness cuts by noise, thick planes are not transitive; exact planes "
    "need no thickness") {
    const double eps = 0x1p-20;
    const std::vector<SplitPlane<3>> ground{SplitPlane<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})};
    // Corners at +eps/2 and -2 eps: noise of the plane says across, and a piece of next to nothing
    // comes off.
    const std::vector<Triangle> noisy{{{0, 0, 0x1p-21f}, {1, 0, -0x1p-19f}, {0, 1, -0x1p-19f}}};
    const auto place = [&](double thickness) {
        std::vector<int> sides;
        Cutter<3>(noisy, ground, Grade::ordered_float, thickness)
            .corner_sides(whole_polygon<3>(noisy[0], 0), ground[0], sides);
        return Cutter<3>::classify(sides);
    };
    CHECK(place(0.0) == PlaneSide::straddling);
    CHECK(place(eps) == PlaneSide::back);

    // Three planes 3/4 of a thickness apart: each is on the next, the first is not on the last.
    // Which comes first decides.
    const auto level = [](float z) { return Triangle{{0, 0, z}, {1, 0, z}, {0, 1, z}}; };
    const std::vector<Triangle> three{level(1.0f), level(1.0f + 3 * 0x1p-23f),
                                      level(1.0f + 6 * 0x1p-23f)};
    const auto nodes = [&](Grade grade, std::uint32_t first) {
        const std::uint32_t order[] = {first};
        return BspBuilder<3>::build(three, {.grade = grade, .order = order}).nodes.size();
    };
    CHECK(nodes(Grade::thick_float, 1) == 1);  // 8 roundings are 4 x 2^-23
    CHECK(nodes(Grade::thick_float, 0) == 2);
    for (const std::uint32_t first : {0u, 1u, 2u}) CHECK(nodes(Grade::exact, first) == 3);

    // Slivers are geometric, not only noise: they stay in exact arithmetic.
    const std::vector<Triangle> triangle{{{0, 0, 0}, {10, 1, 0}, {1, 10, 0}}};
    std::vector<SplitPlane<3>> planes;
    Pcg32 random(3);
    for (int i = 0; i < 14; ++i) {
        const Aabb flat{{1, 1, 0}, {5, 5, 0}};
        const Point3 a = random_point(random, flat), b = random_point(random, flat);
        planes.emplace_back(Triangle{a, b, a + Vector3(0, 0, 1)});
    }
    for (const Grade grade : {Grade::ordered_float, Grade::exact}) {
        const auto fragments = cut_by_all(triangle, planes, grade, float_thickness(10.0));
        double smallest = infinity;
        for (const Fragment<3>& f : fragments) {
            Double3 sum(0.0);
            for (std::size_t i = 2; i < f.corners.size(); ++i)
                sum += glm::cross(f.corners[i - 1].at - f.corners[0].at,
                                  f.corners[i].at - f.corners[0].at);
            smallest = std::min(smallest, 0.5 * glm::length(sum));
        }
        fmt::print(
            "  P2: {} fragments of 14 cuts of a triangle of area 49.5, {}: the smallest has "
            "{:.2g}\n",
            fragments.size(), name(grade), smallest);
        CHECK(fragments.size() > 50);
        CHECK(smallest < 1e-2);
        CHECK(smallest > 0.0);
    }
}

TEST_CASE(
    "P3: neighbours that cut their edge in opposite directions get different points, and rays "
    "leak; in canonical order not") {
    // One edge and many planes: how often do its two polygons get two points?
    Pcg32 random(4);
    int differ[4] = {};
    for (int i = 0; i < points / 10; ++i) {
        const Point3 p = random_point(random, -1, 1), q = random_point(random, -1, 1);
        const std::vector<Triangle> pair{{p, q, random_point(random, -1, 1)},
                                         {q, p, random_point(random, -1, 1)}};
        const std::vector<SplitPlane<3>> planes = random_planes(1, random.next());
        for (std::size_t g = 0; g < 4; ++g) {
            const Cutter<3> cutter(pair, planes, grades[g], 0.0);
            std::optional<Double3> cut[2];
            for (std::uint32_t k = 0; k < 2; ++k) {
                const Fragment<3> fragment = whole_polygon<3>(pair[k], k);
                std::vector<int> sides;
                cutter.corner_sides(fragment, planes[0], sides);
                if (sides[0] * sides[1] >= 0) continue;
                const auto [front, back] = cutter.split(fragment, sides, 0);
                for (const Fragment<3>* half :
                     {&front, &back})  // the corner that edge 0 ends at, or begins with
                    for (std::size_t c = 0; c < half->corners.size(); ++c)
                        if (half->corners[c].carriers.back() == Carrier::original(0) &&
                            half->corners[c].at != Double3(pair[k][0]))
                            cut[k] = half->corners[c].at;
            }
            differ[g] += cut[0] && cut[1] && *cut[0] != *cut[1];
        }
    }
    fmt::print(
        "  P3: of {} pairs of neighbours, two points: {} thick float, {} ordered float, {} ordered "
        "double, {} exact\n",
        points / 10, differ[0], differ[1], differ[2], differ[3]);
    CHECK(differ[0] > points / 100);
    CHECK(differ[1] == 0);
    CHECK(differ[2] == 0);
    CHECK(differ[3] == 0);

    const std::vector<Triangle> sphere = icosphere(8).triangles();
    const auto polygons = sphere;
    const auto planes = random_planes(16, 5);
    for (const Grade grade : grades) {
        const auto fragments = cut_by_all(polygons, planes, grade, 0.0);
        const Gallery gallery({polygons, planes, fragments, grade}, polygons.size());
        const Leaks old = gallery.at_old_edges(rays, 6), cuts = gallery.at_cuts(rays, 7);
        fmt::print(
            "  P3: sphere cut by 16 planes, {}: {} of {} rays leak at old edges, {} of {} at "
            "cuts\n",
            name(grade), old.through, with_commas(old.hits), cuts.through, with_commas(cuts.hits));
        CHECK((old.through > 0) == (grade == Grade::thick_float));
        if (grade != Grade::thick_float) CHECK(cuts.through == 0);
        if (grade == Grade::exact) CHECK(old.unmet + cuts.unmet + old.leaks + cuts.leaks == 0);
    }
}

TEST_CASE(
    "P4: where only one of two neighbours is cut, rays leak through the T-junction; the original "
    "triangles and exact corners close it") {
    const std::vector<Triangle> sphere = icosphere(8).triangles();
    const auto polygons = sphere;
    const auto planes = random_planes(16, 8);
    const auto bsp = Bsp<FilteredExact>::build(sphere);
    for (const Grade grade : grades) {
        const auto fragments = cut_by_all(polygons, planes, grade, 0.0, 2);
        const Leaks leaks =
            Gallery({polygons, planes, fragments, grade}, polygons.size()).at_old_edges(rays, 9);
        std::uint64_t caught = 0;
        for (const Ray& ray : leaks.leaking) caught += any_hit(bsp, ray);
        fmt::print(
            "  P4: every second triangle cut, {}: {} of {} rays leak; the original triangles catch "
            "{} of {}\n",
            name(grade), leaks.through, with_commas(leaks.hits), caught, leaks.leaking.size());
        CHECK(caught == leaks.leaking.size());
        if (grade == Grade::thick_float || grade == Grade::ordered_float) CHECK(leaks.through > 0);
        if (grade == Grade::exact) CHECK(leaks.leaks + leaks.unmet == 0);
    }
}

TEST_CASE("P5: cuts of cuts drift off the plane and lose area; exact corners don't") {
    const std::vector<Triangle> triangle{{{0, 0, 0.3f}, {10, 1, 1.7f}, {1, 10, -2.1f}}};
    std::vector<SplitPlane<3>> planes;
    Pcg32 random(10);
    const auto place = [&] { return random_point(random, Aabb{{1, 1, -1}, {5, 5, 1}}); };
    for (int i = 0; i < 14; ++i) {
        const Point3 a = place(), b = place();
        planes.emplace_back(Triangle{a, b, place()});
    }
    for (const Grade grade : grades) {
        const auto fragments = cut_by_all(triangle, planes, grade, 0.0);
        const double error = area_errors({triangle, planes, fragments, grade})[0];
        int off = 0, corners_seen = 0;
        for (const Fragment<3>& f : fragments)
            for (const auto& c : f.corners) {
                off += cgal_side(triangle[0], c.at) != 0;
                ++corners_seen;
            }
        fmt::print(
            "  P5: 14 cuts, {}: {} fragments, area off by {:.2g}; {} of {} rounded corners off the "
            "plane\n",
            name(grade), fragments.size(), error, off, corners_seen);
        CHECK(fragments.size() > 30);
        CHECK(off > 0);  // in the exact grade, too: but it is not its doubles that decide
        CHECK((error == 0.0) == (grade == Grade::exact));
        if (grade == Grade::ordered_double) CHECK(error < 1e-12);
        if (grade == Grade::ordered_float) CHECK(error > 1e-9);
    }
}

TEST_CASE(
    "P6: without a place for coplanar polygons they are lost or never end; in the node they are "
    "kept") {
    const Triangle one{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        overlapping{{0.2f, 0.2f, 0}, {2, 0, 0}, {0, 2, 0}};
    const std::vector<Triangle> same{one, one}, overlap{one, overlapping};
    for (const auto& polygons : {same, overlap}) {
        const std::vector<SplitPlane<3>> planes{SplitPlane<3>(one)};
        std::vector<int> sides;
        int strictly = 0, loosely = 0;
        for (std::uint32_t i = 0; i < polygons.size(); ++i) {
            Cutter<3>(polygons, planes, Grade::exact, 0.0)
                .corner_sides(whole_polygon<3>(polygons[i], i), planes[0], sides);
            strictly += Cutter<3>::classify(sides) == PlaneSide::front ||
                        Cutter<3>::classify(sides) == PlaneSide::back;
            loosely += std::all_of(sides.begin(), sides.end(), [](int side) { return side <= 0; });
        }
        CHECK(strictly == 0);  // "in front or behind": both are lost
        CHECK(loosely == 2);   // "not in front": both are behind, and so again at every level
        for (const Grade grade : grades) {
            const BspTree<3> tree = BspBuilder<3>::build(polygons, {.grade = grade});
            CHECK(tree.nodes.size() == 1);
            CHECK(tree.fragments.size() == 2);
        }
    }
}

TEST_CASE("P7: fragments grow faster than n; more candidates cut less; the bound stops in time") {
    std::array<double, 2> before{};
    for (const std::uint32_t n : sizes) {
        const auto polygons = scenes::soup(n, 1.0f, 11);
        const auto growth = [&](BspConfig::SplitterChoice choice, std::uint32_t candidates) {
            const BspTree<3> tree =
                BspBuilder<3>::build(polygons, {.splitter = choice, .candidates = candidates});
            return static_cast<double>(tree.fragments.size()) / n;
        };
        const double first = growth(BspConfig::SplitterChoice::first, 1),
                     best = growth(BspConfig::SplitterChoice::fewest_splits, 8),
                     weighted = growth(BspConfig::SplitterChoice::weighted, 8);
        fmt::print(
            "  P7: {} large triangles: {:.0f} fragments of each with the first cutter, {:.0f} "
            "with the one of 8 that cuts fewest, "
            "{:.0f} with the weighted one\n",
            n, first, best, weighted);
        CHECK(first > 1.7 * before[0]);  // n times as many polygons: more than n times as many
                                         // fragments of each
        CHECK(best > 1.5 * before[1]);
        CHECK(best < first);
        CHECK(weighted < first);
        before = {first, best};
        CHECK_THROWS_AS(BspBuilder<3>::build(polygons, {.max_fragments = std::size_t{5} * n}),
                        LimitError);
    }
}

TEST_CASE(
    "P8: a convex body makes a chain whatever polygon is chosen; planes that are no polygons break "
    "it") {
    std::vector<glm::dvec2> profile;
    for (std::uint32_t i = 0; i <= rows; ++i) {
        const double angle = std::numbers::pi * i / rows;
        profile.emplace_back(i == 0 || i == rows ? 0.0 : std::sin(angle), -std::cos(angle));
    }
    const auto polygons = lathe(profile, 24).triangles();
    const auto build = [&](BspConfig::SplitterChoice choice) {
        return BspBuilder<3>::build(polygons, {.splitter = choice});
    };
    const std::size_t faces = polygons.size();
    CHECK(faces == 2 * 24 * (rows - 1));
    for (const BspConfig::SplitterChoice choice :
         {BspConfig::SplitterChoice::first, BspConfig::SplitterChoice::random,
          BspConfig::SplitterChoice::balanced, BspConfig::SplitterChoice::weighted}) {
        const BspTree<3> tree = build(choice);
        fmt::print("  P8: sphere of {} faces, choice {}: depth {}, {} fragments\n", faces,
                   static_cast<int>(choice), tree.depth(), tree.fragments.size());
        CHECK(tree.depth() > faces / 3);
        CHECK(tree.fragments.size() < 3 * faces);
    }
    const BspTree<3> free = build(BspConfig::SplitterChoice::free);
    fmt::print("  P8: sphere of {} faces, free planes: depth {}, {} fragments\n", faces,
               free.depth(), free.fragments.size());
    CHECK(free.depth() < 40);
    CHECK(free.fragments.size() < 3 * faces);
    CHECK(examine_tiling(free, Grade::exact).is_exact());
}

}  // namespace space
