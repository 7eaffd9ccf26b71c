/// Chapter 12: which structure does a scene need?
///     ch12_comparison --out pictures
///     ch12_comparison lab --scene sphereflake --structure all --check
///     ch12_comparison render --scene room --out room.png
///     ch12_comparison compare --out DIR      (the measuring alone, into a CSV file)
#include "chapters/ch12_comparison/lab.hpp"
#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "chapters/ch12_comparison/measured/advice_fit.hpp"
#include "chapters/ch12_comparison/measured/child_overlap.hpp"
#include "chapters/ch12_comparison/measured/comparison.hpp"
#include "chapters/ch12_comparison/measured/comparison_tables.hpp"
#include "chapters/ch12_comparison/measured/lab_counts.hpp"
#include "chapters/ch12_comparison/render.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/provenance.hpp"
#include "common/program/report.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch12 {
namespace {

int lab(int argc, char** argv) {
    return run_lab(structures(), argc, argv);
}

int render(int argc, char** argv) {
    return run_render(structures(), argc, argv);
}

int compare(int argc, char** argv) {
    return run_compare(structures(), argc, argv);
}

Options read_options(int argc, char** argv) {
    Options options = parse_options(
        argc, argv,
        {.name = this_chapter.name,
         .about = "Chapter 12: the comparison. More: ch12_comparison lab --help, render --help",
         .defaults = {.scene = "stadium"}});
    if (options.small && options.scene == "stadium") options.scene = "boxes:36";
    return options;
}

/// The lab's list on one scene: each structure is built and asked the same. @return how many
/// answers are not those of the first, naive tracing
std::uint64_t ask_all_on_one_scene(const Options& options) {
    const std::vector<Triangle> triangles = asked_scene(options).mesh.triangles();
    const std::vector<Ray> rays = rays_within(triangles, options.small ? 100 : 1'000, options.seed);
    std::vector<HitRecord> exact(rays.size()), hits(rays.size());
    std::uint64_t others = 0;
    Table table({"structure", "what it is", "tests per ray", "other answers"});
    for (const Structure& structure : structures()) {
        const BuiltStructure built = structure.variants.front().build_from_triangles(triangles, {});
        const bool is_naive = &structure == &structures().front();
        const TraversalCounts work = built.count({rays, is_naive ? exact : hits});
        std::uint64_t other = 0;
        for (std::size_t i = 0; i < rays.size() && !is_naive; ++i) other += !(hits[i] == exact[i]);
        table.row({std::string(structure.name), std::string(structure.about),
                   fixed(double(work.triangles_tested) / double(rays.size()), 1),
                   with_commas(other)});
        others += other;
    }
    print_heading(fmt::format("{}: {} triangles", options.scene, with_commas(triangles.size())));
    table.print();
    return others;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    if (options.counts && options.quick) {  // what takes seconds
        Numbers numbers;
        count_lab(numbers);
        count_child_overlap(options.seed, numbers);
        numbers.write(options.out, provenance(std::string(this_chapter.name), options));
        return exit_code(0);
    }

    std::uint64_t wrong = options.counts ? 0 : ask_all_on_one_scene(options);
    const bool times = !options.small && !options.counts;
    const Comparison& comparison = measured_once<measure_comparison>(options);
    print_comparison(comparison, times);
    wrong += wrong_answers(comparison);

    Numbers numbers;
    if (!options.small) {
        count_lab(numbers);
        count_child_overlap(options.seed, numbers);
    }
    quote_comparison(comparison, times, numbers);
    if (times) {
        const JudgedAdvice& advice = measured_once<measure_advice>(options);
        quote_advice(advice, numbers);
        write_file(options.out / "ch12_advice.csv", advice.model_csv);
        quote_accuracy(measured_once<measure_accuracy>(options), numbers);
    }
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, answer_comparison(comparison), wrong);
}

}  // namespace
}  // namespace space::ch12

int main(int argc, char** argv) {
    using namespace space;
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (first == "lab") return run_program("lab", ch12::lab, argc - 1, argv + 1);
    if (first == "render") return run_program("render", ch12::render, argc - 1, argv + 1);
    if (first == "compare") return run_program("compare", ch12::compare, argc - 1, argv + 1);
    return run_program(this_chapter.name, ch12::run, argc, argv);
}
