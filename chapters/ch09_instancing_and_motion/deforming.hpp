/// @file
/// Triangles in motion. A motion says where a vertex is at a time, from where it is at rest and
/// from nothing else: so frames can be made in any order, and each of them again.
#pragma once

#include "common/geometry.hpp"
#include "common/parallel.hpp"
#include "common/random.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace space {

// [motion]
/// Where a vertex of a triangle is, which is at `rest` at time 0. The triangle is given by its
/// index: those of one mesh may go different ways.
template <class M>
concept Motion = requires(const M& motion, const Point3& rest, std::uint32_t triangle,
                          double time) {
    { motion(rest, triangle, time) } -> std::same_as<Point3>;
};

/// All triangles at a time.
template <Motion M>
void move_to(double time, const M& motion, std::span<const Triangle> rest,
             std::span<Triangle> moved, unsigned threads = 1) {
    parallel_for(rest.size(), threads, std::size_t{1} << 12, [&](std::size_t i) {
        const auto triangle = static_cast<std::uint32_t>(i);
        const auto at = [&](const Point3& p) { return motion(p, triangle, time); };
        moved[i] = {at(rest[i].a), at(rest[i].b), at(rest[i].c)};
    });
}
// [motion]

/// A standing wave: with the period 1, all goes up and down, the farther along x the later. What
/// are neighbours stay neighbours.
struct Wave {
    double height;      ///< above and below the place at rest
    double wavelength;  ///< along x

    Point3 operator()(const Point3& rest, std::uint32_t, double time) const {
        constexpr double turn = 2.0 * std::numbers::pi;
        const double lift =
            height * std::sin(turn * time) * std::sin(turn * double{rest.x} / wavelength);
        return {rest.x, static_cast<float>(rest.y + lift), rest.z};
    }
};

/// What is on the ground stays, and each height above it turns about the y axis by as much more: at
/// time 1, in all, by so many turns. Boxes that were long and thin come to lie across.
struct Twist {
    Aabb box;  ///< at rest; the axis goes through its middle
    double turns;

    Point3 operator()(const Point3& rest, std::uint32_t, double time) const {
        const Double3 low(box.min), high(box.max), middle = 0.5 * (low + high);
        const double share = (rest.y - low.y) / (high.y - low.y);
        const double angle = 2.0 * std::numbers::pi * turns * time * share;
        const double c = std::cos(angle), s = std::sin(angle);
        const double x = rest.x - middle.x, z = rest.z - middle.z;
        return Point3(middle.x + c * x + s * z, rest.y, middle.z - s * x + c * z);
    }
};

/// Each triangle flies off on its own: from a centre, and aside, by its own numbers.
struct Explosion {
    Double3 centre;
    double speed;  ///< of what lies at distance 1 from the centre, on average
    std::uint64_t seed = 1;

    /// From the centre each point goes as far as it is away, times what is its triangle's: so
    /// triangles keep their shape and grow.
    Point3 operator()(const Point3& rest, std::uint32_t triangle, double time) const {
        Pcg32 random(seed, triangle);
        const double own = random.uniform(0.0f, 2.0f);
        const Double3 aside(random_vector(random));
        return Point3(Double3(rest) + time * speed * (own * (Double3(rest) - centre) + aside));
    }
};

/// Each triangle goes its own way, as far as the time says in each direction: neighbours part
/// evenly. At time m it is moved by a random vector with components up to m.
struct Scatter {
    std::uint64_t seed = 1;

    Point3 operator()(const Point3& rest, std::uint32_t triangle, double time) const {
        Pcg32 random(seed, triangle);
        return Point3(Double3(rest) + time * Double3(random_vector(random)));
    }
};

}  // namespace space
