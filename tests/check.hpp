/// @file
/// What the checks of the exercises share: the book's values in readable numbers, and errors beside
/// what is allowed. A check ends at its first counter-example (REQUIRE or FAIL, also in loops), and
/// says for which ray it was (CAPTURE): more than one teaches no more.
#pragma once

#include "common/accelerator.hpp"
#include "tests/catch.hpp"

#include <concepts>
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

/// As short as tells it from its neighbours.
std::string shortest(float number);
std::string shortest(double number);

}  // namespace space

// Floats as short as tells them from their neighbours. What needs no template is in check.cpp: a
// hundred checks would compile it.
namespace Catch {

template <glm::length_t D, class T, glm::qualifier Q>
struct StringMaker<glm::vec<D, T, Q>> {
    static std::string convert(const glm::vec<D, T, Q>& v) {
        std::string text = "(";
        for (int axis = 0; axis < D; ++axis) {
            if (axis > 0) text += ", ";
            if constexpr (std::floating_point<T>)
                text += space::shortest(v[axis]);
            else
                text += std::to_string(v[axis]);
        }
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
        return Detail::stringify(ray.origin) + " + t " + Detail::stringify(ray.direction) + ", " +
               space::shortest(ray.tmin) + " <= t <= " + space::shortest(ray.tmax);
    }
};

template <>
struct StringMaker<space::Triangle> {
    static std::string convert(const space::Triangle& triangle);
};

template <>
struct StringMaker<space::Segment> {
    static std::string convert(const space::Segment& segment);
};

template <>
struct StringMaker<space::Hit> {
    static std::string convert(const space::Hit& hit);
};

template <>
struct StringMaker<std::optional<space::Hit>> {
    static std::string convert(const std::optional<space::Hit>& hit);
};

template <class Real>
struct StringMaker<space::Number<Real>> {
    static std::string convert(space::Number<Real> number) { return space::shortest(number.value); }
};

template <>
struct StringMaker<space::Error> {
    static std::string convert(const space::Error& error);
};

}  // namespace Catch
