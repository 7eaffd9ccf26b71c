/// @file
/// Are answers in a page the same bits as elsewhere? The module of the live figures and a program
/// are both compiled from this; a test compares what they say.
#pragma once

#include <cstdint>
#include <string>

namespace space::live {

/// Builds a hundred trees by the live figures' builders in turn, over random polygons of which many
/// are degenerate, and asks `rays` rays in all. A line for each builder: fingerprints of its trees
/// and of its answers.
std::string same_bits(std::uint32_t seed, std::uint32_t rays);

}  // namespace space::live
