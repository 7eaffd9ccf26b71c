/// @file
/// The other way to draw the same scene (BvhThesis13, chapter 1): triangle after triangle is
/// projected onto the pixel grid, and a depth buffer keeps the nearest. Which triangle a pixel
/// shows must be what the ray tracer says, but for pixels whose centre lies within
/// coverage_distance() of a projected edge.
#pragma once

#include "chapters/ch01_naive_ray_tracing/coordinate_systems.hpp"
#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "common/program/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace space {

/// What each pixel's centre sees, row by row from the top left. t is the depth, since the pixels'
/// rays end on the plane at distance 1 from the eye; a pixel that sees nothing keeps t = infinity.
struct DepthBuffer {
    int width, height;
    std::vector<Hit> pixels;

    DepthBuffer(int w, int h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    Hit& at(int x, int y) { return pixels[index(x, y)]; }
    const Hit& at(int x, int y) const { return pixels[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

/// Projected vertices are rounded to 1/256 pixel, as graphics processors do: edge functions of
/// whole numbers are exact, so that no pixel falls between two triangles with a common edge.
inline constexpr int subpixel_bits = 8;
inline constexpr int subpixels = 1 << subpixel_bits;
/// In pixels: what reaches farther from the picture's centre is cut off, so that coordinates in
/// subpixels stay below 2^29 and edge functions below 2^61. Pictures may be as large.
inline constexpr double guard_band = 0x1p20;
/// What is nearer to the eye than this part of the distance from eye to target is cut off: nothing
/// in the eye's plane has a projection. A ray tracer knows no such limit.
inline constexpr double near_fraction = 0x1p-10;

/// How far, in pixels, the centre of a pixel may lie from a projected edge where the two renderers
/// decide differently. Three roundings move an edge:
/// - of the vertices to subpixels: by up to half of one in x and in y, that is sqrt(1/2) subpixels;
/// - of the ray's direction d to float: by up to u24 |d|, u24 = 2^-24. With r the distance from the
/// picture's centre to a
///   corner on the image plane, |d| <= 1 + r, and the ray moves on that plane by at most u24 (1 +
///   r)^2;
/// - of the double arithmetic in both: by less than 2^-20 pixels, for edges that do not point at
/// the eye to within 10^-6.
inline double coverage_distance(const PixelGrid& grid) {
    const double pixels_per_unit = 0.5 * grid.height / grid.frame.tan_half_fov;
    const double r = 0.5 * std::hypot(grid.width, grid.height) / pixels_per_unit;
    return std::sqrt(0.5) / subpixels + pixels_per_unit * float_roundoff * (1.0 + r) * (1.0 + r) +
           0x1p-20;
}

/// Triangle after triangle into a z-buffer: one picture, drawn by any number of calls.
class Rasteriser {
  public:
    explicit Rasteriser(const PixelGrid& grid)
        : grid_(grid),
          pixels_per_unit_(0.5 * grid.height / grid.frame.tan_half_fov),
          near_(near_fraction *
                glm::distance(Double3(grid.camera.eye), Double3(grid.camera.target))),
          buffer_(grid.width, grid.height) {}

    // [draw]
    /// Draws one triangle; the order of the triangles does not matter.
    void draw(const Triangle& triangle, std::uint32_t index) {
        if (normal(triangle) == Double3(0.0)) return;  // a triangle without area is never hit
        const Double3 a = to_camera(triangle.a), b = to_camera(triangle.b),
                      c = to_camera(triangle.c);
        const Plane plane(a, b, c);
        if (plane.volume == 0.0) return;  // the eye lies in its plane

        const Polygon polygon = clip({{a, b, c}, 3});
        std::array<Subpixel, Polygon::max_size> corners;
        for (int i = 0; i < polygon.size; ++i) corners[i] = round(to_pixel(polygon.corners[i]));
        for (int i = 2; i < polygon.size; ++i)
            fill(corners[0], corners[i - 1], corners[i], plane, index);
    }
    // [draw]

    const DepthBuffer& buffer() const { return buffer_; }

    /// The corners of the triangle's visible part in pixels, not rounded: up to eight, none where
    /// nothing is visible.
    std::vector<glm::dvec2> outline(const Triangle& triangle) const {
        const Polygon polygon =
            clip({{to_camera(triangle.a), to_camera(triangle.b), to_camera(triangle.c)}, 3});
        std::vector<glm::dvec2> corners;
        for (int i = 0; i < polygon.size; ++i) corners.push_back(to_pixel(polygon.corners[i]));
        return corners;
    }

  private:
    /// In camera coordinates; a triangle cut by five planes has eight corners at most.
    struct Polygon {
        static constexpr int max_size = 8;
        std::array<Double3, max_size> corners;
        int size;
    };
    struct Subpixel {
        std::int64_t x, y;
    };

    /// The Möller-Trumbore test with all that does not depend on the pixel worked out once: the
    /// rays share their origin, the eye at 0, and u, v and 1 - u - v are quotients of functions
    /// that are linear in the direction, and so in the pixel.
    struct Plane {
        Double3 of_sum, of_u, of_v;
        double volume;  ///< six times that of the tetrahedron of the triangle and the eye, signed
        double depth_a, depth_ab, depth_ac;

        Plane(const Double3& a, const Double3& b, const Double3& c) {
            const Double3 ab = b - a, ac = c - a;
            volume = glm::dot(glm::cross(ab, a), ac);
            const double sign = volume < 0.0 ? -1.0 : 1.0;
            of_sum = sign * glm::cross(ac, ab);
            of_u = sign * glm::cross(a, ac);
            of_v = sign * glm::cross(ab, a);
            depth_a = depth(a);
            depth_ab = depth(b) - depth_a;
            depth_ac = depth(c) - depth_a;
        }

        /// Rounding may have moved the pixel's centre into the triangle: the nearest point inside
        /// stands for it.
        Hit at(const Double3& direction, std::uint32_t index) const {
            const double b = glm::dot(of_u, direction), c = glm::dot(of_v, direction);
            const double a = std::max(0.0, glm::dot(of_sum, direction) - b - c);
            const double sum = a + std::max(0.0, b) + std::max(0.0, c);
            const double u = std::max(0.0, b) / sum, v = std::max(0.0, c) / sum;
            return {static_cast<float>(depth_a + u * depth_ab + v * depth_ac), index,
                    static_cast<float>(u), static_cast<float>(v)};
        }
    };

    Double3 to_camera(const Point3& point) const {
        return world_to_camera(grid_.camera, grid_.frame, Double3(point));
    }
    glm::dvec2 to_pixel(const Double3& camera_point) const {
        return camera_to_pixel(grid_.frame, camera_point, grid_.width, grid_.height);
    }
    static Subpixel round(const glm::dvec2& pixel) {
        return {std::llround(pixel.x * subpixels), std::llround(pixel.y * subpixels)};
    }

    /// Cuts off what lies before the near plane or outside the guard band (Sutherland & Hodgman
    /// 1974).
    Polygon clip(const Polygon& triangle) const {
        const double slope = guard_band / pixels_per_unit_;
        const auto inside = [&](const Double3& p) {
            return depth(p) >= near_ && std::max(std::abs(p.x), std::abs(p.y)) <= slope * depth(p);
        };
        if (inside(triangle.corners[0]) && inside(triangle.corners[1]) &&
            inside(triangle.corners[2]))
            return triangle;

        Polygon polygon = triangle;
        const auto keep = [&](const auto& distance) {
            Polygon kept{{}, 0};
            for (int i = 0; i < polygon.size; ++i) {
                const Double3& p = polygon.corners[i];
                const Double3& q = polygon.corners[(i + 1) % polygon.size];
                const double dp = distance(p), dq = distance(q);
                if (dp >= 0.0) kept.corners[kept.size++] = p;
                // From inside to outside, so that the neighbour across the edge finds the same
                // point.
                if (dp >= 0.0 && dq < 0.0)
                    kept.corners[kept.size++] = p + (q - p) * (dp / (dp - dq));
                if (dp < 0.0 && dq >= 0.0)
                    kept.corners[kept.size++] = q + (p - q) * (dq / (dq - dp));
            }
            polygon = kept;
        };
        keep([&](const Double3& p) { return depth(p) - near_; });
        keep([&](const Double3& p) { return slope * depth(p) - p.x; });
        keep([&](const Double3& p) { return slope * depth(p) + p.x; });
        keep([&](const Double3& p) { return slope * depth(p) - p.y; });
        keep([&](const Double3& p) { return slope * depth(p) + p.y; });
        return polygon;
    }

    // [fill]
    /// Sets the pixels whose centre lies in the closed triangle p q r, where it is nearer than what
    /// they hold.
    void fill(const Subpixel& p, Subpixel q, Subpixel r, const Plane& plane, std::uint32_t index) {
        const auto edge = [](const Subpixel& from, const Subpixel& to, const Subpixel& s) {
            return (to.x - from.x) * (s.y - from.y) - (to.y - from.y) * (s.x - from.x);
        };
        const std::int64_t twice_area = edge(p, q, r);
        if (twice_area == 0) return;
        if (twice_area < 0) std::swap(q, r);  // now all three edge functions are >= 0 inside

        constexpr int half = subpixels / 2;
        const auto first = [](std::int64_t low) {
            return std::max<std::int64_t>(0, (low + half - 1) >> subpixel_bits);
        };
        const auto last = [](std::int64_t high, int size) {
            return std::min<std::int64_t>(size - 1, (high - half) >> subpixel_bits);
        };
        const auto x_first = static_cast<int>(first(std::min({p.x, q.x, r.x})));
        const auto x_last = static_cast<int>(last(std::max({p.x, q.x, r.x}), buffer_.width));
        const auto y_first = static_cast<int>(first(std::min({p.y, q.y, r.y})));
        const auto y_last = static_cast<int>(last(std::max({p.y, q.y, r.y}), buffer_.height));
        for (int y = y_first; y <= y_last; ++y)
            for (int x = x_first; x <= x_last; ++x) {
                const Subpixel centre{x * subpixels + half, y * subpixels + half};
                if (edge(p, q, centre) < 0 || edge(q, r, centre) < 0 || edge(r, p, centre) < 0)
                    continue;
                const Hit hit = plane.at(direction(x, y), index);
                if (nearer(hit, buffer_.at(x, y))) buffer_.at(x, y) = hit;
            }
    }
    // [fill]

    /// From the eye through the pixel's centre, in camera coordinates.
    Double3 direction(int x, int y) const {
        return {(x + 0.5 - 0.5 * buffer_.width) / pixels_per_unit_,
                (0.5 * buffer_.height - y - 0.5) / pixels_per_unit_, -1.0};
    }

    PixelGrid grid_;
    double pixels_per_unit_;
    double near_;  ///< depth of the near plane
    DepthBuffer buffer_;
};

/// The whole scene, triangle after triangle.
inline DepthBuffer rasterise(const Scene& scene, int width, int height) {
    Rasteriser rasteriser({scene.camera, width, height});
    for (std::uint32_t face = 0; face < scene.mesh.faces.size(); ++face)
        rasteriser.draw(scene.mesh.triangle(face), face);
    return rasteriser.buffer();
}

/// The rasterised picture with samples x samples points per pixel, the ray tracer's. Shaded by the
/// same function, but a renderer that sees one triangle at a time cannot tell what stands between a
/// point and the light: no shadows.
inline Image render_rasterised(const Scene& scene, int width, int height, int samples = 1) {
    const DepthBuffer buffer = rasterise(scene, width * samples, height * samples);
    const PixelGrid grid(scene.camera, buffer.width, buffer.height);
    Image image(width, height);
    grid.for_each([&](int x, int y) {
        const Hit& hit = buffer.at(x, y);
        image.at(x / samples, y / samples) +=
            hit.t < infinity ? shade(scene, grid.ray(x, y), hit, [](const Ray&) { return true; })
                             : scene.background;
    });
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) /= static_cast<float>(samples * samples);
    return image;
}

}  // namespace space
