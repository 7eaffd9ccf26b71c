#include "chapters/ch12_comparison/check.hpp"

#include "common/pcg32.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace space {
namespace {

std::string answer_text(const HitRecord& hit) {
    if (!hit.is_hit()) return "none";
    if (hit.triangle == HitRecord::some_triangle) return "hit";
    return fmt::format("triangle {} at t = {} (u = {}, v = {})", hit.triangle, hit.t, hit.u, hit.v);
}

bool within_one_float(float exact, float t) {
    return t >= std::nextafter(exact, -infinity) && t <= std::nextafter(exact, infinity);
}

/// With a naive answer of this kind another one may be as good.
bool is_wrong(Relation relation) {
    return relation == Relation::other_triangle || relation == Relation::missed ||
           relation == Relation::false_hit;
}

/// Naive tracing of the same rays by any of its tests, each when it is first asked for.
class NaiveAnswers {
  public:
    NaiveAnswers(const Structure& naive, std::span<const Triangle> triangles,
                 std::span<const Ray> rays, const LabOptions& options)
        : naive_(naive), triangles_(triangles), rays_(rays), options_(options) {}

    std::span<const HitRecord> exact() { return by(naive_.variants.front().triangle_test); }

    std::span<const HitRecord> by(std::string_view triangle_test) {
        std::vector<HitRecord>& hits = hits_[triangle_test];
        if (hits.size() == rays_.size()) return hits;
        const auto variant = std::find_if(
            naive_.variants.begin(), naive_.variants.end(),
            [&](const StructureVariant& v) { return v.triangle_test == triangle_test; });
        hits.resize(rays_.size());
        Progress progress("checking", rays_.size());
        variant->build_from_triangles(triangles_, options_.build)
            .trace({rays_, hits, options_.query, options_.common.threads, &progress});
        return hits;
    }

  private:
    const Structure& naive_;
    std::span<const Triangle> triangles_;
    std::span<const Ray> rays_;
    const LabOptions& options_;
    std::map<std::string_view, std::vector<HitRecord>> hits_;
};

}  // namespace

std::vector<std::size_t> check_sample(std::size_t rays, std::size_t triangles, std::uint64_t seed,
                                      std::size_t limit) {
    const std::size_t count =
        std::min(rays, std::max<std::size_t>(1, limit / std::max<std::size_t>(1, triangles)));
    std::vector<std::size_t> sample(count);
    std::iota(sample.begin(), sample.end(), std::size_t{0});
    if (count == rays) return sample;
    Pcg32 random(seed);
    for (std::size_t& i : sample) {
        const std::size_t first = i * rays / count, last = (i + 1) * rays / count;
        i = first + random.below(static_cast<std::uint32_t>(last - first));
    }
    return sample;
}

Relation relation(const HitRecord& exact, const HitRecord& answer) {
    if (!exact.is_hit()) return answer.is_hit() ? Relation::false_hit : Relation::right;
    if (!answer.is_hit()) return Relation::missed;
    const bool here = within_one_float(exact.t, answer.t);
    if (exact.triangle == answer.triangle) return here ? Relation::right : Relation::t_off;
    return here ? Relation::equal_t : Relation::other_triangle;
}

std::array<std::size_t, relation_count> relations(std::span<const HitRecord> exact,
                                                  std::span<const HitRecord> answers) {
    std::array<std::size_t, relation_count> counts{};
    for (std::size_t i = 0; i < exact.size(); ++i)
        ++counts[static_cast<std::size_t>(relation(exact[i], answers[i]))];
    return counts;
}

Differences differences(std::span<const HitRecord> exact, const Answers& naive,
                        const Answers& other, std::span<const std::size_t> rays) {
    Differences differences;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (naive.hits[i] == other.hits[i]) continue;
        if (is_wrong(relation(exact[i], naive.hits[i])))
            ++differences.naive_wrong;
        else
            differences.lines.push_back(fmt::format("ray {}: {} {}, {} {}", rays[i],
                                                    naive.structure, answer_text(naive.hits[i]),
                                                    other.structure, answer_text(other.hits[i])));
    }
    return differences;
}

std::vector<Checked> check(const Structure& naive, std::span<const Triangle> triangles,
                           std::span<const Ray> rays, std::span<const Measurement> measurements,
                           const LabOptions& options, std::FILE* out) {
    const std::vector<std::size_t> sample =
        check_sample(rays.size(), triangles.size(), options.common.seed);
    std::vector<Ray> sample_rays;
    for (const std::size_t i : sample) sample_rays.push_back(rays[i]);
    NaiveAnswers naive_answers(naive, triangles, sample_rays, options);

    std::vector<Checked> all;
    std::size_t disagreements = 0, naive_wrong = 0;
    for (const Measurement& m : measurements) {
        Checked& checked = all.emplace_back();
        if (!m.stands()) continue;
        std::vector<HitRecord> answers;
        for (const std::size_t i : sample) answers.push_back(m.hits[i]);
        checked.rays = sample.size();
        checked.relations = relations(naive_answers.exact(), answers);
        if (m.choice.structure->is_peer) continue;
        const Differences found = differences(
            naive_answers.exact(), {naive.name, naive_answers.by(m.choice.variant->triangle_test)},
            {m.name(), answers}, sample);
        for (const std::string& line : found.lines) fmt::print(out, "{}\n", line);
        disagreements += checked.disagreements = found.lines.size();
        naive_wrong += checked.naive_wrong = found.naive_wrong;
    }
    if (sample.size() < rays.size())
        fmt::print(out,
                   "check   a sample of {} of {} rays (naive tracing of all would be over {} "
                   "tests): ",
                   with_commas(sample.size()), with_commas(rays.size()), with_commas(check_limit));
    else
        fmt::print(out, "check   all {}: ", counted(rays.size(), "ray"));
    fmt::print(out, "{}", counted(disagreements, "disagreement"));
    if (naive_wrong)
        fmt::print(out, "; {} more where naive tracing by this test is wrong",
                   with_commas(naive_wrong));
    fmt::print(out, "\n\n");
    return all;
}

}  // namespace space
