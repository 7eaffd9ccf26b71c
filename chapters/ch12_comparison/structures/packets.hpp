/// @file
/// What --packets asks of a structure.
#pragma once

#include "chapters/ch10_fast_traversal/packets.hpp"
#include "chapters/ch12_comparison/structures.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace space {

/// A structure of chapter 10 that stands, with its walk for packets.
template <class Tree>
BuiltStructure erased_with_packets(Tree tree, unsigned build_threads = 1) {
    const auto shared = std::make_shared<const Tree>(std::move(tree));
    BuiltStructure built{
        .shape = [shared] { return shared->shape(); },
        .trace = [shared](const Batch& batch) { trace<NoCounts>(*shared, batch); },
        .count = [shared](const Batch& batch) { return trace<TraversalCounts>(*shared, batch); },
        .build_threads = build_threads};
    built.trace_packets = [shared](const Batch& batch) {
        constexpr std::size_t size = 64, block = 16 * size;
        const ManyQuery query = batch.query == Query::any ? ManyQuery::any : ManyQuery::closest;
        parallel_for((batch.rays.size() + block - 1) / block, batch.threads, 1, [&](std::size_t i) {
            const std::size_t first = i * block, count = std::min(block, batch.rays.size() - first);
            trace_in_packets(*shared, batch.rays.subspan(first, count), size, query,
                             [&](std::size_t ray, const std::optional<Hit>& hit) {
                                 batch.hits[first + ray] = query == ManyQuery::any
                                                               ? HitRecord::any(hit.has_value())
                                                               : HitRecord::closest(hit);
                             });
            if (batch.progress) batch.progress->step(count);
        });
    };
    return built;
}

}  // namespace space
