#include "chapters/ch01_naive_ray_tracing/figures/parallel_view.hpp"

#include <fmt/format.h>

namespace space::ch01 {

std::string shown(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_not_of("-0.") == text.npos && text.front() == '-') text.erase(0, 1);
    return text.front() == '-' ? "\u2212" + text.substr(1) : text;
}

}  // namespace space::ch01
