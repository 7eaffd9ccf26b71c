/// Looks at the answers that the program of each chapter wrote with --small, into a folder of the
/// chapter's name in SMALL, and at the committed answers of the last full run; and whether each
/// claim belongs to a chapter that is here. Prints a line per fault. Run   ledger_check ROOT SMALL
#include "common/program/error.hpp"
#include "docs/ledger.hpp"

#include <fmt/format.h>

#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;
using namespace space;

int check(int argc, char** argv) {
    if (argc != 3) throw usage_error("expected ROOT SMALL");
    const fs::path root = argv[1], small = argv[2];
    const auto claims = docs::read_claims(root / "docs/claims.json");
    int chapters = 0, wrong = 0;
    const auto look = [&](int chapter, const char* mode, const fs::path& file) {
        const docs::Answers answers = docs::read_answers(file);
        if (answers.run.mode != mode) {
            fmt::print("{}: expected the mode {}, not {}\n", file.string(), mode, answers.run.mode);
            ++wrong;
        }
        for (const std::string& fault : docs::faults(claims, chapter, answers)) {
            fmt::print("{}: {}\n", file.string(), fault);
            ++wrong;
        }
    };
    for (const docs::Chapter& chapter : docs::read_chapters(root)) {
        if (!chapter.here) continue;
        ++chapters;
        look(chapter.number, "small", small / chapter.folder / "results.json");
        look(chapter.number, "full",
             root / fmt::format("figures/measured/ch{:02}_results.json", chapter.number));
    }
    std::set<std::string> answered;
    for (const docs::ClaimVerdict& verdict : docs::read_verdicts(root, root / "none"))
        if (!verdict.verdict.empty()) answered.insert(verdict.claim.id);
    for (const docs::Claim& claim : claims)
        if (!answered.contains(claim.id)) {
            fmt::print("claim {} is answered by no chapter: {}\n", claim.id, claim.text);
            ++wrong;
        }
    fmt::print("{} chapters here, {} of {} claims answered, {} faults\n", chapters, answered.size(),
               claims.size(), wrong);
    return static_cast<int>(wrong == 0 ? ExitCode::ok : ExitCode::wrong_answer);
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("ledger_check", check, argc, argv);
}
