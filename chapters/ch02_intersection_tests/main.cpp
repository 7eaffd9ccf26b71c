/// Chapter 2: intersection tests and square roots, each with its cost and its error.
/// Run   ch02_intersection_tests --out pictures
/// Draw  ch02_intersection_tests --figure fig_02_11 --out figures
#include "chapters/ch02_intersection_tests/figures/figures.hpp"
#include "chapters/ch02_intersection_tests/measured/measurements.hpp"
#include "chapters/ch02_intersection_tests/measured/tables.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch02 {
namespace {

int run(int argc, char** argv) {
    const Options options =
        parse_options(argc, argv,
                      {.name = "ch02_intersection_tests",
                       .about = "Chapter 2: intersection tests and square roots, fast and right",
                       .defaults = {}});
    if (options.figure) return make_figures(chapter02_figures(), options);
    check_writable(options.out / "results.json");

    const Measurements measured = measure(options);
    print_triangles(measured);
    print_roots(measured);
    print_boxes_and_spheres(measured);
    print_bounces(measured);

    const Results results{provenance("ch02_intersection_tests", options), answer_claims(measured)};
    write_results(options.out / "results.json", results);
    if (options.small) return 0;  // times are no test's business

    print_times(measured);
    for (const Chart& chart : {triangle_chart(measured), root_chart(measured), box_chart(measured),
                               sphere_chart(measured)})
        write_chart(options.out, chart);
    print_heading("The sources' claims");
    for (const ClaimAnswer& answer : results.answers)
        fmt::print("{:4} {}: {}\n", answer.claim, name(answer.verdict), answer.measured);
    return 0;
}

}  // namespace
}  // namespace space::ch02

int main(int argc, char** argv) {
    return space::run_program("ch02_intersection_tests", space::ch02::run, argc, argv);
}
