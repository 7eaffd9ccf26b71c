/// @file
/// Exercise 11.4, a near miss: each record looks at those before it, as if the cache were filled
/// one by one. A record that sees the crack later does not tell those that have missed it.
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
        for (std::size_t j = 0; j < i; ++j) {
            const double apart = glm::distance(records[i].position, records[j].position);
            radii[i] = std::min(radii[i], radii[j] + apart);
        }
    return radii;
}

}  // namespace space
