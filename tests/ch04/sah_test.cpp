// The surface area heuristic against numbers computed by hand and against trying every plane; and
// Heinonen16's scene.
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace space {
namespace {

using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;
using Builder = KdBuilder<3>;

#ifdef BOOK_SANITIZED
constexpr std::uint32_t largest = 8;
#else
constexpr std::uint32_t largest = 64;
#endif

Triangle square(float low, float high, float z) {
    return {{low, low, z}, {high, low, z}, {high, high, z}};
}

/// The names of the segments A .. G in each node, below and above its plane.
struct Sets : NoObserver {
    using NoObserver::observe;
    std::vector<std::string> below, above, leaves;

    static char name(std::uint32_t polygon) { return char('A' + int(polygon)); }
    void observe(const KdBuilder<2>::Chosen& event) {
        if (!event.split) {
            leaves.emplace_back();
            for (const auto& reference : event.references) leaves.back() += name(reference.polygon);
            return;
        }
        below.emplace_back();
        above.emplace_back();
    }
    void observe(const KdBuilder<2>::Placed& event) {
        using Half = KdBuilder<2>::Half;
        if (event.half != Half::above) below.back() += name(event.reference.polygon);
        if (event.half != Half::below) above.back() += name(event.reference.polygon);
    }
};

/// Half the area in double throughout; in a cell that is a line the length.
double measure(const Aabb& box, bool line) {
    const Double3 e = Double3(box.max) - Double3(box.min);
    return line ? e.x + e.y + e.z : e.x * e.y + e.y * e.z + e.z * e.x;
}

/// Watches a build: of each node the least cost that it was told, and the least that there is.
struct BruteForce : NoObserver {
    using NoObserver::observe;
    SahCosts costs;
    double least_told = infinity;
    std::size_t nodes = 0, wrong = 0, planes = 0;

    explicit BruteForce(const SahCosts& of) : costs(of) {}
    void observe(const SahCandidate& candidate) {
        least_told = std::min(least_told, candidate.cost);
    }
    void observe(const Builder::Chosen& event) {
        const double leaf = costs.intersection * double(event.references.size());
        double least = infinity;
        std::optional<double> chosen;
        for (int axis = 0; axis < 3; ++axis)
            for (const auto& reference : event.references)
                for (const float position : {reference.box.min[axis], reference.box.max[axis]})
                    for (const bool coplanar_below : {true, false}) {
                        const KdSplit split{axis, position, coplanar_below};
                        const double cost = cost_of(split, event);
                        least = std::min(least, cost);
                        if (event.split == split) chosen = cost;
                        ++planes;
                    }
        ++nodes;
        // Sums of products in another order.
        const auto equal = [](double x, double y) { return std::abs(x - y) <= 1e-9 * (x + y); };
        if (event.split) {
            wrong += !chosen || !equal(*chosen, least) || !equal(least_told, least);
            wrong += !(least < leaf);
        } else {
            wrong += least < leaf * (1.0 - 1e-9);
        }
        least_told = infinity;
    }

  private:
    /// By definition, with areas of boxes and counts one by one; infinite where a half is the
    /// whole cell and holds as much.
    double cost_of(const KdSplit& split, const Builder::Chosen& event) const {
        std::size_t below = 0, above = 0, both = 0;
        for (const auto& [polygon, box, piece] : event.references) {
            const bool flat =
                box.min[split.axis] == split.position && box.max[split.axis] == split.position;
            const bool is_below =
                box.min[split.axis] < split.position || (flat && split.coplanar_below);
            const bool is_above =
                box.max[split.axis] > split.position || (flat && !split.coplanar_below);
            below += is_below;
            above += is_above;
            both += is_below && is_above;
        }
        const std::size_t all = event.references.size();
        const auto [low, high] = halves(event.cell, split);
        if ((low == event.cell && below == all) || (high == event.cell && above == all))
            return infinity;
        const bool line = measure(event.cell, false) == 0.0;
        const double whole = measure(event.cell, line);
        if (whole == 0.0) return infinity;
        const std::size_t stay = costs.straddlers_stay ? both : 0;
        const double cost = costs.traversal +
                            costs.intersection *
                                (measure(low, line) / whole * double(below - stay) +
                                 measure(high, line) / whole * double(above - stay) + double(stay));
        return below == 0 || above == 0 ? cost * (1.0 - costs.empty_bonus) : cost;
    }
};

/// Counts what a build sweeps: the references of all nodes, two events an axis each.
struct Swept : NoObserver {
    using NoObserver::observe;
    std::uint64_t references = 0;
    void observe(const Builder::Chosen& event) { references += event.references.size(); }
};

}  // namespace

TEST_CASE("Heinonen16, figures 4 and 5: the planes q, u, v, r, t, s give the printed sets") {
    const std::vector<Segment> segments = heinonen_segments();
    const KdSplit planes[] = {{0, 8.0f}, {1, 11.5f}, {0, 4.0f}, {1, 6.5f}, {0, 11.25f}, {0, 12.5f}};
    for (const Rule rule : {Rule::middle, Rule::median}) {
        Sets sets;
        const KdNodes<2> tree = KdBuilder<2>::build(
            segments, {.rule = rule, .max_leaf_size = 1, .max_depth = 3, .planned = planes}, sets);
        CHECK(sets.below == std::vector<std::string>{"ABD", "BD", "D", "EF", "E", "G"});
        CHECK(sets.above == std::vector<std::string>{"CEFG", "A", "B", "CG", "F", "C"});
        CHECK(sets.leaves == std::vector<std::string>{"D", "B", "A", "E", "F", "G", "C"});
        CHECK(tree.references.size() == 7);
        CHECK(tree.depth == 3);
    }
}

TEST_CASE("middle and median cut where they say") {
    // Boxes of side 1 at x = 0, 1, 2 and 9: the cell reaches from 0 to 10.
    std::vector<Triangle> triangles;
    for (const float x : {0.0f, 1.0f, 2.0f, 9.0f})
        triangles.push_back({{x, 0, 0}, {x + 1, 1, 0}, {x + 1, 1, 1}});
    const auto root = [&](Rule rule) {
        return KdBuilder<3>::build(triangles, {.rule = rule, .max_leaf_size = 2}).nodes[0];
    };
    CHECK(root(Rule::middle).axis() == 0);
    CHECK(root(Rule::middle).position() == 5.0f);
    CHECK(root(Rule::median).position() == 2.5f);  // of 0.5, 1.5, 2.5, 9.5
}

TEST_CASE("the cost of a plane, computed by hand") {
    // A cell of 4 x 2 x 1 has half the area 8 + 2 + 4 = 14; cut at x = 1, the halves have 1 x 2 x
    // 1: 5 and 3 x 2 x 1: 11.
    const Aabb cell{{0, 0, 0}, {4, 2, 1}};
    const SahCosts costs{.traversal = 1.0, .intersection = 2.0, .empty_bonus = 0.2};
    const SahCost<3> cost(cell, 0, costs);
    CHECK(cost(1.0f, 3, 4, 7) == Approx(1.0 + 2.0 * (5.0 * 3 + 11.0 * 4) / 14.0));
    CHECK(cost(1.0f, 0, 7, 7) == Approx(0.8 * (1.0 + 2.0 * 11.0 * 7 / 14.0)));      // empty space
    CHECK(cost(1.0f, 3, 5, 7) == Approx(1.0 + 2.0 * (5.0 * 3 + 11.0 * 5) / 14.0));  // a straddler
    SahCosts kept = costs;
    kept.straddlers_stay = true;
    CHECK(SahCost<3>(cell, 0, kept)(1.0f, 3, 5, 7) ==
          Approx(1.0 + 2.0 * (5.0 * 2 + 11.0 * 4) / 14.0 + 2.0));
    // In the plane half the perimeter counts.
    const SahCost<2> flat({{0, 0}, {4, 2}}, 0, costs);
    CHECK(flat(1.0f, 1, 1, 2) == Approx(1.0 + 2.0 * (3.0 + 5.0) / 6.0));
}

TEST_CASE("of two groups with a gap the cheapest plane cuts off the empty space") {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 4; ++i) {
        triangles.push_back(square(0.0f, 1.0f, float(i) / 3.0f));
        triangles.push_back(square(9.0f, 10.0f, float(i) / 3.0f));
    }
    const KdNodes<3> tree = KdBuilder<3>::build(triangles);
    CHECK(tree.nodes[0].axis() < 2);
    CHECK((tree.nodes[0].position() == 1.0f || tree.nodes[0].position() == 9.0f));
}

TEST_CASE("the chosen plane is the cheapest of all that there are, in every node") {
    for (const Straddlers straddlers :
         {Straddlers::clip, Straddlers::duplicate, Straddlers::keep}) {
        std::size_t nodes = 0, planes = 0;
        for (TestScene scene : some_of(adversarial_scenes())) {
            if (scene.triangles.size() > 60) scene.triangles.resize(60);
            KdTreeConfig config{.straddlers = straddlers};
            config.costs.straddlers_stay = straddlers == Straddlers::keep;
            config.max_depth = max_kd_depth;
            BruteForce watch(config.costs);
            KdBuilder<3>::build(scene.triangles, config, watch);
            INFO(scene.name);
            CHECK(watch.wrong == 0);
            nodes += watch.nodes;
            planes += watch.planes;
        }
        CHECK(nodes > sized(500u, 100u));
        fmt::print("  {} nodes, {} planes tried by brute force\n", nodes, planes);
    }
}

TEST_CASE("the build sweeps n log n events, and every level about as many references") {
    double before = 0.0;
    for (std::uint32_t size = largest / 8; size <= largest; size *= 2) {
        const auto triangles = make_scene(fmt::format("icosphere:{}", size)).mesh.triangles();
        Swept swept;
        const KdNodes<3> tree = KdBuilder<3>::build(triangles, {}, swept);
        const double n = double(triangles.size());
        const double ratio = double(swept.references) / (n * std::log2(n));
        fmt::print("  {} triangles: {} swept, {:.2f} n log2 n; depth {}\n", n, swept.references,
                   ratio, tree.depth);
        CHECK(ratio < 4.0);
        // Smaller trees end before they cut much.
        if (before > 0.0 && n > 2'000.0) CHECK(ratio < 1.1 * before);
        before = ratio;
    }
}

TEST_CASE("shape tells the tree's size, and the cost that the heuristic expects") {
    const std::vector<Triangle> one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}};
    const TreeShape shape = KdTree<>::build(one).shape();
    CHECK(shape.nodes == 1);
    CHECK(shape.leaves == 1);
    CHECK(shape.depth == 0);
    CHECK(shape.references == 1);
    CHECK(*shape.sah_cost == Approx(1.0));
    CHECK(sizeof(KdNode) == 8);
}

}  // namespace space
