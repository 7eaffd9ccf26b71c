/// @file
/// Exercise 11.4, our answer. One turn is enough: if radius i is cut down by a radius j that k has
/// cut down, or has yet to, k cuts i down as far, since the way by j is no shorter.
#pragma once

#include "common/geometry.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace space {

/// A point at which light was gathered, and at which distances its rays met something; infinity for
/// those that met nothing. There is at least one ray.
struct Record {
    Double3 position{0.0};
    std::vector<double> distances;
};

/// The radius of each record. 0 < low < high.
inline std::vector<double> record_radii(std::span<const Record> records, double low, double high) {
    std::vector<double> radii;
    for (const Record& record : records) {
        double sum = 0.0;
        for (const double d : record.distances) sum += 1.0 / d;
        radii.push_back(std::clamp(static_cast<double>(record.distances.size()) / sum, low, high));
    }
    for (std::size_t i = 0; i < records.size(); ++i)
        for (std::size_t j = 0; j < records.size(); ++j) {
            const double apart = glm::distance(records[i].position, records[j].position);
            radii[i] = std::min(radii[i], radii[j] + apart);
        }
    return radii;
}

}  // namespace space
