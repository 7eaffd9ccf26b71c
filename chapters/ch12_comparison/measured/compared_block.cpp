#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch12_comparison/check.hpp"
#include "chapters/ch12_comparison/measured/comparison.hpp"
#include "chapters/ch12_comparison/rays.hpp"
#include "common/measure.hpp"
#include "common/random_rays.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace space::ch12 {
namespace {

/// Up to so many triangles naive tracing tells what is right.
constexpr std::size_t most_naive = 10'000;
/// Ray-triangle tests in which naive tracing of one kind of rays is timed.
constexpr std::size_t naive_tests = 1'000'000;
/// A structure has more turns than it must until its rays have taken so long in them.
constexpr double enough_ms = 60.0;
/// One whose rays are slow has fewer where they would take longer.
constexpr double patience_ms = 250.0;
/// Once its builds have taken so long it stays, and its rays are all that is timed again.
constexpr double enough_builds_ms = 60.0;
/// A quick one, whose build decides what few rays cost, is built so often at least.
constexpr int least_quick_builds = 3;
constexpr double quick_build_ns_per_triangle = 700.0;

/// Processor time of this thread, in ms: one thread traces, and what else runs on the machine does
/// not count.
double thread_ms() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

/// Four digits: a time has no more, and a file of them is half as long.
double rounded(double value) {
    return std::isfinite(value) ? std::stod(fmt::format("{:.4g}", value)) : value;
}

Query query_of(RayKind kind) {
    return kind == RayKind::camera || kind == RayKind::diffuse ? Query::closest : Query::any;
}

/// The rays of a block, and the right answers to them.
struct Questions {
    std::array<std::vector<Ray>, ray_kinds.size()> rays;
    std::array<std::vector<HitRecord>, ray_kinds.size()> answers;

    std::size_t count() const {
        std::size_t sum = 0;
        for (const auto& kind : rays) sum += kind.size();
        return sum;
    }
    /// Of each kind the rays first, first + step ...
    Questions part(std::size_t first, std::size_t step) const {
        Questions part;
        for (std::size_t kind = 0; kind < rays.size(); ++kind)
            for (std::size_t i = first; i < rays[kind].size(); i += step) {
                part.rays[kind].push_back(rays[kind][i]);
                part.answers[kind].push_back(answers[kind][i]);
            }
        return part;
    }
};

/// To lamps that the surface faces, from where the rays hit it, spread evenly over the hits.
std::vector<Ray> shadow_rays(const ComparedSubject& subject, std::span<const Ray> rays,
                             std::span<const HitRecord> hits, std::size_t count) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].is_hit()) starts.push_back(i);
    std::vector<Ray> shadows;
    if (starts.empty() || subject.lights.empty()) return shadows;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t start = starts[i * starts.size() / count];
        const auto& [t, u, v, number] = hits[start];
        const Triangle& triangle = subject.triangles[number];
        const Double3 n = normal_towards(triangle, rays[start]);
        const Point3 origin =
            shadow_origin(triangle, hit_point(triangle, {.t = t, .u = u, .v = v}), n);
        for (std::size_t k = 0; k < subject.lights.size(); ++k) {
            const Ray ray = shadow_ray(origin, subject.lights[(i + k) % subject.lights.size()]);
            if (!(glm::dot(n, Double3(ray.direction)) > 0.0)) continue;
            shadows.push_back(ray);
            break;
        }
    }
    return shadows;
}

const Structure& named(std::span<const Structure> structures, std::string_view name) {
    const auto found = std::ranges::find(structures, name, &Structure::name);
    if (found == structures.end())
        throw std::logic_error(fmt::format("the lab has no structure {}", name));
    return *found;
}

Questions questions_of(const ComparedSubject& subject, std::span<const Structure> structures,
                       const CompareEffort& effort, const Options& options) {
    const std::string_view reference =
        subject.triangles.size() <= most_naive ? "naive" : "bvh-binned";
    const BuiltStructure right =
        named(structures, reference).variants.front().build_from_triangles(subject.triangles, {});
    Questions questions;
    const auto answer = [&](RayKind kind) -> std::vector<HitRecord>& {
        const auto i = static_cast<std::size_t>(kind);
        questions.answers[i].resize(questions.rays[i].size());
        right.trace({questions.rays[i], questions.answers[i], query_of(kind), options.threads});
        return questions.answers[i];
    };
    auto& [camera, shadow, diffuse, any] = questions.rays;
    camera = camera_rays({subject.camera, std::max(1, effort.width / subject.coarser),
                          std::max(1, effort.height / subject.coarser)});
    const std::vector<HitRecord>& seen = answer(RayKind::camera);
    shadow = shadow_rays(subject, camera, seen, camera.size());
    diffuse = diffuse_rays([&](std::uint64_t i) { return subject.triangles[i]; }, camera, seen,
                           camera.size(), options.seed);
    any = diffuse;
    answer(RayKind::shadow);
    for (const HitRecord& hit : answer(RayKind::diffuse))
        questions.answers.back().push_back(HitRecord::any(hit.is_hit()));
    return questions;
}

/// A peer's answer is wrong where it names another triangle than the nearest, misses, or hits what
/// is not there; the book's are wrong where a bit differs.
std::uint64_t count_wrong(std::span<const HitRecord> answers, std::span<const HitRecord> right,
                          bool is_peer) {
    if (!is_peer) {
        std::uint64_t wrong = 0;
        for (std::size_t i = 0; i < right.size(); ++i) wrong += !(answers[i] == right[i]);
        return wrong;
    }
    const auto counts = relations(right, answers);
    const auto count = [&](Relation r) { return counts[static_cast<std::size_t>(r)]; };
    return count(Relation::other_triangle) + count(Relation::missed) + count(Relation::false_hit);
}

/// One structure while it is measured.
class Candidate {
  public:
    Candidate(const Structure& structure, const ComparedSubject& subject, const Questions& all,
              const CompareEffort& effort, const Options& options)
        : structure_(structure), subject_(subject), all_(all), effort_(effort), options_(options) {
        row_ = {.scene = subject.scene,
                .spec = subject.spec,
                .triangles = subject.triangles.size(),
                .structure = std::string(structure.name),
                .home = std::string(structure.home),
                .is_peer = structure.is_peer};
        const std::size_t most =
            structure.name == "naive"
                ? std::max<std::size_t>(
                      4, naive_tests / std::max<std::size_t>(1, subject.triangles.size()))
                : all.count();
        const std::size_t each = all.rays.front().size();
        if (most < each) few_ = all.part(each / most / 2, (each + most - 1) / most);
        hits_.resize(each);
    }

    void give_up(std::string why) {
        row_.gave_up = std::move(why);
        for (TracedKind& kind : row_.traced) kind = {};
        row_.made_later.clear();
        built_.reset();
    }

    /// Builds it where it does not stand, and traces. Whatever is thrown is its reason to give up.
    void take_turn() {
        if (!wants_turn()) return;
        try {
            if (!built_) build();
            Stopwatch stopwatch;
            turn();
            turn_ms_ = stopwatch.lap().count();
            turns_ms_ += turn_ms_;
            ++turns_;
            if (wants_build() || !wants_turn()) built_.reset();
        } catch (const std::bad_alloc&) {
            give_up("out of memory");
        } catch (const std::exception& error) {
            give_up(error.what());
        }
    }

    ComparedRow finished() {
        if (!row_.stands() || build_ms_.empty()) return std::move(row_);
        row_.build_ms = rounded(median(build_ms_));
        for (std::size_t kind = 0; kind < trace_ns_.size(); ++kind)
            row_.traced[kind].ns_per_ray = rounded(median(trace_ns_[kind]));
        for (const auto& [rays, ms] : cold_ms_)
            row_.made_later.push_back(
                {double(rays),
                 rounded(std::max(0.0, median(ms) - 1e-6 * double(rays) * row_.mean_ns()))});
        return std::move(row_);
    }

  private:
    const Questions& questions() const { return few_ ? *few_ : all_; }
    bool is_lazy() const { return structure_.name == "kd-lazy"; }
    bool wants_turn() const {
        if (!row_.stands() || turns_ >= std::max(1, effort_.most_turns)) return false;
        return turns_ == 0 || turns_ms_ < enough_ms ||
               (turns_ < effort_.turns && turns_ms_ + turn_ms_ < patience_ms);
    }

    bool wants_build() const {
        const bool is_quick = builds_ms_ * 1e6 < quick_build_ns_per_triangle * double(builds_) *
                                                     double(subject_.triangles.size());
        return builds_ms_ < enough_builds_ms || (is_quick && builds_ < least_quick_builds);
    }

    void build() {
        const std::size_t references = 1'000'000 + 40 * subject_.triangles.size();
        const BuildOptions build{
            .threads = options_.threads,
            .limits = {.references = references, .placements = effort_.most_placed}};
        const Geometry geometry{subject_.triangles, subject_.graph ? &*subject_.graph : nullptr};
        // Of those that know instances the book's take them; a peer is given the triangles.
        const StructureVariant& variant = structure_.variants.front();
        Stopwatch stopwatch;
        built_ = structure_.is_peer ? variant.build_from_triangles(geometry.triangles, build)
                                    : variant.build(geometry, build);
        const double build_ms = stopwatch.lap().count();
        if (effort_.turns > 0) {
            build_ms_.push_back(build_ms);
            if (is_lazy()) make_nodes(*built_);
        }
        builds_ms_ += build_ms + stopwatch.lap().count();
        ++builds_;
    }

    void turn() {
        if (turns_ == 0)
            count(*built_);
        else
            warm_up(*built_);
        if (effort_.turns == 0) return;
        for (const RayKind kind : ray_kinds) time(*built_, kind);
    }

    /// Traces all rays once before they are timed. Of a tree that was just built a part lies in the
    /// caches, one that stayed finds them filled by others: only warm are the two measured alike.
    void warm_up(const BuiltStructure& built) {
        for (const RayKind kind : ray_kinds)
            if (kind != RayKind::any)  // these go where diffuse ones go, just before them
                trace(built, kind, questions());
    }

    void trace(const BuiltStructure& built, RayKind kind, const Questions& part) {
        const std::vector<Ray>& rays = part.rays[static_cast<std::size_t>(kind)];
        if (!rays.empty())
            built.trace({rays, std::span(hits_.data(), rays.size()), query_of(kind), 1});
    }

    /// The first pass over all rays, which warms up, too, and is not timed.
    void count(const BuiltStructure& built) {
        for (std::size_t i = 0; i < ray_kinds.size(); ++i) {
            const std::vector<Ray>& rays = questions().rays[i];
            TracedKind& kind = row_.traced[i];
            const std::span<HitRecord> hits(hits_.data(), rays.size());
            const Batch batch{rays, hits, query_of(ray_kinds[i]), options_.threads};
            kind.rays = rays.size();
            if (built.count && !rays.empty()) {
                const TraversalCounts work = built.count(batch);
                kind.nodes_per_ray = rounded(double(work.nodes_visited) / double(rays.size()));
                kind.tests_per_ray = rounded(double(work.triangles_tested) / double(rays.size()));
            } else
                built.trace(batch);
            kind.wrong = count_wrong(hits, questions().answers[i], structure_.is_peer);
        }
        const TreeShape shape = built.shape();
        const auto known = [](const auto& value) { return value ? double(*value) : unknown; };
        row_.build_threads = built.build_threads;
        row_.bytes = shape.bytes;
        row_.nodes = known(shape.nodes);
        row_.references = shape.references;
        row_.depth = known(shape.depth);
        row_.sah_cost = rounded(known(shape.sah_cost));
    }

    void time(const BuiltStructure& built, RayKind kind) {
        const auto i = static_cast<std::size_t>(kind);
        const auto rays = double(questions().rays[i].size());
        if (rays == 0.0) return;
        const double start = thread_ms();
        trace(built, kind, questions());
        trace_ns_[i].push_back(1e6 * (thread_ms() - start) / rays);
    }

    /// Traces what a tree has never seen, which makes its nodes: one ray, then one in a hundred,
    /// then all.
    void make_nodes(const BuiltStructure& built) {
        std::size_t traced = 0;
        double ms = 0.0;
        const auto make = [&](const Questions& part) {
            const double start = thread_ms();
            for (const RayKind kind : ray_kinds) trace(built, kind, part);
            ms += thread_ms() - start;
            traced += part.count();
            cold_ms_[traced].push_back(ms);
        };
        const std::size_t middle = questions().rays.front().size() / 2;
        Questions one;
        one.rays.front().push_back(questions().rays.front()[middle]);
        make(one);
        make(questions().part(middle % 100, 100));
        make(questions());
    }

    const Structure& structure_;
    const ComparedSubject& subject_;
    const Questions& all_;
    const CompareEffort& effort_;
    const Options& options_;
    ComparedRow row_;
    std::optional<Questions> few_ = {};  ///< where all are too many
    std::vector<HitRecord> hits_;
    std::optional<BuiltStructure> built_ = {};  ///< from turn to turn, where its build is slow
    int turns_ = 0, builds_ = 0;
    double turn_ms_ = 0.0, turns_ms_ = 0.0;  ///< of the last one's rays, of all rays
    double builds_ms_ = 0.0;
    std::vector<double> build_ms_;
    std::array<std::vector<double>, ray_kinds.size()> trace_ns_;
    std::map<std::size_t, std::vector<double>> cold_ms_;  ///< by the rays traced until then
};

}  // namespace

std::vector<ComparedRow> compare_on(const ComparedSubject& subject,
                                    std::span<const Structure> structures,
                                    const CompareEffort& effort, const Options& options,
                                    Progress* progress) {
    const Questions questions = questions_of(subject, structures, effort, options);
    std::vector<Candidate> candidates;
    for (const ComparedStructure& compared : compared_structures()) {
        const auto structure = std::ranges::find(structures, compared.name, &Structure::name);
        if (structure == structures.end()) continue;  // a peer that is not there
        candidates.emplace_back(*structure, subject, questions, effort, options);
        if (subject.triangles.size() > compared.most_triangles)
            candidates.back().give_up(
                fmt::format("not tried beyond {} triangles", compared.most_triangles));
    }
    for (int turn = 0; turn < std::max(1, effort.most_turns); ++turn)
        for (Candidate& candidate : candidates) {
            candidate.take_turn();
            if (progress) progress->step();
        }
    std::vector<ComparedRow> rows;
    for (Candidate& candidate : candidates) rows.push_back(candidate.finished());
    return rows;
}

}  // namespace space::ch12
