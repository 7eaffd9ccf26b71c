#include "chapters/ch04_kd_trees/measured/point_measurements.hpp"

#include "chapters/ch04_kd_trees/measured/nanoflann_points.hpp"
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "common/measure.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace space::ch04 {
namespace {

constexpr std::size_t queries_a_turn = 250;

/// How far the measurement goes; queries in whole turns.
struct PointLimits {
    std::size_t most_points, queries, checked;
    int rounds;
};
PointLimits point_limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.most_points = 1'000, .queries = 500, .checked = 100, .rounds = 0};
        case Amount::quick:
            return {.most_points = 100'000, .queries = 2'000, .checked = 20, .rounds = 5};
        default:  // with --counts --quick the first of the full run's sets
            return {.most_points = options.quick ? 100'000u : 1'000'000u,
                    .queries = 10'000,
                    .checked = 5,
                    .rounds = 5};
    }
}

/// Counts where a search goes.
template <int D>
struct SearchCounter : NoObserver {
    NearestQueries& sums;

    explicit SearchCounter(NearestQueries& all) : sums(all) {}
    using NoObserver::observe;
    void observe(const typename PointSearch<D>::Visited& visited) {
        ++(visited.subtree.is_bucket() ? sums.buckets : sums.subtrees);
    }
    void observe(const typename PointSearch<D>::Compared&) { ++sums.compared; }
};

/// One set of points, its queries and both trees.
template <int D>
struct PointTask {
    std::vector<Point<D>> points, queries;
    KdPoints<D> tree;
    NanoflannPoints<D> peer;

    PointTask(std::vector<Point<D>> all, std::vector<Point<D>> asked)
        : points(std::move(all)),
          queries(std::move(asked)),
          tree(KdPoints<D>::build(points)),
          peer(points) {}
};

/// Whether a loop over all points finds the same.
template <int D>
bool is_right(const PointTask<D>& task, const Point<D>& query, std::span<const Neighbour> best) {
    std::vector<Neighbour> all;
    const TrueOrder<D> nearer{task.tree, query};
    for (std::uint32_t slot = 0; slot < task.points.size(); ++slot)
        all.push_back(nearer.neighbour(slot));
    std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(best.size()), all.end(), nearer);
    all.resize(best.size());
    nearer.name(all);
    return std::ranges::equal(all, best);
}

template <int D>
NearestQueries count_nearest(const PointTask<D>& task, std::size_t k, std::size_t checked) {
    NearestQueries counts{.k = k, .queries = task.queries.size()};
    SearchCounter<D> counter(counts);
    NearestSearch<D> search(task.tree, k);
    std::vector<std::uint32_t> indices(k);
    std::vector<float> distances(k);
    if (NanoflannPoints<D>::available) counts.peer_differs = 0;
    for (const Point<D>& query : task.queries) {
        const auto best = search(query, counter);
        if (counts.checked < checked) {
            ++counts.checked;
            counts.wrong += !is_right(task, query, best);
        }
        if (!counts.peer_differs) continue;
        task.peer.nearest(query, indices, distances);
        for (std::size_t i = 0; i < best.size(); ++i)
            *counts.peer_differs += indices[i] != best[i].index;
    }
    return counts;
}

/// A candidate of interleaved_medians: some of the queries, at the next call the next ones. Short
/// turns: what the machine does beside hits a few of them, and not the median.
template <int D, class Search>
std::function<void()> in_turns(const PointTask<D>& task, Search search) {
    return [&task, search, next = std::size_t{0}]() mutable {
        for (std::size_t i = 0; i < queries_a_turn; ++i) search(task.queries[next + i]);
        next = (next + queries_a_turn) % task.queries.size();
    };
}

template <int D>
void time_nearest(const PointTask<D>& task, int rounds, NearestQueries& measured) {
    NearestSearch<D> search(task.tree, measured.k);
    std::vector<std::uint32_t> indices(measured.k);
    std::vector<float> distances(measured.k);
    std::vector<std::function<void()>> candidates{
        in_turns<D>(task, [&](const Point<D>& query) { do_not_optimize(search(query).data()); })};
    if (NanoflannPoints<D>::available)
        candidates.push_back(in_turns<D>(task, [&](const Point<D>& query) {
            task.peer.nearest(query, indices, distances);
            do_not_optimize(indices.data());
        }));
    const int turns = rounds * static_cast<int>(task.queries.size() / queries_a_turn);
    const auto medians = interleaved_medians(candidates, turns);
    measured.microseconds = 1e3 * medians[0] / double(queries_a_turn);
    if (medians.size() > 1) measured.peer_microseconds = 1e3 * medians[1] / double(queries_a_turn);
}

template <int D>
void time_builds(const PointTask<D>& task, PointSet& set) {
    const std::vector<std::function<void()>> builds{
        [&] { do_not_optimize(KdPoints<D>::build(task.points).size); },
        [&] {
            const NanoflannPoints<D> peer(task.points);
            do_not_optimize(&peer);
        }};
    const std::vector<double> medians = interleaved_medians(builds, 3);
    set.build_ms = medians[0];
    if (NanoflannPoints<D>::available) set.peer_build_ms = medians[1];
}

template <int D>
PointSet measure_set(Places places, std::size_t count, const Options& options) {
    const PointLimits limits = point_limits(options);
    Pcg32 random(count, D);
    auto made = make_points<D>(places, count, count + limits.queries, random);
    std::vector<Point<D>> queries(made.end() - std::ptrdiff_t(limits.queries), made.end());
    made.resize(count);
    PointSet set{.places = places == Places::uniform ? "uniform" : "clustered",
                 .dimensions = D,
                 .points = count};
    const bool timed = !options.small && !options.counts;
    const PointTask<D> task(std::move(made), std::move(queries));
    if (timed) time_builds<D>(task, set);
    for (const std::size_t k : {1, 8, 64}) {
        set.nearest.push_back(count_nearest<D>(task, k, limits.checked));
        if (timed) time_nearest<D>(task, limits.rounds, set.nearest.back());
    }
    return set;
}

}  // namespace

template <int D>
std::vector<Point<D>> make_points(Places places, std::size_t points, std::size_t count,
                                  Pcg32& random) {
    const BasicAabb<D> unit{Point<D>(0.0f), Point<D>(1.0f)};
    std::vector<Point<D>> centres;
    const auto clusters = static_cast<std::uint32_t>(std::sqrt(double(points)));
    for (std::uint32_t i = 0; i < clusters; ++i) centres.push_back(random_point(random, unit));
    std::vector<Point<D>> made;
    for (std::size_t i = 0; i < count; ++i) {
        if (places == Places::uniform) {
            made.push_back(random_point(random, unit));
            continue;
        }
        Point<D> p = centres[random.below(clusters)];
        for (int sum = 0; sum < 4; ++sum)  // nearly a normal distribution
            p += 0.01f * (random_point(random, unit) - 0.5f);
        made.push_back(p);
    }
    return made;
}
template std::vector<Point2> make_points<2>(Places, std::size_t, std::size_t, Pcg32&);
template std::vector<Point3> make_points<3>(Places, std::size_t, std::size_t, Pcg32&);

std::vector<PointSet> measure_point_searches(const Options& options) {
    std::vector<PointSet> sets;
    for (std::size_t count = 1'000; count <= point_limits(options).most_points; count *= 10)
        for (const Places places : {Places::uniform, Places::clustered}) {
            sets.push_back(measure_set<2>(places, count, options));
            sets.push_back(measure_set<3>(places, count, options));
        }
    return sets;
}

}  // namespace space::ch04
