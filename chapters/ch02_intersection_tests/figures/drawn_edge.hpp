/// @file
/// Two triangles with a common edge, and what three ray-triangle tests say of the rays about a
/// place on it, in directions as neighbouring as floats can be.
#pragma once

#include "common/accelerator.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace space::ch02 {

/// What the drawings call the tests of triangle_tests, in their order.
inline constexpr std::array<std::string_view, 8> drawn_test_names{
    "M.–T. in double", "Möller–Trumbore", "Lichter",    "Lichter, improved",
    "unit triangle",   "Plücker",         "watertight", "exact"};

/// A place in a magnifying glass: squares to the right of its middle, from -20 to 19, and above it,
/// from -19 to 20.
struct GlassPlace {
    int right = 0, up = 0;
    bool operator==(const GlassPlace&) const = default;
};
inline constexpr int glass_side = 40;  ///< squares

/// The triangles a b c and a c d, a ray, and the glass that is held over it.
struct EdgeScene {
    Point3 a, b, c, d;                 ///< drawn as seen along z
    Ray aim;                           ///< in the middle of the glass, at t = 1
    float step;                        ///< from square to square, in the direction's x and y
    std::array<std::size_t, 3> tests;  ///< of triangle_tests; the last one is exact
    std::optional<GlassPlace> marked = {};

    Triangle lower() const { return {a, b, c}; }
    Triangle upper() const { return {a, c, d}; }
    /// The ray of a square.
    Ray ray(const GlassPlace& place) const;
};

/// What a test says: 0 neither triangle, 1 only a b c, 2 only a c d, 3 both.
using EdgeVerdict = std::size_t;
inline constexpr std::array<std::string_view, 4> verdict_names{"neither", "only a b c",
                                                               "only a c d", "both"};

/// What a test says of all squares, row by row from the top.
struct EdgeVerdicts : std::array<EdgeVerdict, glass_side * glass_side> {
    EdgeVerdict& of(const GlassPlace& place) { return (*this)[square(place)]; }
    EdgeVerdict of(const GlassPlace& place) const { return (*this)[square(place)]; }

  private:
    static std::size_t square(const GlassPlace& place) {
        constexpr int half = glass_side / 2;
        return static_cast<std::size_t>((half - place.up) * glass_side + half + place.right);
    }
};
/// How many rays a test lets through that hit a triangle exactly.
int leaks_of(const EdgeVerdicts& verdicts, const EdgeVerdicts& exact);
/// Of the scene's tests.
std::array<EdgeVerdicts, 3> edge_verdicts(const EdgeScene& scene);

Svg drawn_edge(const EdgeScene& scene, const std::array<EdgeVerdicts, 3>& verdicts);

/// Where a point of the scene stands on the paper: its z does not matter.
inline constexpr Double2 edge_zero{150, 132}, edge_unit{110, -100};
/// The corner of the i-th glass on the paper, and the size of a square.
inline Double2 glass_corner(std::size_t i) {
    return {4 + 216 * static_cast<double>(i), 260};
}
inline constexpr double glass_square = 5;

/// As the book has them: a quadrilateral cut along its diagonal, and a place four fifths along
/// that.
inline constexpr Point3 edge_a{-1.0625f, -1.125f, -0.125f}, edge_b{0.75f, -0.875f, 0.0625f},
    edge_c{1.1875f, 1.0625f, 0.0f}, edge_d{-1.0625f, 0.8125f, -0.125f};
inline constexpr float edge_share = 0.8f;
inline constexpr std::array<std::size_t, 3> edge_tests{1, 6, 7};
/// To a place on the edge from a to c, by its share of that, or `beside` it.
Ray edge_ray(const Point3& a, const Point3& c, float share, const Vector2& beside = Vector2(0.0f));
/// The smallest step that tells rays about this one apart: in one of x and y to the next float, in
/// the other to the next or to one of the next.
float edge_step(const Ray& aim);

}  // namespace space::ch02
