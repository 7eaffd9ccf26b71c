#include "common/program/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace space {

double Axis::fraction(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low)
                       : (value - low) / (high - low);
}

std::string tick_text(double value, double largest) {
    constexpr std::array<std::pair<double, char>, 4> units{
        {{1e12, 'T'}, {1e9, 'G'}, {1e6, 'M'}, {1e3, 'K'}}};
    if (largest >= 1e4)
        for (const auto& [unit, letter] : units)
            if (value >= unit) return fmt::format("{:g} {}", value / unit, letter);
    return fmt::format("{:g}", value);
}

Axis log_axis(double least, double most, std::size_t most_ticks, double room) {
    // So that no point sits in a corner.
    const double pad = std::pow(std::max(most / least, 2.0), room);
    Axis axis{.logarithmic = true, .low = least / pad, .high = most * pad};
    for (const std::vector<double>& steps :
         {std::vector<double>{1}, std::vector<double>{1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 7}}) {
        std::vector<Tick> ticks;
        for (int e = static_cast<int>(std::floor(std::log10(axis.low)));
             e <= std::ceil(std::log10(axis.high)); ++e)
            for (const double step : steps) {
                const double value = step * std::pow(10.0, e);
                if (value >= axis.low && value <= axis.high)
                    ticks.push_back({value, tick_text(value, axis.high)});
            }
        if (ticks.size() > most_ticks && axis.ticks.size() >= 2) break;  // the coarser ones do
        axis.ticks = std::move(ticks);
        if (axis.ticks.size() >= 3) break;
    }
    if (axis.ticks.size() > most_ticks)  // their names would run into each other
        std::erase_if(axis.ticks, [](const Tick& tick) {
            return std::lround(std::log10(tick.value)) % 3 != 0;
        });
    return axis;
}

Axis linear_axis(double least, double most, double headroom) {
    const double low = std::min(least, 0.0), high = most > low ? most : low + 1.0;
    const double raw = (high - low) / 5, decade = std::pow(10.0, std::floor(std::log10(raw)));
    const double step = decade * (raw <= decade       ? 1
                                  : raw <= 2 * decade ? 2
                                  : raw <= 5 * decade ? 5
                                                      : 10);
    const double first = std::floor(low / step), last = std::ceil(high / step + headroom);
    Axis axis{.low = first * step, .high = last * step};
    for (double k = first; k <= last; ++k)
        axis.ticks.push_back({k * step, tick_text(k * step, axis.high)});
    return axis;
}

}  // namespace space
