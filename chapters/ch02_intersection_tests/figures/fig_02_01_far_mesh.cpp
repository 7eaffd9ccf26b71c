#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/image.hpp"
#include "common/program/report.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace space::ch02 {
namespace {

/// What one test makes of a scene far from the origin.
struct FarPicture {
    /// What wrong pixels are filled with: the palette's vermillion.
    static constexpr Color mark{0.665f, 0.112f, 0.0f};

    std::string_view test;
    Image image{0, 0};
    std::uint64_t wrong =
        0;  ///< pixels that see another triangle than in exact arithmetic, or one only here
};

constexpr Color background{1.0f, 1.0f, 1.0f};

/// Light from the eye, and a little from the left above.
Color gray(const Triangle& triangle, const Camera& camera) {
    const Double3 n = glm::normalize(normal(triangle)),
                  to_eye = glm::normalize(Double3(camera.eye) - Double3(camera.target));
    const double light = 0.25 * std::abs(glm::dot(n, to_eye)) +
                         0.55 * std::max(0.0, glm::dot(n, glm::normalize(Double3(-1, 2, 1))));
    return Color(static_cast<float>(0.05 + light));
}

/// A bumpy ball of radius 1, moved by 10^shift (1, 1/2, -1/4), seen from 5000 radii away through a
/// long lens: the rays' origins and the vertices have few digits in common. side x side pixels.
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

    const PixelGrid grid(camera, side, side);
    const DepthBuffer exact = trace_depth(grid, Naive<FilteredExact>::build(triangles), threads);
    std::array<FarPicture, triangle_test_count> pictures;
    for_each_named(triangle_tests, [&](std::size_t test, const auto& named) {
        const auto naive = Naive<TestOf<decltype(named)>>::build(triangles);
        const DepthBuffer seen = trace_depth(grid, naive, threads);
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

}  // namespace

Svg fig_02_01(const Options& options) {
    constexpr int side = 150, gap = 8, row_height = 206;
    // Pixels that are alone are too small to see: few of them are circled.
    constexpr std::uint64_t few = 60;
    Svg svg(
        "One mesh, a million radii from the origin, seen by every ray-triangle test; wrong "
        "pixels are marked",
        4 * side + 5 * gap, 2 * row_height);
    const auto pictures = far_pictures(side, 6, options.threads);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const FarPicture& picture = pictures[i];
        const auto left = static_cast<float>(gap + static_cast<int>(i % 4) * (side + gap)),
                   top = static_cast<float>(i / 4 * row_height);
        const float middle = left + 0.5f * side;
        svg.picture({left, top}, {side, side}, picture.image, picture.test);
        if (picture.wrong <= few)
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    if (picture.image.at(x, y) == FarPicture::mark)
                        svg.circle({left + static_cast<float>(x) + 0.5f,
                                    top + static_cast<float>(y) + 0.5f},
                                   4, {.stroke = Ink::vermillion});
        svg.text({middle, top + side + 18}, picture.test, {.size = 13.5});
        svg.text({middle, top + side + 40},
                 picture.wrong == 0 ? "none wrong" : with_commas(picture.wrong) + " wrong",
                 {.ink = Ink::quiet, .size = 16});
    }
    return svg;
}

}  // namespace space::ch02
