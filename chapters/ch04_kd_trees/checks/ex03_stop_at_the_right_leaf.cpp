#include "ex03_stop_at_the_right_leaf.hpp"

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace space {

static std::ostream& operator<<(std::ostream& out, const PassedCell& cell) {
    out << "from " << cell.enter << " to " << cell.leave << ":";
    for (const std::uint32_t triangle : cell.triangles) out << " " << triangle;
    return out;
}

}  // namespace space

using namespace space;

namespace {

using Cells = std::vector<PassedCell>;
using Triangles = std::vector<std::uint32_t>;

/// The triangles that the ray hits, each with its t.
using Hits = std::map<std::uint32_t, float>;

std::string words(const Hits& hits) {
    std::string text;
    for (const auto& [triangle, t] : hits) text += fmt::format("{} at t = {}; ", triangle, t);
    return text;
}

HitTest test_for(const Hits& hits) {
    return [&hits](std::uint32_t triangle) -> std::optional<Hit> {
        const auto found = hits.find(triangle);
        if (found == hits.end()) return std::nullopt;
        return Hit{found->second, triangle};
    };
}

/// The answer, and the triangles that were tested for it, from the least to the greatest index.
struct Found {
    std::optional<Hit> nearest;
    Triangles tested;
};
Found search(const Cells& cells, const HitTest& test) {
    Found found;
    found.nearest = nearest_hit(cells, [&](std::uint32_t triangle) {
        found.tested.push_back(triangle);
        return test(triangle);
    });
    std::ranges::sort(found.tested);
    return found;
}
Found search(const Cells& cells, const Hits& hits) {
    return search(cells, test_for(hits));
}

/// Of the triangles in the first `count` cells.
std::set<std::uint32_t> named(const Cells& cells, std::size_t count) {
    std::set<std::uint32_t> triangles;
    for (std::size_t i = 0; i < count; ++i)
        triangles.insert(cells[i].triangles.begin(), cells[i].triangles.end());
    return triangles;
}
std::optional<Hit> nearest_of(const std::set<std::uint32_t>& triangles, const HitTest& test) {
    std::optional<Hit> nearest;
    for (const std::uint32_t triangle : triangles) {
        const std::optional<Hit> hit = test(triangle);
        if (hit && (!nearest || nearer(*hit, *nearest))) nearest = hit;
    }
    return nearest;
}
/// All triangles up to the last cell that begins no later than the nearest hit of those before it.
Triangles tested_at_best(const Cells& cells, const HitTest& test) {
    std::size_t opened = 0;
    while (opened < cells.size()) {
        const std::optional<Hit> nearest = nearest_of(named(cells, opened), test);
        if (nearest && double{nearest->t} < cells[opened].enter) break;
        ++opened;
    }
    const std::set<std::uint32_t> triangles = named(cells, opened);
    return {triangles.begin(), triangles.end()};
}

/// Random cells, some of them only touched, and triangles in neighbouring cells; a hit lies in one
/// of the cells that name the triangle.
struct Passage {
    Cells cells;
    Hits hits;

    explicit Passage(Pcg32& random) {
        double t = 0.0;
        for (std::uint32_t i = 0, count = 1 + random.below(8); i < count; ++i) {
            const double leave = t + random.below(4);
            cells.push_back({t, leave, {}});
            t = leave;
        }
        for (std::uint32_t triangle = 0, count = random.below(12); triangle < count; ++triangle) {
            const std::uint32_t first = random.below(std::uint32_t(cells.size()));
            const std::uint32_t last =
                first + random.below(std::min(4u, std::uint32_t(cells.size()) - first));
            for (std::uint32_t i = first; i <= last; ++i) {
                Triangles& list = cells[i].triangles;
                list.insert(list.begin() + random.below(std::uint32_t(list.size()) + 1), triangle);
            }
            if (random.below(3) == 0) continue;
            const double length = cells[last].leave - cells[first].enter;
            const double part = 0.5 * random.below(std::uint32_t(2.0 * length) + 1);
            hits[triangle] = float(cells[first].enter + part);
        }
    }
};

/// The leaves that a ray passes in a tree of the book, to the end of the tree.
Cells leaves_along(const Ray& ray, const KdNodes<3>& tree) {
    struct {
        RayPart part;
        void observe(const KdVisit& visit) { part = visit.part; }
    } last{};
    Cells cells;
    NoCounts none;
    const auto own = [&](std::uint32_t leaf) {
        const auto named = tree.own(leaf);
        cells.push_back({last.part.enter, last.part.leave, {named.begin(), named.end()}});
        return double{infinity};
    };
    walk_cells(tree, ray, none, own, last);
    return cells;
}

}  // namespace

TEST_CASE("where nothing is hit there is no hit") {
    CHECK(search({}, Hits{}).nearest == std::nullopt);
    CHECK(search({{0, 2, {0, 1}}, {2, 4, {}}, {4, 5, {1}}}, Hits{}).nearest == std::nullopt);
}

TEST_CASE("of the hits in a cell the nearest counts, wherever its triangle stands in the list") {
    const Hits hits{{0, 1.5f}, {1, 0.5f}, {2, 1.0f}};
    CHECK(search({{0, 2, {0, 1, 2}}}, hits).nearest == Hit{0.5f, 1});
    CHECK(search({{0, 2, {1, 2, 0}}}, hits).nearest == Hit{0.5f, 1});
    CHECK(search({{0, 2, {2, 0, 1}}}, hits).nearest == Hit{0.5f, 1});
}

TEST_CASE("a hit beyond the cell in hand does not hide a nearer one in the next cell") {
    const Cells cells{{0, 2, {0}}, {2, 4, {0, 1}}, {4, 6, {0}}};
    CHECK(search(cells, {{0, 5.0f}, {1, 3.0f}}).nearest == Hit{3.0f, 1});
}

TEST_CASE("a hit that was met in an earlier cell is not forgotten") {
    const Cells cells{{0, 2, {0}}, {2, 4, {0, 1}}, {4, 6, {0, 2}}};
    CHECK(search(cells, {{0, 5.0f}}).nearest == Hit{5.0f, 0});
    CHECK(search(cells, {{0, 5.0f}, {2, 5.5f}}).nearest == Hit{5.0f, 0});
    CHECK(search({{0, 2, {0}}, {2, 4, {}}, {4, 6, {0}}}, {{0, 5.0f}}).nearest == Hit{5.0f, 0});
}

TEST_CASE("of equal hits on a border the smaller index wins, in whichever cell it is named") {
    CHECK(search({{0, 2, {5}}, {2, 4, {3}}}, {{3, 2.0f}, {5, 2.0f}}).nearest == Hit{2.0f, 3});
    CHECK(search({{0, 2, {3}}, {2, 4, {5}}}, {{3, 2.0f}, {5, 2.0f}}).nearest == Hit{2.0f, 3});
    const Cells touched{{0, 2, {5}}, {2, 2, {4}}, {2, 4, {3}}};
    CHECK(search(touched, {{3, 2.0f}, {4, 2.0f}, {5, 2.0f}}).nearest == Hit{2.0f, 3});
}

TEST_CASE("the walk ends with the cell in which the best hit lies") {
    const Cells cells{{0, 2, {0}}, {2, 4, {1}}, {4, 6, {2}}, {6, 8, {3}}};
    CHECK(search(cells, {{0, 1.0f}}).tested == Triangles{0});
    CHECK(search(cells, {{1, 3.0f}, {2, 5.0f}}).tested == Triangles{0, 1});
    CHECK(search({{0, 2, {0}}, {2, 4, {}}, {4, 6, {7}}, {6, 8, {8}}}, {{0, 5.0f}}).tested ==
          Triangles{0, 7});
}

TEST_CASE("no triangle is tested twice, hit or not") {
    const Cells cells{{0, 2, {0, 9}}, {2, 4, {9, 0}}, {4, 6, {1, 9}}, {6, 8, {0, 1}}};
    CHECK(search(cells, Hits{}).tested == Triangles{0, 1, 9});
    CHECK(search(cells, {{0, 7.0f}}).tested == Triangles{0, 1, 9});
}

TEST_CASE("a ray knows nothing of the one before it") {
    const Cells cells{{0, 2, {0, 1}}, {2, 4, {0, 1}}};
    CHECK(search(cells, {{0, 1.0f}, {1, 3.0f}}).nearest == Hit{1.0f, 0});
    CHECK(search(cells, {{0, 3.5f}, {1, 3.0f}}).nearest == Hit{3.0f, 1});
    CHECK(search(cells, {{0, 1.0f}, {1, 3.0f}}).nearest == Hit{1.0f, 0});
}

TEST_CASE("random rays find the nearest hit, and test what it needs") {
    Pcg32 random(43);
    int ended_early = 0, met_early = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Passage passage(random);
        const Triangles needed = tested_at_best(passage.cells, test_for(passage.hits));
        const std::set<std::uint32_t> all = named(passage.cells, passage.cells.size());
        const std::optional<Hit> nearest = nearest_of(all, test_for(passage.hits));
        ended_early += needed.size() < all.size();
        met_early += nearest && nearest->t > passage.cells[0].leave &&
                     std::ranges::count(passage.cells[0].triangles, nearest->triangle) > 0;
        CAPTURE(passage.cells, words(passage.hits));
        const Found found = search(passage.cells, passage.hits);
        REQUIRE(found.nearest == nearest);
        REQUIRE(found.tested == needed);
    }
    CHECK(ended_early > 5'000);
    CHECK(met_early > 500);
}

TEST_CASE("in a tree of the book rays see what the naive loop sees, by no more tests") {
    Pcg32 random(44);
    std::vector<Triangle> triangles;
    std::set<std::uint32_t> all;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const Point3 corner = random_point(random, 0.0f, 8.0f);
        const Vector3 to_b = random_vector(random), to_c = random_vector(random);
        triangles.push_back({corner, corner + 3.0f * to_b, corner + 0.5f * to_c});
        all.insert(i);
    }
    const KdNodes<3> tree = KdBuilder<3>::build(triangles);
    std::size_t tested = 0, named_along = 0;
    for (int i = 0; i < 1'000; ++i) {
        const Point3 from = random_point(random, -4.0f, 12.0f),
                     to = random_point(random, 0.0f, 8.0f);
        const Ray ray{from, to - from};
        const HitTest test = [&](std::uint32_t triangle) {
            std::optional<Hit> hit = MollerTrumbore::intersect(ray, triangles[triangle]);
            if (hit) hit->triangle = triangle;
            return hit;
        };
        const Cells cells = leaves_along(ray, tree);
        const Found found = search(cells, test);
        CAPTURE(ray);
        REQUIRE(found.nearest == nearest_of(all, test));
        REQUIRE(found.tested == tested_at_best(cells, test));
        tested += found.tested.size();
        for (const PassedCell& cell : cells) named_along += cell.triangles.size();
    }
    CHECK(3 * tested < 2 * named_along);
}
