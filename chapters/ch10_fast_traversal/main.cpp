/// Chapter 10: as fast as the hardware allows, and still exact.
///     ch10_fast_traversal --out pictures
///     ch10_fast_traversal --figure fig_10_01 --out figures
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"
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

/// The ladder's foot: chapter 7's binary tree.
void start_with_the_binary_tree(const Options& options) {
    const std::vector<Triangle> mesh = asked_scene(options).mesh.triangles();
    const auto tree = Bvh<BinnedBuilder>::build(mesh);
    const std::vector<Ray> rays = rays_within(mesh, options.small ? 500 : 50'000, options.seed);
    TraversalCounts counts;
    for (const Ray& ray : rays) tree.closest_hit(ray, counts);
    Table table({"tree", "bytes", "nodes per ray", "tests per ray"});
    const auto per_ray = [&](std::uint64_t n) { return fixed(double(n) / double(rays.size()), 1); };
    table.row({"binary", with_commas(tree.shape().bytes), per_ray(counts.nodes_visited),
               per_ray(counts.triangles_tested)});
    print_heading(fmt::format("{}: {} triangles", options.scene, with_commas(mesh.size())));
    table.print();
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);

    start_with_the_binary_tree(options);
    const WalkCounts counts = measure_walk_counts(options);
    print_walk_counts(counts);
    std::uint64_t wrong = wrong_walk_counts(counts);

    Numbers numbers;
    quote_walk_counts(counts, numbers);
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
