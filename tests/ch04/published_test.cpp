// Lichter23's tree as published, cure by cure.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <set>

namespace space {
namespace {

using Tree = PublishedKdTree<FilteredExact>;
using Config = PublishedKdTreeConfig;

std::set<std::uint32_t> named(const Tree& tree) {
    return {tree.references().begin(), tree.references().end()};
}

std::vector<Triangle> shifted(std::vector<Triangle> triangles, const Vector3& by) {
    return scenes::mapped(std::move(triangles), [&](const Point3& p) { return p + by; });
}

std::vector<Ray> rays_at(std::span<const Triangle> triangles, int count) {
    Pcg32 random(7);
    Aabb box;
    for (const Triangle& t : triangles) box.extend(bounds(t));
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Triangle& aim = triangles[random.below(std::uint32_t(triangles.size()))];
        const Point3 target = (aim.a + aim.b + aim.c) / 3.0f;
        const Point3 origin = box.centroid() + 3.0f * random_vector(random);
        rays.push_back({origin, target - origin});
    }
    return rays;
}

/// What a tree's rays cost, and how many are answered otherwise than naively.
struct Outcome {
    std::size_t wrong = 0;
    TraversalCounts counts = {};
};
Outcome outcome(std::span<const Triangle> triangles, const Config& config) {
    const Tree tree = Tree::build(triangles, config);
    const auto naive = Naive<FilteredExact>::build(triangles);
    Outcome result;
    for (const Ray& ray : rays_at(triangles, 1'000)) {
        const auto hit = tree.closest_hit(ray, result.counts);
        NoCounts none;
        result.wrong += hit != naive.closest_hit(ray, none);
    }
    return result;
}

}  // namespace

TEST_CASE("the suite: the published k-d tree with all its cures") {
    run_suite<PublishedKdTree>("kd-published, cured", Config::cured());
}

TEST_CASE("L10: the published scene box is too small or too large, and loses triangles") {
    // The first triangle is never looked at: here it sticks out of all the others' box.
    std::vector<Triangle> triangles = shifted(scenes::ball(2), {2, 2, 2});
    triangles.insert(triangles.begin(), {{2, 5, 2}, {3, 5, 2}, {2, 5, 3}});
    const Tree plain = Tree::build(triangles);
    CHECK(named(plain).count(0) == 0);
    CHECK(named(plain).size() == triangles.size() - 1);
    const Tree whole = Tree::build(triangles, {.whole_scene_box = true});
    CHECK(named(whole).size() == triangles.size());
    const Ray ray{{2.25f, 9, 2.25f}, {0, -1, 0}};
    CHECK(!(closest_hit(plain, ray) && closest_hit(plain, ray)->triangle == 0));
    CHECK(closest_hit(whole, ray)->triangle == 0);
    // The x of the first corner stands for y and z, too: far from the scene, it makes the box
    // large and its cells empty.
    const auto away = shifted(scenes::ball(2), {100, 0, 0});
    CHECK(Tree::build(away).nodes()[0].box.max.y > 98.0f);
    CHECK(Tree::build(away, {.whole_scene_box = true}).nodes()[0].box.max.y < 2.0f);
    CHECK(named(Tree::build(away)).size() == away.size());
}

TEST_CASE(
    "in a box that holds all corners sorting by corners loses nothing: what stays has corners in "
    "both halves, what goes down has all of them in one") {
    for (const TestScene& scene : some_of(adversarial_scenes())) {
        const Tree by_corners = Tree::build(scene.triangles, {.whole_scene_box = true});
        const Tree by_overlap =
            Tree::build(scene.triangles, {.whole_scene_box = true, .sort_by_overlap = true});
        INFO(scene.name);
        CHECK(named(by_corners).size() == scene.triangles.size());
        CHECK(by_corners.references().size() == scene.triangles.size());
        CHECK(std::equal(by_corners.references().begin(), by_corners.references().end(),
                         by_overlap.references().begin(), by_overlap.references().end()));
        CHECK(by_corners.nodes().size() == by_overlap.nodes().size());
    }
}

TEST_CASE("in a box that is too small sorting by corners loses triangles that overlap keeps") {
    // The first triangle, which the box does not know, spans it and has no corner in it.
    std::vector<Triangle> triangles = shifted(scenes::ball(2), {2, 2, 2});
    triangles.insert(triangles.begin(), {{2, -9, 2}, {12, 9, 2}, {-8, 9, 2.5f}});
    CHECK(named(Tree::build(triangles)).count(0) == 0);
    CHECK(named(Tree::build(triangles, {.sort_by_overlap = true})).count(0) == 1);
}

TEST_CASE("each cure of the way through the tree spares tests or nodes, and none changes a hit") {
    const auto triangles = make_scene("icosphere:16").mesh.triangles();
    Config config{.whole_scene_box = true, .sort_by_overlap = true, .safe_box_test = true};
    const Outcome blind = outcome(triangles, config);
    config.near_child_first = true;
    const Outcome ordered = outcome(triangles, config);
    config.near_child_first = false;
    config.early_end = true;
    const Outcome early = outcome(triangles, config);
    config.near_child_first = true;
    const Outcome both = outcome(triangles, config);
    CHECK(blind.wrong + ordered.wrong + early.wrong + both.wrong == 0);
    CHECK(ordered.counts == blind.counts);  // the order alone spares nothing
    CHECK(early.counts.triangles_tested < blind.counts.triangles_tested);
    CHECK(both.counts.triangles_tested < early.counts.triangles_tested);
    CHECK(both.counts.nodes_visited < early.counts.nodes_visited);
    fmt::print("  tests for 1000 rays: published way {}, early end {}, and near child first {}\n",
               blind.counts.triangles_tested, early.counts.triangles_tested,
               both.counts.triangles_tested);
}

TEST_CASE("the published box test loses rays in the planes of boxes, the safe one none") {
    // Faces of boxes lie in the planes that cut the scene.
    std::vector<Triangle> triangles;
    for (int i = 0; i < 8; ++i)
        scenes::add_box(triangles, Point3(float(i), 0, 0), Point3(float(i + 1), 1, 1));
    const Config plain{.max_leaf_size = 1, .whole_scene_box = true};
    Config safe = plain;
    safe.safe_box_test = true;
    const auto naive = Naive<FilteredExact>::build(triangles);
    std::size_t lost = 0, wrong = 0;
    const Tree published = Tree::build(triangles, plain), cured = Tree::build(triangles, safe);
    for (int i = 0; i <= 16; ++i)
        for (int axis = 1; axis < 3; ++axis) {
            Ray ray{{0.5f * float(i), 0.5f, 0.5f}, Vector3(0.0f)};
            ray.origin[axis] = 3.0f;
            ray.direction[axis] = -1.0f;
            const auto expected = closest_hit(naive, ray);
            lost += closest_hit(published, ray) != expected;
            wrong += closest_hit(cured, ray) != expected;
        }
    CHECK(lost > 0);
    CHECK(wrong == 0);
}

TEST_CASE("no scene, coincident triangles and points at neighbouring floats end the build") {
    CHECK(Tree::build({}).nodes().empty());
    const Triangle one{{0.1f, 0.2f, 0.3f}, {0.9f, 0.3f, 0.4f}, {0.4f, 0.8f, 0.7f}};
    CHECK(Tree::build(std::vector<Triangle>(100, one), Config::cured()).nodes().size() == 3);
    const Point3 p(1.0f), q(std::nextafter(1.0f, 2.0f));
    std::vector<Triangle> points(50, {p, p, p});
    points.resize(100, {q, q, q});
    CHECK(Tree::build(points, Config::cured()).shape().references == 100);
}

}  // namespace space
