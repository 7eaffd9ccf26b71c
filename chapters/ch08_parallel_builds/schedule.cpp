#include "chapters/ch08_parallel_builds/schedule.hpp"

#include <stdexcept>

namespace space {

std::string_view name(CoreRun::Doing doing) {
    switch (doing) {
        case CoreRun::Doing::boxing:
            return "boxing";
        case CoreRun::Doing::node:
            return "node";
        case CoreRun::Doing::subtree:
            return "subtree";
        case CoreRun::Doing::chunk:
            return "chunk";
        case CoreRun::Doing::joining:
            return "joining";
        case CoreRun::Doing::starting:
            return "starting";
        case CoreRun::Doing::locked:
            return "locked";
        case CoreRun::Doing::lock_wait:
            return "waiting for the lock";
        case CoreRun::Doing::stealing:
            return "stealing";
        case CoreRun::Doing::join_wait:
            return "waiting for a thread";
    }
    throw std::invalid_argument("no such thing to do");
}

bool is_work(CoreRun::Doing doing) {
    return doing <= CoreRun::Doing::joining;
}

double Schedule::spent(CoreRun::Doing doing) const {
    double sum = 0.0;
    for (const CoreRun& run : runs)
        if (run.doing == doing) sum += run.end - run.begin;
    return sum;
}

double Schedule::idle() const {
    double time = makespan * cores;
    for (const CoreRun& run : runs)
        if (run.doing != CoreRun::Doing::lock_wait && run.doing != CoreRun::Doing::join_wait)
            time -= run.end - run.begin;
    return time;
}

}  // namespace space
