#include "common/random.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cmath>

namespace space {

std::vector<Segment> scattered_segments() {
    std::vector<Segment> segments;
    Pcg32 random(27);
    while (segments.size() < 22) {
        const Point2 middle = random_point(random, Aabb2{{1.5f, 1.0f}, {24.5f, 12.0f}});
        const auto angle = static_cast<double>(random.uniform(0.0f, 3.14f));
        const double half = static_cast<double>(random.uniform(0.5f, 1.4f));
        const Vector2 way(half * Double2(std::cos(angle), std::sin(angle)));
        const bool near = std::ranges::any_of(segments, [&](const Segment& other) {
            return glm::length(0.5f * (other.a + other.b) - middle) < 2.4f;
        });
        if (!near) segments.push_back({middle - way, middle + way});
    }
    return segments;
}

}  // namespace space
