#include "ex04_nearest_neighbour.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <utility>
#include <vector>

using namespace space;

namespace {

/// Random points with small whole coordinates, halved by lines across x and y in turn.
struct Plane {
    std::vector<Point2> points;
    std::vector<PointNode> nodes;
    int root = 0;

    Plane(Pcg32& random, int count, std::uint32_t width) {
        const auto whole = [&] { return static_cast<float>(random.below(width)); };
        std::vector<int> all;
        for (int i = 0; i < count; ++i) {
            const float x = whole(), y = whole();
            points.emplace_back(x, y);
            all.push_back(i);
        }
        root = grow(all, 0);
    }

    int grow(std::span<int> part, int axis) {
        if (part.size() == 1) return ~part[0];
        const auto at = [&](int p) { return points[static_cast<std::size_t>(p)][axis]; };
        std::ranges::sort(part,
                          [&](int a, int b) { return std::pair(at(a), a) < std::pair(at(b), b); });
        const std::size_t half = part.size() / 2;
        const double line = at(part[half]);
        const std::size_t index = nodes.size();
        nodes.emplace_back();
        const int below = grow(part.first(half), 1 - axis),
                  above = grow(part.subspan(half), 1 - axis);
        nodes[index] = {axis, line, below, above};
        return static_cast<int>(index);
    }

    double distance(int p, const Point2& query) const {
        const Double2 away = Double2(points[static_cast<std::size_t>(p)]) - Double2(query);
        return glm::dot(away, away);
    }
    int nearest(const Point2& query) const {
        int best = 0;
        for (int p = 1; p < int(points.size()); ++p)
            if (distance(p, query) < distance(best, query)) best = p;
        return best;
    }
    /// The points that are asked for by a search that goes down on the query's side, and to the
    /// other one where the least of the distances so far allows it: with a stack and no recursion.
    std::set<int> asked_at_most(const Point2& query) const {
        struct Task {
            int child;
            double gap;  // squared, to the line beyond which the child lies
        };
        std::set<int> asked;
        double least = infinity;
        std::vector<Task> tasks{{root, 0.0}};
        while (!tasks.empty()) {
            const auto [child, gap] = tasks.back();
            tasks.pop_back();
            if (gap > least) continue;
            if (child < 0) {
                asked.insert(~child);
                least = std::min(least, distance(~child, query));
                continue;
            }
            const PointNode& node = nodes[static_cast<std::size_t>(child)];
            const double to_line = static_cast<double>(query[node.axis]) - node.at;
            const bool below = to_line <= 0.0;
            tasks.push_back({below ? node.above : node.below, to_line * to_line});
            tasks.push_back({below ? node.below : node.above, 0.0});
        }
        return asked;
    }
};

/// The answer, and the points that were asked for.
struct Found {
    int best;
    std::set<int> asked;
};
Found search(const Plane& plane, const Point2& query) {
    Found found{};
    found.best = nearest_point(plane.nodes, plane.root, query, [&](int p) {
        REQUIRE((p >= 0 && p < int(plane.points.size())));
        found.asked.insert(p);
        return plane.distance(p, query);
    });
    return found;
}
/// A query with whole coordinates, in the points' square or around it.
Point2 some_query(Pcg32& random, std::uint32_t width) {
    const float x = static_cast<float>(random.below(width + 8)) - 4.0f;
    const float y = static_cast<float>(random.below(width + 8)) - 4.0f;
    return {x, y};
}

}  // namespace

TEST_CASE("of two points the nearer one is found") {
    const std::vector<PointNode> nodes{{0, 4.0, ~0, ~1}};  // at x = 1 and x = 7
    const auto distance = [](double x) {
        return [x](int p) { return p == 0 ? (x - 1) * (x - 1) : (x - 7) * (x - 7); };
    };
    CHECK(nearest_point(nodes, 0, {0, 0}, distance(0)) == 0);
    CHECK(nearest_point(nodes, 0, {9, 0}, distance(9)) == 1);
    CHECK(nearest_point(nodes, 0, {3, 0}, distance(3)) == 0);
}

TEST_CASE("a tree of a single point finds it") {
    CHECK(nearest_point({}, ~0, {3, 3}, [](int) { return 5.0; }) == 0);
}

TEST_CASE("the nearest may lie on the other side of a line") {
    Pcg32 random(41);
    for (int i = 0; i < 5'000; ++i) {
        const Plane plane(random, 2 + int(random.below(30)), 1000);
        const Point2 query = some_query(random, 1000);
        CAPTURE(i, plane.points.size(), query);
        REQUIRE(plane.distance(search(plane, query).best, query) ==
                plane.distance(plane.nearest(query), query));
    }
}

TEST_CASE("of equally near points the lower index wins, on whichever side it lies") {
    Pcg32 random(42);
    for (int i = 0; i < 5'000; ++i) {
        const Plane plane(random, 2 + int(random.below(30)), 6);
        const Point2 query = some_query(random, 6);
        CAPTURE(i, plane.points.size(), query);
        REQUIRE(search(plane, query).best == plane.nearest(query));
    }
}

TEST_CASE("sides that are too far away are left out") {
    Pcg32 random(43);
    for (int i = 0; i < 300; ++i) {
        const Plane plane(random, 500, 10'000);
        const Point2 query = some_query(random, 10'000) + 0.5f;  // in no line
        const std::size_t asked = search(plane, query).asked.size(),
                          enough = plane.asked_at_most(query).size();
        CAPTURE(i, query);
        if (asked > enough)
            FAIL("the search asks for " << asked << " of 500 points, and " << enough
                                        << " are enough");
    }
}
