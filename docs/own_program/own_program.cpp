// A mesh of one's own, chapter 10's tree over it, and rays through that.
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"

#include <cstdio>
#include <optional>
#include <vector>

namespace {

/// The saddle z = x^2 - y^2 over -1 <= x, y <= 1, as 2 n^2 triangles.
std::vector<space::Triangle> saddle(int n) {
    const auto corner = [n](int i, int j) {
        const float x = 2.0f * float(i) / float(n) - 1.0f, y = 2.0f * float(j) / float(n) - 1.0f;
        return space::Point3(x, y, x * x - y * y);
    };
    std::vector<space::Triangle> triangles;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
            triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
        }
    }
    return triangles;
}

}  // namespace

int main() {
    const std::vector<space::Triangle> triangles = saddle(100);
    const auto tree = space::FastBvh<>::build(triangles);
    std::printf("%zu triangles, %zu nodes\n", triangles.size(), tree.shape().nodes.value_or(0));

    const space::Point3 eye(0.1f, -3.0f, 1.0f);
    for (const float down : {0.0f, 0.5f, 0.75f, 1.0f}) {
        const space::Ray ray{.origin = eye, .direction = {0.0f, 1.0f, -down}};
        if (const std::optional<space::Hit> hit = closest_hit(tree, ray)) {
            const space::Point3 p = ray.at(hit->t);
            std::printf("%.2f down: triangle %u at %.4f %.4f %.4f\n", double(down), hit->triangle,
                        double(p.x), double(p.y), double(p.z));
        } else {
            std::printf("%.2f down: nothing\n", double(down));
        }
    }
    const space::Point3 other(0.0f, 3.0f, -1.25f);
    const space::Ray sight{.origin = eye, .direction = other - eye, .tmin = 0.0f, .tmax = 1.0f};
    std::printf("the other side is %s\n", any_hit(tree, sight) ? "hidden" : "seen");
}
