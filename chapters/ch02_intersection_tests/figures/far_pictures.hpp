/// @file
/// The same mesh, far from the world's origin, through the eyes of every triangle test; wrong
/// pixels marked.
#pragma once

#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/image.hpp"
#include "common/scene.hpp"

#include <array>
#include <string_view>

namespace space::ch02 {

/// What one test makes of a scene far from the origin.
struct FarPicture {
    /// What wrong pixels are filled with: the palette's vermillion.
    static constexpr Color mark{0.665f, 0.112f, 0.0f};

    std::string_view test;
    Image image{0, 0};
    std::uint64_t wrong =
        0;  ///< pixels that see another triangle than in exact arithmetic, or one only here
};

/// A bumpy ball of radius 1, moved by 10^shift (1, 1/2, -1/4), seen from 5000 radii away through a
/// long lens: the rays' origins and the vertices have few digits in common. side x side pixels.
std::array<FarPicture, triangle_test_count> far_pictures(int side, int shift, unsigned threads);

}  // namespace space::ch02
