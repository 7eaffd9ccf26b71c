/// @file
/// Catch2, version 2 (Debian 12) or 3, and how large a test is under sanitizers.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

namespace space {

#ifdef BOOK_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif
/// A test's size: sanitized code is some ten times slower.
template <class T>
constexpr T sized(T full, T sanitized) {
    return is_sanitized ? sanitized : full;
}

}  // namespace space
