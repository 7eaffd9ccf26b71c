/// @file
/// What our parallel builders share: all threads at each large node, then a task for each small
/// one, which idle threads steal.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/work_stealing.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// What threads share, in triangles. It depends on no number of threads: the build is the same sum
/// of work for 2 and for 256.
struct StealingSizes {
    std::size_t large = 32'768;  ///< all threads work at a node above it, and then at the next
    std::size_t chunk = 4'096;   ///< what a thread takes of a large node at a time, at least 1
    std::size_t grain = 2'048;   ///< a node above it is a task, which leaves two; below it, the
                                 ///< subtree is one

    /// `chunk` as it can be: a triangle, or as many as there may be.
    std::size_t usable_chunk() const {
        return std::clamp<std::size_t>(chunk, 1, std::size_t{1} << 31);
    }
};

/// One build. Method says how nodes are cut: choice() is for the nodes of one part, by one thread;
/// choose_by_all(task) for one node, by all.
template <int D, class Method, class Observer>
class StealingParts {
  public:
    StealingParts(const BvhLimits& limits, const StealingSizes& sizes, WorkStealing& threads,
                  const Method& method, Observer& observer)
        : limits_(limits), sizes_(sizes), threads_(threads), method_(method), observer_(observer) {}

    // [stealing_parts]
    void make_all(BvhPart<D>& root, std::span<std::uint32_t> names) {
        names_ = names;
        std::vector<BvhPart<D>*> large, small;
        const auto sort_in = [&](BvhPart<D>& part) {
            (part.task.range.size() > sizes_.large ? large : small).push_back(&part);
        };
        sort_in(root);
        while (!large.empty()) {
            BvhPart<D>& part = *large.back();
            large.pop_back();
            make_by_all(part, sort_in);
        }
        threads_.run([&](const auto& spawn) {
            for (BvhPart<D>* const part : small) spawn([&, part] { make(*part, spawn); });
        });
    }

  private:
    /// A node; its sides are parts that others make, as given(part) is told.
    template <class Given>
    void make_by_all(BvhPart<D>& part, const Given& given) {
        const auto choose = [&](const BvhTask<D>& task) { return method_.choose_by_all(task); };
        make_part<D>(
            part, limits_, choose, [](const auto&, const auto&) { return true; },
            [&](auto& first, auto& second) { given(first), given(second); }, observer_, names_);
    }

    /// A node above the grain leaves its sides to whoever comes first, mostly this thread.
    void make(BvhPart<D>& part, const WorkStealing::Spawn& spawn) {
        auto choice = method_.choice();  // each task has bins of its own
        const bool is_task = part.task.range.size() > sizes_.grain;
        make_part<D>(
            part, limits_, choice, [&](const auto&, const auto&) { return is_task; },
            [&](BvhPart<D>& first, BvhPart<D>& second) {
                spawn([&] { make(first, spawn); });
                spawn([&] { make(second, spawn); });
            },
            observer_, names_);
    }
    // [stealing_parts]

    const BvhLimits limits_;
    const StealingSizes& sizes_;
    WorkStealing& threads_;
    const Method& method_;
    Observer& observer_;
    std::span<std::uint32_t> names_;
};

/// The tree of all references, whose box is given.
template <int D, class Method, class Observer>
BvhNodes<D> build_by_stealing(std::span<BvhReference<D>> all, const BasicAabb<D>& box,
                              const BvhLimits& limits, const StealingSizes& sizes,
                              WorkStealing& threads, const Method& method, Observer& observer) {
    return build_in_parts<D>(all, box, threads.threads(), [&](auto& root, auto names) {
        StealingParts<D, Method, Observer>(limits, sizes, threads, method, observer)
            .make_all(root, names);
    });
}

}  // namespace space
