#include "chapters/ch02_intersection_tests/measured/timing.hpp"

#include "chapters/ch02_intersection_tests/branches.hpp"
#include "chapters/ch02_intersection_tests/measured/lichter_variants.hpp"
#include "chapters/ch02_intersection_tests/planes.hpp"
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "chapters/ch02_intersection_tests/square_roots.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>

namespace space::ch02 {
namespace {

/// Times functions that run in turns. Each does `tests` tests in a run.
class Race {
  public:
    void add(std::string name, std::function<void()> run) {
        names_.push_back(std::move(name));
        runs_.push_back(std::move(run));
    }
    std::vector<Timed> times(double tests, int rounds) const {
        const std::vector<double> ms = interleaved_medians(runs_, rounds);
        std::vector<Timed> times;
        for (std::size_t i = 0; i < ms.size(); ++i)
            times.push_back({names_[i], 1e6 * ms[i] / tests});
        return times;
    }

  private:
    std::vector<std::string> names_;
    std::vector<std::function<void()>> runs_;
};

/// A loop over leaves, their rays and their triangles: hit(ray, triangle) is asked, its answers are
/// summed up. noinline: each test gets a loop of its own, laid out alone.
template <class Test>
[[gnu::noinline]] float test_leaves(const Leaves& leaves, const auto& triangles) {
    float sum = 0.0f;
    for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
        const std::span in_leaf =
            std::span(triangles).subspan(leaf * leaves.leaf_size, leaves.leaf_size);
        for (const Ray& ray :
             std::span(leaves.rays).subspan(leaf * leaves.rays_per_leaf, leaves.rays_per_leaf)) {
            const auto ready = prepared<Test>(ray);
            for (const auto& triangle : in_leaf)
                if (const auto hit = Test::intersect(ready, triangle)) sum += hit->t;
        }
    }
    return sum;
}

/// The nearest hit of each ray in its leaf: the ray ends at the nearest so far. Flattened, so that
/// no variant pays for calls that another one is spared by the inliner's mood: the same cross
/// product, inlined or called, moves the time by more than a root.
template <class Test>
[[gnu::noinline, gnu::flatten]] float nearest_in_leaves(const Leaves& leaves) {
    float sum = 0.0f;
    for (std::size_t leaf = 0; leaf < leaves.count(); ++leaf) {
        const std::span in_leaf =
            std::span(leaves.triangles).subspan(leaf * leaves.leaf_size, leaves.leaf_size);
        for (Ray ray :
             std::span(leaves.rays).subspan(leaf * leaves.rays_per_leaf, leaves.rays_per_leaf)) {
            for (const Triangle& triangle : in_leaf)
                if (const auto hit = Test::intersect(ray, triangle)) {
                    ray.tmax = hit->t;
                    sum += hit->u;
                }
            sum += ray.tmax < infinity ? ray.tmax : 0.0f;
        }
    }
    return sum;
}

template <class Test>
auto prepared_triangles(const std::vector<Triangle>& triangles) {
    std::vector<decltype(prepared<Test>(triangles[0]))> ready;
    for (const Triangle& triangle : triangles) ready.push_back(prepared<Test>(triangle));
    return ready;
}

}  // namespace

// --- triangles ---

Leaves make_leaves(const std::string& scene, std::span<const Triangle> triangles,
                   std::size_t leaves, std::uint64_t seed) {
    Leaves result{.scene = scene,
                  .leaf_size = std::min<std::size_t>(8, triangles.size()),
                  .rays_per_leaf = 64,
                  .triangles = {},
                  .rays = {}};
    Pcg32 random(seed);
    std::vector<Point3> middles;
    Aabb all;
    for (const Triangle& triangle : triangles) {
        middles.push_back(bounds(triangle).centroid());
        all.extend(bounds(triangle));
    }
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
        const Point3 middle = middles[random.below(static_cast<std::uint32_t>(triangles.size()))];
        const auto nearer_to_middle = [&](std::uint32_t i, std::uint32_t j) {
            const Vector3 a = middles[i] - middle, b = middles[j] - middle;
            const float da = glm::dot(a, a), db = glm::dot(b, b);
            return da < db || (da == db && i < j);
        };
        std::partial_sort(order.begin(),
                          order.begin() + static_cast<std::ptrdiff_t>(result.leaf_size),
                          order.end(), nearer_to_middle);
        Aabb box;
        for (std::size_t i = 0; i < result.leaf_size; ++i) {
            result.triangles.push_back(triangles[order[i]]);
            box.extend(bounds(result.triangles.back()));
        }
        const double reach = glm::length(Double3(all.extent()));
        for (std::size_t i = 0; i < result.rays_per_leaf; ++i) {
            const Double3 share = 0.5 + 0.5 * Double3(random_vector(random));
            const Double3 target = Double3(box.min) + share * Double3(box.extent());
            const Double3 away = random_direction(random);
            result.rays.push_back(
                {.origin = Point3(target + reach * away), .direction = Vector3(-away)});
        }
    }
    return result;
}

Leaves random_leaves(std::size_t leaves, std::uint64_t seed) {
    Leaves result{
        .scene = "random", .leaf_size = 8, .rays_per_leaf = 64, .triangles = {}, .rays = {}};
    Pcg32 random(seed);
    for (std::size_t i = 0; i < leaves * result.leaf_size; ++i)
        result.triangles.push_back(
            {random_vector(random), random_vector(random), random_vector(random)});
    for (std::size_t i = 0; i < leaves * result.rays_per_leaf; ++i) {
        const Double3 origin = 3.0 * random_direction(random);
        result.rays.push_back({.origin = Point3(origin),
                               .direction = Vector3(Double3(random_vector(random)) - origin)});
    }
    return result;
}

std::vector<Timed> time_triangle_tests(const Leaves& leaves, int rounds) {
    Race race;
    for_each_named(triangle_tests, [&](std::size_t, const auto& named) {
        using Test = TestOf<decltype(named)>;
        race.add(std::string(named.name),
                 [&leaves, ready = prepared_triangles<Test>(leaves.triangles)] {
                     do_not_optimize(test_leaves<Test>(leaves, ready));
                 });
    });
    return race.times(static_cast<double>(leaves.tests()), rounds);
}

std::vector<Timed> time_stages(const Leaves& leaves, int rounds) {
    struct ExpansionsOnly {
        static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
            const auto volumes = expansion_volumes(ray, triangle);
            if (!volumes.line_hits()) return std::nullopt;
            return Hit{.t = static_cast<float>(volumes.t.value() / volumes.det.value())};
        }
    };
    Race race;
    race.add("filter first",
             [&] { do_not_optimize(test_leaves<FilteredExact>(leaves, leaves.triangles)); });
    race.add("expansions only",
             [&] { do_not_optimize(test_leaves<ExpansionsOnly>(leaves, leaves.triangles)); });
    return race.times(static_cast<double>(leaves.tests()), rounds);
}

std::vector<Timed> time_lichter_tests(const Leaves& leaves, int rounds) {
    Race race;
    race.add("first", [&] { do_not_optimize(nearest_in_leaves<LichterFirst>(leaves)); });
    const auto add = [&]<class Variant>(const char* name, Variant) {
        race.add(name, [&] { do_not_optimize(nearest_in_leaves<Variant>(leaves)); });
    };
    add("two roots", LichterVariant<false, false, 2>());
    add("roots for hits", LichterVariant<false, true, 2>());
    add("exit", LichterVariant<true, false, 3>());
    add("exit, roots last", LichterVariant<true, true, 3>());
    race.add("improved", [&] { do_not_optimize(nearest_in_leaves<LichterImproved>(leaves)); });
    return race.times(static_cast<double>(leaves.tests()), rounds);
}

namespace {

/// One ray per leaf, so that every test's outcome is drawn by itself.
Leaves leaves_of(Pattern pattern) {
    Leaves leaves{.scene = "", .leaf_size = 8, .rays_per_leaf = 1, .triangles = {}, .rays = {}};
    Pcg32 random(1);
    for (int leaf = 0; leaf < 4096; ++leaf) {
        const Double3 origin = 3.0 * random_direction(random),
                      target = 0.5 * Double3(random_vector(random));
        leaves.rays.push_back({.origin = Point3(origin), .direction = Vector3(target - origin)});
        for (std::size_t i = 0; i < leaves.leaf_size; ++i) {
            const Double3 ab(random_vector(random)), ac(random_vector(random));
            const bool hits = pattern == Pattern::all_hit ||
                              (pattern == Pattern::unpredictable && random.below(2));
            double u, v;  // where the ray is to meet the triangle's plane
            do {
                u = hits ? random.uniform_double() : 4.0 * random.uniform_double() - 1.5;
                v = hits ? random.uniform_double() : 4.0 * random.uniform_double() - 1.5;
            } while (hits != (u >= 0.0 && v >= 0.0 && u + v <= 1.0));
            if (pattern == Pattern::all_miss) u = -1.0 - random.uniform_double();
            const Double3 a = target - u * ab - v * ac;
            leaves.triangles.push_back({Point3(a), Point3(a + ab), Point3(a + ac)});
        }
    }
    return leaves;
}

}  // namespace

std::vector<Timed> time_orders(Pattern pattern, int rounds) {
    const Leaves leaves = leaves_of(pattern);
    Race race;
    race.add("cheap first",
             [&] { do_not_optimize(test_leaves<CheapFirst>(leaves, leaves.triangles)); });
    race.add("expensive first",
             [&] { do_not_optimize(test_leaves<ExpensiveFirst>(leaves, leaves.triangles)); });
    race.add("decide last",
             [&] { do_not_optimize(test_leaves<DecideLast>(leaves, leaves.triangles)); });
    return race.times(static_cast<double>(leaves.tests()), rounds);
}

// --- square roots ---

namespace {

/// Roots of 4096 numbers of many sizes, one after the other; each result is kept, so that no loop
/// is vectorised.
template <class Root>
[[gnu::noinline]] void root_loop(std::span<const float> numbers, const Root& root) {
    for (const float a : numbers) do_not_optimize(root(a));
}
template <class Root>
[[gnu::noinline]] void root_loop_by_four(std::span<const float> numbers, const Root& root) {
    for (std::size_t i = 0; i < numbers.size(); i += 4) root(numbers.subspan(i).first<4>());
}

template <int Rounds>
void add_newton_forms(Race& race, std::span<const float> numbers) {
    const auto add = [&](const char* form, auto loop) {
        race.add(form + std::to_string(Rounds), loop);
    };
    add("Newton ", [=] { root_loop(numbers, [](float a) { return newton_root<Rounds>(a); }); });
    add("careful ",
        [=] { root_loop(numbers, [](float a) { return careful_newton_root<Rounds>(a); }); });
    add("reciprocal ",
        [=] { root_loop(numbers, [](float a) { return a * reciprocal_newton_root<Rounds>(a); }); });
    add("four in an array ", [=] {
        root_loop_by_four(numbers, [](std::span<const float, 4> a) {
            float roots[4];
            newton_roots<Rounds>(a, roots);
            do_not_optimize(roots);
        });
    });
    add("vector type ", [=] {
        root_loop_by_four(numbers, [](std::span<const float, 4> a) {
            do_not_optimize(newton_root<Rounds>(Float4{a[0], a[1], a[2], a[3]}));
        });
    });
    add("std::simd ", [=] {
        root_loop_by_four(numbers, [](std::span<const float, 4> a) {
            do_not_optimize(
                newton_root<Rounds>(Simd4(a.data(), std::experimental::element_aligned)));
        });
    });
}

}  // namespace

std::vector<TimedRoot> time_roots(int rounds) {
    Pcg32 random(1);
    std::vector<float> numbers(4096);
    for (float& a : numbers) {
        const int exponent = static_cast<int>(random.below(40)) - 20;
        a = std::ldexp(1.0f + random.uniform(), exponent);
    }

    Race race;
    add_newton_forms<0>(race, numbers);
    add_newton_forms<1>(race, numbers);
    add_newton_forms<2>(race, numbers);
    add_newton_forms<3>(race, numbers);
    add_newton_forms<4>(race, numbers);
#if defined(__SSE__)
    race.add("estimate 0", [&] {
        root_loop(numbers, [](float a) { return a * hardware_reciprocal_root<0>(a); });
    });
    race.add("estimate 1", [&] {
        root_loop(numbers, [](float a) { return a * hardware_reciprocal_root<1>(a); });
    });
    race.add("estimate 2", [&] {
        root_loop(numbers, [](float a) { return a * hardware_reciprocal_root<2>(a); });
    });
    race.add("four by the processor", [&] {
        root_loop_by_four(numbers, [](std::span<const float, 4> a) {
            do_not_optimize(_mm_sqrt_ps(_mm_loadu_ps(a.data())));
        });
    });
#endif
    race.add("std::sqrt", [&] { root_loop(numbers, [](float a) { return std::sqrt(a); }); });
    float (*volatile sqrt_call)(float) =
        ::sqrtf;  // volatile: stays a call, as it is without optimisation
    race.add("sqrtf as a call", [&] { root_loop(numbers, sqrt_call); });
    std::vector<TimedRoot> times;
    for (const Timed& timed : race.times(static_cast<double>(numbers.size()), rounds)) {
        const char last = timed.test.back();
        times.push_back({timed.test, last >= '0' && last <= '4' ? last - '0' : 0, timed.ns});
    }
    return times;
}

// --- boxes, spheres, planes ---

namespace {

/// All shapes against all rays: the number of hits.
template <class Test, class Shape>
[[gnu::noinline]] std::uint64_t test_all(const std::vector<Ray>& rays,
                                         const std::vector<Shape>& shapes) {
    std::uint64_t hits = 0;
    for (const Ray& ray : rays) {
        const auto ready = prepared<Test>(ray);
        for (const Shape& shape : shapes) {
            if constexpr (requires { Test::hits(ready, shape); })
                hits += Test::hits(ready, shape);
            else
                hits += Test::intersect(ready, shape).has_value();
        }
    }
    return hits;
}

}  // namespace

std::vector<Timed> time_box_tests(Pattern pattern, int rounds) {
    Pcg32 random(1);
    std::vector<Ray> rays;
    std::vector<Aabb> boxes;
    for (int i = 0; i < 512; ++i) {
        const Point3 middle = 0.25f * random_vector(random);
        const Vector3 half = 0.25f + 0.2f * random_vector(random);
        boxes.push_back({middle - half, middle + half});
    }
    for (int i = 0; i < 64; ++i) {
        Double3 away = random_direction(random);
        Double3 target = 0.05 * Double3(random_vector(random));
        if (pattern != Pattern::unpredictable) away = glm::abs(away);
        if (pattern ==
            Pattern::all_miss) {  // beside all boxes, and parallel to them but for a little
            away = glm::normalize(Double3(0.01 * away.x, away.y, away.z));
            target = {5.0, 0.0, 0.0};
        }
        if (pattern == Pattern::unpredictable) target = 0.55 * Double3(random_vector(random));
        rays.push_back({.origin = Point3(target + 3.0 * away), .direction = Vector3(-away)});
    }
    if (pattern == Pattern::all_hit)
        for (Aabb& box : boxes) box = {box.min - 0.5f, box.max + 0.5f};
    Race race;
    for_each_named(box_tests, [&](std::size_t, const auto& named) {
        race.add(std::string(named.name),
                 [&] { do_not_optimize(test_all<TestOf<decltype(named)>>(rays, boxes)); });
    });
    return race.times(static_cast<double>(rays.size() * boxes.size()), rounds);
}

std::vector<Timed> time_sphere_tests(int rounds) {
    Pcg32 random(1);
    std::vector<Ray> rays;
    std::vector<Sphere> spheres;
    for (int i = 0; i < 512; ++i)
        spheres.push_back({0.5f * random_vector(random), random.uniform(0.2f, 0.8f)});
    for (int i = 0; i < 64; ++i) {
        const Double3 away = random_direction(random);
        const Double3 target = 0.5 * Double3(random_vector(random));
        rays.push_back({.origin = Point3(target + 3.0 * away), .direction = Vector3(-away)});
    }
    Race race;
    for_each_named(sphere_tests, [&](std::size_t, const auto& named) {
        race.add(std::string(named.name),
                 [&] { do_not_optimize(test_all<TestOf<decltype(named)>>(rays, spheres)); });
    });
    return race.times(static_cast<double>(rays.size() * spheres.size()), rounds);
}

namespace {

template <class Plane>
[[gnu::noinline]] void meet_planes(const std::vector<Ray>& rays, const std::vector<Plane>& planes) {
    float sum = 0.0f;
    for (const Ray& ray : rays)
        for (const Plane& plane : planes) sum += plane_t(ray, plane);
    do_not_optimize(sum);
}

}  // namespace

std::vector<Timed> time_planes(int rounds) {
    Pcg32 random(1);
    std::vector<Ray> rays;
    std::vector<Plane> planes;
    std::vector<AxisPlane> axis_planes;
    for (int i = 0; i < 512; ++i) {
        planes.push_back({Vector3(random_direction(random)), random.uniform(-1.0f, 1.0f)});
        axis_planes.push_back({static_cast<int>(random.below(3)), random.uniform(-1.0f, 1.0f)});
    }
    for (int i = 0; i < 64; ++i)
        rays.push_back(
            {.origin = random_vector(random), .direction = Vector3(random_direction(random))});
    Race race;
    race.add("general", [&] { meet_planes(rays, planes); });
    race.add("axis-aligned", [&] { meet_planes(rays, axis_planes); });
    return race.times(static_cast<double>(rays.size() * planes.size()), rounds);
}

}  // namespace space::ch02
