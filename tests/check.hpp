/// @file
/// What the checks of the exercises share: the book's values in readable numbers, and errors beside
/// what is allowed. A check ends at its first counter-example (REQUIRE or FAIL, also in loops), and
/// says for which ray it was (CAPTURE): more than one teaches no more.
#pragma once

#include "common/accelerator.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

namespace space {

/// As a condition: whether an error is at most what is allowed; NaN is not.
struct Error {
    double is, allowed;

    explicit operator bool() const { return is <= allowed; }
};

/// A float or double that is printed as short as tells it from its neighbours: Catch2 prints a
/// small one as 0.0f.
template <class Real>
struct Number {
    Real value;

    bool operator==(const Number&) const = default;
};
template <class Real>
Number(Real) -> Number<Real>;

}  // namespace space

// Floats as short as tells them from their neighbours.
namespace Catch {

template <glm::length_t D, class T, glm::qualifier Q>
struct StringMaker<glm::vec<D, T, Q>> {
    static std::string convert(const glm::vec<D, T, Q>& v) {
        std::string text = "(";
        for (int axis = 0; axis < D; ++axis) text += fmt::format("{}{}", axis ? ", " : "", v[axis]);
        return text + ")";
    }
};

template <int D>
struct StringMaker<space::BasicAabb<D>> {
    static std::string convert(const space::BasicAabb<D>& box) {
        return "from " + Detail::stringify(box.min) + " to " + Detail::stringify(box.max);
    }
};

template <int D>
struct StringMaker<space::BasicRay<D>> {
    static std::string convert(const space::BasicRay<D>& ray) {
        return fmt::format("{} + t {}, {} <= t <= {}", Detail::stringify(ray.origin),
                           Detail::stringify(ray.direction), ray.tmin, ray.tmax);
    }
};

template <>
struct StringMaker<space::Triangle> {
    static std::string convert(const space::Triangle& t) {
        return Detail::stringify(t.a) + " " + Detail::stringify(t.b) + " " + Detail::stringify(t.c);
    }
};

template <>
struct StringMaker<space::Segment> {
    static std::string convert(const space::Segment& s) {
        return Detail::stringify(s.a) + " " + Detail::stringify(s.b);
    }
};

template <>
struct StringMaker<space::Hit> {
    static std::string convert(const space::Hit& hit) {
        return fmt::format("triangle {} at t = {} (u = {}, v = {})", hit.triangle, hit.t, hit.u,
                           hit.v);
    }
};

template <>
struct StringMaker<std::optional<space::Hit>> {
    static std::string convert(const std::optional<space::Hit>& hit) {
        return hit ? Detail::stringify(*hit) : "no hit";
    }
};

template <class Real>
struct StringMaker<space::Number<Real>> {
    static std::string convert(space::Number<Real> number) {
        return fmt::format("{}", number.value);
    }
};

template <>
struct StringMaker<space::Error> {
    static std::string convert(const space::Error& error) {
        int digits = 2;  // and as many more as tell the two numbers apart
        const auto text = [&](double x) { return fmt::format("{:.{}g}", x, digits); };
        while (digits < 17 && error.is != error.allowed && text(error.is) == text(error.allowed))
            ++digits;
        return fmt::format("{} (allowed {})", text(error.is), text(error.allowed));
    }
};

}  // namespace Catch
