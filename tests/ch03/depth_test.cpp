// Chains of a hundred thousand nodes on a small stack, sets without an end, numbers at the ends of
// float's range, bounds on memory, and the same tree twice.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "common/program/error.hpp"
#include "tests/catch.hpp"
#include "tests/ch03/tiling_scenes.hpp"

#include <pthread.h>

#include <bit>
#include <cstdlib>

namespace space {
namespace {

constexpr std::int32_t built_chain = sized(10'000, 2'000);
constexpr std::size_t stack_bytes = sized(96 << 10, 1 << 20);  // the sanitizer's frames are large
constexpr std::int32_t made_chain = 100'000;

/// Runs on a stack on which no recursion gets a thousand nodes deep.
template <class Body>
void on_a_small_stack(Body body) {
    pthread_attr_t attributes;
    REQUIRE(pthread_attr_init(&attributes) == 0);
    REQUIRE(pthread_attr_setstacksize(&attributes, stack_bytes) == 0);
    pthread_t thread;
    const auto run = [](void* it) -> void* {
        (*static_cast<Body*>(it))();
        return nullptr;
    };
    REQUIRE(pthread_create(&thread, &attributes, run, &body) == 0);
    REQUIRE(pthread_join(thread, nullptr) == 0);
    pthread_attr_destroy(&attributes);
}

/// Equal triangles one above the other, fronts upwards.
std::vector<Triangle> stairs(std::int32_t count) {
    std::vector<Triangle> triangles;
    for (std::int32_t i = 0; i < count; ++i) {
        const auto z = static_cast<float>(i);
        triangles.push_back({{0, 0, z}, {1, 0, z}, {0, 1, z}});
    }
    return triangles;
}

/// The tree that the stairs make, without the time that it takes to sort them: each plane has all
/// later ones in front.
BspTree<3> chain(std::int32_t count) {
    BspTree<3> tree;
    const std::vector<Triangle> triangles = stairs(count);
    for (std::int32_t i = 0; i < count; ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        tree.polygons.push_back(triangles[number]);
        tree.planes.emplace_back(tree.polygons.back());
        tree.fragments.push_back(whole_polygon<3>(tree.polygons.back(), number));
        tree.nodes.push_back(
            {number, i + 1 < count ? number + 1 : BspTree<3>::none, BspTree<3>::none, number, 1});
    }
    return tree;
}

/// What is asked of a chain, from below, above and within.
struct Answers {
    std::size_t depth = 0, painted = 0, crossed_up = 0, crossed_down = 0;
    std::uint32_t first_painted = 0, last_painted = 0;
    bool in_order = true;
    Location below{}, between{}, top{};

    void ask(const BspTree<3>& tree) {
        const auto count = static_cast<float>(tree.nodes.size());
        depth = tree.depth();
        std::uint32_t previous = 0;
        tree.back_to_front({0.25f, 0.25f, count + 1.0f}, [&](const Fragment<3>& f) {
            if (painted++ == 0) first_painted = f.polygon;
            in_order = in_order && (painted == 1 || f.polygon == previous + 1);
            last_painted = previous = f.polygon;
        });
        NoCounts none;
        const auto count_crossed = [&](const Ray& ray) {
            std::size_t crossed = 0;
            front_to_back(tree, ray, none, [&](const BspTree<3>::Node&) {
                ++crossed;
                return double{infinity};
            });
            return crossed;
        };
        crossed_up = count_crossed({{0.25f, 0.25f, -1}, {0, 0, 1}});
        crossed_down = count_crossed({{0.25f, 0.25f, count}, {0, 0, -1}});
        below = tree.locate({0.25f, 0.25f, -1});
        between = tree.locate({0.25f, 0.25f, 2.5f});
        top = tree.locate({0.25f, 0.25f, count - 1});  // on the last plane
    }
    void check(std::size_t count) const {
        CHECK(depth == count - 1);
        CHECK(painted == count);
        CHECK(first_painted == 0);
        CHECK(last_painted == count - 1);
        CHECK(in_order);
        CHECK(crossed_up == count);
        CHECK(crossed_down == count);
        CHECK(below == Location::inside);
        CHECK(between == Location::inside);
        CHECK(top == Location::boundary);
    }
};

/// Builds a chain and asks everything that an accelerator is asked.
void build_and_trace(std::int32_t count) {
    const std::vector<Triangle> triangles = stairs(count);
    Answers answers;
    std::optional<Hit> up, down, along;
    bool any = false, none = true;
    TreeShape shape;
    on_a_small_stack([&] {
        const auto bsp = Bsp<>::build(triangles, {.splitter = BspConfig::SplitterChoice::first});
        answers.ask(bsp.tree());
        shape = bsp.shape();
        up = closest_hit(bsp, {{0.25f, 0.25f, -2}, {0, 0, 1}});
        down = closest_hit(bsp, {{0.25f, 0.25f, 2e5f}, {0, 0, -1}});
        along = closest_hit(bsp, {{-1, 0.25f, 7}, {1, 0, 0}});
        any = any_hit(bsp, {{0.25f, 0.25f, -2}, {0, 0, 1}});
        none = any_hit(bsp, {{2, 2, -2}, {0, 0, 1}});
    });
    answers.check(static_cast<std::size_t>(count));
    CHECK(shape.depth == static_cast<std::size_t>(count) - 1);
    REQUIRE(up);
    CHECK(up->triangle == 0);
    CHECK(up->t == 2.0f);
    REQUIRE(down);
    CHECK(down->triangle == static_cast<std::uint32_t>(count) - 1);
    CHECK_FALSE(along);
    CHECK(any);
    CHECK_FALSE(none);
}

std::vector<Triangle> scaled(std::vector<Triangle> triangles, float by) {
    return scenes::mapped(std::move(triangles), [&](const Point3& p) { return p * by; });
}

/// Rays around the triangles: how many answers differ from the naive loop's.
template <TriangleTest Test>
int wrong_hits(const std::vector<Triangle>& triangles, const BspConfig& config, float size) {
    const auto naive = Naive<Test>::build(triangles);
    const auto bsp = Bsp<Test>::build(triangles, config);
    Pcg32 random(3);
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const Point3 origin = size * random_point(random, -0.5f, 1.5f);
        Vector3 direction = random_point(random, -1.0f, 1.0f);
        if (i % 2 && !triangles.empty()) {
            const Triangle& aim =
                triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
            direction = 0.25f * (aim.a + aim.b) + 0.5f * aim.c - origin;
        }
        wrong += closest_hit(bsp, {origin, direction}) != closest_hit(naive, {origin, direction});
        wrong += any_hit(bsp, {origin, direction}) != any_hit(naive, {origin, direction});
    }
    return wrong;
}

}  // namespace

TEST_CASE(
    "a chain of a hundred thousand nodes is painted, traced, located in, copied and destroyed on a "
    "small stack") {
    Answers answers, of_copy;
    on_a_small_stack([&] {
        const BspTree<3> tree = chain(made_chain);
        answers.ask(tree);
        const BspTree<3> copy = tree;
        of_copy.ask(copy);
    });
    answers.check(made_chain);
    of_copy.check(made_chain);
}

TEST_CASE("a chain is built without recursion, and gives a ray's hits") {
    build_and_trace(built_chain);
}

TEST_CASE("a chain of a hundred thousand nodes is built without recursion", "[.big]") {
    build_and_trace(made_chain);
}

TEST_CASE(
    "in the plane, too: a chain of segments is built, painted and located in on a small stack") {
    const std::int32_t count = built_chain / 2;
    std::vector<Segment> segments;
    for (std::int32_t i = 0; i < count; ++i) {
        const auto y = static_cast<float>(i);
        segments.push_back({{0, y}, {1, y}});
    }
    std::size_t depth = 0, painted = 0;
    Location cell{};
    on_a_small_stack([&] {
        const BspTree<2> tree =
            BspBuilder<2>::build(segments, {.splitter = BspConfig::SplitterChoice::first});
        depth = tree.depth();
        tree.back_to_front({0.5f, -1}, [&](const Fragment<2>&) { ++painted; });
        cell = tree.locate({0.5f, -1});
    });
    CHECK(depth == static_cast<std::size_t>(count) - 1);
    CHECK(painted == static_cast<std::size_t>(count));
    CHECK(cell == Location::inside);
}

TEST_CASE("thousands of equal triangles make one node, and a ray hits the first of them") {
    const Triangle one{{0.1f, 0.2f, 0.3f}, {0.9f, 0.3f, 0.4f}, {0.4f, 0.8f, 0.7f}};
    std::vector<Triangle> triangles(5'000, one);
    for (std::size_t i = 1; i < triangles.size(); i += 2) std::swap(triangles[i].b, triangles[i].c);
    for (const Grade grade :
         {Grade::thick_float, Grade::ordered_float, Grade::ordered_double, Grade::exact}) {
        const auto bsp = Bsp<>::build(triangles, {.grade = grade});
        CHECK(bsp.tree().nodes.size() == 1);
        CHECK(bsp.tree().fragments.size() == triangles.size());
        const Point3 middle = (one.a + one.b + one.c) / 3.0f;
        const auto hit = closest_hit(bsp, {{0, 0, 5}, middle - Point3(0, 0, 5)});
        REQUIRE(hit);
        CHECK(hit->triangle == 0);
    }
}

TEST_CASE("polygons in one plane make one node in the exact grade, however the plane lies") {
    CHECK(Bsp<>::build(scenes::mapped(scenes::soup(2'000, 0.3f, 6),
                                      [](const Point3& p) { return Point3(p.x, p.y, 0.5f); }))
              .tree()
              .nodes.size() == 1);
    std::vector<Triangle> slanted = scenes::coplanar(300, 5);
    slanted.resize(500);  // of the first plane
    CHECK(Bsp<>::build(slanted).tree().nodes.size() == 1);
    CHECK(wrong_hits<FilteredExact>(slanted, {}, 1.0f) == 0);
}

TEST_CASE("polygons without extent leave no trace") {
    const Point3 a(0.1f, 0.2f, 0.3f), step(0.25f, 0.5f, 0.125f);
    const std::vector<Triangle> degenerate{
        {a, a, a}, {a, a, a + step}, {step, 2.0f * step, 4.0f * step}};
    for (const auto& triangles : {std::vector<Triangle>{}, degenerate}) {
        const auto bsp = Bsp<>::build(triangles);
        CHECK(bsp.tree().nodes.empty());
        CHECK(bsp.tree().fragments.empty());
        CHECK_FALSE(closest_hit(bsp, {{0, 0, 5}, {0, 0, -1}}));
        CHECK_FALSE(any_hit(bsp, {{0, 0, 5}, {0, 0, -1}}));
        CHECK(bsp.tree().locate({0, 0, 0}) == Location::outside);
        CHECK(bsp.tree().depth() == 0);
        bsp.tree().back_to_front({0, 0, 0}, [](const Fragment<3>&) { FAIL("nothing to draw"); });
        CHECK(bsp.shape().nodes == 0u);
    }
    const std::vector<Segment> points{{{1, 1}, {1, 1}}, {{0, 0}, {1, 0}}};
    CHECK(BspBuilder<2>::build(points).fragments.size() == 1);
}

TEST_CASE("one triangle makes one node") {
    const auto bsp = Bsp<>::build(std::vector<Triangle>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    CHECK(bsp.tree().nodes.size() == 1);
    CHECK(bsp.tree().depth() == 0);
    CHECK(closest_hit(bsp, {{0.25f, 0.25f, 1}, {0, 0, -1}})->t == 1.0f);
    CHECK_FALSE(closest_hit(bsp, {{1, 1, 1}, {0, 0, -1}}));
}

TEST_CASE(
    "the exact grade gives the exact test's hits for the largest, the smallest and denormal "
    "numbers") {
    const std::vector<Triangle> soup = scenes::soup(60, 0.5f, 11);
    for (const float size : {1e38f, 1e20f, 1e-20f, 1e-38f, 1e-42f, 1e-44f})
        for (const BspConfig::SplitterChoice choice :
             {BspConfig::SplitterChoice::weighted, BspConfig::SplitterChoice::free}) {
            INFO(size);
            CHECK(wrong_hits<FilteredExact>(scaled(soup, size), {.splitter = choice}, size) == 0);
        }
    // A unit cube's soup beside 1e38 and 1e-38.
    std::vector<Triangle> mixed = soup;
    for (const float size : {1e38f, 1e-38f, 1e-44f})
        for (const Triangle& t : scaled(scenes::soup(10, 0.5f, 12), size)) mixed.push_back(t);
    CHECK(wrong_hits<FilteredExact>(mixed, {}, 1.0f) == 0);
}

TEST_CASE("the inexact grades end on the largest and smallest numbers") {
    for (const Grade grade : {Grade::thick_float, Grade::ordered_float, Grade::ordered_double})
        for (const float size : {1e38f, 1e-38f, 1e-42f})
            for (const BspConfig::SplitterChoice choice :
                 {BspConfig::SplitterChoice::first, BspConfig::SplitterChoice::weighted,
                  BspConfig::SplitterChoice::free}) {
                const auto bsp =
                    Bsp<>::build(scaled(scenes::soup(40, 0.5f, 13), size),
                                 {.splitter = choice, .grade = grade, .max_fragments = 100'000});
                CHECK(bsp.tree().fragments.size() > 0);
            }
}

TEST_CASE("the bound on fragments holds to the last one, and says so in one line") {
    const std::vector<Triangle> triangles = scenes::soup(100, 1.0f, 6);
    const std::size_t needed = Bsp<>::build(triangles).tree().fragments.size();
    REQUIRE(needed > 300);
    CHECK(Bsp<>::build(triangles, {.max_fragments = needed}).tree().fragments.size() == needed);
    for (const std::size_t bound :
         {needed - 1, std::size_t{200}, std::size_t{99}, std::size_t{0}}) {
        try {
            Bsp<>::build(triangles, {.max_fragments = bound});
            FAIL("built");
        } catch (const LimitError& error) {
            const std::string line = error.what();
            INFO(line);
            CHECK(line.find('\n') == std::string::npos);
            CHECK(line.find("more than " + std::to_string(bound) + " fragments") !=
                  std::string::npos);
        }
    }
    // Shared polygons count, too.
    CHECK_THROWS_AS(
        Bsp<>::build(triangles, {.straddlers = BspConfig::Straddlers::share, .max_fragments = 200}),
        LimitError);
    CHECK(Bsp<>::build(std::vector<Triangle>{}, {.max_fragments = 0}).tree().nodes.empty());
}

TEST_CASE("free planes end where nothing can be parted") {
    // All of one middle, all flat: an axis plane through it has everything across or in it.
    const Triangle one{{-1, -1, 0.5f}, {1, -1, 0.5f}, {0, 1, 0.5f}};
    for (const Grade grade : {Grade::ordered_float, Grade::exact}) {
        const BspConfig config{.splitter = BspConfig::SplitterChoice::free,
                               .grade = grade,
                               .candidates = 1,
                               .lopsided = 1.1};
        CHECK(Bsp<>::build(std::vector<Triangle>(50, one), config).tree().nodes.size() == 1);
        CHECK(Bsp<>::build(scenes::soup(60, 1.0f, 14), config).tree().fragments.size() > 60);
        CHECK(Bsp<>::build(scenes::whole_numbers(60, 4, 15), config).tree().fragments.size() > 40);
        CHECK(Bsp<>::build(scenes::torus(16, 8), config).tree().fragments.size() >= 256);
    }
}

TEST_CASE("no candidates mean one") {
    CHECK(Bsp<>::build(scenes::soup(20, 0.5f, 16), {.candidates = 0}).tree().fragments.size() >=
          20);
}

// ---- the same tree twice
// -------------------------------------------------------------------------------------------

namespace {

template <int D>
std::vector<std::uint64_t> bits(const BspTree<D>& tree) {
    std::vector<std::uint64_t> all;
    const auto add = [&](double x) { all.push_back(std::bit_cast<std::uint64_t>(x)); };
    for (const auto& node : tree.nodes)
        for (const std::int64_t x :
             {std::int64_t{node.plane}, std::int64_t{node.front}, std::int64_t{node.back},
              std::int64_t{node.first}, std::int64_t{node.count}})
            all.push_back(static_cast<std::uint64_t>(x));
    for (const auto& plane : tree.planes)
        for (int axis = 0; axis < D; ++axis) {
            add(plane.normal[axis]);
            for (int point = 0; point < D; ++point) add(plane.through[point][axis]);
        }
    for (const auto& fragment : tree.fragments) {
        all.push_back(fragment.polygon);
        for (const auto& corner : fragment.corners) {
            for (int axis = 0; axis < D; ++axis) add(corner.at[axis]);
            add(corner.error);
            all.push_back(static_cast<std::uint64_t>(corner.carriers.back().id));
        }
    }
    return all;
}

}  // namespace

TEST_CASE(
    "the same polygons and seed give the same tree, bit for bit; another seed gives another") {
    const auto polygons = scenes::soup(60, 0.6f, 17);
    std::vector<Segment> segments;
    for (const auto& p : polygons) segments.push_back({Point2(p[0]), Point2(p[1])});
    for (const Grade grade :
         {Grade::thick_float, Grade::ordered_float, Grade::ordered_double, Grade::exact})
        for (const BspConfig::SplitterChoice choice :
             {BspConfig::SplitterChoice::first, BspConfig::SplitterChoice::random,
              BspConfig::SplitterChoice::balanced, BspConfig::SplitterChoice::fewest_splits,
              BspConfig::SplitterChoice::weighted, BspConfig::SplitterChoice::free}) {
            const BspConfig config{.splitter = choice, .grade = grade};
            CHECK(bits(BspBuilder<3>::build(polygons, config)) ==
                  bits(BspBuilder<3>::build(polygons, config)));
            CHECK(bits(BspBuilder<2>::build(segments, config)) ==
                  bits(BspBuilder<2>::build(segments, config)));
            BspConfig other = config;
            other.seed = 2;
            CHECK((bits(BspBuilder<3>::build(polygons, config)) ==
                   bits(BspBuilder<3>::build(polygons, other))) ==
                  (choice == BspConfig::SplitterChoice::first));
        }
}

}  // namespace space
