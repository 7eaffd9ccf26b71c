/// @file
/// Exercise 9.5: When is rebuilding worth it?
/// Difficulty 2 of 3, about 35 minutes.
///
/// An animation of so many frames as `rays` has entries. Its tree is built in the first frame, and
/// in every `period`-th from there on: with 3 in frames 0, 3, 6 and so on. In all others it is
/// refitted. What the rays of a frame cost depends on how long ago the tree was built: `rays[0]` in
/// the frame in which it was, `rays[1]` in the one after that, and so on. A build costs `build`, a
/// refit `refit`, all in the same unit.
///
/// Which period makes the whole animation cheapest? From 1, a build in every frame, to the number
/// of frames, one build and never again. Of periods that cost the same take the longest.
///
/// All costs are whole numbers below 10^6, so sums are exact. There is at least one frame.
#pragma once

#include <cstddef>
#include <span>

namespace space {

inline std::size_t best_period(double /*build*/, double /*refit*/, std::span<const double> rays) {
    return rays.size();  // TODO: never again may be too seldom
}

}  // namespace space
