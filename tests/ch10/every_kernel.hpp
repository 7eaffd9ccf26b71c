/// @file
/// The chapter's structures under one roof for tests: each width, and compressed nodes, with
/// each instruction set that this processor has.
#pragma once

#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "common/geometry.hpp"
#include "tests/catch.hpp"

#include <span>
#include <string>

namespace space {

/// Calls check(bvh, name) for each; a failed test says which it was.
template <int N, class Builder = QuickBuilder, class Check>
void for_each_kernel_of(std::span<const Triangle> triangles, const Check& check,
                        const WideBvhConfig<Builder>& config = {}) {
    for (const InstructionSet set : usable_instruction_sets()) {
        WideBvhConfig<Builder> with = config;
        with.instructions = set;
        const std::string name = "nodes of " + std::to_string(N) + ", " + std::string(name_of(set));
        INFO(name);
        check(WideBvh<N, Builder>::build(triangles, with), name);
    }
}
template <class Builder = QuickBuilder, class Check>
void for_each_compressed(std::span<const Triangle> triangles, const Check& check,
                         const WideBvhConfig<Builder>& config = {}) {
    for (const InstructionSet set : usable_instruction_sets()) {
        WideBvhConfig<Builder> with = config;
        with.instructions = set;
        const std::string name = "compressed, " + std::string(name_of(set));
        INFO(name);
        check(BasicCompressedBvh<Builder>::build(triangles, with), name);
    }
}
template <class Builder = QuickBuilder, class Check>
void for_each_kernel(std::span<const Triangle> triangles, const Check& check,
                     const WideBvhConfig<Builder>& config = {}) {
    for_each_kernel_of<4, Builder>(triangles, check, config);
    for_each_kernel_of<8, Builder>(triangles, check, config);
    for_each_compressed<Builder>(triangles, check, config);
}

}  // namespace space
