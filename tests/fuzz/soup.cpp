// Triangles and rays of hostile floats, made of bytes.
#include "common/geometry.hpp"
#include "tests/fuzz/answers.hpp"
#include "tests/fuzz/kinds.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace space::fuzz {
namespace {

using Number = std::numeric_limits<float>;

/// Where trees and tests go wrong: both zeros, neighbours of 1, of denormal numbers and of the
/// largest, powers of two at the kernels' bounds, and what is no number. Small whole numbers stand
/// between, so that triangles share corners and planes.
constexpr std::array hostile{0.0f,
                             -0.0f,
                             1.0f,
                             -1.0f,
                             2.0f,
                             -2.0f,
                             3.0f,
                             -3.0f,
                             0.5f,
                             0.25f,
                             -0.5f,
                             0.1f,
                             1.0f / 3.0f,
                             1.0f + Number::epsilon(),
                             1.0f - Number::epsilon() / 2,
                             -1.0f - Number::epsilon(),
                             100.0f,
                             1e3f,
                             1e6f,
                             16777216.0f,
                             1e-3f,
                             1e-6f,
                             0x1p-24f,
                             0x1p30f,
                             -0x1p30f,
                             0x1.000002p30f,
                             0x1p-90f,
                             0x1.fffffep-91f,
                             0x1p63f,
                             0x1p100f,
                             Number::min(),
                             -Number::min(),
                             Number::denorm_min(),
                             -Number::denorm_min(),
                             1e-42f,
                             Number::max(),
                             Number::lowest(),
                             1e38f,
                             Number::infinity(),
                             -Number::infinity(),
                             Number::quiet_NaN()};

/// Takes bytes; zeros after the last.
struct Tape {
    std::string_view bytes;

    unsigned byte() {
        if (bytes.empty()) return 0;
        const auto first = static_cast<unsigned char>(bytes.front());
        bytes.remove_prefix(1);
        return first;
    }
    /// One of the hostile ones, a number of sixteenths, or any four bytes.
    float number() {
        const unsigned kind = byte();
        if (kind < hostile.size()) return hostile[kind];
        if (kind < 240) return (float(kind) - 140.0f) / 16.0f;
        std::array<unsigned char, 4> raw{};
        for (unsigned char& each : raw) each = static_cast<unsigned char>(byte());
        float any;
        std::memcpy(&any, raw.data(), sizeof any);
        return any;
    }
    Point3 point() {
        const float x = number(), y = number(), z = number();
        return {x, y, z};
    }
    /// A new corner, or one of before.
    Point3 corner(const std::vector<Triangle>& before) {
        const unsigned which = byte();
        if (which % 2 == 0 || before.empty()) return point();
        return before[which / 6 % before.size()][static_cast<int>(which / 2 % 3)];
    }
};

/// Aimed at a corner, at a point of an edge, or anywhere.
Ray ray_of(Tape& tape, const std::vector<Triangle>& triangles) {
    const unsigned kind = tape.byte();
    Ray ray{.origin = tape.corner(triangles), .direction = tape.point()};
    if (kind % 4 != 0 && !triangles.empty()) {
        const Triangle& at = triangles[kind / 4 % triangles.size()];
        const Point3 aim = kind % 4 == 1   ? at.a
                           : kind % 4 == 2 ? at.a * 0.5f + at.b * 0.5f
                                           : at.a + (at.b - at.a) * 0.25f + (at.c - at.a) * 0.5f;
        ray.direction = aim - ray.origin;
    }
    if (kind >= 128) {
        ray.tmin = tape.number();
        ray.tmax = tape.number();
    }
    return ray;
}

}  // namespace

void feed_triangles(std::string_view bytes) {
    Tape tape{bytes};
    const unsigned head = tape.byte();
    std::vector<Triangle> triangles(head % 24);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::vector<Triangle> before(triangles.begin(),
                                           triangles.begin() + static_cast<std::ptrdiff_t>(i));
        for (Point3* corner : {&triangles[i].a, &triangles[i].b, &triangles[i].c})
            *corner = tape.corner(before);
    }
    std::vector<Ray> rays;
    do rays.push_back(ray_of(tape, triangles));
    while (!tape.bytes.empty() && rays.size() < 16);
    Answers(std::move(triangles), head < 224 ? 1 : 2).compare(rays);
}

}  // namespace space::fuzz
