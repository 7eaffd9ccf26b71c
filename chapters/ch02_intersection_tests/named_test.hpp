/// @file
/// Tests with names, and loops over tuples of them.
#pragma once

#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace space {

/// A test as a type, with its name and one line about it.
template <class T>
struct NamedTest {
    using Test = T;
    std::string_view name, about;
};

/// The test that a NamedTest names.
template <class Named>
using TestOf = typename std::remove_cvref_t<Named>::Test;

/// Calls f(index, named) for each of the tuple's tests.
template <class Tuple, class F>
constexpr void for_each_named(const Tuple& tests, const F& f) {
    std::size_t index = 0;
    std::apply([&](const auto&... named) { (f(index++, named), ...); }, tests);
}

/// What a test makes of a ray once for many shapes, or of a shape once for many rays; the argument
/// itself where it makes nothing.
template <class Test, class Argument>
auto prepared(const Argument& argument) {
    if constexpr (requires { Test::prepare(argument); })
        return Test::prepare(argument);
    else
        return argument;
}

}  // namespace space
