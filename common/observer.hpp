/// @file
/// Observers: whoever watches an algorithm is told each of its steps as an event, a small struct,
/// through `observe(event)`.
#pragma once

namespace space {

/// Ignores every event, and costs nothing. An observer of some events inherits this, says `using
/// NoObserver::observe` and adds an `observe` for each event that it wants.
struct NoObserver {
    template <class Event>
    constexpr void observe(const Event&) const {}
};

}  // namespace space
