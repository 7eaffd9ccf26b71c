/// @file
/// A crowd that walks: instances of one object, each with a matrix for each time. Nothing about the
/// object itself changes.
#pragma once

#include "chapters/ch09_instancing_and_motion/placement.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/random.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

// [crowd]
/// Walkers on a square. Each goes straight on; a wall turns it back, as a mirror would. A pure
/// function of time, like every motion here.
class Crowd {
  public:
    /// On the square with corners at 0 and at `side` along x and z; `speed` is the way in one unit
    /// of time, on average.
    Crowd(std::size_t walkers, double side, double speed, std::uint64_t seed) : side_(side) {
        Pcg32 random(seed);
        for (std::size_t i = 0; i < walkers; ++i) {
            Walker walker;
            for (double* place : {&walker.x, &walker.z}) *place = side * random.uniform_double();
            const Double3 way = random_direction(random);
            const double own = speed * (0.5 + random.uniform_double());
            const double length = std::sqrt(way.x * way.x + way.z * way.z);
            walker.step_x = own * way.x / length;
            walker.step_z = own * way.z / length;
            walkers_.push_back(walker);
        }
    }

    std::size_t size() const { return walkers_.size(); }

    /// Where a walker stands, its x axis in the direction in which it goes.
    ObjectPlacement placement(std::size_t walker, double time) const {
        const auto [x, z, step_x, step_z] = walkers_[walker];
        const Along along_x = along(x + time * step_x), along_z = along(z + time * step_z);
        const Double3 ahead =
            glm::normalize(Double3(along_x.sign * step_x, 0.0, along_z.sign * step_z));
        const Double3 up(0.0, 1.0, 0.0);
        return {.translation = {along_x.place, 0.0, along_z.place},
                .rotation = {ahead, up, glm::cross(ahead, up)}};
    }

    /// All of them as instances of an object.
    std::vector<Instance> instances(std::uint32_t object, double time) const {
        std::vector<Instance> all;
        for (std::size_t i = 0; i < size(); ++i)
            all.push_back({affine(placement(i, time)), object});
        return all;
    }

  private:
    struct Walker {
        double x, z, step_x, step_z;
    };
    /// The way without walls, folded into the square.
    struct Along {
        double place, sign;
    };
    Along along(double way) const {
        const double laps = way / side_, lap = std::floor(laps), rest = way - lap * side_;
        const bool is_back = std::fmod(std::abs(lap), 2.0) == 1.0;
        return is_back ? Along{side_ - rest, -1.0} : Along{rest, 1.0};
    }

    double side_;
    std::vector<Walker> walkers_;
};
// [crowd]

}  // namespace space
