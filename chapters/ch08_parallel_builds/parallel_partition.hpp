/// @file
/// A range in two by all threads at once.
#pragma once

#include "chapters/ch08_parallel_builds/work_stealing.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace space {

// [chunks_of]
/// A range in equal chunks of nearly a given size: enough of them for all threads, and each long
/// enough to hide that it had to be fetched.
struct ChunksOf {
    std::size_t size, chunk;

    std::size_t count() const { return (size + chunk - 1) / chunk; }
    std::size_t begin(std::size_t i) const { return std::min(i * chunk, size); }
    template <class T>
    std::span<T> operator()(std::span<T> range, std::size_t i) const {
        return range.subspan(begin(i), begin(i + 1) - begin(i));
    }
};
// [chunks_of]

// [parallel_partition]
/// Puts what is_first says before the rest, by all threads, in place. Each chunk is parted by
/// itself. Then what lies on the wrong side of the middle is exchanged: the k-th of these on the
/// left with the k-th on the right.
template <class T>
class ParallelPartition {
  public:
    ParallelPartition(std::span<T> range, std::size_t chunk, WorkStealing& threads)
        : range_(range), chunks_{range.size(), chunk}, threads_(threads) {}

    template <class IsFirst>
    void run(const IsFirst& is_first) {
        std::vector<std::size_t> firsts(chunks_.count());
        threads_.for_each(chunks_.count(), [&](std::size_t i) {
            const std::span<T> part = chunks_(range_, i);
            firsts[i] = static_cast<std::size_t>(
                std::partition(part.begin(), part.end(), is_first) - part.begin());
        });
        std::size_t middle = 0;
        for (const std::size_t count : firsts) middle += count;
        Runs left, right;  // of what is misplaced
        for (std::size_t i = 0; i < chunks_.count(); ++i) {
            const std::size_t begin = chunks_.begin(i), end = chunks_.begin(i + 1);
            left.add(begin + firsts[i], std::min(end, middle));
            right.add(std::max(begin, middle), begin + firsts[i]);
        }
        const ChunksOf swaps{left.total(), chunks_.chunk};
        threads_.for_each(swaps.count(), [&](std::size_t i) {
            exchange(left, right, swaps.begin(i), swaps.begin(i + 1));
        });
    }

  private:
    /// Pieces of the range, and how many elements stand before each.
    struct Runs {
        std::vector<std::size_t> begin, before{0};

        void add(std::size_t from, std::size_t to) {
            if (from >= to) return;
            begin.push_back(from);
            before.push_back(before.back() + (to - from));
        }
        std::size_t total() const { return before.back(); }
        /// The run that the k-th element is in.
        std::size_t run_of(std::size_t k) const {
            return std::size_t(std::ranges::upper_bound(before, k) - before.begin()) - 1;
        }
    };

    void exchange(const Runs& left, const Runs& right, std::size_t k, std::size_t end) {
        std::size_t l = left.run_of(k), r = right.run_of(k);
        while (k < end) {
            const std::size_t until = std::min({end, left.before[l + 1], right.before[r + 1]});
            T* const from = &range_[left.begin[l] + (k - left.before[l])];
            std::swap_ranges(from, from + (until - k),
                             &range_[right.begin[r] + (k - right.before[r])]);
            k = until;
            if (k == left.before[l + 1]) ++l;
            if (k == right.before[r + 1]) ++r;
        }
    }

    std::span<T> range_;
    ChunksOf chunks_;
    WorkStealing& threads_;
};
// [parallel_partition]

}  // namespace space
