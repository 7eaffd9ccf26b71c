/// @file
/// One scene drawn twice: fragments in the painter's order, the nearest last and with no depths to
/// compare, and triangles in any order into a z-buffer. Both cover the pixels whose rays hit, by
/// exact arithmetic, so that the pictures are the same where the order is right.
#pragma once

#include "chapters/ch01_naive_ray_tracing/rasteriser.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch03_bsp_trees/tiling.hpp"

#include <cstdint>

namespace space {

/// Calls pixel(x, y, ray) for the pixels that the box around the corners' picture touches: for all
/// of them where a corner lies beside or behind the eye, and so has none. Centres that are covered
/// lie half a pixel within that: room for rounding.
template <class Corners, class Pixel>
void for_pixels_around(const Corners& corners, const PixelGrid& grid, const Pixel& pixel) {
    const Camera& camera = grid.camera;
    const double near = near_fraction * glm::distance(Double3(camera.eye), Double3(camera.target));
    const glm::dvec2 size(grid.width, grid.height);
    glm::dvec2 low = size, high(0.0);
    for (const Double3& corner : corners) {
        const Double3 seen = world_to_camera(camera, grid.frame, corner);
        const bool behind = depth(seen) < near;
        const glm::dvec2 at = camera_to_pixel(grid.frame, seen, grid.width, grid.height);
        low = behind ? glm::dvec2(0.0) : glm::min(low, at);
        high = behind ? size : glm::max(high, at);
    }
    low = glm::max(low, 0.0);
    high = glm::min(high, size);
    for (int y = static_cast<int>(low.y); y < high.y; ++y)
        for (int x = static_cast<int>(low.x); x < high.x; ++x) pixel(x, y, grid.ray(x, y));
}

/// Calls pixel(x, y, ray, hit) for the pixels that show the fragment, with its triangle's hit.
template <class Pixel>
void for_pixels_of(const Fragment<3>& fragment, const BspTree<3>& tree, const FragmentRays& covers,
                   const PixelGrid& grid, const Pixel& pixel) {
    std::vector<Double3> corners;
    for (const auto& corner : fragment.corners) corners.push_back(corner.at);
    for_pixels_around(corners, grid, [&](int x, int y, const Ray& ray) {
        auto hit = FilteredExact::intersect(ray, tree.polygons[fragment.polygon]);
        if (!hit || !covers.meets(ray, fragment)) return;
        hit->triangle = fragment.polygon;
        pixel(x, y, ray, *hit);
    });
}

// [painter]
/// What each pixel shows when the fragments are laid one over the other, back to front.
inline DepthBuffer paint(const BspTree<3>& tree, Grade grade, const PixelGrid& grid) {
    const FragmentRays covers(tree, grade);
    DepthBuffer picture(grid.width, grid.height);
    tree.back_to_front(grid.camera.eye, [&](const Fragment<3>& fragment) {
        for_pixels_of(fragment, tree, covers, grid, [&](int x, int y, const Ray&, const Hit& hit) {
            picture.at(x, y) = hit;  // over whatever was there
        });
    });
    return picture;
}
// [painter]

/// The nearest triangle of each pixel.
inline DepthBuffer z_buffer(std::span<const Triangle> triangles, const PixelGrid& grid) {
    DepthBuffer picture(grid.width, grid.height);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        const std::array<Double3, 3> corners{a, b, c};
        for_pixels_around(corners, grid, [&](int x, int y, const Ray& ray) {
            auto hit = FilteredExact::intersect(ray, triangles[i]);
            if (!hit) return;
            hit->triangle = i;
            if (nearer(*hit, picture.at(x, y))) picture.at(x, y) = *hit;
        });
    }
    return picture;
}

/// A picture of what each pixel shows, lit without shadows.
inline Image picture_of(const Scene& scene, const DepthBuffer& shown) {
    const PixelGrid grid(scene.camera, shown.width, shown.height);
    Image image(shown.width, shown.height);
    grid.for_each([&](int x, int y) {
        const Hit& hit = shown.at(x, y);
        image.at(x, y) = hit.t < infinity
                             ? shade(scene, grid.ray(x, y), hit, [](const Ray&) { return true; })
                             : scene.background;
    });
    return image;
}

/// Pixels in which two pictures show different triangles. Where both lie at one depth, but for
/// rounding to float, either is right.
struct PixelDifferences {
    std::uint64_t pixels = 0, covered = 0, same_depth = 0, wrong = 0;
};
inline PixelDifferences pixel_differences(const DepthBuffer& one, const DepthBuffer& other) {
    constexpr double tolerance = 8.0 * float_roundoff;
    PixelDifferences result;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        const Hit &a = one.pixels[i], &b = other.pixels[i];
        ++result.pixels;
        result.covered += a.t < infinity;
        if (a.triangle == b.triangle && (a.t < infinity) == (b.t < infinity)) continue;
        const bool both = a.t < infinity && b.t < infinity;
        const bool tied = both && std::abs(double{a.t} - double{b.t}) <= tolerance * double{a.t};
        ++(tied ? result.same_depth : result.wrong);
    }
    return result;
}

}  // namespace space
