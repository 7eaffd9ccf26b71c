/// @file
/// Exercise 12.3: Which structure for which job?
/// Difficulty 1 of 3, about 30 minutes.
///
/// Choose a structure of this book, by its name in the lab (`./book lab --structure list`), for
/// each of three jobs. There is no code to write: read the chapter's tables and charts, and say
/// why.
///
/// 1. `click`: a program loads a scanned mesh of about a million triangles, somebody clicks on one
///    point of its picture, the program tells which triangle that is, and ends. One ray.
/// 2. `bake`: the light of a building of about a hundred thousand triangles is computed once and
///    for all, from 10^10 rays that leave its surfaces to all sides.
/// 3. `pocket`: the same building and as many such rays, on a small device: no more than 32 bytes
///    for each of its triangles, for the structure and all that it needs.
///
/// The check takes the times and bytes of the chapter's kept measurement (`figures/measured`),
/// build and rays together. No structure of the book that fits may be done in less than 1 / 1.15 of
/// the time of yours.
#pragma once

#include <string_view>

namespace space {

/// What a structure is wanted for.
enum class Job { click, bake, pocket };

/// The name of a structure, as the lab has it.
inline std::string_view structure_for(Job job) {
    switch (job) {
        case Job::click:
        case Job::bake:
        case Job::pocket:
            break;
    }
    return "bvh-binned";  // TODO: a good tree, but not the best for each of them
}

}  // namespace space
