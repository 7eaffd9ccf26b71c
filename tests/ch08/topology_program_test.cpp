// The program `topology`: as it is, and as it is on a machine without cpuid.
#include "chapters/ch08_parallel_builds/recorded_machines.hpp"
#include "common/program/file.hpp"
#include "common/program/temporary.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace space {
namespace {

/// How a program ended, and what it printed.
struct Ended {
    int code;
    std::string out, err;
};

Ended run(const std::string& program, const std::string& arguments) {
    const TemporaryDirectory folder;
    const std::string out = folder / "out", err = folder / "err";
    const int status =
        std::system(fmt::format("'{}' {} > {} 2> {}", program, arguments, out, err).c_str());
    return {WEXITSTATUS(status), read_file(out), read_file(err)};
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("it tells of this machine, by three sources and without colours") {
    const Ended ended = run(TOPOLOGY, "");
    CHECK(ended.code == 0);
    CHECK(ended.err == "");
    CHECK(holds(ended.out, "This process may use "));
    CHECK(holds(ended.out, "By cpuid: "));
    CHECK(holds(ended.out, "By kernel: "));
    CHECK(holds(ended.out, "By hwloc: "));
    CHECK(!holds(ended.out, "\x1b"));
}

TEST_CASE("without cpuid it tells what the kernel and hwloc know") {
    const TemporaryDirectory folder;
    const Ended ended =
        run(TOPOLOGY_WITHOUT_CPUID, fmt::format("--out '{}'", folder.path().string()));
    CHECK(ended.code == 0);
    CHECK(holds(read_file(folder / "topology.svg"), "core 0"));
    CHECK(holds(ended.out, "By cpuid: nothing."));
    CHECK(!holds(ended.out, "APIC"));
}

TEST_CASE("it tells of each recorded machine, and draws it") {
    const TemporaryDirectory folder;
    for (const RecordedMachine& machine : recorded_machines()) {
        const Ended ended = run(
            TOPOLOGY, fmt::format("--machine {} --out '{}'", machine.name, folder.path().string()));
        CAPTURE(machine.name);
        CHECK(ended.code == 0);
        CHECK(holds(ended.out, fmt::format("{} cores", machine.known.cores)));
        CHECK(holds(
            read_file(folder / "topology.svg"),
            fmt::format("{} cores and {} threads", machine.known.cores, machine.known.threads)));
    }
}

TEST_CASE("what it can't do it says in one line") {
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    for (const std::string wrong :
         {"--machine pdp-11", "--nonsense", "one-more", "--out /dev/null/x"}) {
        const Ended ended = run(TOPOLOGY, wrong);
        CAPTURE(wrong);
        CHECK(ended.code == (wrong.starts_with("--out") ? 4 : 2));
        CHECK(ended.out == "");
        CHECK(lines(ended.err) == 1);
        CHECK(ended.err.starts_with("topology: "));
    }
    const Ended help = run(TOPOLOGY, "--help");
    CHECK(help.code == 0);
    CHECK(holds(help.out, "--machine"));
}

}  // namespace space
