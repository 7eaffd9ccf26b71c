/// @file
/// The light in a closed room of diffuse rectangles, found without a ray: each is cut into patches
/// whose form factors are known exactly, and what the cut costs is bounded (Goral, Torrance,
/// Greenberg, Battaile 1984; the bound is Galerkin's). All light is given as radiance, which a
/// diffuse surface sends out the same in all directions.
#pragma once

#include "chapters/ch11_sampling_and_caching/form_factors.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace space {

/// In a closed room whose surfaces all send out `emission` themselves and reflect the share
/// `reflectance` < 1, each sees the same radiance everywhere: L = emission + reflectance L.
inline double furnace_radiance(double emission, double reflectance) {
    return emission / (1.0 - reflectance);
}

/// One of the rectangles of a closed convex room; its front looks into it.
struct Wall {
    Rectangle shape;
    double reflectance = 0.0;  ///< from 0 to less than 1
    double emission = 0.0;     ///< radiance
};

/// A room's walls, each cut into as many equal patches, and the form factors between these.
struct Patches {
    std::vector<Rectangle> shapes;     ///< wall after wall
    std::vector<std::size_t> wall;     ///< of each patch
    std::vector<double> form_factors;  ///< row after row: from the row's patch to the column's

    double form_factor(std::size_t from, std::size_t to) const {
        return form_factors[from * shapes.size() + to];
    }
};

/// Cuts each wall into `cuts` x `cuts` patches. Patches of one plane do not see each other.
inline Patches cut_walls(std::span<const Wall> walls, int cuts) {
    Patches patches;
    for (std::size_t w = 0; w < walls.size(); ++w)
        for (int i = 0; i < cuts; ++i)
            for (int j = 0; j < cuts; ++j) {
                const Rectangle& whole = walls[w].shape;
                const auto at = [&](int x, int y) {
                    return whole.corner + whole.u * (double(x) / cuts) +
                           whole.v * (double(y) / cuts);
                };
                patches.shapes.push_back(
                    {at(i, j), at(i + 1, j) - at(i, j), at(i, j + 1) - at(i, j)});
                patches.wall.push_back(w);
            }
    const std::size_t n = patches.shapes.size();
    patches.form_factors.assign(n * n, 0.0);
    const auto facing = [](const Rectangle& r) { return glm::sign(glm::cross(r.u, r.v)); };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Rectangle &a = patches.shapes[i], &b = patches.shapes[j];
            if (facing(a) == facing(b)) continue;  // of one plane, since the room is convex
            const double exchanged = exchange_area(a, b);
            patches.form_factors[i * n + j] = exchanged / a.area();
            patches.form_factors[j * n + i] = exchanged / b.area();
        }
    return patches;
}

/// The radiance of each patch, where patch i sends out emission[i] itself and reflects
/// reflectance[i]: each turn adds a bounce. Rows of form factors add up to 1, so a turn that
/// changes nothing by more than `change` leaves at most change * r / (1 - r) to come, r the largest
/// reflectance: rounding, when it ends.
inline std::vector<double> patch_radiances(const Patches& patches,
                                           std::span<const double> reflectance,
                                           std::span<const double> emission) {
    const std::size_t n = patches.shapes.size();
    std::vector<double> now(emission.begin(), emission.end()), next(n);
    for (double change = 1.0, largest = 1.0; change > 0x1p-52 * largest;) {
        change = largest = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            double arriving = 0.0;
            for (std::size_t j = 0; j < n; ++j) arriving += patches.form_factor(i, j) * now[j];
            next[i] = emission[i] + reflectance[i] * arriving;
            change = std::max(change, std::abs(next[i] - now[i]));
            largest = std::max(largest, next[i]);
        }
        now.swap(next);
    }
    return now;
}

/// What patches are like, from their walls.
inline std::vector<double> patch_radiances(const Patches& patches, std::span<const Wall> walls) {
    std::vector<double> reflectance, emission;
    for (const std::size_t w : patches.wall) {
        reflectance.push_back(walls[w].reflectance);
        emission.push_back(walls[w].emission);
    }
    return patch_radiances(patches, reflectance, emission);
}

/// The irradiance that a point of the room gets from all patches: as exact as their radiances, and
/// smoother than these.
inline double room_irradiance(const Patches& patches, std::span<const double> radiance,
                              const Double3& point, const Double3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < patches.shapes.size(); ++i)
        sum += radiance[i] * polygon_irradiance(point, normal, patches.shapes[i].corners());
    return sum;
}

/// The mean radiance of a wall, own emission included: `radiance` +- `error`.
struct WallRadiance {
    double radiance = 0.0, error = 0.0;
};

/// How much of the light that wall l alone sends out comes to wall k, with all bounces, in units of
/// area: entry k * walls + l. It is symmetric, and least squares in the norm of the equation
/// (Galerkin): with finer cuts the diagonal only grows.
inline std::vector<double> wall_exchange(std::span<const Wall> walls, int cuts) {
    const Patches patches = cut_walls(walls, cuts);
    const std::size_t n = patches.shapes.size();
    std::vector<double> exchange(walls.size() * walls.size()), reflectance;
    for (const std::size_t w : patches.wall) reflectance.push_back(walls[w].reflectance);
    for (std::size_t l = 0; l < walls.size(); ++l) {
        std::vector<double> emission(n);
        for (std::size_t i = 0; i < n; ++i) emission[i] = patches.wall[i] == l ? 1.0 : 0.0;
        const std::vector<double> radiance = patch_radiances(patches, reflectance, emission);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                exchange[patches.wall[i] * walls.size() + l] +=
                    patches.shapes[i].area() * patches.form_factor(i, j) * radiance[j];
    }
    return exchange;
}

/// The mean radiance of each wall of the room, from patches of cuts x cuts and of twice as many
/// each way; `cuts` is at least 2.
///
/// Let H be the exact exchange and H' that of patches. H - H' has no negative eigenvalue: with the
/// roots of the reflectances taken to both sides the operator I - sqrt(r) F sqrt(r) is symmetric
/// and positive, and the patches' solution is the best of all that are constant on them. So an
/// entry is wrong by no more than the root of the product of its two diagonal entries' errors.
/// These are squares: with twice as many cuts they fall to a quarter where the light has a slope.
/// Taken for certain is less, a half: then the finer diagonal is wrong by no more than it differs
/// from the coarser one.
inline std::vector<WallRadiance> wall_radiances(std::span<const Wall> walls, int cuts) {
    const std::size_t n = walls.size();
    const std::vector<double> coarse = wall_exchange(walls, cuts),
                              fine = wall_exchange(walls, 2 * cuts);
    const auto error = [&](std::size_t k) {
        return std::max(0.0, fine[k * n + k] - coarse[k * n + k]);
    };
    std::vector<WallRadiance> means;
    for (std::size_t k = 0; k < n; ++k) {
        WallRadiance mean{walls[k].emission, 0.0};
        const double reflected = walls[k].reflectance / walls[k].shape.area();
        for (std::size_t l = 0; l < n; ++l) {
            mean.radiance += reflected * walls[l].emission * fine[k * n + l];
            mean.error += reflected * walls[l].emission * std::sqrt(error(k) * error(l));
        }
        means.push_back(mean);
    }
    return means;
}

}  // namespace space
