/// Chapter 10: as fast as the hardware allows, and still exact.
///     ch10_fast_traversal --out pictures
///     ch10_fast_traversal --figure fig_10_01 --out figures
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/fast.hpp"
#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/provenance.hpp"
#include "common/program/report.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

namespace space::ch10 {
namespace {

constexpr const char* default_scene = "stadium";

Options read_options(int argc, char** argv) {
    Options options = parse_options(argc, argv,
                                    {.name = this_chapter.name,
                                     .about = "Chapter 10: fast traversal",
                                     .defaults = {.scene = default_scene}});
    if (options.small && options.scene == default_scene) options.scene = "boxes:36";
    return options;
}

/// One scene by the binary tree and by what becomes of it: the same answers. @return how many are
/// not
std::uint64_t climb_on_one_scene(const Options& options) {
    const std::vector<Triangle> mesh = asked_scene(options).mesh.triangles();
    const std::vector<Ray> rays = rays_within(mesh, options.small ? 500 : 50'000, options.seed);
    const auto binary = Bvh<BinnedBuilder>::build(mesh);
    Table table({"tree", "bytes a triangle", "nodes per ray", "tests per ray", "other answers"});
    std::uint64_t others = 0;
    const auto show = [&](const std::string& name, const auto& tree) {
        TraversalCounts counts;
        std::uint64_t other = 0;
        for (const Ray& ray : rays) {
            tree.closest_hit(ray, counts);
            other += closest_hit(tree, ray) != closest_hit(binary, ray);
        }
        const auto per = [](double n, std::size_t all) { return fixed(n / double(all), 1); };
        table.row({name, per(double(tree.shape().bytes), mesh.size()),
                   per(double(counts.nodes_visited), rays.size()),
                   per(double(counts.triangles_tested), rays.size()), with_commas(other)});
        others += other;
    };
    show("binary (chapter 7)", binary);
    show("four children", WideBvh<4, QuickBuilder>::build(mesh));
    show("eight children", FastBvh<>::build(mesh));
    show("eight, compressed", CompressedBvh<>::build(mesh));
    print_heading(fmt::format("{}: {} triangles", options.scene, with_commas(mesh.size())));
    table.print();
    return others;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);

    std::uint64_t wrong = options.counts ? 0 : climb_on_one_scene(options);
    const bool times = !options.small && !options.counts;
    const WalkCounts counts = measure_walk_counts(options);
    print_walk_counts(counts);
    const FastMeasurements& measured = measured_once<measure_fast>(options);
    print_fast(measured, times);
    wrong += wrong_walk_counts(counts) + wrong_answers(measured);

    Numbers numbers;
    quote_walk_counts(counts, numbers);
    quote_fast(measured, times, numbers);
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    return finish(options, {}, wrong);
}

}  // namespace
}  // namespace space::ch10

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch10::run, argc, argv);
}
