/// @file
/// How workers of a queue end, as plain values.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

/// Which of them the text speaks of.
enum class EndingKind { hasty, published, cure };

/// A build whose first task is held between the pop and the flag.
struct HeldEnd {
    std::string_view ending;
    EndingKind kind = {};
    unsigned threads = 0;
    unsigned too_early = 0;        ///< workers that quit before the tree was whole
    std::size_t most_missing = 0;  ///< triangles in no leaf when one of them did; of 2 threads
};

/// Builds as they come, with nothing injected.
struct NaturalEnds {
    std::string_view ending;
    unsigned threads = 0, builds = 0;
    unsigned with_early_quits = 0;  ///< builds in which a worker quit before the end
    unsigned by_one_worker = 0;     ///< builds in which one worker took all tasks
};

/// All of them.
struct EndingMeasurements {
    std::string scene;
    std::size_t triangles = 0;
    std::vector<HeldEnd> held = {};
    std::vector<NaturalEnds> natural = {};
};

}  // namespace space::ch08
