/// @file
/// The oracle that stands beside the exact one: no library, other formulas, whole numbers of 128
/// bits.
#pragma once

#include "tests/oracle/exact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace space {

/// For triangles and rays whose coordinates are whole numbers up to 2^15: a coordinate of the
/// direction or of an edge then has at most 17 bits, a side of an edge and a plane's height fewer
/// than 56, and the products that compare two t fewer than 112. Rays have no interval here: t in
/// [0, infinity).
class IntegerOracle {
  public:
    static constexpr float largest = 0x1p15f;

    static IntegerOracle build(std::span<const Triangle> triangles) {
        IntegerOracle oracle;
        for (const Triangle& triangle : triangles)
            oracle.corners_.push_back({whole(triangle.a), whole(triangle.b), whole(triangle.c)});
        return oracle;
    }

    /// In the order of t, equal t by triangle index.
    std::vector<ExactHit> hits(const Ray& ray) const {
        const Vec origin = whole(ray.origin), direction = whole(ray.direction);
        const Vec moment =
            cross(origin, direction);  // the ray's line in Plücker coordinates: (direction, moment)
        struct Found {
            ExactHit hit;
            std::int64_t height, speed;  // t = height / speed, speed > 0
        };
        std::vector<Found> found;
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            const auto& [a, b, c] = corners_[i];
            const Vec normal = cross(minus(b, a), minus(c, a));
            const std::int64_t speed = dot(normal, direction),
                               height = dot(normal, minus(a, origin));
            if (speed == 0) continue;
            int zeros = 0, signs = 0;
            for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
                const std::int64_t side =
                    dot(direction, cross(from, to)) + dot(moment, minus(to, from));
                zeros += side == 0;
                signs |= side < 0 ? 1 : side > 0 ? 2 : 0;
            }
            const bool ahead = speed > 0 ? height >= 0 : height <= 0;
            if (signs == 3 || !ahead) continue;
            const Place place = zeros == 0   ? Place::interior
                                : zeros == 1 ? Place::edge
                                             : Place::vertex;
            const std::int64_t sign = speed < 0 ? -1 : 1;
            found.push_back({{.triangle = i, .place = place}, sign * height, sign * speed});
        }
        // -1, 0 or 1 as x is nearer than, as near as or farther than y.
        const auto order = [](const Found& x, const Found& y) {
            const Wide left = Wide{x.height} * y.speed, right = Wide{y.height} * x.speed;
            return left < right ? -1 : left > right ? 1 : 0;
        };
        std::stable_sort(found.begin(), found.end(),
                         [&](const Found& x, const Found& y) { return order(x, y) < 0; });
        std::vector<ExactHit> hits;
        for (std::size_t i = 0; i < found.size(); ++i) {
            found[i].hit.rank =
                i == 0 ? 0 : found[i - 1].hit.rank + (order(found[i - 1], found[i]) < 0);
            // Wrong by at most 2^-64 of itself before it is rounded to float.
            found[i].hit.t = static_cast<float>(static_cast<long double>(found[i].height) /
                                                static_cast<long double>(found[i].speed));
            hits.push_back(found[i].hit);
        }
        return hits;
    }

  private:
    __extension__ typedef __int128 Wide;
    using Vec = std::array<std::int64_t, 3>;

    static Vec whole(const Point3& p) {
        Vec v{};
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] != std::trunc(p[axis]) || std::abs(p[axis]) > largest)
                throw std::invalid_argument("the integer oracle needs small whole numbers");
            v[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(p[axis]);
        }
        return v;
    }
    static Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
    static Vec cross(const Vec& a, const Vec& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static std::int64_t dot(const Vec& a, const Vec& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    std::vector<std::array<Vec, 3>> corners_;
};

}  // namespace space
