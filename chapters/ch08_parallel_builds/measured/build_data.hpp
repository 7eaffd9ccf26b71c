/// @file
/// What chapter 8 counts and times of builds, as plain values: enough for table 3 anew, its
/// charts, and the verdict on claim P8.
#pragma once

#include "chapters/ch08_parallel_builds/measured/timing.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

inline constexpr std::string_view sequential = "sequential", symmetric = "symmetric",
                                  asymmetric = "asymmetric", by_queue = "queue", ours = "ours",
                                  embree = "Embree", by_sweep = "sweep", morton = "Morton",
                                  parallel_morton = "parallel Morton",
                                  two_at_once = "two builds at once";

/// The methods of [BvhThesis13], in the order of its tables.
inline constexpr std::array<std::string_view, 3> published_methods{symmetric, asymmetric, by_queue};

/// A row of table 3 (2 threads) or 4 (4 threads) of [BvhThesis13]: seconds, and shares as printed.
struct PublishedBuild {
    std::string_view scene;     ///< theirs
    std::string_view stand_in;  ///< ours for it
    unsigned threads;
    double sequential_s;
    std::array<double, 3> parallel_s;       ///< by published_methods
    std::array<double, 3> printed_percent;  ///< by how much the time falls

    double gain(std::size_t method) const { return sequential_s / parallel_s[method]; }
    double fall(std::size_t method) const { return 1.0 - parallel_s[method] / sequential_s; }
};
const std::vector<PublishedBuild>& published_builds();

/// One way to build one scene.
struct BuildPoint {
    std::string scene;
    std::string_view method;
    unsigned threads = 1;
    std::uint64_t n = 0;  ///< triangles
    double cost = 0.0;    ///< of a ray that meets the root; none where the method does not tell
    Spread ms;
    Spread gain;  ///< the sequential build's time over it
};

/// Builds of one scene by one method with several threads: what must be the same.
struct SamePoint {
    std::string scene;
    std::string_view method;
    std::uint64_t n = 0, nodes = 0, depth = 0;
    double cost = 0.0;
    std::vector<unsigned> threads;
    std::uint64_t builds = 0;
    std::uint64_t other = 0;  ///< trees that are not the sequential builder's
};

/// What two threads can gain at most: two sequential builds at once.
struct CeilingPoint {
    std::string scene;
    std::uint64_t n = 0;
    Spread alone_ms;   ///< one build by itself
    Spread both_ms;    ///< two of them at once, until both are done
    Spread gain;       ///< 2 alone / both: 2 where neither is in the other's way
    Spread copy_gain;  ///< the same for copies of the triangles in memory
};

/// The five scenes like those of [BvhThesis13].
struct SceneBuilds {
    std::vector<BuildPoint> points;
    std::vector<CeilingPoint> ceilings;
};

/// All of them.
struct BuildMeasurements {
    std::vector<SamePoint> same;
    // None where nothing is timed.
    std::vector<BuildPoint> scenes;  ///< the five like those of [BvhThesis13]
    std::vector<BuildPoint> growth;  ///< a scene as it grows
    std::vector<CeilingPoint> ceilings;
};

/// Trees that are not the sequential builder's.
std::uint64_t other_trees(const BuildMeasurements& measured);

/// The scene's point; null where there is none.
const BuildPoint* point_of(const std::vector<BuildPoint>& points, std::string_view scene,
                           std::string_view method, unsigned threads);

}  // namespace space::ch08
