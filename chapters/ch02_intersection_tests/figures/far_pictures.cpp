#include "chapters/ch02_intersection_tests/figures/far_pictures.hpp"

#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"

#include <cmath>
#include <numbers>

namespace space::ch02 {
namespace {

constexpr Color background{1.0f, 1.0f, 1.0f};

/// Light from the eye, and a little from the left above.
Color gray(const Triangle& triangle, const Camera& camera) {
    const Double3 n = glm::normalize(normal(triangle)),
                  to_eye = glm::normalize(Double3(camera.eye) - Double3(camera.target));
    const double light = 0.25 * std::abs(glm::dot(n, to_eye)) +
                         0.55 * std::max(0.0, glm::dot(n, glm::normalize(Double3(-1, 2, 1))));
    return Color(static_cast<float>(0.05 + light));
}

}  // namespace

std::array<FarPicture, triangle_test_count> far_pictures(int side, int shift, unsigned threads) {
    const Double3 middle = std::pow(10.0, shift) * Double3(1.0, 0.5, -0.25);
    TriangleMesh mesh = bumpy_ball(3);
    for (Point3& vertex : mesh.vertices) vertex = Point3(Double3(vertex) + middle);
    const std::vector<Triangle> triangles = mesh.triangles();
    constexpr double distance = 5000.0, radius = 1.25;
    const Double3 eye = middle + distance * glm::normalize(Double3(0.9, 1.1, 2.7));
    const auto field_of_view =
        static_cast<float>(2.0 * std::atan(radius / distance) * 180.0 / std::numbers::pi);
    const Camera camera{
        .eye = Point3(eye), .target = Point3(middle), .field_of_view = field_of_view};

    const DepthBuffer exact =
        trace_depth(camera, Naive<FilteredExact>::build(triangles), side, side, threads);
    std::array<FarPicture, triangle_test_count> pictures;
    for_each_named(triangle_tests, [&](std::size_t test, const auto& named) {
        const auto naive = Naive<TestOf<decltype(named)>>::build(triangles);
        const DepthBuffer seen = trace_depth(camera, naive, side, side, threads);
        pictures[test] = {.test = named.name, .image = Image(side, side)};
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const Hit &hit = seen.at(x, y), &truth = exact.at(x, y);
                const bool hits = hit.t < infinity, hits_truly = truth.t < infinity;
                const bool wrong = hits != hits_truly || (hits && hit.triangle != truth.triangle);
                pictures[test].wrong += wrong;
                pictures[test].image.at(x, y) = wrong  ? FarPicture::mark
                                                : hits ? gray(triangles[hit.triangle], camera)
                                                       : background;
            }
    });
    return pictures;
}

}  // namespace space::ch02
