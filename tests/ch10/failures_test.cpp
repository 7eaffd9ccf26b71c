// Where fast traversals fail: of each failure a test in which the plain method fails, by how much,
// and the cure holds.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch10_fast_traversal/compressed_node.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "common/accelerator.hpp"
#include "common/limit_error.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/ch10/quadruple.hpp"
#include "tests/ch10/wide_faults.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace space {
namespace {

/// Each kernel's answers to rays, beside those of the naive loop over the exact test.
template <class Builder = QuickBuilder>
std::size_t check_kernels(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays,
                          const WideBvhConfig<Builder>& config = {}) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    std::vector<std::optional<Hit>> expected;
    std::size_t hits = 0;
    for (const Ray& ray : rays) {
        expected.push_back(closest_hit(naive, ray));
        hits += expected.back().has_value();
    }
    for_each_kernel<Builder>(
        triangles,
        [&](const auto& bvh, const std::string&) {
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if (closest_hit(bvh, rays[i]) == expected[i] &&
                    any_hit(bvh, rays[i]) == expected[i].has_value())
                    continue;
                CAPTURE(i, expected[i].has_value(), any_hit(bvh, rays[i]));
                FAIL("another answer than the naive loop's");
            }
        },
        config);
    return hits;
}

/// A box, and a ray aimed at its corner or at an edge of it from afar.
struct BoxCase {
    Aabb box;
    Ray ray;
};
BoxCase box_case(Pcg32& random, float away) {
    BoxCase c;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = random.uniform(0.0f, 1.0f);
        const float b = random.uniform(0.0f, 1.0f);
        c.box.min[axis] = std::min(a, b);
        c.box.max[axis] = std::max(a, b);
    }
    c.ray.origin = away * random_vector(random);
    Point3 target = random_point(random, c.box);
    const std::uint32_t planes = random.below(3) == 0 ? 7 : 7 ^ (1u << random.below(3));
    for (int axis = 0; axis < 3; ++axis) {
        const bool upper = random.below(2) == 0;
        if ((planes >> axis & 1u) != 0) target[axis] = (upper ? c.box.max : c.box.min)[axis];
    }
    c.ray.direction = target - c.ray.origin;
    return c;
}
/// Whether the ray meets the closed box: all near planes before all far ones, and the latter not
/// behind it, in exact arithmetic.
bool is_met(const BoxCase& c) {
    std::array<Quadruple, 3> near, far, speed;  // times the speed, which is not negative
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = std::size_t(axis);
        const Quadruple d = c.ray.direction[axis], o = c.ray.origin[axis];
        if (c.ray.direction[axis] == 0.0f) return false;  // not asked about
        speed[i] = d > 0 ? d : -d;
        near[i] = d > 0 ? c.box.min[axis] - o : o - c.box.max[axis];
        far[i] = d > 0 ? c.box.max[axis] - o : o - c.box.min[axis];
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (far[j] < 0 || near[i] * speed[j] > far[j] * speed[i]) return false;
    return true;
}
/// With each plane's t by a function of plane, axis, and whether it is a near one.
template <class Place>
bool is_met_by(const BoxCase& c, const Place& place) {
    float enter = 0.0f, leave = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const bool backwards = c.ray.direction[axis] < 0.0f;
        enter = std::max(enter, place((backwards ? c.box.max : c.box.min)[axis], axis, true));
        leave = std::min(leave, place((backwards ? c.box.min : c.box.max)[axis], axis, false));
    }
    return enter <= leave;
}

}  // namespace

TEST_CASE("slabs: plain and fused planes lose boxes, lengthened fused ones too; ours lose none") {
    for (const float away : {3.0f, 30.0f}) {
        Pcg32 random(1);
        std::size_t met = 0, plain = 0, fused = 0, lengthened = 0, kernel = 0;
        for (int i = 0; i < sized(100'000, 20'000); ++i) {
            const BoxCase c = box_case(random, away);
            if (!is_met(c)) continue;
            ++met;
            const Vector3 r = 1.0f / c.ray.direction, o = c.ray.origin;
            plain +=
                !is_met_by(c, [&](float p, int axis, bool) { return (p - o[axis]) * r[axis]; });
            const auto by_fused = [&](float p, int axis) {
                return std::fma(p, r[axis], -(o[axis] * r[axis]));
            };
            fused += !is_met_by(c, [&](float p, int axis, bool) { return by_fused(p, axis); });
            lengthened += !is_met_by(c, [&](float p, int axis, bool is_near) {
                return by_fused(p, axis) * (is_near ? 1.0f : 1.0f + 6.0f * 0x1p-24f);
            });
            KernelRay ray{};
            REQUIRE(prepare_kernel_ray(c.ray, 1.0f, ray));
            kernel += !is_met_by(c, [&](float p, int axis, bool is_near) {
                return is_near ? (p - ray.near_origin[axis]) * ray.near_scale[axis]
                               : (p - ray.far_origin[axis]) * ray.far_scale[axis];
            });
        }
        fmt::print(
            "  origins up to {} away, of {} boxes met: lost {} plain, {} fused, {} fused and "
            "lengthened, {} by the kernels' planes\n",
            away, met, plain, fused, lengthened, kernel);
        CHECK(met > 3'000);
        CHECK(plain > met / 100);
        CHECK(fused > met / 100);
        CHECK(lengthened > 0);
        CHECK(kernel == 0);
    }
}

TEST_CASE(
    "a ray that touches a box in its corner alone hits the triangle that has a vertex there") {
    // On a grid, so that directions are exact: each ray meets its vertex at t = 1, and must not
    // lose it to a near plane that is met a rounding later than a far one.
    Pcg32 random(21);
    const auto coordinate = [&](std::uint32_t most) {
        return 0x1p-16f * float(1 + random.below(most));
    };
    const auto point = [&](std::uint32_t most) {
        Point3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(most);
        return p;
    };
    std::vector<Triangle> triangles(500);
    for (Triangle& t : triangles) {
        t.a = point(50'000);
        t.b = t.a + point(8'000);
        t.c = t.a + point(8'000);
    }
    std::vector<Ray> rays;
    for (int i = 0; i < sized(60'000, 6'000); ++i) {
        const Triangle& t = triangles[random.below(500)];
        const Point3 origin = 2.0f * point(60'000) - 0.5f;
        const Ray ray{.origin = origin, .direction = t.a - origin, .tmin = 1.0f, .tmax = 1.0f};
        if (FilteredExact::intersect(ray, t)) rays.push_back(ray);  // not seen edge-on
    }
    CHECK(rays.size() > 4'000);
    for_each_kernel(
        triangles,
        [&](const auto& bvh, const std::string&) {
            std::size_t lost = 0;
            for (const Ray& ray : rays)
                lost += !closest_hit(bvh, ray).has_value() || !any_hit(bvh, ray);
            REQUIRE(lost == 0);
        },
        WideBvhConfig<QuickBuilder>{.binary = {.max_leaf_size = 1}, .collapse = {.max_leaf = 1}});
}

namespace {

/// A node with eight boxes far from the origin, and rays at their corners.
WideNode<8> far_node(Pcg32& random, float away) {
    const Point3 place = away * random_vector(random);
    WideNode<8> node;
    for (std::size_t i = 0; i < 8; ++i) {
        Aabb box;
        for (int corner = 0; corner < 2; ++corner) box.extend(place + random_vector(random));
        node.put(i, box, {});
    }
    return node;
}
/// Planes to the nearest, in place of outwards.
CompressedNode nearest_planes(const WideNode<8>& node) {
    CompressedNode small = compressed(node);
    for (std::size_t row = 0; row < 6; ++row)
        for (std::size_t i = 0; i < 8; ++i) {
            const std::size_t axis = row % 3;
            const double steps = (double{node.planes[row][i]} - double{small.origin[axis]}) /
                                 double{small.step(axis)};
            small.planes[row][i] = std::uint8_t(std::clamp(std::round(steps), 0.0, 255.0));
        }
    return small;
}

}  // namespace

TEST_CASE(
    "eight bits: planes to the nearest lose rays at a box's corners; outward ones lose none") {
    for (const float away : {1.0f, 1'000.0f, 1e6f}) {
        Pcg32 random(17);
        std::size_t rays = 0, lost_nearest = 0, lost = 0;
        for (int i = 0; i < sized(4'000, 400); ++i) {
            const WideNode<8> node = far_node(random, away);
            const CompressedNode nearest = nearest_planes(node), outward = compressed(node);
            REQUIRE(outward.count == 8);
            for (std::size_t child = 0; child < 8; ++child) {
                const Aabb box = node.box(child);
                Point3 corner;
                const std::uint32_t which = random.below(8);
                for (int axis = 0; axis < 3; ++axis)
                    corner[axis] = ((which >> axis & 1u) != 0 ? box.max : box.min)[axis];
                const Vector3 way = random_vector(random);
                // From the corner itself: what does not hold it, and is not ahead, is missed.
                const Ray ray{.origin = corner, .direction = way, .tmax = 0.0f};
                ++rays;
                lost_nearest += !SlabConservative::intersect(ray, nearest.box(child)).has_value();
                lost += !SlabConservative::intersect(ray, outward.box(child)).has_value();
            }
        }
        fmt::print(
            "  up to {} away, of {} rays lost: {} by planes to the nearest, {} by outward "
            "ones\n",
            away, rays, lost_nearest, lost);
        CHECK(lost_nearest > rays / 100);
        CHECK(lost == 0);
    }
}

TEST_CASE("eight bits: quotients that doubles round lose no box either") {
    for (const float small : {0x1p-80f, 0x1p-30f, 1e-45f})
        for (const float scale : {1.0f, 0x1p20f, 0x1p60f}) {
            WideNode<8> node;
            for (std::size_t i = 0; i < 8; ++i) node.put(i, Aabb{}, {});
            const float at = small * scale;
            node.put(0, {Point3(-0x1p60f * scale), Point3(0x1p60f * scale)}, {});
            node.put(1, {Point3(-at), Point3(-at)}, {});
            node.put(2, {Point3(at), Point3(at)}, {});
            const CompressedNode packed = compressed(node);
            CAPTURE(small, scale);
            REQUIRE(packed.count == 3);
            for (std::size_t i = 0; i < 3; ++i) REQUIRE(packed.box(i).contains(node.box(i)));
        }
}

TEST_CASE(
    "leaves: a float test loses hits at edges and vertices of a closed mesh; ours loses none") {
    const auto triangles = make_scene("icosphere", 1, true).mesh.triangles();
    RayMaker maker(triangles, 5);
    std::vector<Ray> rays;
    for (int i = 0; i < sized(20'000, 1'000); ++i)
        rays.push_back((i % 2 == 0 ? maker.at_edge() : maker.at_vertex()).ray);
    const auto in_float = WideBvh<8, BinnedBuilder, MollerTrumboreFloat>::build(triangles);
    const auto naive = Naive<FilteredExact>::build(triangles);
    std::size_t wrong = 0, lost = 0;
    for (const Ray& ray : rays) {
        const auto exact = closest_hit(naive, ray), got = closest_hit(in_float, ray);
        wrong +=
            exact.has_value() != got.has_value() || (exact && got->triangle != exact->triangle);
        lost += exact && !got;
    }
    fmt::print("  of {} aimed rays a test in float answers {} wrongly and loses {} altogether\n",
               rays.size(), wrong, lost);
    CHECK(wrong > rays.size() / 100);
    CHECK(lost > 0);
    CHECK(check_kernels(triangles, rays) > rays.size() / 2);
}

TEST_CASE("V9: a hit half a place farther may have the same t and the smaller index") {
    // Two walls at z = 0 and z = 1: from 2^26 away both have one t. The farther comes first.
    const std::vector<Triangle> walls{{{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}},
                                      {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}};
    const Ray ray{.origin = {0, 0, -0x1p26f}, .direction = {0, 0, 1}};
    const auto near = FilteredExact::intersect(ray, walls[1]);
    const auto far = FilteredExact::intersect(ray, walls[0]);
    REQUIRE((near && far && near->t == far->t));
    // A limit at the nearest t: the far wall begins beyond it, where t is exact. Here it is lost.
    const std::optional<Hit> nearest = closest_hit(Naive<FilteredExact>::build(walls), ray);
    REQUIRE(nearest->triangle == 0);
    for (const std::size_t leaf : {1u, 4u}) {
        std::vector<Triangle> more = walls;
        for (int i = 0; i < 40; ++i) {  // in leaves of their own
            const float x = float(20 * i);
            more.push_back({{x - 9, -9, 0.5f}, {x + 9, -9, 0.5f}, {x, 9, 0.5f}});
            more.push_back({{x - 9, -9, -3}, {x - 9, 9, -3}, {x - 9, 0, 3}});
        }
        const WideBvhConfig<BinnedBuilder> config{.binary = {.max_leaf_size = leaf},
                                                  .collapse = {.max_leaf = leaf}};
        std::vector<Ray> rays;
        for (int i = 0; i < 400; ++i)
            rays.push_back({.origin = {0.5f * float(i), 0.25f, -0x1p26f}, .direction = {0, 0, 1}});
        CHECK(check_kernels(more, rays, config) > 100);
    }
}

namespace {

/// Walls across x, each in a leaf of its own, and for each a ray that ends where it hits: where the
/// near plane of the wall's box, computed plainly, comes after the float behind that.
void add_walls(std::vector<Triangle>& walls, std::vector<Ray>& rays, std::size_t count) {
    Pcg32 random(15);
    while (rays.size() < count) {
        const float p = random.uniform(1.0f, 2.0f);
        const float o = random.uniform(-1.0f, 0.0f);
        const float d = random.uniform(0.5f, 2.0f);
        const float t = float((double{p} - double{o}) / double{d});
        if ((p - o) * (1.0f / d) <= std::nextafter(t, infinity)) continue;
        const float y = 10.0f * float(rays.size());
        walls.push_back({{p, y - 4, -4}, {p, y + 4, -4}, {p, y, 4}});
        rays.push_back({.origin = {o, y, -1}, .direction = {d, 1e-3f, 1e-3f}, .tmax = t});
    }
}

}  // namespace

TEST_CASE("a ray that ends at a wall meets the wall's box, though a plain plane comes too late") {
    std::vector<Triangle> walls;
    std::vector<Ray> rays;
    add_walls(walls, rays, 40);
    const WideBvhConfig<BinnedBuilder> config{.binary = {.max_leaf_size = 1},
                                              .collapse = {.max_leaf = 1}};
    CHECK(check_kernels(walls, rays, config) == rays.size());
    for_each_kernel_of<8, BinnedBuilder>(
        walls,
        [&](const auto& tree, const std::string&) {
            for (const ManyQuery query : {ManyQuery::closest, ManyQuery::any}) {
                std::size_t hits = 0;
                trace_in_packets(
                    tree, rays, 8, query,
                    [&](std::size_t, const std::optional<Hit>& hit) { hits += hit.has_value(); });
                CHECK(hits == rays.size());
            }
        },
        config);
}

TEST_CASE("B1, B2: rays that lie in planes of boxes, zeros of either sign") {
    const auto triangles = scenes::soup(400, 0.2f, 6);
    std::vector<Ray> rays;
    RayMaker maker(triangles, 7);
    for (int i = 0; i < sized(6'000, 600); ++i)
        rays.push_back((i % 2 == 0 ? maker.axis_parallel() : maker.within_a_slab()).ray);
    // In the planes of one box exactly, along its edges.
    for (const Triangle& t : triangles) {
        const Aabb box = bounds(t);
        for (int axis = 0; axis < 3; ++axis) {
            Ray ray{.origin = box.min, .direction = Vector3(-0.0f)};
            ray.direction[axis] = 1.0f;
            ray.origin[axis] -= 1.0f;
            rays.push_back(ray);
            ray.origin = box.max;
            ray.direction[axis] = -1.0f;
            rays.push_back(ray);
        }
    }
    CHECK(check_kernels(triangles, rays) > rays.size() / 10);
    const auto walls = scenes::mapped(triangles, [](const Point3& p) {
        return Point3(0.25f * std::round(4.0f * p.x), p.y, 0.25f * std::round(4.0f * p.z));
    });
    CHECK(check_kernels(walls, rays) > rays.size() / 20);
}

namespace {

/// A chain: each node has a leaf of one triangle, and all the later ones.
struct ChainBuilder {
    struct Config {
        BvhCosts costs = {};
    };
    template <int D>
    static BvhNodes<3> build(std::span<const Triangle> triangles, const Config&) {
        const auto depth = std::uint32_t(triangles.size() - 1);
        BvhNodes<3> tree;
        tree.depth = depth;
        tree.nodes.resize(2 * depth + 2);
        Aabb box = bounds(triangles[depth]);
        tree.nodes[2 * depth + 1] = {box, depth, 1};
        for (std::uint32_t i = depth; i-- > 0;) {
            tree.nodes[2 * i + 2] = {bounds(triangles[i]), i, 1};
            box.extend(bounds(triangles[i]));
            tree.nodes[i == 0 ? 0 : 2 * i + 1] = {box, 2 * i + 2, 0};
        }
        for (std::uint32_t i = 0; i <= depth; ++i) tree.references.push_back(i);
        return tree;
    }
};

/// Triangles above each other, z = 0, 1, 2, ...; one is on the z axis, only the boxes of the others
/// are.
std::vector<Triangle> tower(std::uint32_t height, std::uint32_t hit) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < height; ++i) {
        const auto z = static_cast<float>(i);
        triangles.push_back(i == hit ? Triangle{{-1, -1, z}, {2, -1, z}, {-1, 2, z}}
                                     : Triangle{{-0.75f, 1, z}, {1, -0.75f, z}, {1, 1, z}});
    }
    return triangles;
}

}  // namespace

TEST_CASE("V8: the stack is as deep as the tree, and a tree that is too deep is refused") {
    for (const std::uint32_t height : {2u, 5u, 64u, 400u})
        for (const std::uint32_t hit : {0u, height / 2, height - 1}) {
            const auto triangles = tower(height, hit);
            const WideBvhConfig<ChainBuilder> config{.collapse = {.max_leaf = 1}};
            std::vector<Ray> rays;
            for (const float z : {-10.0f, 10.0f + float(height)})
                for (int i = 0; i < 20; ++i)
                    rays.push_back({.origin = {0.01f * float(i), 0.005f * float(i), z},
                                    .direction = {0, 0, z < 0 ? 1.0f : -1.0f}});
            CAPTURE(height, hit);
            CHECK(check_kernels(triangles, rays, config) > rays.size() / 2);
            for_each_kernel(
                triangles,
                [&](const auto& bvh, const std::string&) {
                    REQUIRE(wide_faults(bvh.tree(), triangles) == "");
                },
                config);
        }
    const auto too_many = tower(3'000, 1);
    CHECK_THROWS_AS((WideBvh<4, ChainBuilder>::build(too_many, {.collapse = {.max_leaf = 1}})),
                    LimitError);
    CHECK_THROWS_AS((WideBvh<8, ChainBuilder>::build(too_many, {.collapse = {.max_leaf = 1}})),
                    LimitError);
}

TEST_CASE("V1, T7: copies, points and lines, and vertices that are no numbers") {
    const Triangle one{{0, 0, 0}, {1, 0.1f, 0.3f}, {0.2f, 1, 1}};
    for (const std::size_t count : {1u, 2u, 4u, 5u, 31u, 32u, 33u, 257u, 5'000u}) {
        const std::vector<Triangle> copies(count, one);
        RayMaker maker(copies, 4);
        std::vector<Ray> rays;
        for (int i = 0; i < 100; ++i) rays.push_back(maker.random().ray);
        rays.push_back(maker.probe(one));
        rays.push_back(maker.at_vertex().ray);
        CAPTURE(count);
        CHECK(check_kernels(copies, rays) > 0);
    }
    auto broken = scenes::soup(300, 0.3f, 8);
    const float bad[] = {std::nanf(""), infinity, -infinity};
    for (std::size_t i = 0; i < 60; ++i) broken[5 * i].b[int(i % 3)] = bad[i / 3 % 3];
    for (std::size_t i = 0; i < 30; ++i) broken[5 * i + 1].b = broken[5 * i + 1].a;
    for (std::size_t i = 0; i < 30; ++i)
        broken[5 * i + 2] = {Point3(0.5f), Point3(0.5f), Point3(0.5f)};
    std::vector<Triangle> sound;
    for (const Triangle& t : broken)
        if (!box_if_finite<3>(t).is_empty()) sound.push_back(t);
    RayMaker maker(sound, 9);
    std::vector<Ray> rays;
    for (int i = 0; i < sized(3'000, 300); ++i) rays.push_back(maker.random().ray);
    CHECK(check_kernels(broken, rays) > 100);
    for_each_kernel(broken, [&](const auto& bvh, const std::string&) {
        REQUIRE(wide_faults(bvh.tree(), broken) == "");
    });
    for (const std::vector<Triangle>& none :
         {std::vector<Triangle>{}, std::vector<Triangle>(7, broken[0])})
        CHECK(check_kernels(none, rays) == 0);
}

TEST_CASE(
    "V4: coordinates from denormal to the largest, also where floats in kernels would not do") {
    for (const float scale :
         {1e-44f, 1e-38f, 1e-30f, 1e-12f, 1e6f, 0x1p29f, 0x1p30f, 0x1p31f, 1e30f, 1.5e38f}) {
        const auto triangles = scenes::mapped(scenes::soup(200, 0.3f, 10),
                                              [&](const Point3& p) { return (p - 0.5f) * scale; });
        RayMaker maker(triangles, 11);
        std::vector<Ray> rays;
        for (int i = 0; i < sized(1'500, 200); ++i) {
            rays.push_back((i % 3 == 0   ? maker.at_edge()
                            : i % 3 == 1 ? maker.at_vertex()
                                         : maker.random())
                               .ray);
            if (i % 5 == 0) rays.back().direction *= 0x1p-60f;
            if (i % 7 == 0 && scale < 1e20f) rays.back().direction *= 0x1p40f;
        }
        CAPTURE(scale);
        check_kernels(triangles, rays);
    }
}

TEST_CASE("rays with denormal directions, with ends at hits, before the origin, or beyond floats") {
    const auto triangles = scenes::soup(300, 0.3f, 12);
    const auto naive = Naive<FilteredExact>::build(triangles);
    RayMaker maker(triangles, 13);
    std::vector<Ray> rays;
    for (int i = 0; i < sized(1'000, 100); ++i) {
        const Ray ray = maker.random().ray;
        Ray slow = ray;
        slow.direction[i % 3] = i % 2 == 0 ? 1e-44f : -1e-40f;
        rays.push_back(slow);
        slow.direction *= 1e-38f;
        rays.push_back(slow);
        if (const auto hit = closest_hit(naive, ray))
            for (const TestRay& cut : RayMaker::cut_at(ray, hit->t)) rays.push_back(cut.ray);
    }
    for (const TestRay& invalid : maker.invalid()) rays.push_back(invalid.ray);
    CHECK(check_kernels(triangles, rays) > 1'000u / sized(1u, 10u));
}

TEST_CASE("flat scenes, seen from above, from the side and from within their plane") {
    for (const int axis : {0, 1, 2}) {
        const auto triangles = scenes::mapped(scenes::soup(300, 0.2f, 14), [&](Point3 p) {
            p[axis] = 0.25f;
            return p;
        });
        RayMaker maker(triangles, 15);
        std::vector<Ray> rays;
        for (int i = 0; i < sized(2'000, 200); ++i) {
            Ray ray = maker.random().ray;
            if (i % 4 == 0) ray.origin[axis] = 0.25f;
            if (i % 8 == 0) ray.direction[axis] = i % 16 == 0 ? 0.0f : -0.0f;
            rays.push_back(ray);
            rays.push_back(maker.at_edge().ray);
        }
        CAPTURE(axis);
        CHECK(check_kernels(triangles, rays) > 500u / sized(1u, 10u));
    }
}

}  // namespace space
