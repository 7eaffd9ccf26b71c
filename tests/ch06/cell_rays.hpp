/// @file
/// Rays aimed at what an octree's cells have in common: faces, edges, corners.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_nodes.hpp"
#include "common/random.hpp"
#include "tests/suite/test_rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// In and around the cells of one tree.
class CellRays {
  public:
    CellRays(const OrthtreeNodes<3>& tree, std::span<const Triangle> triangles, std::uint64_t seed)
        : triangles_(triangles), maker_(triangles, seed), random_(seed, 6), bounds_(tree.bounds) {
        tree.for_each_cell([&](std::uint32_t, const OrthtreeCell<3>& cell) {
            cells_.push_back(tree.frame.box(cell));
        });
    }

    TestRay next() {
        if (cells_.empty() || triangles_.empty()) return maker_.random();
        const OrthtreeBox<3>& cell = cells_[random_.below(std::uint32_t(cells_.size()))];
        // On a face, an edge or a corner of the cell: one, two or three of its planes.
        const std::uint32_t planes = 1 + random_.below(7);
        const Point3 target = on_planes(cell, planes);
        const float sign = random_.below(2) ? 1.0f : -1.0f;
        Ray ray{.origin = target, .direction = random_vector(random_)};
        switch (random_.below(10)) {
            case 0:
                return maker_.at_edge();
            case 1:
                return maker_.at_vertex();
            case 2:
                return maker_.axis_parallel();
            case 3:
                ray.origin = outside();
                ray.direction = target - ray.origin;
                return {"at a face, edge or corner of a cell", ray};
            case 4:
                return {"from a face, edge or corner of a cell", ray};
            case 5: {  // within all of these planes, where that leaves a direction
                ray.origin = outside();
                ray.direction = target - ray.origin;
                for (int axis = 0; axis < 3; ++axis)
                    if ((planes >> axis & 1u) != 0 && planes != 7) {
                        ray.origin[axis] = target[axis];
                        ray.direction[axis] = 0.0f * sign;
                    }
                return {"within planes of a cell", ray};
            }
            case 6: {  // along a diagonal: all planes of a cell's corner at one t
                for (int axis = 0; axis < 3; ++axis)
                    ray.direction[axis] = random_.below(2) ? 1.0f : -1.0f;
                if (random_.below(3) == 0) ray.direction[int(random_.below(3))] = 0.0f * sign;
                const float back = float(cell.max.x - cell.min.x) * float(random_.below(5));
                ray.origin = target - back * ray.direction;
                return {"along a diagonal", ray};
            }
            case 7: {  // nearly within a plane
                const int axis = int(random_.below(3));
                ray.origin = outside();
                ray.direction = target - ray.origin;
                ray.origin[axis] = std::nextafter(target[axis], sign * infinity);
                ray.direction[axis] = sign * 1e-30f;
                return {"nearly within a plane", ray};
            }
            case 8: {  // away from it, so that it is met at a negative t
                ray.direction = target - outside();
                ray.origin = target + ray.direction;
                ray.tmin = -infinity;
                return {"met behind the origin", ray};
            }
            default: {  // where a triangle's edge meets a plane
                const Triangle& t = triangles_[random_.below(std::uint32_t(triangles_.size()))];
                const int edge = int(random_.below(3)), axis = int(random_.below(3));
                const Double3 a(t[edge]), b(t[(edge + 1) % 3]);
                const double s = (cell.min[axis] - a[axis]) / (b[axis] - a[axis]);
                Point3 meet = target;
                if (s >= 0.0 && s <= 1.0) meet = Point3(a + s * (b - a));
                ray.origin = outside();
                ray.direction = meet - ray.origin;
                return {"at an edge in a plane", ray};
            }
        }
    }

  private:
    /// A point of the cell, on one of its two planes across each of these axes.
    Point3 on_planes(const OrthtreeBox<3>& cell, std::uint32_t planes) {
        Point3 p = random_point(random_, Aabb{Point3(cell.min), Point3(cell.max)});
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = random_.below(2) != 0;
            if ((planes >> axis & 1u) != 0) p[axis] = float((upper ? cell.max : cell.min)[axis]);
        }
        return p;
    }
    Point3 outside() {
        return bounds_.centroid() +
               1.5f * random_vector(random_) * glm::max(bounds_.extent(), 1e-30f);
    }

    std::span<const Triangle> triangles_;
    RayMaker maker_;
    Pcg32 random_;
    Aabb bounds_;
    std::vector<OrthtreeBox<3>> cells_;
};

}  // namespace space
