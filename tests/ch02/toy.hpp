/// @file
/// The toy of chapter 2's staircase to rounding, which keeps three decimal digits.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace space::ch02 {

/// The toy that keeps three decimal digits: a whole number of ten-thousandths, rounded to nearest,
/// ties to even.
inline std::int64_t toy(std::int64_t exact) {
    if (exact < 0) return -toy(-exact);
    std::int64_t unit = 1;
    while (exact / unit >= 1000) unit *= 10;
    const std::int64_t low = exact / unit * unit, twice = 2 * (exact - low);
    const bool up = twice > unit || (twice == unit && low / unit % 2 != 0);
    return up ? low + unit : low;
}
inline std::string decimal(std::int64_t tenthousandths, int digits) {
    return fmt::format("{:.{}f}", static_cast<double>(tenthousandths) / 1e4, digits);
}

}  // namespace space::ch02
