// Many threads in one lazy tree: with delays wherever one thread could see what another has begun,
// and with errors while others wait.
#include "chapters/ch04_kd_trees/kd_config.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "common/limit_error.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch05/same_tree.hpp"
#include "tests/ch05/watchdog.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <atomic>
#include <barrier>
#include <chrono>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace space {
namespace {

using Answers = std::vector<std::optional<Hit>>;

/// The rays that every thread asks, in an order of its own, and the eager tree's answers.
struct Questions {
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    KdTree<> eager;
    Answers answers;

    Questions(std::vector<Triangle> scene, int count)
        : triangles(std::move(scene)), eager(KdTree<>::build(triangles)) {
        RayMaker maker(triangles, 3);
        for (int i = 0; i < count; ++i) {
            rays.push_back((i % 2 == 0 ? maker.random() : maker.at_edge()).ray);
            answers.push_back(closest_hit(eager, rays.back()));
        }
    }
};

/// What happened in a tree, told by all of its threads.
struct Happened {
    explicit Happened(std::size_t nodes) : entered(nodes), stands(nodes) {}
    std::vector<std::atomic<int>> entered, stands;  ///< by node
    std::atomic<int> waited{0};
};

/// Counts what happens, and now and then takes its time over it.
struct Delays : NoObserver {
    Happened* happened = nullptr;
    std::uint64_t seed = 0;

    using NoObserver::observe;
    void observe(const LazyKdEvent::Entered& event) const {
        ++happened->entered[event.node];
        delay(event.node, 1);
    }
    void observe(const LazyKdEvent::Waits& event) const {
        ++happened->waited;
        delay(event.node, 2);
    }
    void observe(const LazyKdEvent::Stands& event) const {
        ++happened->stands[event.node];
        delay(event.node, 3);
    }
    void observe(const KdSplitter<3>::Chosen& event) const { delay(event.node, 4); }

  private:
    void delay(std::uint32_t node, std::uint64_t place) const {
        Pcg32 random(seed * 1000 + node, place);
        switch (random.below(12)) {
            case 0:
                std::this_thread::sleep_for(std::chrono::microseconds(random.below(60)));
                break;
            case 1:
                std::this_thread::yield();
                break;
            default:
                break;
        }
    }
};

/// Calls body(thread) on several threads that start as one.
template <class Body>
void on_threads(unsigned threads, const Body& body) {
    std::barrier start(threads);
    std::vector<std::jthread> all;
    for (unsigned thread = 0; thread < threads; ++thread)
        all.emplace_back([&, thread] {
            start.arrive_and_wait();
            body(thread);
        });
}

std::size_t wrong_answers(const auto& tree, const Questions& questions, unsigned thread) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < questions.rays.size(); ++i) {
        // Two by two they come to the same nodes at the same time.
        const std::size_t k = (i + thread / 2 * 7) % questions.rays.size();
        wrong += closest_hit(tree, questions.rays[k]) != questions.answers[k];
    }
    return wrong;
}

}  // namespace

TEST_CASE("2 to 8 threads with delays: the same tree and hits each time, one thread makes a node") {
    const int runs = sized(400, 60);
    const Watchdog watchdog(300);
    const Questions questions(scenes::soup(40, 0.3f, 11), 16);
    int waited = 0;
    for (int run = 0; run < runs; ++run) {
        CAPTURE(run);
        const unsigned threads = 2 + unsigned(run) % 7;
        Happened happened(4096);
        Delays delays;
        delays.happened = &happened;
        delays.seed = std::uint64_t(run);
        const auto tree = WatchedLazyKdTree<FilteredExact, Delays>::build(questions.triangles,
                                                                          {.at_once = 0}, delays);
        std::atomic<std::size_t> wrong{0};
        on_threads(threads,
                   [&](unsigned thread) { wrong += wrong_answers(tree, questions, thread); });
        REQUIRE(wrong == 0);
        if (run % 2 == 0) on_threads(threads, [&](unsigned) { tree.build_all(); });
        const SameTree same(questions.eager.nodes(), tree.nodes());
        REQUIRE(same.fault() == "");
        REQUIRE((run % 2 == 1 || same.waiting() == 0));
        std::size_t entered = 0;
        tree.nodes().for_each_cell([&](const auto& cell) {
            const int times = cell.state == LazyKdNodes<3, Delays>::State::waiting ? 0 : 1;
            REQUIRE(happened.entered[cell.node] == times);
            REQUIRE(happened.stands[cell.node] == times);
        });
        for (const std::atomic<int>& times : happened.entered) entered += std::size_t(times);
        REQUIRE(entered == tree.nodes().counts().standing());
        waited += happened.waited;
    }
    fmt::print("  {} runs, in which threads waited {} times for another\n", runs, waited);
    CHECK(waited > runs / 10);
}

TEST_CASE("threads make a larger tree together, without delays") {
    const Watchdog watchdog(300);
    const Questions questions(scenes::soup(sized(4'000u, 400u), 0.05f, 12), sized(2'000, 200));
    for (int run = 0; run < 5; ++run) {
        const auto tree =
            LazyKdTree<>::build(questions.triangles, {.at_once = run % 2 == 0 ? 16u : 0u});
        std::atomic<std::size_t> wrong{0};
        on_threads(4, [&](unsigned thread) { wrong += wrong_answers(tree, questions, thread); });
        CHECK(wrong == 0);
        on_threads(4, [&](unsigned) { tree.build_all(); });
        const SameTree same(questions.eager.nodes(), tree.nodes());
        CHECK(same.fault() == "");
        CHECK(same.waiting() == 0);
    }
}

namespace {

/// Whoever makes the root holds still until all others wait for it, and then fails, so many times.
struct FailsAtRoot : NoObserver {
    struct Shared {
        int others;
        std::atomic<int> waiting{0}, failures{0}, fails;
    };
    Shared* shared;

    explicit FailsAtRoot(Shared* with) : shared(with) {}
    using NoObserver::observe;
    void observe(const LazyKdEvent::Waits&) const { ++shared->waiting; }
    void observe(const KdSplitter<3>::Chosen& event) const {
        if (event.node != 0 || shared->fails.fetch_sub(1) <= 0) return;
        if (shared->failures++ == 0) {
            while (shared->waiting < shared->others) std::this_thread::yield();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));  // until they sleep
        }
        throw std::bad_alloc();
    }
};

}  // namespace

TEST_CASE("an error while a node is made reaches every thread that needs it, and none hangs") {
    const Watchdog watchdog(60);
    const Questions questions(scenes::soup(60, 0.3f, 13), 24);
    const Ray into_box{questions.eager.nodes().box.centroid(), {1, 0, 0}};
    for (const int threads : {2, 8}) {
        FailsAtRoot::Shared shared{.others = threads - 1, .fails = threads};
        const auto tree = WatchedLazyKdTree<FilteredExact, FailsAtRoot>::build(
            questions.triangles, {}, FailsAtRoot(&shared));
        std::atomic<int> errors{0};
        on_threads(unsigned(threads), [&](unsigned) {
            try {
                closest_hit(tree, into_box);
            } catch (const std::bad_alloc&) {
                ++errors;
            }
        });
        CHECK(errors == threads);
        CHECK(shared.failures == threads);
        const LazyKdCounts counts = tree.nodes().counts();
        CHECK(counts.standing() == 0);
        CHECK(counts.waiting == 1);
        // With memory again, all is well.
        CHECK(wrong_answers(tree, questions, 0) == 0);
        tree.build_all();
        const SameTree same(questions.eager.nodes(), tree.nodes());
        CHECK(same.fault() == "");
        CHECK(same.waiting() == 0);
    }
}

TEST_CASE("where one thread fails, one of those that wait makes the node, and the others get it") {
    const Watchdog watchdog(60);
    const Questions questions(scenes::soup(60, 0.3f, 14), 24);
    FailsAtRoot::Shared shared{.others = 7, .fails = 1};
    const auto tree = WatchedLazyKdTree<FilteredExact, FailsAtRoot>::build(questions.triangles, {},
                                                                           FailsAtRoot(&shared));
    std::atomic<int> errors{0};
    std::atomic<std::size_t> wrong{0};
    on_threads(8, [&](unsigned thread) {
        try {
            wrong += wrong_answers(tree, questions, thread);
        } catch (const std::bad_alloc&) {
            ++errors;
        }
    });
    CHECK(errors == 1);
    CHECK(wrong == 0);
}

TEST_CASE("an error at any step of any node leaves the node as it was") {
    /// Fails at the n-th event of the splitter.
    struct FailsAt : NoObserver {
        int* left;
        explicit FailsAt(int* events) : left(events) {}
        using NoObserver::observe;
        void count() const {
            if ((*left)-- == 0) throw std::bad_alloc();
        }
        void observe(const LazyKdEvent::Entered&) const { count(); }
        void observe(const KdSplitter<3>::Chosen&) const { count(); }
        void observe(const KdSplitter<3>::Placed&) const { count(); }
    };
    for (const std::size_t at_once : {0, 8})
        for (const auto& triangles : {scenes::soup(20, 0.5f, 15), scenes::ball(1)}) {
            const auto eager = KdBuilder<3>::build(triangles);
            int failures = 0, left = 0;
            const LazyKdNodes<3, FailsAt> lazy(triangles, {.at_once = at_once}, FailsAt(&left));
            for (int fails_at = 0;; ++fails_at) {
                left = fails_at;
                try {
                    lazy.build_all();
                    break;
                } catch (const std::bad_alloc&) {
                    ++failures;
                }
            }
            CHECK(failures > 20);
            CHECK(lazy.node(0).below() == 2);  // of all that failed no place was lost
            const SameTree same(eager, lazy);
            CHECK(same.fault() == "");
            CHECK(same.waiting() == 0);
        }
}

TEST_CASE("the limit of references holds as in the eager tree, and what was made stays good") {
    const Watchdog watchdog(60);
    const Questions questions(scenes::soup(200, 0.3f, 16), 50);
    const std::size_t needed = [&] {  // counted with lost parts
        std::size_t low = questions.triangles.size(), high = 100'000;
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            try {
                KdBuilder<3>::build(questions.triangles, {.max_references = middle});
                high = middle;
            } catch (const LimitError&) {
                low = middle + 1;
            }
        }
        return low;
    }();
    CHECK_THROWS_AS(LazyKdTree<>::build(questions.triangles, {.max_references = 199}), LimitError);
    for (const std::size_t at_once : {0, 20}) {
        const auto enough = LazyKdTree<>::build(questions.triangles,
                                                {.max_references = needed, .at_once = at_once});
        CHECK_NOTHROW(enough.build_all());
        const auto scarce = LazyKdTree<>::build(questions.triangles,
                                                {.max_references = needed - 1, .at_once = at_once});
        std::atomic<int> errors{0};
        on_threads(4, [&](unsigned) {
            for (int time = 0; time < 2; ++time) try {
                    scarce.build_all();
                } catch (const LimitError&) {
                    ++errors;
                }
        });
        CHECK(errors == 8);
        const SameTree same(questions.eager.nodes(), scarce.nodes());
        CHECK(same.fault() == "");
        CHECK(same.waiting() > 0);
        for (std::size_t i = 0; i < questions.rays.size(); ++i) try {
                const auto hit = closest_hit(scarce, questions.rays[i]);
                CHECK(hit == questions.answers[i]);
            } catch (const LimitError&) {
            }
        // What fits is made: in the end all but one node, whose straddlers are one too many.
        for (std::size_t before = ~0u; before != scarce.nodes().counts().standing();) {
            before = scarce.nodes().counts().standing();
            std::vector<std::uint32_t> nodes;
            scarce.nodes().for_each_cell([&](const auto& cell) { nodes.push_back(cell.node); });
            for (const std::uint32_t node : nodes) try {
                    scarce.nodes().node(node);
                } catch (const LimitError&) {
                }
        }
        CHECK(scarce.nodes().counts().waiting == 1);
    }
}

TEST_CASE("a node that meets the limit takes no room from others, not for a moment") {
    const Watchdog watchdog(300);
    // Two long triangles straddle the middle of the last octant: its node always meets the limit.
    // In the first one lie pairs of specks, around which planes cut off empty space. The moment is
    // short: where one thread's failure takes room, ThreadSanitizer's slow threads nearly always
    // meet it, others seldom.
    std::vector<Triangle> triangles{{{0.3f, 0.3f, 0.3f}, {0.7f, 0.7f, 0.7f}, {0.7f, 0.6f, 0.7f}},
                                    {{0.3f, 0.4f, 0.3f}, {0.7f, 0.7f, 0.7f}, {0.6f, 0.7f, 0.7f}}};
    const auto add_speck = [&](const Point3& at) {
        triangles.push_back({at, at + Vector3(1e-6f, 0, 0), at + Vector3(0, 1e-6f, 1e-6f)});
    };
    for (const float corner : {-1.0f, 0.3f, 0.7f, 1.0f}) add_speck(Point3(corner));
    Pcg32 random(17);
    for (int i = 0; i < 200; ++i) {
        const Point3 at = random_point(random, -0.9f, -0.1f);
        add_speck(at);
        add_speck(at + Vector3(4e-3f));
    }
    for (int run = 0; run < 20; ++run) {
        CAPTURE(run);
        const LazyKdNodes<3> nodes(triangles, {.rule = LazyKdTreeConfig::Rule::middle,
                                               .max_leaf_size = 1,
                                               .max_depth = max_kd_depth,
                                               .max_references = triangles.size(),
                                               .at_once = 0});
        std::uint32_t full = 0;
        for (int level = 0; level < 3; ++level) full = nodes.node(full).below() + 1;
        std::atomic<bool> done{false};
        int refused = 0;
        on_threads(2, [&](unsigned thread) {
            if (thread == 0) {
                while (!done) try {
                        nodes.node(full);
                    } catch (const LimitError&) {
                    }
                return;
            }
            std::vector<std::uint32_t> open{0};
            while (!open.empty()) {
                const std::uint32_t index = open.back();
                open.pop_back();
                if (index != full) try {
                        const KdNode node = nodes.node(index);
                        if (!node.is_leaf())
                            open.insert(open.end(), {node.below() + 1, node.below()});
                    } catch (const LimitError&) {
                        ++refused;
                    }
            }
            done = true;
        });
        CHECK(refused == 0);
        const LazyKdCounts counts = nodes.counts();
        CHECK(counts.waiting == 1);
        CHECK(counts.references + counts.waiting_references == triangles.size());
    }
}

}  // namespace space
