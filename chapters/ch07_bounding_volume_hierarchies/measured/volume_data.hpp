/// @file
/// What is counted and timed of bounding volumes, as plain values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch07 {

inline constexpr std::string_view box_kind = "box", ritter_kind = "sphere, Ritter's",
                                  sphere_kind = "sphere, smallest",
                                  principal_kind = "oriented box, principal axes",
                                  tight_kind = "oriented box, tight", dop14_kind = "14-DOP",
                                  dop18_kind = "18-DOP", dop26_kind = "26-DOP";

/// One kind of volume around parts of one scene that are about equally large. Rays are lines that
/// are equally likely everywhere and in all directions.
struct VolumePoint {
    std::string scene;
    std::uint64_t part_size = 0;  ///< triangles of a part, at most
    std::string_view kind;
    std::uint64_t parts = 0, rays = 0;
    std::uint64_t met = 0;      ///< rays that meet the volume
    std::uint64_t hits = 0;     ///< rays that hit a triangle of the part
    double chance = 0.0;        ///< that a ray meets the volume, by surfaces: the parts' mean
    double least_chance = 0.0;  ///< the same of the tightest volume of each part
    std::uint64_t twice = 0;    ///< parts with at least twice the tight oriented box's surface

    /// Of the rays that meet the volume those that hit nothing in it.
    double empty_share() const { return 1.0 - double(hits) / double(met); }
    double looseness() const { return chance / least_chance; }
};

/// A ray against a volume.
struct VolumeTest {
    std::string_view kind;
    std::uint64_t bytes = 0;  ///< of a volume
    double ns = 0.0;          ///< of one test; the ray is prepared
    double chance = 0.0;      ///< that it meets one, in these tests
};

/// Volumes around a needle that is turned away from the axes (figure 6 of Heinonen16).
struct NeedlePoint {
    double thickness = 0.0;            ///< of its length
    double box = 0.0, oriented = 0.0;  ///< surfaces, of the length's square
};

/// All that is counted and timed of volumes.
struct VolumeMeasurements {
    std::vector<VolumePoint> points;
    std::vector<NeedlePoint> needles;
    std::vector<VolumeTest> tests;  ///< none where nothing is timed
};

}  // namespace space::ch07
