#include "common/program/chapter.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space {
namespace {

std::filesystem::path results_file(const Options& options) {
    return options.out / "results.json";
}

}  // namespace

Scene asked_scene(const Options& options) {
    Scene scene = make_scene(options.scene, options.seed, options.small);
    print_remarks(this_chapter.name, scene.mesh.remarks);
    return scene;
}

void check_results_writable(const Options& options) {
    check_writable(results_file(options));
}

int exit_code(std::uint64_t wrong_answers) {
    return static_cast<int>(wrong_answers ? ExitCode::wrong_answer : ExitCode::ok);
}

int finish(const Options& options, const std::vector<ClaimAnswer>& answers,
           std::uint64_t wrong_answers) {
    write_results(results_file(options),
                  {provenance(std::string(this_chapter.name), options), answers});
    if (!options.small) {
        for (const Figure& figure : this_chapter.figures)
            if (figure.is_chart()) write_figure(figure, options);
        print_heading(
            "The sources' claims; docs/claims.json and the page \"Claims and verdicts\" word them");
        for (const ClaimAnswer& answer : answers) {
            const std::string line =
                fmt::format("{:4} {}: {}", answer.claim, name(answer.verdict), answer.measured);
            fmt::print("{}\n", wrapped(line, 5));
        }
    }
    return exit_code(wrong_answers);
}

}  // namespace space
