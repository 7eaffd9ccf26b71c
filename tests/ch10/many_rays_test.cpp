#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "chapters/ch10_fast_traversal/sorted_stream.hpp"
#include "common/camera.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace space {
namespace {

using Answers = std::vector<std::optional<Hit>>;
using Tree = FastBvh<>;
/// A way to trace many rays: the answer to each.
using Way = std::function<Answers(const Tree&, std::span<const Ray>, ManyQuery)>;

/// Each ray must be answered once.
template <class Trace>
Answers answers_by(std::span<const Ray> rays, const Trace& trace) {
    Answers answers(rays.size());
    std::vector<int> times(rays.size());
    trace([&](std::size_t i, const std::optional<Hit>& hit) {
        answers[i] = hit;
        ++times[i];
    });
    CHECK(std::ranges::count(times, 1) == std::ssize(rays));
    return answers;
}

struct NamedWay {
    std::string name;
    Way way;
};
std::vector<NamedWay> ways() {
    std::vector<NamedWay> all;
    for (const std::size_t size : {1, 3, 16, 17, 32, 64})
        all.push_back({"packets of " + std::to_string(size),
                       [size](const Tree& tree, std::span<const Ray> rays, ManyQuery query) {
                           return answers_by(rays, [&](const auto& answer) {
                               trace_in_packets(tree, rays, size, query, answer);
                           });
                       }});
    for (const unsigned together : {1u, 2u, 7u, 32u})
        all.push_back({std::to_string(together) + " interleaved",
                       [together](const Tree& tree, std::span<const Ray> rays, ManyQuery query) {
                           return answers_by(rays, [&](const auto& answer) {
                               trace_interleaved(tree, rays, together, query, answer);
                           });
                       }});
    all.push_back({"a sorted stream of packets",
                   [](const Tree& tree, std::span<const Ray> rays, ManyQuery query) {
                       return answers_by(rays, [&](const auto& answer) {
                           const auto packets = [&](std::span<const Ray> sorted, const auto& put) {
                               trace_in_packets(tree, sorted, 16, query, put);
                           };
                           trace_sorted(rays, tree.tree().box, packets, answer);
                       });
                   }});
    return all;
}

/// Pixels' rays; rays in all directions; rays at vertices, along axes and in planes of faces, with
/// intervals that begin and end at hits; and such as are none.
std::vector<Ray> rays_through(const Scene& scene, const std::vector<Triangle>& triangles,
                              int side) {
    std::vector<Ray> rays;
    const std::vector<Ray> pixels = camera_rays(PixelGrid(scene.camera, side, side));
    for (const std::uint32_t pixel : tiled_order(side, side, 4)) rays.push_back(pixels[pixel]);
    const auto some = static_cast<std::size_t>(side * side);
    for (const Ray& ray : rays_within(triangles, some, 3)) rays.push_back(ray);
    Pcg32 random(7);
    for (std::size_t i = 0; i < some; ++i) {
        const Triangle& at = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
        Ray ray = rays[random.below(static_cast<std::uint32_t>(2 * some))];
        ray.direction = at.a - ray.origin;
        if (i % 4 == 1) ray.tmax = 1.0f;
        if (i % 4 == 2) ray.tmin = 1.0f;
        if (i % 4 == 3) ray.direction[static_cast<int>(random.below(3))] = 0.0f;
        rays.push_back(ray);
    }
    const float nan = std::nanf("");
    for (const Ray& odd :
         {Ray{{0, 0, 0}, {0, 0, 0}}, Ray{{nan, 0, 0}, {1, 1, 1}}, Ray{{0, 0, 0}, {1, nan, 1}},
          Ray{{0, 0, 0}, {1, 1, 1}, 2.0f, 1.0f}, Ray{{0, 0, 0}, {1, 1, 1}, -infinity, infinity},
          Ray{{infinity, 0, 0}, {1, 1, 1}}, Ray{{0, 0, 0}, {1e-40f, 1, 1}},
          Ray{{1e35f, 0, 0}, {-1e35f, 1, 1}}, Ray{{0, 0, 0}, {1, 1, 1}, -0.0f}})
        rays.insert(rays.begin() + static_cast<std::ptrdiff_t>(random.below(100)), odd);
    return rays;
}

TEST_CASE("many rays at once get the answers of single rays, to the last bit") {
    for (const char* name : {"stadium", "icosphere:12", "soup:2000", "slivers:300", "boxes:36"}) {
        const Scene scene = make_scene(name);
        const std::vector<Triangle> triangles = scene.mesh.triangles();
        const std::vector<Ray> rays = rays_through(scene, triangles, sized(64, 12));
        for (const InstructionSet set : usable_instruction_sets()) {
            Tree::Config config;
            config.instructions = set;
            const Tree tree = Tree::build(triangles, config);
            for (const ManyQuery query : {ManyQuery::closest, ManyQuery::any}) {
                const Answers wanted = answers_by(
                    rays, [&](const auto& put) { trace_singly(tree, rays, query, put); });
                for (const NamedWay& way : ways()) {
                    const Answers got = way.way(tree, rays, query);
                    for (std::size_t i = 0; i < rays.size(); ++i) {
                        const bool is_same = query == ManyQuery::any
                                                 ? got[i].has_value() == wanted[i].has_value()
                                                 : got[i] == wanted[i];
                        if (is_same) continue;
                        CAPTURE(name, name_of(set), way.name, i, rays[i], wanted[i], got[i]);
                        REQUIRE(is_same);
                    }
                }
            }
        }
    }
}

TEST_CASE("nothing is hit in an empty scene, and no rays are no work") {
    const Tree tree = Tree::build({});
    const std::vector<Ray> rays(20, Ray{{0, 0, 0}, {1, 1, 1}});
    for (const NamedWay& way : ways()) {
        CAPTURE(way.name);
        CHECK(way.way(tree, rays, ManyQuery::closest) == Answers(20));
        CHECK(way.way(tree, {}, ManyQuery::any).empty());
    }
}

TEST_CASE("packets of rays from one eye share their nodes") {
    const Scene scene = make_scene("stadium");
    const Tree tree = Tree::build(scene.mesh.triangles());
    if (!many_kernels(tree.instructions())) return;
    constexpr int side = 64;
    const std::vector<Ray> pixels = camera_rays(PixelGrid(scene.camera, side, side));
    std::vector<Ray> rays;
    for (const std::uint32_t pixel : tiled_order(side, side, 8)) rays.push_back(pixels[pixel]);
    std::uint64_t before = ~std::uint64_t{0};
    for (const std::size_t size : {2, 4, 16, 64}) {
        const PacketCounts counts = trace_in_packets(tree, std::span<const Ray>(rays), size,
                                                     ManyQuery::closest, [](auto, const auto&) {});
        CAPTURE(size, counts.nodes);
        CHECK(counts.nodes < before);
        before = counts.nodes;
    }
}

TEST_CASE("tiles hold every pixel once, and neighbours come together") {
    const std::vector<std::uint32_t> order = tiled_order(13, 7, 4);
    CHECK(std::set<std::uint32_t>(order.begin(), order.end()).size() == 13 * 7);
    CHECK(*std::ranges::max_element(order) == 13 * 7 - 1);
    CHECK(std::vector(order.begin(), order.begin() + 5) ==
          std::vector<std::uint32_t>{0, 1, 2, 3, 13});
    CHECK(std::vector(order.end() - 3, order.end()) == std::vector<std::uint32_t>{64, 77, 90});
}

TEST_CASE("a stream is sorted by octants first, and of like keys the first comes first") {
    Pcg32 random(11);
    std::vector<Ray> rays;
    for (int i = 0; i < 5'000; ++i) {
        const Point3 origin = random_point(random, -1.2f, 1.2f);
        rays.push_back({.origin = origin, .direction = random_vector(random)});
    }
    rays.push_back({.origin = Point3(std::nanf("")), .direction = {0, 0, 0}});
    rays.push_back(rays.front());
    const Aabb box{Point3(-1.0f), Point3(1.0f)};
    const std::vector<std::uint32_t> order = stream_order(rays, box);
    REQUIRE(std::set<std::uint32_t>(order.begin(), order.end()).size() == rays.size());
    const StreamKeys key_of(box);
    for (std::size_t i = 1; i < order.size(); ++i) {
        const std::uint32_t before = key_of(rays[order[i - 1]]), key = key_of(rays[order[i]]);
        REQUIRE((before < key || (before == key && order[i - 1] < order[i])));
        REQUIRE(key >> StreamKeys::bits == 0);
    }
    const auto octant = [&](std::size_t i) { return key_of(rays[order[i]]) >> 22; };
    std::size_t changes = 0;
    for (std::size_t i = 1; i < order.size(); ++i) changes += octant(i) != octant(i - 1);
    CHECK(changes == 7);
}

}  // namespace
}  // namespace space
