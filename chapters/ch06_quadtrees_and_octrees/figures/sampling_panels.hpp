/// @file
/// Pictures about adaptive sampling: cells, errors, and several of them in one.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/adaptive_sampling.hpp"

namespace space::ch06 {

/// The picture, pale, with its cells: outlines, and orange where a cell is one pixel.
Image cells_of(const AdaptivePicture& picture);
/// The full picture, pale, and on it what is off: blue up to `threshold` of the screen's steps,
/// red beyond.
Image errors_of(const Image& picture, const Image& full, int threshold);
/// Each pixel as scale x scale of them.
Image enlarged(const Image& image, int scale);
/// Two rows of two.
Image four(const Image& a, const Image& b, const Image& c, const Image& d);

}  // namespace space::ch06
