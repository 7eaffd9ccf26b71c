#include "chapters/ch10_fast_traversal/fast_bvh.hpp"

#include "tests/suite/accelerator_suite.hpp"

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
