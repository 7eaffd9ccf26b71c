/// @file
/// Mailboxes: what spares a ray to test a triangle twice.
#pragma once

#include <array>
#include <cstdint>

namespace space {

/// The triangles that a ray has tested last: where a triangle is in several cells, it need not be
/// tested again (Amanatides & Woo 1987). On the ray's own stack: threads share nothing.
class Mailbox {
  public:
    explicit Mailbox(bool used) : used_(used) { last_.fill(~0u); }

    /// Whether the triangle was among the last; it is from now on.
    bool remembers(std::uint32_t triangle) {
        if (!used_) return false;
        std::uint32_t& slot = last_[triangle % last_.size()];
        if (slot == triangle) return true;
        slot = triangle;
        return false;
    }

  private:
    bool used_;
    std::array<std::uint32_t, 16> last_;
};

}  // namespace space
