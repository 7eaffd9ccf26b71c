// Three threads and a tree whose root stands: real threads, kept in step so that the order is the
// same each time.

#include "chapters/ch05_lazy_kd_trees/figures.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_nodes.hpp"
#include "common/scene.hpp"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace space::ch05 {
namespace {

/// What one of the threads did.
struct Told {
    enum What { comes, enters, waits, stands, goes_on } what;
    std::size_t thread;
    std::uint32_t node;
};

/// The threads' common account; a thread can wait until it has grown.
class Log {
  public:
    void add(const Told& told) {
        const std::lock_guard guard(lock_);
        all_.push_back(told);
        grown_.notify_all();
    }
    void wait_for(Told::What what, std::size_t thread) {
        std::unique_lock guard(lock_);
        grown_.wait(guard, [&] {
            for (const Told& told : all_)
                if (told.what == what && told.thread == thread) return true;
            return false;
        });
    }
    std::vector<Told> all() const { return all_; }

  private:
    std::mutex lock_;
    std::condition_variable grown_;
    std::vector<Told> all_;
};

thread_local std::size_t this_thread = 0;

/// Writes down what is told. The first thread's node takes until the third one is done.
struct ThreadWatcher : NoObserver {
    Log* log;
    std::uint32_t slow;

    explicit ThreadWatcher(Log& to, std::uint32_t slow_node) : log(&to), slow(slow_node) {}
    using NoObserver::observe;
    void observe(const LazyKdEvent::Entered& event) const {
        if (event.node == 0) return;
        log->add({Told::enters, this_thread, event.node});
        if (event.node == slow) log->wait_for(Told::goes_on, 2);
    }
    void observe(const LazyKdEvent::Waits& event) const {
        log->add({Told::waits, this_thread, event.node});
    }
    void observe(const LazyKdEvent::Stands& event) const {
        if (event.node != 0) log->add({Told::stands, this_thread, event.node});
    }
};

/// The root stands; its children are 2 and 3. One makes 3, another comes to it, a third one to 2.
std::vector<Told> watched_threads() {
    constexpr std::uint32_t near = 3, far = 2;
    const std::vector<Segment> segments = heinonen_segments();
    Log log;
    const LazyKdNodes<2, ThreadWatcher> nodes(
        segments, {.rule = LazyKdTreeConfig::Rule::median, .max_leaf_size = 1, .at_once = 0},
        ThreadWatcher(log, near));
    nodes.node(0);
    const auto come = [&](std::size_t thread, std::uint32_t node) {
        this_thread = thread;
        log.add({Told::comes, thread, node});
        nodes.node(node);
        log.add({Told::goes_on, thread, node});
    };
    std::jthread first(come, 0, near);
    log.wait_for(Told::enters, 0);
    std::jthread second(come, 1, near);
    log.wait_for(Told::waits, 1);
    std::jthread third(come, 2, far);
    third.join();
    first.join();
    second.join();
    return log.all();
}

std::string fmt_node(const char* what, std::uint32_t node) {
    return what + std::to_string(node);
}

constexpr double lanes_left = 120, lane = 74, top = 40, lanes_width = 840;

double y_of(std::size_t thread) {
    return top + lane * double(thread);
}

/// From one moment to another, what a thread is at.
void draw_bar(Svg& svg, std::size_t thread, double from, double to, Ink ink,
              const std::string& text) {
    svg.rect(at(from, y_of(thread)), at(to - from, 34),
             {.stroke = ink, .fill = ink, .opacity = 0.25});
    svg.text(at(0.5 * (from + to), y_of(thread) + 23), text, {.size = 17});
}

}  // namespace

Svg fig_05_04(const Options&) {
    const std::vector<Told> told = watched_threads();
    Svg svg(
        "Three threads at a tree whose root stands: one makes a node, one waits for it, one makes "
        "another node meanwhile",
        lanes_width, top + 3 * lane);
    // The last two moments are those of threads that were set free together: in which order they
    // are told is chance.
    const auto moment = [&](Told::What what, std::size_t thread) {
        for (std::size_t i = 0; i < told.size(); ++i)
            if (told[i].what == what && told[i].thread == thread)
                return lanes_left +
                       (lanes_width - lanes_left - 110) * double(std::min(i, std::size_t{8})) / 8.0;
        return lanes_width;
    };
    const auto node_of = [&](std::size_t thread) {
        for (const Told& event : told)
            if (event.thread == thread) return event.node;
        return 0u;
    };
    for (std::size_t thread = 0; thread < 3; ++thread) {
        svg.text(at(lanes_left - 14, y_of(thread) + 23), std::string("thread ") + "ABC" [thread],
                 { .anchor = Anchor::end, .bold = true });
        svg.line(at(lanes_left, y_of(thread) + 34), at(lanes_width - 8, y_of(thread) + 34),
                 {.stroke = Ink::quiet, .arrow = true});
    }
    const double end = lanes_width - 16, done = moment(Told::stands, 0);
    draw_bar(svg, 0, moment(Told::enters, 0), done, Ink::green,
             fmt_node("makes node ", node_of(0)));
    draw_bar(svg, 0, done, end, Ink::blue, "goes on");
    draw_bar(svg, 1, moment(Told::waits, 1), done, Ink::orange,
             fmt_node("waits for node ", node_of(1)));
    draw_bar(svg, 1, done, end, Ink::blue, "goes on");
    draw_bar(svg, 2, moment(Told::enters, 2), moment(Told::stands, 2), Ink::green,
             fmt_node("makes ", node_of(2)));
    draw_bar(svg, 2, moment(Told::stands, 2), end, Ink::blue, "goes on");
    svg.line(at(done, top - 12), at(done, y_of(1) + 44), {.stroke = Ink::ink, .dashed = true});
    svg.text(at(done, top - 18), "it stands", {.size = 17});
    return svg;
}

}  // namespace space::ch05
