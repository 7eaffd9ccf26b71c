/// Chapter 11: where rays should go, and what need not be traced twice.
///     ch11_sampling_and_caching --out pictures
///     ch11_sampling_and_caching --figure fig_11_01 --out figures
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/provenance.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

Options read_options(int argc, char** argv) {
    return parse_options(argc, argv,
                         {.name = this_chapter.name,
                          .about = "Chapter 11: sampling and caching",
                          .defaults = {.scene = "room"}});
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);

    const std::vector<Triangle> mesh = asked_scene(options).mesh.triangles();
    fmt::print("{}: {} triangles, {} nodes\n", options.scene, with_commas(mesh.size()),
               with_commas(FastBvh<>::build(mesh).shape().nodes.value_or(0)));
    const std::uint64_t wrong = 0;

    Numbers numbers;
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, {}, wrong);
}

}  // namespace
}  // namespace space::ch11

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch11::run, argc, argv);
}
