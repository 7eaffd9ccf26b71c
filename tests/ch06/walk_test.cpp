// Rays on which a walk could lose a hit: at faces, edges and corners of cells, within them, from
// them, along diagonals, far away, huge and tiny. Every answer must be exact arithmetic's.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/pointer_orthtree.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch06/cell_rays.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}
namespace {

using Straddlers = OctreeConfig::Straddlers;
using Walk = OctreeConfig::Walk;

constexpr int rays_each = sized(1'000, 150), oracle_rays = sized(40, 20);

struct Variant {
    const char* name;
    OctreeConfig config;
};
const std::vector<Variant>& variants() {
    static const std::vector<Variant> all{
        {"tight", {}},
        {"deep", {.costs = {.traversal = 0.0}, .max_leaf_size = 1, .max_growth = 40.0}},
        {"kept", {.straddlers = Straddlers::keep}},
        {"loose", {.straddlers = Straddlers::keep, .looseness = 2.0}}};
    return all;
}

/// Who is asked for a ray that is aimed at the cells of one tree: that tree, or all of them.
enum class Asked { that_tree, all_trees };

/// Rays aimed at the cells of one tree; naively, and of the exact oracle now and then, once for all
/// that are asked.
void check_rays(const TestScene& scene, const std::vector<Octree<>>& octrees, std::size_t aimed,
                const LinearOctree<>& linear, Asked asked, int rays, int by_oracle) {
    CellRays maker(octrees[aimed].nodes(), scene.triangles, 17);
    const auto naive = Naive<FilteredExact>::build(scene.triangles);
    const ExactOracle oracle = ExactOracle::build(scene.triangles);
    for (int i = 0; i < rays; ++i) {
        auto [kind, ray] = maker.next();
        if (ray.direction == Vector3(0.0f)) continue;
        if (i % 7 == 0) ray.tmin = -infinity;
        const auto expected = closest_hit(naive, ray);
        bool is_right = true;
        const auto ask = [&](const char* name, const auto& tree) {
            const auto got = closest_hit(tree, ray);
            const bool any = any_hit(tree, ray);
            if (got == expected && any == expected.has_value()) return;
            is_right = false;
            CAPTURE(name, kind, i, expected.has_value() ? expected->t : -1.0f,
                    got.has_value() ? got->t : -1.0f);
            CHECK(got == expected);
            CHECK(any == expected.has_value());
        };
        for (std::size_t of = 0; of < octrees.size(); ++of)
            if (of == aimed || asked == Asked::all_trees) ask(variants()[of].name, octrees[of]);
        ask("linear", linear);
        if (!is_right) return;  // one is enough
        if (i % std::max(1, rays / by_oracle) == 0)
            CHECK(!compare(oracle, ray, expected).is_wrong());
    }
}

std::vector<TestScene> walked_scenes() {
    using namespace scenes;
    std::vector<TestScene> all = extreme_scenes();
    // Whole numbers in a cube of 8: every triangle lies in planes of cells, or ends there.
    all.push_back({"in cells' planes", sheet(8, 8, [](int i, int j) { return Point3(4, i, j); })});
    for (const Triangle& t : sheet(8, 8, [](int i, int j) { return Point3(i, 4, j); }))
        all.back().triangles.push_back(t);
    for (const Triangle& t : sheet(8, 8, [](int i, int j) { return Point3(i, j, i); }))
        all.back().triangles.push_back(t);
    return all;
}

/// So many rays at the cells of each variant's tree.
void check_all(Asked asked, int rays, int by_oracle) {
    std::vector<TestScene> all = walked_scenes();
    for (TestScene& scene : some_of(adversarial_scenes())) all.push_back(std::move(scene));
    for (const TestScene& scene : all) {
        INFO(scene.name);
        std::vector<Octree<>> octrees;
        for (const Variant& variant : variants())
            octrees.push_back(Octree<>::build(scene.triangles, variant.config));
        const auto linear = LinearOctree<>::build(scene.triangles);
        for (std::size_t aimed = 0; aimed < octrees.size(); ++aimed)
            check_rays(scene, octrees, aimed, linear, asked, rays, by_oracle);
    }
}

/// What an observer is told of a walk.
template <int D>
struct Visits : NoObserver {
    using NoObserver::observe;
    void observe(const OrthtreeVisit<D>& visit) { all.push_back(visit); }
    std::vector<OrthtreeVisit<D>> all;
};

template <int D>
Visits<D> visits_of(const OrthtreeNodes<D>& nodes, Walk way, const BasicRay<D>& ray,
                    double limit_at_leaves) {
    Visits<D> visits;
    TraversalCounts counts;
    walk_orthtree(
        nodes, way, ray, counts, [&](std::uint32_t) { return limit_at_leaves; }, visits);
    CHECK(counts.nodes_visited == visits.all.size());
    return visits;
}

}  // namespace

TEST_CASE("rays at faces, edges and corners of cells, and within them, are answered exactly") {
    check_all(Asked::all_trees, rays_each, oracle_rays);
}

// By hand, some twenty minutes: ch06.walk "[.big]".
TEST_CASE("the same with a million rays a scene", "[.big]") {
    check_all(Asked::that_tree, 250'000, 500);
}

TEST_CASE("both walks visit the same nodes in the same order, and know the same parts of rays") {
    const auto triangles = scenes::soup(300, 0.2f, 21);
    for (const Variant& variant : variants()) {
        const auto tree = OrthtreeBuilder<3>::build(triangles, variant.config);
        CellRays maker(tree, triangles, 5);
        std::size_t visited = 0;
        for (int i = 0; i < sized(20'000, 500); ++i) {
            const Ray ray = maker.next().ray;
            const double limit = i % 2 ? double{infinity} : 1.0;
            const auto plain = visits_of(tree, Walk::plain, ray, limit),
                       parametric = visits_of(tree, Walk::parametric, ray, limit);
            REQUIRE(plain.all.size() == parametric.all.size());
            for (std::size_t k = 0; k < plain.all.size(); ++k) {
                REQUIRE(plain.all[k].node == parametric.all[k].node);
                REQUIRE(plain.all[k].cube.centre == parametric.all[k].cube.centre);
                REQUIRE(plain.all[k].part.enter == parametric.all[k].part.enter);
                REQUIRE(plain.all[k].part.leave == parametric.all[k].part.leave);
            }
            visited += plain.all.size();
        }
        CHECK(visited > 1'000);
    }
}

TEST_CASE("in the layout of pointers the walk takes the same way") {
    const auto triangles = scenes::soup(300, 0.2f, 25);
    const auto tree = OrthtreeBuilder<3>::build(triangles);
    const PointerOrthtree<3> pointers(tree);
    CHECK(pointers.bytes() == 80 * tree.nodes.size());
    CellRays maker(tree, triangles, 7);
    for (int i = 0; i < sized(5'000, 300); ++i) {
        const Ray ray = maker.next().ray;
        std::vector<std::uint32_t> named, named_by_pointers;
        NoCounts none;
        walk_orthtree(tree, Walk::parametric, ray, none, [&](std::uint32_t index) {
            named.push_back(tree.node(index).first);
            return double{infinity};
        });
        walk_orthtree(pointers, Walk::parametric, ray, none, [&](const PointerNode<3>* node) {
            named_by_pointers.push_back(node->first);
            return double{infinity};
        });
        REQUIRE(named == named_by_pointers);
    }
}

TEST_CASE("cells come in the order of the ray, but for those that share its point") {
    const auto segments = [] {
        std::vector<Segment> all;
        for (const Triangle& t : scenes::soup(300, 0.1f, 22))
            all.push_back({{t.a.x, t.a.y}, {t.b.x, t.b.y}});
        return all;
    }();
    const auto tree = OrthtreeBuilder<2>::build(segments);
    Pcg32 random(6);
    for (int i = 0; i < 1'000; ++i) {
        const Aabb2 around{Point2(-1.0f), Point2(2.0f)};
        const Point2 origin = random_point(random, around);
        const Ray2 ray{origin, random_point(random, around) - origin};
        double last = -infinity;
        for (const auto& visit : visits_of(tree, Walk::parametric, ray, infinity).all) {
            if (!tree.nodes[visit.node].is_leaf()) continue;
            REQUIRE(visit.part.enter >= last - 1e-12 * std::abs(last));
            last = visit.part.enter;
        }
    }
}

TEST_CASE("a hit ends the walk: no cell that begins beyond it is visited") {
    const auto triangles = scenes::soup(300, 0.2f, 23);
    const auto tree = OrthtreeBuilder<3>::build(triangles);
    CellRays maker(tree, triangles, 9);
    for (int i = 0; i < sized(3'000, 300); ++i) {
        bool named = false;
        struct Watcher : NoObserver {
            using NoObserver::observe;
            void observe(const OrthtreeVisit<3>& visit) {
                if (named) REQUIRE(visit.part.enter <= 0.5);
            }
            const bool& named;
        } watcher{{}, named};
        NoCounts none;
        const auto own = [&](std::uint32_t) { return named = true, 0.5; };
        walk_orthtree(tree, Walk::parametric, maker.next().ray, none, own, watcher);
    }
}

TEST_CASE("no ray allocates memory") {
    const auto triangles = scenes::soup(500, 0.1f, 24);
    const auto check = [&](const auto& tree, CellRays maker) {
        std::vector<Ray> rays;
        for (int i = 0; i < 1'000; ++i) rays.push_back(maker.next().ray);
        std::size_t hits = 0;
        test::allocations_left = 0;  // the next one throws
        for (const Ray& ray : rays) hits += closest_hit(tree, ray).has_value();
        for (const Ray& ray : rays) hits += any_hit(tree, ray);
        test::allocations_left = -1;
        CHECK(hits > 500);
    };
    for (const Variant& variant : variants()) {
        const auto octree = Octree<>::build(triangles, variant.config);
        check(octree, CellRays(octree.nodes(), triangles, 3));
    }
    const auto aimed_at = OrthtreeBuilder<3>::build(triangles);
    check(LinearOctree<>::build(triangles), CellRays(aimed_at, triangles, 3));
}

TEST_CASE(
    "planes of cells: the largest error of their t stays below its bound, and comes near it") {
    Pcg32 random(1);
    double worst = 0.0;
    const auto number = [&](int exponents) {
        const float mantissa = random.uniform(1.0f, 2.0f);
        const int exponent = int(random.below(std::uint32_t(exponents))) - exponents / 2;
        const float sign = random.below(2) != 0 ? 1.0f : -1.0f;
        return sign * std::ldexp(mantissa, exponent);
    };
    for (int i = 0; i < sized(300'000, 2'000); ++i) {
        Ray ray{.origin = Point3(number(8))};
        ray.direction = Vector3(number(8));
        // A plane with up to 53 bits, as deep cells have them.
        double position = number(8);
        position += std::ldexp(double{number(2)}, -25);
        const double t = OrthtreeRay<3>(ray).distance(0, position);
        const mpq_class exact =
            (mpq_class(position) - double{ray.origin.x}) / mpq_class(double{ray.direction.x});
        const mpq_class part = abs((mpq_class(t) - exact) / exact) * mpq_class(0x1p53) / 3;
        worst = std::max(worst, part.get_d());
        PlaneSpan span;
        span.begin_at(t);
        span.end_at(t);
        REQUIRE(mpq_class(span.begin) < exact);
        REQUIRE(mpq_class(span.end) > exact);
    }
    fmt::print("  distance to a cell's plane: the largest error is {:.3f} of gamma(3)\n", worst);
    CHECK(worst < 1.0);
    CHECK(worst > sized(0.6, 0.5));  // fewer samples come less near
}

TEST_CASE("along a plane all of one side is left out, within it none") {
    const OrthtreeRay<2> ray({{1.0f, 2.0f}, {0.0f, -1.0f}});
    PlaneSpan ahead, behind, in;
    ahead.begin_at(ray.distance(0, 3.0));
    CHECK(ahead.begin == infinity);
    behind.end_at(ray.distance(0, 0.5));
    CHECK(behind.end == -infinity);
    in.begin_at(ray.distance(0, 1.0));
    in.end_at(ray.distance(0, 1.0));
    const RayPart part = within({0.0, 5.0}, in);
    CHECK(part.enter == 0.0);
    CHECK(part.leave == 5.0);
}

}  // namespace space
