/// @file
/// What a structure throws where it would outgrow a limit that its Config sets.
#pragma once

#include <stdexcept>

namespace space {

/// Says in one line which structure met which limit. What it was built from is sound: another
/// Config may do.
struct LimitError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace space
