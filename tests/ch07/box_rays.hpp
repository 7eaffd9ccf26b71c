/// @file
/// Rays aimed at what the boxes of a tree have in common with rays: faces, edges, corners, planes.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/random.hpp"
#include "tests/suite/test_rays.hpp"

#include <glm/common.hpp>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// In and around the boxes of one tree.
class BoxRays {
  public:
    BoxRays(const BvhNodes<3>& tree, std::span<const Triangle> triangles, std::uint64_t seed)
        : maker_(triangles, seed), random_(seed, 7) {
        tree.for_each_node(
            [&](std::uint32_t index, unsigned) { boxes_.push_back(tree.nodes[index].box); });
    }

    TestRay next() {
        if (boxes_.empty()) return maker_.random();
        const Aabb& box = boxes_[random_.below(std::uint32_t(boxes_.size()))];
        // On a face, an edge or a corner of the box: one, two or three of its planes.
        const std::uint32_t planes = 1 + random_.below(7);
        const Point3 target = on_planes(box, planes);
        const float sign = random_.below(2) ? 1.0f : -1.0f;
        Ray ray{.origin = outside(), .direction = random_vector(random_)};
        switch (random_.below(9)) {
            case 0:
                return maker_.at_edge();
            case 1:
                return maker_.at_vertex();
            case 2:
                return maker_.axis_parallel();
            case 3:
                return maker_.from_vertex();
            case 4:
                ray.origin = target;
                return {"from a face, edge or corner of a box", ray};
            case 5:  // within all of these planes, where that leaves a direction
                ray.direction = way(ray.origin, target);
                for (int axis = 0; axis < 3; ++axis)
                    if ((planes >> axis & 1u) != 0 && planes != 7) {
                        ray.origin[axis] = target[axis];
                        ray.direction[axis] = 0.0f * sign;
                    }
                return {"within planes of a box", ray};
            case 6: {  // nearly within a plane
                const int axis = int(random_.below(3));
                ray.direction = way(ray.origin, target);
                ray.origin[axis] = std::nextafter(target[axis], sign * infinity);
                ray.direction[axis] = sign * 1e-30f;
                return {"nearly within a plane", ray};
            }
            case 7:  // away from it, so that it is met at a negative t
                ray.direction = way(ray.origin, target);
                ray.origin = glm::clamp(target + ray.direction, -largest, largest);
                ray.tmin = -infinity;
                return {"met behind the origin", ray};
            default:
                ray.direction = way(ray.origin, target);
                return {"at a face, edge or corner of a box", ray};
        }
    }

  private:
    /// A point of the box, on one of its two planes across each of these axes.
    Point3 on_planes(const Aabb& box, std::uint32_t planes) {
        Point3 p = random_point(random_, box);
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = random_.below(2) != 0;
            if ((planes >> axis & 1u) != 0) p[axis] = (upper ? box.max : box.min)[axis];
        }
        return p;
    }
    Point3 outside() {
        const Point3 p = boxes_[0].centroid() +
                         1.5f * random_vector(random_) * glm::max(boxes_[0].extent(), 1e-30f);
        return glm::clamp(p, -largest, largest);
    }
    /// Half of the way where all of it is more than a float holds.
    static Vector3 way(const Point3& from, const Point3& to) {
        return is_finite<3>(to - from) ? to - from : 0.5f * to - 0.5f * from;
    }
    static constexpr float largest = 3.4e38f;

    RayMaker maker_;
    Pcg32 random_;
    std::vector<Aabb> boxes_;
};

}  // namespace space
