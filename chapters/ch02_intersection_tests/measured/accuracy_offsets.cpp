#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/measured/chunks.hpp"
#include "chapters/ch02_intersection_tests/offset_origin.hpp"

namespace space::ch02 {
namespace {

constexpr float usual_epsilon = 1e-4f;  // of the plain ways: a number that suits some scene

/// A room from 0 to 1 that is seen from inside, with a ball of radius 1/4 that is seen from
/// outside.
std::vector<Triangle> room_with_ball(double place) {
    TriangleMesh mesh;
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back(
            {corner & 1 ? 1.0f : 0.0f, corner & 2 ? 1.0f : 0.0f, corner & 4 ? 1.0f : 0.0f});
    // Each wall counter-clockwise from inside.
    for (const auto& [a, b, c, d] : {std::array{0u, 2u, 6u, 4u},
                                     {1u, 5u, 7u, 3u},
                                     {0u, 4u, 5u, 1u},
                                     {2u, 3u, 7u, 6u},
                                     {0u, 1u, 3u, 2u},
                                     {4u, 6u, 7u, 5u}}) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({a, c, d});
    }
    TriangleMesh ball = bumpy_ball(2);
    for (Point3& vertex : ball.vertices) vertex = 0.25f * vertex + 0.5f;
    mesh.append(ball);
    for (Point3& vertex : mesh.vertices)
        vertex = Point3(Double3(vertex) + place * Double3(1.0, 0.75, 0.5));
    return mesh.triangles();
}

struct Found {
    Hit hit;
    bool front = false;
};
/// The nearest hit; of equal ones one that is seen from the front.
template <class Test>
std::optional<Found> nearest(std::span<const Triangle> triangles, const Ray& ray) {
    std::optional<Found> best;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        if (auto hit = Test::intersect(ray, triangles[i]);
            hit && (!best || hit->t <= best->hit.t)) {
            hit->triangle = i;
            const bool front = seen_from_front(triangles[i], ray);
            if (!best || hit->t < best->hit.t || front) best = Found{*hit, front};
        }
    return best;
}

template <class Test>
Bounces bounce(const OriginWay& way, double place, std::uint64_t count, std::uint64_t seed,
               unsigned threads) {
    const std::vector<Triangle> triangles = room_with_ball(place);
    const auto parts =
        count_by_chunks<Bounces>(count, seed, threads, [&](Pcg32& random, std::uint64_t size) {
            // In the corner of the room, clear of the ball.
            const Point3 start(place * Double3(1.0, 0.75, 0.5) + 0.125);
            Ray ray{.origin = start, .direction = Vector3(random_direction(random))};
            std::optional<Found> found = nearest<Test>(triangles, ray);
            Bounces part;
            while (part.bounces < size && found) {
                const Triangle& from = triangles[found->hit.triangle];
                const Double3 n = normal_towards(from, ray);
                Double3 next = random_direction(random);
                if (glm::dot(n, next) < 0.0) next = -next;
                const Ray leaving{.origin = way.origin(ray, found->hit, from, n, Vector3(next)),
                                  .direction = Vector3(next)};
                const auto then = nearest<Test>(triangles, leaving);
                ++part.bounces;
                part.offset += glm::length(Double3(leaving.origin) - hit_point(from, found->hit));
                const bool self_hit = then && then->hit.triangle == found->hit.triangle;
                // On a wall's plane, and leaving it for the room: the wall is hit, at t = 0, though
                // the ray does not cross it.
                const bool touch = then && !self_hit && !then->front && then->hit.t == 0.0f;
                const bool leak = !then || (!then->front && !self_hit && !touch);
                part.self_hits += self_hit;
                part.touches += touch;
                part.leaks += leak;
                const bool lost =
                    self_hit || touch || leak;  // what follows a wrong step would be counted twice
                ray = lost ? Ray{.origin = start, .direction = Vector3(random_direction(random))}
                           : leaving;
                found = lost ? nearest<Test>(triangles, ray) : then;
            }
            return part;
        });
    Bounces sum;
    for (const Bounces& part : parts) {
        sum.bounces += part.bounces;
        sum.self_hits += part.self_hits;
        sum.touches += part.touches;
        sum.leaks += part.leaks;
        sum.offset += part.offset;
    }
    sum.offset /= static_cast<double>(sum.bounces);
    return sum;
}

}  // namespace

const std::vector<OriginWay>& origin_ways() {
    static const std::vector<OriginWay> all{
        {"o + t d", [](const Ray& ray, const Hit& hit, const Triangle&, const Double3&,
                       const Vector3&) { return ray.at(hit.t); }},
        {"o + t d, 1e-4 along the ray",
         [](const Ray& ray, const Hit& hit, const Triangle&, const Double3&, const Vector3& next) {
             return ray.at(hit.t) + usual_epsilon * next;
         }},
        {"o + t d, 1e-4 along the normal",
         [](const Ray& ray, const Hit& hit, const Triangle&, const Double3& n, const Vector3&) {
             return ray.at(hit.t) + usual_epsilon * Vector3(n);
         }},
        {"chapter 1: by 2 e m per axis",
         [](const Ray&, const Hit& hit, const Triangle& triangle, const Double3& n,
            const Vector3&) { return shadow_origin(triangle, hit_point(triangle, hit), n); }},
        {"moved by 4 e m along the normal",
         [](const Ray&, const Hit& hit, const Triangle& triangle, const Double3& n,
            const Vector3&) { return offset_origin(triangle, hit, n); }},
    };
    return all;
}

Bounces bounces(const OriginWay& way, std::size_t triangle_test, double place, std::uint64_t count,
                std::uint64_t seed, unsigned threads) {
    Bounces result;
    for_each_named(triangle_tests, [&](std::size_t i, const auto& named) {
        if (i == triangle_test)
            result = bounce<TestOf<decltype(named)>>(way, place, count, seed, threads);
    });
    return result;
}

}  // namespace space::ch02
