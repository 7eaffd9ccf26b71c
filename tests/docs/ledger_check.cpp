/// Runs the program of each chapter that is here with --small and looks at the answers that it
/// writes; looks at the committed answers of the last full run too. Prints a line per fault. Run
/// ledger_check ROOT PROGRAMS OUT
#include "common/program/error.hpp"
#include "docs/ledger.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace {

namespace fs = std::filesystem;
using namespace space;

int check(int argc, char** argv) {
    if (argc != 4) throw usage_error("expected ROOT PROGRAMS OUT");
    const fs::path root = argv[1], programs = argv[2], out = argv[3];
    const auto claims = docs::read_claims(root / "docs/claims.json");
    int chapters = 0, wrong = 0;
    const auto look = [&](int chapter, const fs::path& file) {
        const docs::Answers answers = docs::read_answers(file);
        const char* mode = file.string().starts_with(out.string()) ? "small" : "full";
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
        const fs::path folder = out / chapter.folder;
        fs::remove_all(folder);
        const std::string command =
            fmt::format("\"{}\" --small --out \"{}\" > /dev/null",
                        (programs / chapter.folder).string(), folder.string());
        if (std::system(command.c_str()) != 0) throw input_error(fmt::format("{} failed", command));
        look(chapter.number, folder / "results.json");
        look(chapter.number,
             root / fmt::format("figures/measured/ch{:02}_results.json", chapter.number));
    }
    fmt::print("{} chapters here, {} faults\n", chapters, wrong);
    return static_cast<int>(wrong == 0 ? ExitCode::ok : ExitCode::wrong_answer);
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("ledger_check", check, argc, argv);
}
