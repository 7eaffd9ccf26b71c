#include "common/program/heat.hpp"

#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <array>

namespace space {

Color heat(double share) {
    constexpr std::array ramp{0x440154u, 0x3B528Bu, 0x21918Cu, 0x5EC962u, 0xFDE725u};
    const double place = std::clamp(share, 0.0, 1.0) * double(ramp.size() - 1);
    const auto step = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
    return glm::mix(srgb(ramp[step]), srgb(ramp[step + 1]),
                    static_cast<float>(place - static_cast<double>(step)));
}

Image heat_bar() {
    Image bar(260, 1);
    for (int x = 0; x < bar.width(); ++x) bar.at(x, 0) = heat((x + 0.5) / bar.width());
    return bar;
}

}  // namespace space
