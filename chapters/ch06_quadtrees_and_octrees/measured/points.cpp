#include "chapters/ch04_kd_trees/point_search.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_search.hpp"
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <tuple>

namespace space::ch06 {
namespace {

template <int D>
Point<D> point_in(Pcg32& random, float low, float high) {
    return random_point(random, BasicAabb<D>{Point<D>(low), Point<D>(high)});
}

/// A kind of set of points.
struct PointKind {
    std::string_view name;
    int apart = 0;  ///< pairs are 2^apart apart; 0: no pairs
};
constexpr PointKind even{"even"}, on_a_curve{"on a curve"};
constexpr PointKind kinds[]{
    even, on_a_curve, {"pairs 2^-12", -12}, {"pairs 2^-16", -16}, {"pairs 2^-20", -20}};

/// Even in the unit cube; on an arc about the origin; or even ones, each with a second one beside
/// it on the first axis.
template <int D>
std::vector<Point<D>> points_of(const PointKind& kind, std::size_t n, std::uint64_t seed) {
    Pcg32 random(seed, D);
    std::vector<Point<D>> points;
    while (kind.apart != 0 && points.size() < n) {
        Point<D> p = point_in<D>(random, 0.0f, 1.0f);
        p.x *= 0x1p-7f;  // so near to 0 that floats see the difference
        points.push_back(p);
        p.x += std::ldexp(1.0f, kind.apart);
        points.push_back(p);
    }
    while (points.size() < n) {
        Point<D> p = point_in<D>(random, 0.0f, 1.0f);
        // A rational point of the circle: with x = t no function of the library is needed.
        if (kind.name == on_a_curve.name) {
            const float t = p.x;
            p.x = (1.0f - t * t) / (1.0f + t * t);
            p.y = 2.0f * t / (1.0f + t * t);
            if constexpr (D == 3) p.z = t;
        }
        points.push_back(p);
    }
    return points;
}

template <int D>
PointTree point_tree(const PointKind& kind, std::size_t n, const Options& options) {
    const std::vector<Point<D>> points = points_of<D>(kind, n, options.seed);
    const LinearOrthtreeConfig config{.leaf_size = 1};
    const auto tree = OrthtreePoints<D>::build(points, config);  // which warms up
    PointTree point{
        .points = std::string(kind.name), .dimensions = D, .n = n, .depth = tree.cells.depth};
    point.nodes = tree.cells.nodes.size();
    point.cells = 1;
    for (const auto& node : tree.cells.nodes)
        if (!node.is_leaf()) point.cells += orthants<D>;
    std::vector<double> ms;
    for (int round = 0; round < limits(options).rounds; ++round) {
        Stopwatch stopwatch;
        do_not_optimize(OrthtreePoints<D>::build(points, config));
        ms.push_back(stopwatch.lap().count());
    }
    if (!ms.empty()) point.build_ms = median(std::move(ms));
    return point;
}

template <int D>
void add_points(const Options& options, std::vector<PointTree>& points) {
    for (const PointKind& kind : kinds)
        for (std::size_t n = 1'000; n <= limits(options).most_points; n *= 10)
            points.push_back(point_tree<D>(kind, n, options));
}

// --- segments ---

/// Across the unit square, from side to side.
std::vector<Segment> long_segments(std::size_t n, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Segment> segments;
    while (segments.size() < n) {
        const float y = random.uniform(), end = random.uniform();
        segments.push_back({{0.0f, y}, {1.0f, end}});
    }
    return segments;
}

// --- codes ---

std::size_t distinct(std::vector<std::uint64_t> codes) {
    std::ranges::sort(codes);
    return std::size_t(std::unique(codes.begin(), codes.end()) - codes.begin());
}

// --- searches ---

template <class Search>
struct SearchCounter : NoObserver {
    SearchPoint& sums;

    explicit SearchCounter(SearchPoint& all) : sums(all) {}
    using NoObserver::observe;
    void observe(const typename Search::Visited& visited) {
        bool is_leaf;
        if constexpr (requires { visited.is_leaf; })
            is_leaf = visited.is_leaf;
        else
            is_leaf = visited.subtree.is_bucket();
        ++(is_leaf ? sums.leaves : sums.inner);
    }
    void observe(const typename Search::Compared&) { ++sums.compared; }
};

template <int D, class Search, class Tree>
SearchPoint count_searches(std::string_view name, const Tree& tree,
                           std::span<const Point<D>> queries, std::vector<Neighbour>& answers) {
    SearchPoint point{.tree = name, .dimensions = D, .n = tree.size, .queries = queries.size()};
    SearchCounter<Search> counter(point);
    NearestSearch<D, Search> search(tree, 1);
    const bool first = answers.empty();
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Neighbour best = search(queries[i], counter)[0];
        if (first)
            answers.push_back(best);
        else
            point.differs += !(best == answers[i]);
    }
    return point;
}

template <int D>
void add_searches(std::size_t n, const Options& options, std::vector<SearchPoint>& points) {
    const std::vector<Point<D>> all = points_of<D>(even, n, options.seed),
                                queries =
                                    points_of<D>(even, limits(options).queries, options.seed + 1);
    const auto tree = KdPoints<D>::build(all);
    const auto orthtree = OrthtreePoints<D>::build(all);
    std::vector<Neighbour> answers;
    points.push_back(count_searches<D, PointSearch<D>>("k-d tree", tree, queries, answers));
    points.push_back(count_searches<D, OrthtreeSearch<D>>(D == 2 ? "quadtree" : "octree", orthtree,
                                                          queries, answers));
    if (limits(options).rounds == 0) return;
    const auto ask = [&]<class Search>(NearestSearch<D, Search>& search) {
        for (const Point<D>& query : queries) do_not_optimize(search(query).data());
    };
    NearestSearch<D> in_tree(tree, 1);
    NearestSearch<D, OrthtreeSearch<D>> in_orthtree(orthtree, 1);
    const std::function<void()> candidates[]{[&] { ask(in_tree); }, [&] { ask(in_orthtree); }};
    const std::vector<double> medians = interleaved_medians(candidates, limits(options).rounds);
    for (std::size_t i = 0; i < 2; ++i)
        points[points.size() - 2 + i].microseconds = 1e3 * medians[i] / double(queries.size());
}

}  // namespace

std::vector<PointTree> measure_points(const Options& options) {
    std::vector<PointTree> points;
    add_points<2>(options, points);
    add_points<3>(options, points);
    return points;
}

std::vector<SegmentTree> measure_segments(const Options& options) {
    std::vector<SegmentTree> trees;
    for (const std::size_t n : {10u, 100u, 1'000u})
        for (std::uint32_t depth = 2; depth <= (options.small ? 6u : 10u); depth += 2) {
            const std::vector<Segment> segments = long_segments(n, options.seed);
            // A cut that costs less than nothing always pays.
            const OctreeConfig config{.costs = {.traversal = -1e9},
                                      .max_leaf_size = 1,
                                      .max_depth = depth,
                                      .max_growth = 1e9};
            const auto tree = OrthtreeBuilder<2>::build(segments, config);
            SegmentTree point{.n = n, .depth = tree.depth, .cells = 1};
            for (const OrthtreeNode& node : tree.nodes)
                if (!node.is_leaf()) point.cells += orthants<2>;
            point.references = tree.references.size();
            trees.push_back(point);
        }
    return trees;
}

std::vector<CodePoint> measure_codes(const Options& options) {
    const std::size_t n = options.small ? 1'000 : 100'000;
    std::vector<CodePoint> points;
    for (int exponent = 0; exponent >= -6; --exponent) {
        Pcg32 random(options.seed);
        std::vector<std::uint64_t> fine, coarse;
        std::vector<std::tuple<float, float, float>> places;
        const auto edge = float(std::pow(10.0, exponent));
        for (std::size_t i = 0; i < n; ++i) {
            const Point3 p =
                Point3(exponent == 0 ? 0.0f : 0.3f) + edge * random_point(random, 0.0f, 1.0f);
            fine.push_back(morton_code(OrthtreeFrame<3>(), p));
            coarse.push_back(fine.back() >> 33);  // ten bits of each axis
            places.emplace_back(p.x, p.y, p.z);
        }
        std::ranges::sort(places);
        const auto end = std::unique(places.begin(), places.end());
        points.push_back({.exponent = exponent,
                          .points = n,
                          .distinct_points = std::uint64_t(end - places.begin()),
                          .codes_30 = distinct(std::move(coarse)),
                          .codes_63 = distinct(std::move(fine))});
    }
    return points;
}

std::vector<SortTimes> measure_sorts(const Options& options) {
    std::vector<SortTimes> sorts;
    for (std::size_t n = 10'000; n <= limits(options).most_points; n *= 10) {
        const std::vector<Point3> points = points_of<3>(even, n, options.seed);
        const OrthtreeFrame<3> frame;
        std::vector<CodedIndex> coded(n), items(n), scratch(n);
        std::vector<std::byte> from(n * sizeof(CodedIndex)), to(from.size());
        RadixSortWork work;
        const std::function<void()> candidates[]{
            [&] {
                for (std::uint32_t i = 0; i < n; ++i) coded[i] = {morton_code(frame, points[i]), i};
                do_not_optimize(coded.data());
            },
            [&] {
                items = coded;
                do_not_optimize(items.data());
            },
            [&] {
                items = coded;
                work = radix_sort(items, scratch);
                do_not_optimize(items.data());
            },
            [&] {
                std::memcpy(to.data(), from.data(), from.size());
                do_not_optimize(to.data());
            }};
        const auto ms = interleaved_medians(candidates, std::max(3, limits(options).rounds));
        sorts.push_back({.items = n,
                         .passes = std::uint64_t(work.passes),
                         .bytes_moved = work.bytes_moved(),
                         .codes_ms = ms[0],
                         .sort_ms = ms[2] - ms[1],
                         .copy_bytes_per_ms = 2.0 * double(from.size()) / ms[3]});
    }
    return sorts;
}

std::vector<SearchPoint> measure_searches(const Options& options) {
    std::vector<SearchPoint> points;
    for (std::size_t n = 1'000; n <= limits(options).most_points; n *= 10) {
        add_searches<2>(n, options, points);
        add_searches<3>(n, options, points);
    }
    return points;
}

}  // namespace space::ch06
