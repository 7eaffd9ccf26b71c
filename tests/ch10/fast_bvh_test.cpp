#include "chapters/ch10_fast_traversal/fast_bvh.hpp"

#include "common/scene.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <utility>
#include <vector>

namespace {

using namespace space;

template <TriangleTest Test>
using Wide4 = WideBvh<4, BinnedBuilder, Test>;
template <TriangleTest Test>
using Wide8 = WideBvh<8, BinnedBuilder, Test>;

}  // namespace

TEST_CASE("the suite: nodes of four and eight, in plain C++ and over other tests") {
    WideBvhConfig<BinnedBuilder> config{.instructions = InstructionSet::scalar};
    run_suite<Wide4>("nodes of four, scalar", config);
    run_suite<Wide8>("nodes of eight, scalar", config);
}

TEST_CASE("the suite: kernels of each width and instruction set") {
    for (const InstructionSet set : usable_instruction_sets()) {
        if (set == InstructionSet::scalar) continue;
        const WideBvhConfig<BinnedBuilder> config{.instructions = set};
        const std::string name(name_of(set));
        check_accelerator<Wide4<FilteredExact>>("nodes of four, " + name,
                                                [&](std::span<const Triangle> all) {
                                                    return Wide4<FilteredExact>::build(all, config);
                                                });
        check_accelerator<Wide8<FilteredExact>>("nodes of eight, " + name,
                                                [&](std::span<const Triangle> all) {
                                                    return Wide8<FilteredExact>::build(all, config);
                                                });
    }
}

TEST_CASE("the suite: the default and the best tree") {
    run_suite<FastBvh>("fast");
    SuiteOptions some;
    check_accelerator<FastHighBvh<>>(
        "fast, high quality",
        [](std::span<const Triangle> all) { return FastHighBvh<>::build(all); }, some.fewer());
}

TEST_CASE("a structure that was moved elsewhere is empty, and none of its rays hits") {
    const std::vector<Triangle> triangles = make_scene("icosphere", 1, true).mesh.triangles();
    const Ray ray{.origin = {0.0f, 0.0f, 5.0f}, .direction = {0.01f, 0.02f, -1.0f}};
    for_each_kernel(triangles, [&](auto bvh, const std::string&) {
        const auto moved = std::move(bvh);
        CHECK(bvh.tree().empty());
        CHECK_FALSE(closest_hit(bvh, ray));
        CHECK_FALSE(any_hit(bvh, ray));
        CHECK(closest_hit(moved, ray));
        CHECK(any_hit(moved, ray));
    });
}
