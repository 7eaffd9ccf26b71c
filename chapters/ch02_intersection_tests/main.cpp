/// Chapter 2: intersection tests and square roots, each with its cost and its error.
///     ch02_intersection_tests --out pictures
///     ch02_intersection_tests --figure fig_02_03 --out figures
#include "chapters/ch02_intersection_tests/measured/measurements.hpp"
#include "chapters/ch02_intersection_tests/measured/outcome.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

namespace space::ch02 {
namespace {

/// One ray at the diagonal of a quadrilateral that is cut into two triangles. Exactly, one of them
/// is hit; who rounds may see it pass between the two, or hit both.
void one_ray_at_an_edge() {
    const Point3 a{-1.0625f, -1.125f, -0.125f}, b{0.75f, -0.875f, 0.0625f},
        c{1.1875f, 1.0625f, 0.0f}, d{-1.0625f, 0.8125f, -0.125f};
    const Triangle lower{a, b, c}, upper{a, c, d};
    const Ray ray{.origin = {3.0f, 2.0f, 5.0f},
                  .direction = {-2.26249552f, -1.37499571f, -5.0250001f}};

    Table table({"test", "lower triangle", "upper triangle", "what it is"});
    for_each_named(triangle_tests, [&](std::size_t, const auto& named) {
        using Test = TestOf<decltype(named)>;
        const auto answer = [&](const Triangle& triangle) {
            const std::optional<Hit> hit = Test::intersect(ray, triangle);
            return hit ? fmt::format("t = {:.9g}", hit->t) : "miss";
        };
        table.row(
            {std::string(named.name), answer(lower), answer(upper), std::string(named.about)});
    });
    print_heading("One ray, and the two triangles beside the edge that it meets");
    table.print();
}

int run(int argc, char** argv) {
    const Options options =
        parse_options(argc, argv,
                      {.name = this_chapter.name,
                       .about = "Chapter 2: intersection tests and square roots, fast and right",
                       .defaults = {}});
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);

    one_ray_at_an_edge();
    const Measurements& measured = measure_all(options);
    print_triangles(measured);
    print_signs(measured);
    print_roots(measured);
    print_boxes_and_spheres(measured);
    print_bounces(measured);
    quoted(measured).write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong_answers(measured));
    if (!options.small) print_times(measured);  // no test's business
    return finish(options, answer_claims(measured), wrong_answers(measured));
}

}  // namespace
}  // namespace space::ch02

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch02::run, argc, argv);
}
