#include "tests/fuzz/answers.hpp"

#include "chapters/ch12_comparison/rays.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "tests/fuzz/kinds.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace space::fuzz {
namespace {

/// A soup that a fuzzer makes is small: who needs more than this is on the way to hang.
constexpr Limits limits{.references = 20'000, .placements = 200'000};

constexpr Query queries[] = {Query::closest, Query::any};

std::vector<HitRecord> answers_of(const BuiltStructure& built, std::span<const Ray> rays,
                                  Query query) {
    std::vector<HitRecord> hits(rays.size());
    built.trace({rays, hits, query});
    return hits;
}

void compare_with(std::span<const HitRecord> expected, const BuiltStructure& other,
                  std::string_view name, std::span<const Ray> rays, Query query) {
    const std::vector<HitRecord> got = answers_of(other, rays, query);
    std::vector<HitRecord> counted(rays.size());
    other.count({rays, counted, query});
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (!(got[i] == expected[i]) || !(counted[i] == expected[i]))
            fail(fmt::format(
                "{}, ray {}, query {}: t {} triangle {}, counting t {} triangle "
                "{}, naively t {} triangle {}",
                name, i, static_cast<int>(query), got[i].t, got[i].triangle, counted[i].t,
                counted[i].triangle, expected[i].t, expected[i].triangle));
}

}  // namespace

Answers::Answers(std::vector<Triangle> triangles, unsigned build_threads)
    : triangles_(std::move(triangles)) {
    for (const Structure& structure : structures()) {
        if (structure.name == "bvh-instanced-local") continue;  // not exact, as chapter 9 says
        const auto& build = structure.variants.front().build_from_triangles;
        try {
            built_.emplace_back(structure.name, build(triangles_, {build_threads, limits}));
        } catch (const LimitError&) {
        }
    }
}

void Answers::compare(std::span<const Ray> rays) const {
    for (const Query query : queries) {
        const std::vector<HitRecord> expected = answers_of(built_[0].second, rays, query);
        for (std::size_t i = 1; i < built_.size(); ++i)
            compare_with(expected, built_[i].second, built_[i].first, rays, query);
    }
}

void compare_instances(const SceneGraph& graph) {
    const std::vector<Triangle> triangles = flatten(graph);
    std::vector<Ray> rays;
    for (const Triangle& triangle : triangles) {
        rays.push_back(
            {.origin = {3.0f, 2.0f, 1.0f}, .direction = triangle.a - Point3(3.0f, 2.0f, 1.0f)});
        rays.push_back({.origin = triangle.a, .direction = triangle.b - triangle.a});
        rays.push_back({.origin = triangle.c, .direction = {0.0f, 0.0f, 1.0f}, .tmin = -infinity});
    }
    const BuiltStructure naive =
        structures().front().variants.front().build_from_triangles(triangles, {});
    for (const Structure& structure : structures()) {
        if (structure.name != "bvh-instanced") continue;
        const BuiltStructure built = structure.variants.front().build_from_graph(graph, {});
        for (const Query query : queries)
            compare_with(answers_of(naive, rays, query), built, structure.name, rays, query);
    }
}

}  // namespace space::fuzz
