/// @file
/// Exercise 12.3, a near miss: for each job the tree that is traced fastest. A build counts as
/// well, and memory.
#pragma once

#include <string_view>

namespace space {

/// What a structure is wanted for.
enum class Job { click, bake, pocket };

/// The name of a structure, as the lab has it.
inline std::string_view structure_for(Job job) {
    switch (job) {
        case Job::click:
            return "fast";
        case Job::bake:
            return "fast";
        case Job::pocket:
            break;
    }
    return "fast";
}

}  // namespace space
