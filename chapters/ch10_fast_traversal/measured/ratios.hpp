/// @file
/// How many times as much one thing is as another, over scenes and kinds of rays.
#pragma once

#include "common/measure.hpp"

#include <algorithm>
#include <vector>

namespace space::ch10 {

/// The least, the median and the largest of what is there.
struct Ratios {
    std::vector<double> all;

    void add(double over, double under) {
        if (over > 0.0 && under > 0.0) all.push_back(over / under);
    }
    double least() const { return all.empty() ? 0.0 : *std::ranges::min_element(all); }
    double middle() const { return all.empty() ? 0.0 : median(all); }
    double most() const { return all.empty() ? 0.0 : *std::ranges::max_element(all); }
};

}  // namespace space::ch10
