// Rays on which a walk could lose a hit: at splitting planes, within them, from them, along axes,
// far away, huge and tiny. Every answer must be exact arithmetic's.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace space {
namespace {

using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;

#ifdef BOOK_SANITIZED
constexpr int rays_each = 200, oracle_rays = 20, samples = 2'000;
#else
constexpr int rays_each = 2'500, oracle_rays = 100, samples = 300'000;
#endif

/// Where planes cut cells, and what rays may do there.
class PlaneRays {
  public:
    PlaneRays(const KdNodes<3>& tree, std::span<const Triangle> triangles, std::uint64_t seed)
        : triangles_(triangles), maker_(triangles, seed), random_(seed, 3) {
        tree.for_each_cell([&](std::uint32_t index, const Aabb& cell, std::size_t) {
            const KdNode node = tree.nodes[index];
            if (!node.is_leaf()) cuts_.push_back({{node.axis(), node.position()}, cell});
        });
        box_ = tree.box;
    }

    TestRay next() {
        if (cuts_.empty() || triangles_.empty()) return maker_.random();
        const auto& [split, cell] = cuts_[random_.below(std::uint32_t(cuts_.size()))];
        const Point3 p = random_point(random_, cell);
        Point3 target = p;
        target[split.axis] = split.position;
        const float sign = random_.below(2) ? 1.0f : -1.0f;
        Ray ray{.origin = target, .direction = random_vector(random_)};
        switch (random_.below(9)) {
            case 0:
                return maker_.at_edge();
            case 1:
                return maker_.at_vertex();
            case 2:
                return maker_.axis_parallel();
            case 3: {  // at a point of the plane, from outside
                ray.origin = outside();
                ray.direction = target - ray.origin;
                return {"at a plane", ray};
            }
            case 4:
                return {"from a plane", ray};
            case 5: {  // all the way within the plane, which a zero of either sign says
                ray.origin = outside();
                ray.direction = target - ray.origin;
                ray.origin[split.axis] = split.position;
                ray.direction[split.axis] = 0.0f * sign;
                return {"within a plane", ray};
            }
            case 6: {  // the same along another axis
                const int along = (split.axis + 1 + int(random_.below(2))) % 3;
                ray.direction = Vector3(0.0f * sign);
                ray.direction[along] = sign;
                ray.origin[along] = sign > 0 ? box_.min[along] : box_.max[along];
                return {"along a plane", ray};
            }
            case 7: {  // nearly within the plane
                ray.origin = outside();
                ray.direction = target - ray.origin;
                ray.origin[split.axis] = std::nextafter(split.position, sign * infinity);
                ray.direction[split.axis] = sign * 1e-30f;
                return {"nearly within a plane", ray};
            }
            default: {  // where an edge meets the plane
                const Triangle& t = triangles_[random_.below(std::uint32_t(triangles_.size()))];
                const int edge = int(random_.below(3));
                const Double3 a(t[edge]), b(t[(edge + 1) % 3]);
                const double s = (split.position - a[split.axis]) / (b[split.axis] - a[split.axis]);
                if (s >= 0.0 && s <= 1.0) target = Point3(a + s * (b - a));
                ray.origin = outside();
                ray.direction = target - ray.origin;
                return {"at an edge in a plane", ray};
            }
        }
    }

  private:
    Point3 outside() {
        return box_.centroid() + 1.5f * random_vector(random_) * glm::max(box_.extent(), 1e-30f);
    }

    struct Cut {
        KdSplit split;
        Aabb cell;
    };
    std::span<const Triangle> triangles_;
    RayMaker maker_;
    Pcg32 random_;
    std::vector<Cut> cuts_;
    Aabb box_;
};

/// By default, with small leaves, by another rule, and with straddlers in inner nodes.
std::vector<KdTree<>> trees_over(std::span<const Triangle> triangles) {
    std::vector<KdTree<>> trees;
    for (const KdTreeConfig& config :
         {KdTreeConfig{}, KdTreeConfig{.costs = {.traversal = 0.01}},
          KdTreeConfig{.rule = Rule::middle}, KdTreeConfig{.straddlers = Straddlers::keep}})
        trees.push_back(KdTree<>::build(triangles, config));
    return trees;
}

/// Rays at the planes of each tree in turn. Every tree must answer every ray as the naive loop
/// does; some answers are held against the exact oracle, too.
void check_scene(const TestScene& scene, int rays, int by_oracle) {
    INFO(scene.name);
    const std::vector<KdTree<>> trees = trees_over(scene.triangles);
    const auto naive = Naive<FilteredExact>::build(scene.triangles);
    const ExactOracle oracle = ExactOracle::build(scene.triangles);
    std::vector<PlaneRays> makers;
    for (const KdTree<>& kd : trees)
        makers.emplace_back(kd.nodes(), scene.triangles, 17 + makers.size());
    for (int i = 0; i < rays; ++i) {
        auto [kind, ray] = makers[std::size_t(i) % makers.size()].next();
        if (ray.direction == Vector3(0.0f)) continue;
        if (i % 7 == 0) ray.tmin = -infinity;
        const auto expected = closest_hit(naive, ray);
        for (std::size_t k = 0; k < trees.size(); ++k) {
            const auto got = closest_hit(trees[k], ray);
            const bool any = any_hit(trees[k], ray);
            if (got == expected && any == expected.has_value()) continue;
            CAPTURE(kind, k, expected.has_value() ? expected->t : -1.0f,
                    got.has_value() ? got->t : -1.0f);
            CHECK(got == expected);
            CHECK(any == expected.has_value());
            return;  // one is enough
        }
        if (i % std::max(1, rays / by_oracle) == 0)
            CHECK(!compare(oracle, ray, expected).is_wrong());
    }
}

std::vector<TestScene> walked_scenes() {
    using namespace scenes;
    std::vector<TestScene> all = extreme_scenes();
    all.push_back({"around zero", mapped(soup(60, 0.4f, 32), [](const Point3& p) {
                       return glm::round(p * 4.0f) * 0.0f + glm::round(p * 4.0f) - 2.0f;
                   })});
    all.push_back({"walls in planes", sheet(4, 4, [](int i, int j) { return Point3(0, i, j); })});
    for (const Triangle& t : sheet(4, 4, [](int i, int j) { return Point3(i, 0, j); }))
        all.back().triangles.push_back(t);
    for (const Triangle& t : sheet(4, 4, [](int i, int j) { return Point3(2, i, j); }))
        all.back().triangles.push_back(t);
    return all;
}

void check_all(int rays, int by_oracle) {
    for (const TestScene& scene : walked_scenes()) check_scene(scene, rays, by_oracle);
    for (const TestScene& scene : some_of(adversarial_scenes()))
        check_scene(scene, rays, by_oracle);
}

}  // namespace

TEST_CASE("rays at planes, edges and vertices, and along planes, are answered exactly") {
    check_all(rays_each, oracle_rays);
}

TEST_CASE("the same with a million rays a scene", "[.big]") {
    check_all(1'000'000, 10'000);
}

TEST_CASE("distances to planes: the largest error stays below its bound, and comes near it") {
    Pcg32 random(1);
    double worst = 0.0;
    for (int i = 0; i < samples; ++i) {
        const auto number = [&] {
            const float mantissa = random.uniform(1.0f, 2.0f);
            const int exponent = int(random.below(8)) - 4;
            const float sign = random.below(2) != 0 ? 1.0f : -1.0f;
            return sign * std::ldexp(mantissa, exponent);
        };
        Ray ray{Point3(number()), Vector3(number())};
        const float position = number();
        const double t = KdRay<3>(ray).distance(0, position);
        const mpq_class exact = (mpq_class(double{position}) - double{ray.origin.x}) /
                                mpq_class(double{ray.direction.x});
        if (exact == 0) {
            CHECK(t == 0.0);
            continue;
        }
        const mpq_class part = abs((mpq_class(t) - exact) / exact) * mpq_class(0x1p53) / 3;
        worst = std::max(worst, part.get_d());
        // The ends that the plane makes lie beyond it, so far that other distances need no margin.
        RayPart ends{-RayPart::largest, RayPart::largest};
        ends.begin_at(t);
        ends.end_at(t);
        const mpq_class spare = 3 * abs(exact) * mpq_class(0x1p-53);
        REQUIRE(mpq_class(ends.enter) < exact - spare);
        REQUIRE(mpq_class(ends.leave) > exact + spare);
    }
    fmt::print("  distance to a plane: the largest error is {:.3f} of gamma(3)\n", worst);
    CHECK(worst < 1.0);
    CHECK(worst > sized(0.6, 0.5));  // fewer samples come less near
}

TEST_CASE("clipped corners: the largest error stays below its margin, and is no tenth of it") {
    Pcg32 random(2);
    double worst = 0.0;
    for (int i = 0; i < samples / 10; ++i) {
        ClippedPolygon<3> polygon;
        std::array<Double3, 2> ends;
        for (Double3& end : ends) end = Double3(random_point(random, -1.0f, 1.0f));
        // From next to one end of the axis to next to the other.
        ends[0].y = random.uniform(0.9f, 1.0f);
        ends[1].y = random.uniform(-1.0f, -0.9f);
        polygon.push_back(ends[0]);
        polygon.push_back(ends[1]);
        const double position = random.uniform(-0.5f, 0.5f);
        if (!(std::min(ends[0].x, ends[1].x) < position &&
              position < std::max(ends[0].x, ends[1].x)))
            continue;
        const ClippedPolygon<3> part = polygon.clipped(0, position, 1.0);
        const mpq_class s = (mpq_class(position) - ends[0].x) / (mpq_class(ends[1].x) - ends[0].x);
        const mpq_class exact = mpq_class(ends[0].y) + s * (mpq_class(ends[1].y) - ends[0].y);
        for (std::size_t k = 0; k < part.size; ++k)
            if (part.corners[k].x == position) {
                const mpq_class off = abs(mpq_class(part.corners[k].y) - exact);
                const double bound = clipping_margin<3>(1.0) / 6.0;
                worst = std::max(worst, mpq_class(off / mpq_class(bound)).get_d());
            }
    }
    fmt::print("  a clipped corner: the largest error is {:.3f} of its margin\n", worst);
    CHECK(worst < 1.0);
    CHECK(worst > 0.1);
}

}  // namespace space
