/// @file
/// Exercise 11.4: How far a record reaches
/// Difficulty 2 of 3, about 40 minutes.
///
/// A record of the radiance cache serves points around it, up to a radius. Near other surfaces
/// light changes fast, so the radius begins as the harmonic mean of the distances at which the
/// record's rays met something: *n* over the sum of 1 / *d*. In a corner that is nearly 0, and
/// below an open sky it is infinite, so it is then brought into the range from `low` to `high`.
///
/// That is not all. Of two records at the distance *d* from each other one may have seen the crack
/// below a door, which all rays of the other have missed. What one sees at 1 m, the other must have
/// at 1 m + *d* at most: no record's radius may be larger than that of any other plus the distance
/// between the two. Of all radii that fulfil this, and are no larger than they were, take the
/// largest. The order of the records does not matter.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
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
inline std::vector<double> record_radii(std::span<const Record> records, double /*low*/,
                                        double high) {
    std::vector<double> radii;  // TODO: the nearest distance is too careful
    for (const Record& record : records)
        radii.push_back(
            std::min(high, *std::min_element(record.distances.begin(), record.distances.end())));
    return radii;
}

}  // namespace space
