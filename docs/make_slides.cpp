/// Makes slides of the book's figures, a file a chapter or one of the figures that are named. Run
/// make_slides --out build/figures ch07_bounding_volume_hierarchies
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/options.hpp"
#include "docs/slides.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace space;

int make_slides(int argc, char** argv) {
    docs::Places places{.root = book_root(),
                        .configured = BOOK_CONFIGURED,
                        .runs = book_root() / "build/book",
                        .pages = {}};
    fs::path out = ".";
    std::string colors = "system";
    std::vector<std::string> named;
    CLI::App app("Makes slides of the book's figures: web pages that need no other file.",
                 "make_slides");
    app.add_option("--out", out, "folder of the slides")->capture_default_str();
    app.add_option("--runs", places.runs,
                   "what ./book run wrote; newer figures than the committed ones are shown")
        ->capture_default_str();
    add_choice(app, "--colors", {"system", "light", "dark"}, colors,
               "those of the reader's system, or always light or dark at first");
    app.add_option("named", named, "chapters' folders and figures' ids; nothing: all chapters");
    parse_command_line(app, argc, argv);
    const docs::SlideMode mode = colors == "light"  ? docs::SlideMode::light
                                 : colors == "dark" ? docs::SlideMode::dark
                                                    : docs::SlideMode::system;
    for (const docs::SlideShow& show : docs::slide_shows(places, named)) {
        const fs::path file = out / show.file;
        write_file(file, docs::slides(show.title, show.figures, places.root, mode));
        fmt::print("{}\n", file.string());
    }
    return static_cast<int>(ExitCode::ok);
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("make_slides", make_slides, argc, argv);
}
