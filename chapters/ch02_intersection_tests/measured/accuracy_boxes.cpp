#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/measured/chunks.hpp"
#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "chapters/ch02_intersection_tests/oriented_box.hpp"

#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace space::ch02 {
namespace {

void count(const RayAndBox& pair, BoxAccuracy& accuracy) {
    const bool hits = exactly_hits(pair.ray, pair.box);
    ++accuracy.pairs;
    accuracy.exact_hits += hits;
    for_each_named(box_tests, [&](std::size_t test, const auto& named) {
        const bool hit = TestOf<decltype(named)>::intersect(pair.ray, pair.box).has_value();
        accuracy.wrong[test].test = named.name;
        ++accuracy.wrong[test].decisions;
        accuracy.wrong[test].hits += hit && !hits;
        accuracy.wrong[test].misses += !hit && hits;
    });
}

/// The decision about a turned box in double: of the box as its float members say.
bool hits_in_double(const Ray& ray, const OrientedBox& box) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(box.axes));
    const Double3 origin = inverse * (Double3(ray.origin) - Double3(box.centre)),
                  direction = inverse * Double3(ray.direction);
    double enter = ray.tmin, leave = ray.tmax;
    for (int axis = 0; axis < 3; ++axis) {
        const double t0 = (-box.half[axis] - origin[axis]) / direction[axis];
        const double t1 = (box.half[axis] - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave;
}

}  // namespace

BoxAccuracy lattice_box_accuracy() {
    BoxAccuracy accuracy;
    for (const RayAndBox& pair : lattice_boxes()) count(pair, accuracy);
    return accuracy;
}

BoxAccuracy box_accuracy(std::uint64_t pairs, std::uint64_t seed, unsigned threads) {
    const auto parts =
        count_by_chunks<BoxAccuracy>(pairs, seed, threads, [](Pcg32& random, std::uint64_t size) {
            BoxAccuracy part;
            for (std::uint64_t i = 0; i < size; ++i) count(make_box_pair(random), part);
            return part;
        });
    BoxAccuracy sum;
    for (const BoxAccuracy& part : parts) {
        sum.pairs += part.pairs;
        sum.exact_hits += part.exact_hits;
        for (std::size_t test = 0; test < box_test_count; ++test)
            sum.wrong[test].add(part.wrong[test]);
    }
    return sum;
}

RaysFromInside rays_from_inside(std::uint64_t rays, std::uint64_t seed) {
    Pcg32 random(seed);
    RaysFromInside result{.rays = rays};
    for (std::uint64_t i = 0; i < rays; ++i) {
        const Point3 p = random_vector(random), q = random_vector(random);
        const Aabb box{glm::min(p, q), glm::max(p, q)};
        const Double3 share = 0.5 + 0.5 * Double3(random_vector(random));
        const Ray ray{.origin = glm::clamp(Point3(Double3(box.min) + share * Double3(box.extent())),
                                           box.min, box.max),
                      .direction = Vector3(random_direction(random))};
        for_each_named(box_tests, [&](std::size_t test, const auto& named) {
            result.rejected[test] += !TestOf<decltype(named)>::intersect(ray, box);
        });
    }
    return result;
}

RaysInFaces rays_in_faces(std::uint64_t rays, std::uint64_t seed) {
    Pcg32 random(seed);
    const auto on_grid = [&] { return glm::round(64.0f * random_vector(random)) / 64.0f; };
    RaysInFaces result;
    while (result.rays < rays) {
        const Point3 a = on_grid(), b = on_grid(), c = on_grid();
        Point3 origin = 4.0f * on_grid();
        const std::uint32_t axis = random.below(3);
        const Aabb box = bounds({a, b, c});
        const Point3 vertex = a[axis] == box.max[axis] ? a : b[axis] == box.max[axis] ? b : c;
        origin[axis] = vertex[axis];
        const Ray ray{.origin = origin, .direction = vertex - origin};
        if (!FilteredExact::intersect(ray, {a, b, c})) continue;  // no area, or seen edge-on
        ++result.rays;
        result.in_closed_box += exactly_hits(ray, box);
        for_each_named(box_tests, [&](std::size_t test, const auto& named) {
            result.rejected[test] += !TestOf<decltype(named)>::intersect(ray, box);
        });
    }
    return result;
}

OrientedBoxes oriented_box_accuracy(std::uint64_t rays, std::uint64_t seed) {
    Pcg32 random(seed);
    OrientedBoxes result{.rays = rays};
    for (std::uint64_t i = 0; i < rays; ++i) {
        // A turn by half the circle about a random axis after another one: any turn
        // (Cartan-Dieudonné).
        const Double3 first = random_direction(random), second = random_direction(random);
        const glm::dquat turn = glm::dquat(0.0, first) * glm::dquat(0.0, second);
        const Vector3 half = 0.5f + 0.5f * random_vector(random);
        const OrientedBox box{random_vector(random), glm::mat3(glm::mat3_cast(turn)), half};
        const Double3 target = Double3(box.centre) + 1.5 * Double3(random_vector(random));
        const Point3 origin(target + 5.0 * random_direction(random));
        const Ray ray{.origin = origin, .direction = Point3(target) - origin};
        const bool hit = intersect(ray, box).has_value();
        const bool around = SlabConservative::intersect(ray, bounds(box)).has_value();
        result.hits += hit;
        result.wrong += hit != hits_in_double(ray, box);
        result.around += around;
        result.not_around += hit && !around;
    }
    return result;
}

}  // namespace space::ch02
