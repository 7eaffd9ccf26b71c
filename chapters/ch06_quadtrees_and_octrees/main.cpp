/// Chapter 6: quadtrees and octrees, whose cells are cut in the middle of every axis at once.
///     ch06_quadtrees_and_octrees --out pictures
///     ch06_quadtrees_and_octrees --figure fig_06_10 --out figures
#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"

#include <fmt/format.h>

namespace space::ch06 {
namespace {

int run(int argc, char** argv) {
    const Options options = parse_options(
        argc, argv,
        {.name = this_chapter.name, .about = "Chapter 6: quadtrees and octrees", .defaults = {}});
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;
    const std::vector<AdaptivePoint>& adaptive = measured_once<measure_adaptive>(options);
    print_adaptive(adaptive, times);
    const std::uint64_t wrong = wrong_answers(adaptive);
    Numbers numbers;
    quote_adaptive(adaptive, times, numbers);
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, {}, wrong);
}

}  // namespace
}  // namespace space::ch06

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch06::run, argc, argv);
}
