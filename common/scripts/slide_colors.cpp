/// For ./book figures --dark and --light: a figure's file for slide programs, which don't know
/// whether the reader's system is light or dark. Run   slide_colors dark FIGURE.svg FIGURE_dark.svg
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/svg_colors.hpp"

#include <string_view>

namespace {

int slide_colors(int argc, char** argv) {
    using namespace space;
    const std::string_view mode = argc == 4 ? argv[1] : "";
    if (mode != "dark" && mode != "light")
        throw usage_error("give: dark or light, the figure, the file to write");
    write_file(argv[3], svg_fixed(read_file(argv[2]), mode == "dark"));
    return static_cast<int>(ExitCode::ok);
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("slide_colors", slide_colors, argc, argv);
}
