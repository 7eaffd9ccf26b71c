// The limit that threads share.
#include "chapters/ch05_lazy_kd_trees/shared_limit.hpp"

#include "tests/catch.hpp"

#include <algorithm>
#include <cstddef>

namespace space {
namespace {

/// A counter that remembers its highest value, and lets another thread in before an exchange.
struct Watched {
    static inline std::size_t highest, value, others;

    explicit Watched(std::size_t begin) {
        set(begin);
        highest = value;
    }
    std::size_t load() const { return value; }
    bool compare_exchange_weak(std::size_t& expected, std::size_t next) {
        set(value + others);
        others = 0;
        if (value == expected) {
            set(next);
            return true;
        }
        expected = value;
        return false;
    }
    std::size_t fetch_add(std::size_t more) {
        set(value + more);
        return value - more;
    }
    std::size_t operator+=(std::size_t more) { return fetch_add(more) + more; }
    std::size_t operator-=(std::size_t less) {
        set(value - less);
        return value;
    }

  private:
    static void set(std::size_t to) {
        value = to;
        highest = std::max(highest, value);
    }
};

}  // namespace

TEST_CASE("a shared limit is never exceeded, not for a moment, and what fails takes nothing") {
    SharedLimit<Watched> limit(10);
    CHECK(limit.take(7));
    CHECK_FALSE(limit.take(4));
    CHECK(Watched::value == 7);
    CHECK(limit.take(3));
    CHECK_FALSE(limit.take(1));
    CHECK_FALSE(limit.take(~std::size_t{0}));
    CHECK(limit.take(0));
    CHECK(Watched::highest == 10);
    limit.give_back(5);
    CHECK_FALSE(limit.take(6));
    CHECK(limit.take(5));
    CHECK(Watched::highest == 10);
}

TEST_CASE("what another thread takes meanwhile counts, too") {
    SharedLimit<Watched> limit(10);
    Watched::others = 4;
    CHECK(limit.take(6));  // after the other
    CHECK(Watched::value == 10);
    limit.give_back(10);
    Watched::others = 5;
    CHECK_FALSE(limit.take(6));
    CHECK(Watched::value == 5);
    CHECK(Watched::highest == 10);
}

}  // namespace space
