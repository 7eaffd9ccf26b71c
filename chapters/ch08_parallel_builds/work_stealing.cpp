#include "chapters/ch08_parallel_builds/work_stealing.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <utility>

// ThreadSanitizer sees no atomics inside the installed library. So this file is compiled without it
// where there is one, and what TBB promises is told to it in words of its own: what was done before
// a task was handed over is seen by who runs it, and what tasks did by who has waited for them.
// What the library does with its own memory is not looked at.
#ifdef BOOK_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
extern "C" const char* __tsan_default_suppressions() {
    return "called_from_lib:libtbb.so";
}
#else
static void __tsan_acquire(void*) {}
static void __tsan_release(void*) {}
#endif

namespace space {

/// TBB ends the program where the machine gives it a thread less than it asks for, and beyond 255
/// it warns. More than four on a core would wait for each other; a test asks for some on any.
static unsigned most_threads() {
    return std::max(16u, 4 * static_cast<unsigned>(tbb::this_task_arena::max_concurrency()));
}

struct WorkStealing::Threads {
    explicit Threads(unsigned threads)
        : allowed(tbb::global_control::max_allowed_parallelism,
                  std::max<std::size_t>(threads, tbb::this_task_arena::max_concurrency())),
          arena(static_cast<int>(threads)) {}

    tbb::global_control allowed;  // else no more than the machine has cores
    tbb::task_arena arena;
};

WorkStealing::WorkStealing(unsigned threads)
    : threads_(threads), tbb_(std::make_unique<Threads>(std::min(threads, most_threads()))) {}
WorkStealing::~WorkStealing() = default;

void WorkStealing::for_each(std::size_t count, const std::function<void(std::size_t)>& body) {
    char started = 0, ended = 0;  // addresses, to name the two moments by
    __tsan_release(&started);
    const auto part = [&](std::size_t i) {
        __tsan_acquire(&started);
        body(i);
        __tsan_release(&ended);
    };
    tbb_->arena.execute(
        [&] { tbb::parallel_for(std::size_t{0}, count, part, tbb::simple_partitioner{}); });
    __tsan_acquire(&ended);
}

void WorkStealing::run(const std::function<void(const Spawn& spawn)>& body) {
    char ended = 0;
    tbb_->arena.execute([&] {
        tbb::task_group group;
        const Spawn spawn = [&](std::function<void()> task) {
            auto job = std::make_unique<std::function<void()>>(std::move(task));
            __tsan_release(job.get());
            group.run([&ended, job = std::move(job)] {
                __tsan_acquire(job.get());
                (*job)();
                __tsan_release(&ended);
            });
        };
        try {
            body(spawn);
        } catch (...) {
            group.cancel();
            group.wait();
            throw;
        }
        group.wait();
    });
    __tsan_acquire(&ended);
}

}  // namespace space
