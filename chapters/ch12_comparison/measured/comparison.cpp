#include "chapters/ch12_comparison/measured/comparison.hpp"

#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "common/measure.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/provenance.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

namespace space::ch12 {
namespace {

void tell(const std::string& line) {
    fmt::print(stderr, "compare: {}\n", line);
}

constexpr const char* chapter_name = "ch12_comparison";

/// The fingerprints of all that is measured as one text. This chapter's own folder also makes
/// tables and charts, whose changes need no new times; how it measures is in the settings.
std::string sources_text(Fingerprints prints) {
    prints.erase(fmt::format("chapters/{}", chapter_name));
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
    for (const auto& [folder, print] : prints)
        for (const char c : folder + print)
            hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return fmt::format("{:016x}", hash);
}

std::string turns_text(const CompareEffort& effort) {
    const std::string most = counted(std::uint64_t(effort.most_turns), "turn");
    return effort.turns < effort.most_turns ? fmt::format("{} to {}", effort.turns, most) : most;
}

/// An empty comparison as these options would fill it.
Comparison begun(std::span<const Structure> structures, const CompareEffort& effort,
                 const Options& options) {
    std::set<std::string> peers;
    for (const Structure& structure : structures)
        if (structure.is_peer) peers.emplace(structure.home);
    const Provenance run = provenance(chapter_name, options);
    return {.rows = {},
            .machine = run.machine,
            .date = run.date,
            .sources = sources_text(run.sources),
            .settings = fmt::format(
                "{}, {} of each kind, {}, seed {}, {}, {}", run.mode,
                counted(std::uint64_t(effort.width) * std::uint64_t(effort.height), "ray"),
                turns_text(effort), options.seed, counted(options.threads, "thread"),
                peers.empty() ? "no peers" : fmt::format("{}", fmt::join(peers, ", ")))};
}

/// What an earlier run left that this one would measure again.
Comparison taken_up(const std::filesystem::path& csv, Comparison fresh) {
    std::error_code error;
    if (!std::filesystem::exists(csv, error)) return fresh;
    std::size_t dropped = 0;
    Comparison earlier = read_whole_blocks(csv, dropped);
    const auto differs = [&](std::string_view what, const std::string& then,
                             const std::string& now) {
        if (then == now) return false;
        tell(fmt::format("{} is of {} ({}): all is measured anew", csv.string(), what,
                         then.empty() ? "unknown" : then));
        return true;
    };
    if (differs("another machine", earlier.machine, fresh.machine) ||
        differs("other sources", earlier.sources, fresh.sources) ||
        differs("other settings", earlier.settings, fresh.settings))
        return fresh;
    if (dropped > 0)
        tell(fmt::format("{}: its last {} after the last whole block left out", csv.string(),
                         dropped == 1 ? "line is" : fmt::format("{} lines are", dropped)));
    earlier.date = fresh.date;
    return earlier;
}

/// The lab with peers, where it stands beside this program.
std::filesystem::path program_with_peers() {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto beside = self.parent_path() / "lab_with_peers";
    return !error && std::filesystem::exists(beside, error) ? beside : std::filesystem::path();
}

/// Runs it with the sub-command compare and these options; no shell is between.
int run_with_peers(const std::filesystem::path& program, const Options& options) {
    std::vector<std::string> words{program.string(), "compare",
                                   "--out",          options.out.string(),
                                   "--threads",      std::to_string(options.threads),
                                   "--seed",         std::to_string(options.seed)};
    if (options.quick) words.emplace_back("--quick");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int fault =
        ::posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments.data(), environ);
    if (fault)
        throw output_error(
            fmt::format("cannot start {}: {}", program.string(), std::strerror(fault)));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(ExitCode::internal);
}

}  // namespace

Comparison compare_into(const std::filesystem::path& csv, std::span<const Structure> structures,
                        const CompareEffort& effort, const Options& options) {
    check_writable(csv);
    Comparison comparison = taken_up(csv, begun(structures, effort, options));
    std::set<std::string> done;
    for (const ComparedRow& row : comparison.rows) done.insert(row.spec);
    std::vector<std::pair<std::string, std::string>> to_do;
    for (const auto& block : effort.blocks)
        if (!done.contains(block.second)) to_do.push_back(block);
    if (!done.empty())
        tell(fmt::format("{} holds {} of {} already{}", csv.string(), done.size(),
                         counted(effort.blocks.size(), "block"),
                         to_do.empty() ? "; remove it to measure anew" : ""));
    const std::size_t turns = static_cast<std::size_t>(std::max(1, effort.most_turns));
    Progress progress("comparing", to_do.size() * turns * compared_structures().size());
    for (const auto& [scene, spec] : to_do) {
        Stopwatch stopwatch;
        auto rows = compare_on(make_subject(scene, spec, options.seed), structures, effort, options,
                               &progress);
        std::ranges::move(rows, std::back_inserter(comparison.rows));
        comparison.minutes += stopwatch.lap().count() / 60e3;
        write_file(csv, csv_text(comparison));
    }
    if (to_do.empty() && done.empty()) throw input_error("there is nothing to compare");
    return comparison;
}

int run_compare(std::span<const Structure> structures, int argc, char** argv) {
    const Options options =
        parse_options(argc, argv,
                      {.name = "compare",
                       .about = "Every structure on every scene, into ch12_comparison.csv in --out",
                       .defaults = {}});
    const std::filesystem::path csv = options.out / comparison_file;
    compare_into(csv, structures, compare_effort(options), options);
    accuracy_into(options.out / accuracy_file, structures, options);
    fmt::print("{}\n", csv.string());
    return static_cast<int>(ExitCode::ok);
}

Comparison measure_comparison(const Options& options) {
    const CompareEffort effort = compare_effort(options);
    for (const ComparedScene& scene : compared_scenes())
        if (scene.specs.size() == 1 && effort.turns > 0 && !options.quick &&
            std::ranges::find(effort.blocks, scene.specs.front(),
                              &std::pair<std::string, std::string>::second) == effort.blocks.end())
            tell(fmt::format("{} is left out: {} is not there", scene.name,
                             scene_file(scene.specs.front()).string()));
    const std::filesystem::path csv = options.out / comparison_file;
    const std::filesystem::path with_peers = program_with_peers();
    if (effort.turns == 0 || with_peers.empty()) {
        if (effort.turns > 0) return compare_into(csv, structures(), effort, options);
        Comparison counted = begun(structures(), effort, options);
        for (const auto& [scene, spec] : effort.blocks)
            std::ranges::move(
                compare_on(make_subject(scene, spec, options.seed), structures(), effort, options),
                std::back_inserter(counted.rows));
        return counted;
    }
    if (const int code = run_with_peers(with_peers, options); code != 0)
        throw Error(static_cast<ExitCode>(code),
                    fmt::format("{} compare ended with exit code {}", with_peers.string(), code));
    return read_comparison(csv);
}

}  // namespace space::ch12
