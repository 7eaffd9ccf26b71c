/// @file
/// The light that arrives at a point from the hemisphere above it: irradiance by stratified rays,
/// the mean distance of what they meet, and from neighbouring rays how the irradiance changes as
/// the point moves or its normal turns (Ward and Heckbert 1992, "Irradiance Gradients").
#pragma once

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance_record.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/geometry.hpp"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace space {

// [grid]
/// A hemisphere in `rings` x `sectors` cells, each of which sends as much light to the point below
/// as any other where all are equally bright: pi / (rings sectors). Each gets one ray.
struct HemisphereGrid {
    int rings = 24, sectors = 72;

    int cells() const { return rings * sectors; }
    /// Sine of the angle between the pole and the inner edge of a ring; 1 at the horizon, the inner
    /// edge of ring number `rings`.
    double sine(int ring) const { return std::sqrt(double(ring) / rings); }
    double cosine(int ring) const { return std::sqrt(double(rings - ring) / rings); }
    double sector_angle() const { return 2.0 * std::numbers::pi / sectors; }  ///< radians
    /// sin^2, integrated from the pole to the inner edge of a ring.
    double square_to(int ring) const {
        return 0.5 * (std::asin(sine(ring)) - sine(ring) * cosine(ring));
    }
    /// Of length 1, from the x axis towards y by so many sectors. z is the pole.
    Double3 horizontal(double turn) const { return Double3(circle_point(turn / sectors), 0.0); }
    /// Of a point of a cell, given in [0, 1)^2: evenly there, cosine-weighted on the hemisphere.
    Double3 direction(int ring, int sector, const Double2& at) const {
        const double square = (ring + at.x) / rings;  // of the sine
        return horizontal(sector + at.y) * std::sqrt(square) +
               Double3(0.0, 0.0, std::sqrt(1.0 - square));
    }
};
/// A horizontal vector, turned from x towards y.
inline Double3 quarter_turn(const Double3& v) {
    return {-v.y, v.x, v.z};
}
// [grid]

/// What a ray has met.
struct SeenLight {
    Double3 radiance{0.0};
    double distance = infinity;  ///< to the first surface
};

// [gradients]
/// What the cells tell of the light at the pole's foot: cell (ring, sector) has the index
/// sector rings + ring, and what is closer than `closest` counts as that far. Coordinates are the
/// hemisphere's own; position and normal are left as they are.
///
/// As the normal n turns about an axis w, the light L from a direction d changes by
/// L w . (n x d). Over a cell, the integral of that is L sin^2, integrated over its angles to the
/// pole, times the mean of its horizontal vectors across.
///
/// As the point moves, so do the edges between cells, each as if it were drawn on the nearer of
/// both, at a distance r. For a step of 1 outwards the inner edge of a ring comes nearer to the
/// pole by cos / r, and that much more is as bright as the outer cell: weighted, cos sin of it. For
/// a step of 1 across, the edge between two sectors goes back by 1 / (r sin): weighted, cos sin of
/// it, integrated over the ring's angles.
inline IrradianceRecord record_of(const HemisphereGrid& grid, std::span<const SeenLight> cells,
                                  double closest) {
    IrradianceRecord record;
    double closeness = 0.0;
    const double chord = 2.0 * std::sin(0.5 * grid.sector_angle());  // of a sector
    for (int sector = 0; sector < grid.sectors; ++sector) {
        const Double3 outwards = grid.horizontal(sector + 0.5);
        const Double3 across = quarter_turn(outwards);
        const Double3 edge_across = quarter_turn(grid.horizontal(sector));
        for (int ring = 0; ring < grid.rings; ++ring) {
            const auto cell_at = [&](int r, int s) -> const SeenLight& {
                return cells[static_cast<std::size_t>(s * grid.rings + r)];
            };
            const auto add_edge = [&](const SeenLight& from, const SeenLight& to,
                                      const Double3& direction, double width) {
                const double nearer = std::max(closest, std::min(from.distance, to.distance));
                record.translation_gradient +=
                    glm::outerProduct(to.radiance - from.radiance, direction * (width / nearer));
            };
            const SeenLight& cell = cell_at(ring, sector);
            record.irradiance += cell.radiance * (std::numbers::pi / grid.cells());
            closeness += 1.0 / cell.distance;
            record.nearest = std::min(record.nearest, cell.distance);
            record.rotation_gradient += glm::outerProduct(
                cell.radiance,
                across * (chord * (grid.square_to(ring + 1) - grid.square_to(ring))));
            const double sine = grid.sine(ring), cosine = grid.cosine(ring);
            if (ring > 0)
                add_edge(cell_at(ring - 1, sector), cell, outwards, chord * cosine * cosine * sine);
            add_edge(cell_at(ring, (sector + grid.sectors - 1) % grid.sectors), cell, edge_across,
                     grid.sine(ring + 1) - sine);
        }
    }
    record.radius = grid.cells() / closeness;
    return record;
}
// [gradients]

// [gather]
/// Sends a ray into each cell: `look(direction, sampler)` gives what it meets, as a SeenLight.
/// Random is the sampler's pixel `stream`, with a sample for each cell; `cells` lends its memory.
template <class Look>
IrradianceRecord gather_irradiance(const Double3& position, const Double3& normal,
                                   const HemisphereGrid& grid, double closest, Sampler& sampler,
                                   std::uint64_t stream, std::vector<SeenLight>& cells,
                                   const Look& look) {
    const Basis basis(normal);
    cells.clear();
    for (int sector = 0; sector < grid.sectors; ++sector)
        for (int ring = 0; ring < grid.rings; ++ring) {
            sampler.start(stream, static_cast<std::uint32_t>(cells.size()));
            const Double3 local = grid.direction(ring, sector, sampler.next_pair());
            cells.push_back(look(basis.to_world(local), sampler));
        }
    IrradianceRecord record = record_of(grid, cells, closest);
    record.position = position;
    record.normal = normal;
    const glm::dmat3 to_local = glm::transpose(glm::dmat3(basis.x, basis.y, basis.z));
    record.translation_gradient = record.translation_gradient * to_local;
    record.rotation_gradient = record.rotation_gradient * to_local;
    return record;
}
// [gather]

}  // namespace space
