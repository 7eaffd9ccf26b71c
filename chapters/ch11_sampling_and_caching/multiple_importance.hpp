/// @file
/// Two ways to choose a direction, both used: how much each one's sample counts (Veach & Guibas
/// 1995, section 3). The weights of a direction add up to 1 over the ways that can choose it, so
/// the sum of the weighted estimates has the right mean, whatever the densities.
#pragma once

namespace space {

// [balance]
/// The weight of a sample that was chosen with density `pdf` where the other way would have chosen
/// it with density `other`: in proportion to the densities. No weights have a variance lower by
/// more than a bound that Veach & Guibas prove.
/// @param pdf positive  @param other not negative
inline double balance_heuristic(double pdf, double other) {
    return 1.0 / (1.0 + other / pdf);
}
/// In proportion to the densities' squares, which is better where one way alone is nearly perfect.
inline double power_heuristic(double pdf, double other) {
    const double ratio = other / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}
// [balance]

}  // namespace space
