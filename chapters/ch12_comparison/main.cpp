/// Chapter 12: which structure does a scene need? The comparison comes when the structures stand;
/// the lab is here. Run   ch12_comparison lab --scene sphereflake --structure all --check
/// and for pictures over any of them   ch12_comparison render --scene room --out room.png
#include "chapters/ch12_comparison/lab.hpp"
#include "chapters/ch12_comparison/measured/comparison.hpp"
#include "chapters/ch12_comparison/measured/lab_counts.hpp"
#include "chapters/ch12_comparison/render.hpp"
#include "common/program/error.hpp"
#include "common/program/figure.hpp"
#include "common/program/file.hpp"
#include "common/program/options.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <string_view>

namespace {

int lab(int argc, char** argv) {
    return space::run_lab(space::structures(), argc, argv);
}

int render(int argc, char** argv) {
    return space::run_render(space::structures(), argc, argv);
}

int compare(int argc, char** argv) {
    return space::ch12::run_compare(space::structures(), argc, argv);
}

int comparison(int argc, char** argv) {
    const space::Options options =
        space::parse_options(argc, argv,
                             {.name = "ch12_comparison",
                              .about = "Chapter 12: the lab (ch12_comparison lab --help)",
                              .defaults = {}});
    if (options.figure) return space::write_figures({}, options);
    space::check_writable(options.out / "numbers.json");
    space::print_heading("Chapter 12: comparison");
    fmt::print(
        "The comparison of all structures on all scenes is not written yet. The lab runs those "
        "that there are on\n"
        "your own mesh and rays: ch12_comparison lab --help\n\n");
    space::Table table({"structure", "what it is"});
    for (const space::Structure& structure : space::structures())
        table.row({std::string(structure.name), std::string(structure.about)});
    table.print();
    if (!options.small)
        space::ch12::count_lab().write(options.out, space::provenance("ch12_comparison", options));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::string_view(argv[1]) == "lab")
        return space::run_program("lab", lab, argc - 1, argv + 1);
    if (argc > 1 && std::string_view(argv[1]) == "compare")
        return space::run_program("compare", compare, argc - 1, argv + 1);
    if (argc > 1 && std::string_view(argv[1]) == "render")
        return space::run_program("render", render, argc - 1, argv + 1);
    return space::run_program("ch12_comparison", comparison, argc, argv);
}
