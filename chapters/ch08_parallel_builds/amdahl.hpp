/// @file
/// Amdahl's law: what the part of a program that one core has to do leaves for the others to gain.
#pragma once

namespace space {

// [amdahl]
/// How many times faster on so many cores, where a share of the time on one core stays serial and
/// the rest is divided evenly (Amdahl 1967).
inline double amdahl_speedup(double serial_share, double cores) {
    return 1.0 / (serial_share + (1.0 - serial_share) / cores);
}

/// What no number of cores exceeds.
inline double amdahl_bound(double serial_share) {
    return 1.0 / serial_share;
}

/// The share that explains a measured speed-up on so many cores, at least two (Karp & Flatt 1990).
inline double serial_share_of(double speedup, double cores) {
    return (1.0 / speedup - 1.0 / cores) / (1.0 - 1.0 / cores);
}
// [amdahl]

}  // namespace space
