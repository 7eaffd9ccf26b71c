/// Are the counts in figures/measured those that the program gives now? Runs a chapter's program
/// with --counts --quick and compares every count and every table of counts with the committed
/// ones: a line per difference. Run   counts_check ROOT PROGRAM OUT [if_changed|all]
/// With `all` the program counts everything, which takes minutes. With `if_changed` it is believed
/// where its code is, by the fingerprints, that of the full run that was committed: the same code
/// counts the same (COUNTS=all: it counts).
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/provenance.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

namespace {

namespace fs = std::filesystem;
using namespace space;

/// "numbers" or "tables" of a numbers.json, those that are counts; a table as its Markdown.
std::map<std::string, std::string> counts_in(const fs::path& file, const std::string& kind,
                                             const std::string& tables_as) {
    std::map<std::string, std::string> counts;
    const auto document = nlohmann::json::parse(read_file(file));
    for (const auto& [name, entry] : document.at(kind).items())
        if (entry.at("count"))
            counts[name] = kind == "numbers"
                               ? entry.at("text").get<std::string>()
                               : read_file(file.parent_path() / (tables_as + name + ".md"));
    return counts;
}

bool all_are_counted() {
    const char* asked = std::getenv("COUNTS");
    return asked && std::string(asked) == "all";
}

/// Whether a full run of what stands in `root` now gave these numbers.
bool is_of_this_code(const fs::path& root, const fs::path& measured) {
    const auto run = nlohmann::json::parse(read_file(measured)).get<Provenance>();
    return run.mode == "full" && !run.sources.empty() &&
           run.sources == source_fingerprints(root, run.chapter);
}

int check(int argc, char** argv) {
    const std::string how = argc == 5 ? argv[4] : "";
    const bool all = how == "all", if_changed = how == "if_changed";
    if (argc != 4 && !all && !if_changed)
        throw usage_error("expected ROOT PROGRAM OUT [if_changed|all]");
    const fs::path root = argv[1], program = argv[2], out = argv[3];
    const std::string chapter = program.filename().string().substr(0, 4);
    const fs::path measured = root / "figures/measured" / (chapter + "_numbers.json");
    if (if_changed && !all_are_counted() && is_of_this_code(root, measured)) {
        fmt::print("the code is that of the full run in figures/measured\n");
        return static_cast<int>(ExitCode::ok);
    }
    fs::remove_all(out);
    const std::string command = fmt::format("\"{}\" --counts {} --out \"{}\" > /dev/null",
                                            program.string(), all ? "" : "--quick", out.string());
    if (std::system(command.c_str()) != 0) throw input_error(fmt::format("{} failed", command));
    std::ptrdiff_t compared = 0, wrong = 0, left_out = 0;
    for (const char* kind : {"numbers", "tables"}) {
        const auto then = counts_in(measured, kind, chapter + "_"),
                   now = counts_in(out / "numbers.json", kind, chapter + "_");
        for (const auto& [name, text] : now) {
            ++compared;
            const auto committed = then.find(name);
            if (committed != then.end() && committed->second == text) continue;
            ++wrong;
            fmt::print("{}.{}: figures/measured has {}\nbut the program gives {}\n", chapter, name,
                       committed == then.end() ? "nothing" : committed->second, text);
        }
        left_out += std::ranges::count_if(
            then, [&](const auto& committed) { return !now.contains(committed.first); });
    }
    fmt::print(
        "{} counts compared, {} differ, {} were not counted{}\n", compared, wrong, left_out,
        wrong ? fmt::format("; ./book run {} --update measures anew", chapter.substr(2)) : "");
    return static_cast<int>(wrong == 0 && compared > 0 ? ExitCode::ok : ExitCode::wrong_answer);
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("counts_check", check, argc, argv);
}
