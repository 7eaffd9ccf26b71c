#include "ex03_publish_a_node.hpp"

#include "tests/check.hpp"

#include <atomic>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace space;

namespace {

using Order = std::memory_order;

bool acquires(Order order) {
    return order == Order::acquire || order == Order::acq_rel || order == Order::seq_cst;
}
bool releases(Order order) {
    return order == Order::release || order == Order::acq_rel || order == Order::seq_cst;
}

/// std::atomic<std::uint64_t> as one thread sees it: before each step the others may act.
class PlayedWord {
  public:
    std::uint64_t value;
    std::function<void(std::size_t step)> others = [](std::size_t) {};  ///< step: 0 is the first
    std::size_t steps = 0, loads = 0, waits = 0;
    bool is_told = true;         ///< all who wait know of the last change
    bool read_acquired = false;  ///< the value that stands now was read so, or waited for
    bool written_released = true;

    explicit PlayedWord(std::uint64_t begin) : value(begin) {}

    std::uint64_t load(Order order = Order::seq_cst) {
        turn();
        ++loads;
        return read(order);
    }
    void store(std::uint64_t to, Order order = Order::seq_cst) {
        turn();
        write(to, order);
    }
    std::uint64_t exchange(std::uint64_t to, Order order = Order::seq_cst) {
        turn();
        const std::uint64_t before = read(order);
        write(to, order);
        return before;
    }
    bool compare_exchange_strong(std::uint64_t& expected, std::uint64_t to,
                                 Order success = Order::seq_cst) {
        return compare_exchange_strong(expected, to, success,
                                       success == Order::acq_rel   ? Order::acquire
                                       : success == Order::release ? Order::relaxed
                                                                   : success);
    }
    bool compare_exchange_strong(std::uint64_t& expected, std::uint64_t to, Order success,
                                 Order failure) {
        turn();
        if (value != expected) {
            expected = read(failure);
            return false;
        }
        read(success);
        write(to, success);
        return true;
    }
    template <class... Orders>
    bool compare_exchange_weak(std::uint64_t& expected, std::uint64_t to, Orders... orders) {
        if (++weak_ % 3 == 1) {  // fails for no reason, as it may
            turn();
            read_acquired = false;
            return false;
        }
        return compare_exchange_strong(expected, to, orders...);
    }
    void wait(std::uint64_t old, Order order = Order::seq_cst) {
        turn();
        ++waits;
        for (int patience = 0; value == old; ++patience) {
            if (patience == 100) FAIL("it waits for ever: nothing changes the word " << old);
            turn();
        }
        read(order);
    }
    void notify_one() { turn(); }  // there may be two who wait
    void notify_all() {
        turn();
        is_told = true;
    }

  private:
    void turn() {
        if (steps == 1'000) FAIL("after a thousand steps there is no end");
        others(steps++);
    }
    std::uint64_t read(Order order) {
        read_acquired = acquires(order);
        return value;
    }
    void write(std::uint64_t to, Order order) {
        if (to != being_made_word) {
            written_released = releases(order);
            is_told = false;
        }
        value = to;
    }

    std::size_t weak_ = 0;
};

/// make(), counted.
struct Maker {
    int times = 0;
    std::uint64_t operator()() { return ++times, 77; }
};

/// Asked outside of CHECK, where Catch2 3 would take the word's FAIL for a throw of the answer's.
void check_node(PlayedWord& word, Maker& maker, std::uint64_t expected) {
    const std::uint64_t node = node_at(word, std::ref(maker));
    CHECK(node == expected);
}

}  // namespace

TEST_CASE("a node that stands is returned, after one load that acquires") {
    PlayedWord word(42);
    Maker maker;
    check_node(word, maker, 42);
    CHECK(maker.times == 0);
    CHECK(word.steps == 1);
    CHECK(word.loads == 1);
    CHECK(word.read_acquired);
    CHECK(word.value == 42);
}

TEST_CASE("a node that waits is made once, and stands for those who come later") {
    PlayedWord word(waiting_word);
    Maker maker;
    check_node(word, maker, 77);
    CHECK(word.value == 77);
    check_node(word, maker, 77);
    CHECK(maker.times == 1);
}

TEST_CASE("while a node is made the word says so") {
    PlayedWord word(waiting_word);
    std::uint64_t seen = 0;
    node_at(word, [&] {
        seen = word.value;
        return std::uint64_t{77};
    });
    CHECK(seen == being_made_word);
}

TEST_CASE("if another takes the node first, at whatever step, it is not made again") {
    for (std::size_t step = 1; step < 6; ++step) {
        PlayedWord word(waiting_word);
        Maker maker;
        bool is_taken = false;
        word.others = [&](std::size_t now) {
            if (now == step && word.value == waiting_word)
                is_taken = true, word.value = being_made_word;
            if (now == step + 4 && is_taken) word.value = 99;
        };
        CAPTURE(step);
        const std::uint64_t value = node_at(word, std::ref(maker));
        REQUIRE(value == (is_taken ? 99 : 77));
        REQUIRE(maker.times == (is_taken ? 0 : 1));
        REQUIRE(word.value == value);
        REQUIRE(word.read_acquired);
    }
}

TEST_CASE("if another has made it meanwhile, its value counts") {
    PlayedWord word(waiting_word);
    Maker maker;
    word.others = [&](std::size_t now) {
        if (now == 1) word.value = 99;
    };
    check_node(word, maker, 99);
    CHECK(maker.times == 0);
    CHECK(word.read_acquired);
}

TEST_CASE("while another makes it one waits, and does not ask again and again") {
    PlayedWord word(being_made_word);
    Maker maker;
    word.others = [&](std::size_t now) {
        if (now == 40) word.value = 99;
    };
    check_node(word, maker, 99);
    CHECK(maker.times == 0);
    CHECK(word.waits >= 1);
    CHECK(word.loads <= 3);
    CHECK(word.read_acquired);
}

TEST_CASE("what make() has written is released with the value, and all who wait are told") {
    PlayedWord word(waiting_word);
    Maker maker;
    node_at(word, std::ref(maker));
    CHECK(word.written_released);
    CHECK(word.is_told);
}

TEST_CASE("if make() throws, the node waits again, all who wait are told, and the caller knows") {
    PlayedWord word(waiting_word);
    bool caller_knows = false;
    try {
        node_at(word, []() -> std::uint64_t { throw std::runtime_error("no memory"); });
    } catch (const std::runtime_error&) {
        caller_knows = true;
    }
    CHECK(caller_knows);
    CHECK(word.value == waiting_word);
    CHECK(word.is_told);
    Maker maker;
    check_node(word, maker, 77);
    CHECK(maker.times == 1);
}

TEST_CASE("if it throws for another, whoever waited makes the node") {
    PlayedWord word(being_made_word);
    Maker maker;
    word.others = [&](std::size_t now) {
        if (now == 5) word.value = waiting_word;
    };
    check_node(word, maker, 77);
    CHECK(maker.times == 1);
    CHECK(word.value == 77);
}

TEST_CASE("with real threads and a real atomic each node is made once") {
    for (int round = 0; round < sized(200, 20); ++round) {
        std::atomic<std::uint64_t> word{waiting_word};
        std::atomic<int> made{0}, wrong{0};
        int written = 0;
        {
            std::vector<std::jthread> threads;
            for (int i = 0; i < 4; ++i)
                threads.emplace_back([&] {
                    const std::uint64_t value = node_at(word, [&] {
                        ++made;
                        written = 12;
                        return std::uint64_t{77};
                    });
                    if (value != 77 || written != 12) ++wrong;
                });
        }
        REQUIRE(made == 1);
        REQUIRE(wrong == 0);
    }
}
