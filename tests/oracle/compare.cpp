#include "tests/oracle/compare.hpp"

#include "common/program/report.hpp"
#include "tests/oracle/moller_trumbore_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace space {
namespace {

double ulp(float t) {
    const float size = std::abs(t);
    return std::isinf(size) ? infinity : double{std::nextafter(size, infinity)} - double{size};
}

/// How far from the exact t a right answer may be: half a unit in the last place and the error
/// bound.
double t_uncertainty(const Ray& ray, const Triangle& triangle) {
    const std::optional<Crossing> exact = crossing(ray, triangle);
    if (!exact) return infinity;
    return 0.5 * ulp(static_cast<float>(exact->t)) + moller_trumbore_bound(ray, triangle, *exact).t;
}

/// Two of them apart: a unit in the last place and the bound twice.
bool as_near(float t, float other, double uncertainty) {
    return t == other || std::abs(double{t} - double{other}) <= 2.0 * uncertainty;
}

}  // namespace

const char* name(Agreement agreement) {
    switch (agreement) {
        case Agreement::agree:
            return "agree";
        case Agreement::tie:
            return "tie";
        case Agreement::inversion:
            return "inversion";
        case Agreement::interval_end:
            return "interval end";
        case Agreement::wrong_hit:
            return "wrong hit";
        case Agreement::wrong_miss:
            return "wrong miss";
        case Agreement::wrong_triangle:
            return "wrong triangle";
    }
    return "";
}

Comparison compare(const ExactOracle& oracle, const Ray& ray, const std::optional<Hit>& answer) {
    const std::vector<ExactHit> hits = oracle.hits(ray);
    const std::span<const Triangle> triangles = oracle.triangles();
    const auto at_an_end = [&](float t, std::uint32_t triangle) {
        const double uncertainty = t_uncertainty(ray, triangles[triangle]);
        return as_near(t, ray.tmin, uncertainty) || as_near(t, ray.tmax, uncertainty);
    };
    const auto wrong = [&](Agreement agreement, std::uint32_t triangle) -> Comparison {
        return {.agreement = agreement,
                .beyond_bound = !within_bound(ray, triangles[triangle]),
                .wrongly_decided = triangle};
    };

    if (!answer) {
        for (const ExactHit& hit : hits)
            if (!at_an_end(hit.t, hit.triangle)) return wrong(Agreement::wrong_miss, hit.triangle);
        return {.agreement = hits.empty() ? Agreement::agree : Agreement::interval_end};
    }
    if (answer->triangle >= triangles.size())
        return {.agreement = Agreement::wrong_triangle, .beyond_bound = true};

    const auto mine = std::find_if(hits.begin(), hits.end(), [&](const ExactHit& hit) {
        return hit.triangle == answer->triangle;
    });
    if (mine == hits.end()) {
        Ray line = ray;
        line.tmin = -infinity;
        line.tmax = infinity;
        const bool hit = decide(line, triangles[answer->triangle]) != Place::miss;
        if (hit && at_an_end(answer->t, answer->triangle))
            return {.agreement = Agreement::interval_end};
        return wrong(hits.empty() ? Agreement::wrong_hit : Agreement::wrong_triangle,
                     answer->triangle);
    }

    Comparison right{.rounded = mine->t != answer->t};
    if (right.rounded) {
        const double exact = crossing(ray, triangles[answer->triangle])->t;
        right.beyond_bound =
            std::abs(double{answer->t} - exact) > t_uncertainty(ray, triangles[answer->triangle]);
    }
    if (mine->rank == 0) {
        right.agreement = hits.size() > 1 && hits[1].rank == 0 ? Agreement::tie : Agreement::agree;
        return right;
    }
    right.agreement = Agreement::interval_end;
    for (auto nearer_one = hits.begin(); nearer_one != mine; ++nearer_one) {
        const double uncertainty = std::max(t_uncertainty(ray, triangles[nearer_one->triangle]),
                                            t_uncertainty(ray, triangles[answer->triangle]));
        if (as_near(nearer_one->t, mine->t, uncertainty))
            right.agreement = Agreement::inversion;
        else if (!at_an_end(nearer_one->t, nearer_one->triangle))
            return wrong(Agreement::wrong_triangle, nearer_one->triangle);
    }
    return right;
}

bool within_bound(const Ray& ray, const Triangle& triangle) {
    const std::optional<Crossing> exact = crossing(ray, triangle);
    if (!exact) return true;
    const double bound = moller_trumbore_bound(ray, triangle, *exact).weight;
    const double smallest = std::min({exact->u, exact->v, exact->w});
    return std::abs(smallest) <= bound;
}

std::size_t Tally::examined() const {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

std::size_t Tally::wrong() const {
    return (*this)[Agreement::wrong_hit] + (*this)[Agreement::wrong_miss] +
           (*this)[Agreement::wrong_triangle];
}

void Tally::add(const Comparison& comparison) {
    ++counts[static_cast<std::size_t>(comparison.agreement)];
    rounded_t += comparison.rounded;
    beyond_bound += comparison.beyond_bound;
}

Tally& Tally::operator+=(const Tally& other) {
    for (std::size_t i = 0; i < agreements; ++i) counts[i] += other.counts[i];
    rounded_t += other.rounded_t;
    beyond_bound += other.beyond_bound;
    skipped += other.skipped;
    return *this;
}

std::string Tally::text() const {
    std::string text;
    for (std::size_t i = 0; i < agreements; ++i)
        if (counts[i])
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                                name(static_cast<Agreement>(i)), with_commas(counts[i]));
    return fmt::format("{}; t not the nearest float {}; beyond the error bound {}; skipped {}",
                       text, with_commas(rounded_t), with_commas(beyond_bound),
                       with_commas(skipped));
}

}  // namespace space
