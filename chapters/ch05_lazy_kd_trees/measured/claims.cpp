#include "chapters/ch05_lazy_kd_trees/measured/outcome.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace space::ch05 {
namespace {

std::string called(const ViewPoint& point) {
    return fmt::format("{}, {}", point.scene, point.view);
}

/// The views for which the table has a row, of the mesh on a floor or of the plants.
std::vector<ViewPoint> of_mesh(const std::vector<ViewPoint>& views, bool plants = false) {
    std::vector<ViewPoint> some;
    for (const ViewPoint& point : views)
        if (point.is_plants() == plants) some.push_back(point);
    return some;
}
std::string scenes_of(const std::vector<ViewPoint>& views) {
    std::vector<std::string> words;
    for (const ViewPoint& point : views) {
        const std::string word = fmt::format("{} ({} triangles)", point.scene, point.triangles);
        if (words.empty() || words.back() != word) words.push_back(word);
    }
    return joined(words);
}

/// A share of lazy over eager in each view, beside the published one: how many are at most that?
template <class Ours, class Theirs>
ClaimAnswer answer_share(std::string claim, const std::string& of,
                         const std::vector<ViewPoint>& views, const Ours& ours,
                         const Theirs& theirs, int digits) {
    std::vector<std::string> texts;
    std::size_t agree = 0;
    for (const ViewPoint& point : views) {
        const double published_share = theirs(*published(point));
        agree += ours(point) <= published_share;
        texts.push_back(fmt::format("{} {:.{}f} % ({:.{}f} %)", called(point), 100.0 * ours(point),
                                    digits, 100.0 * published_share, digits));
    }
    return {std::move(claim), verdict_of(agree, views.size()),
            fmt::format("{} of the lazy tree, of the eager one's (published): {}", of,
                        fmt::join(texts, "; ")),
            scenes_of(views),
            "confirmed if at most as much as published in every view, refuted if in none"};
}

ClaimAnswer answer_same(const std::vector<ViewPoint>& views) {
    std::size_t agree = 0;
    std::uint64_t rays = 0, tests = 0;
    for (const ViewPoint& point : views) {
        agree += point.lazy.same_work(point.eager) && point.other_pixels == 0;
        rays += point.rays;
        tests += point.eager.tests;
    }
    return {
        "J4", verdict_of(agree, views.size()),
        fmt::format("{} of {} views have the same pixels, hits, tests and visited nodes by both "
                    "trees; {} pixels, {} tests in all",
                    agree, views.size(), rays, tests),
        scenes_of(views), "confirmed if all views have, refuted if none"};
}

ClaimAnswer answer_plants(const std::vector<ViewPoint>& plants) {
    std::vector<std::string> texts;
    std::size_t slower = 0;
    for (const ViewPoint& point : plants) {
        slower += point.total_share() > 1.0;
        texts.push_back(fmt::format("{} {:.1f} % with {:.1f} % of the nodes", point.view,
                                    100.0 * point.total_share(), 100.0 * point.node_share()));
    }
    const PublishedRow row = *published(plants.front());
    return {"J5", verdict_of(slower, plants.size()),
            fmt::format("total time of the lazy tree, of the eager one's: {}; the report has "
                        "{:.1f} % with {:.1f} %. By its numbers a node took {:.1f} µs while the "
                        "tree was built and {:.1f} µs while rays waited for it",
                        fmt::join(texts, "; "), 100.0 * row.total_share(), 100.0 * row.node_share(),
                        row.eager_node_us(), row.lazy_node_us()),
            scenes_of(plants), "confirmed if slower in both views, refuted if in none"};
}

ClaimAnswer answer_lists(const std::vector<ListPoint>& lists) {
    std::vector<std::string> texts;
    std::size_t far_more = 0, hardly = 0;
    for (const ListPoint& point : lists) {
        const double ratio = point.scattered_ns / point.placed_ns;
        far_more += ratio >= 10.0;
        hardly += ratio < 2.0;
        texts.push_back(fmt::format("{} triangles {:.2f}", point.triangles, ratio));
    }
    return {"J6",
            far_more == lists.size() ? Verdict::confirmed
            : hardly == lists.size() ? Verdict::refuted
                                     : Verdict::depends,
            fmt::format("time of a ray with scattered lists and triangles over that with copies in "
                        "the order of the leaves: {}",
                        fmt::join(texts, "; ")),
            "soup; the report tells of thousands of seconds in place of some seventy",
            "confirmed if at least 10 at every size, refuted if below 2 at every size"};
}

ClaimAnswer answer_printed() {
    const PublishedRow& row = published_rows[1];
    const double share = row.node_share();
    const bool differs = std::abs(share - printed_share) > 0.5 * share;
    return {
        "J7", differs ? Verdict::confirmed : Verdict::refuted,
        fmt::format("{:.0f} of {:.3f} million nodes are {:.4f} %, {:.0f} times what is printed",
                    row.lazy_nodes, 1e-6 * row.eager_nodes, 100.0 * share, share / printed_share),
        "Johnston06's table", "confirmed if the printed share is off by more than half"};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    const std::vector<ViewPoint> mesh = of_mesh(measured.views),
                                 plants = of_mesh(measured.views, true);
    return {answer_share(
                "J1", "time to build", mesh, [](const ViewPoint& p) { return p.build_share(); },
                [](const PublishedRow& row) { return row.build_share(); }, 1),
            answer_share(
                "J2", "total time", mesh, [](const ViewPoint& p) { return p.total_share(); },
                [](const PublishedRow& row) { return row.total_share(); }, 1),
            answer_share(
                "J3", "nodes", mesh, [](const ViewPoint& p) { return p.node_share(); },
                [](const PublishedRow& row) { return row.node_share(); }, 4),
            answer_same(measured.views),
            answer_plants(plants),
            answer_lists(measured.lists),
            answer_printed()};
}

}  // namespace space::ch05
