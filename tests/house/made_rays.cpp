/// Makes rays at edges and vertices of a closed mesh and traces them in the same translation unit,
/// so that all of it may be inlined into one. Prints fingerprints of the answers, which a test
/// compares between compilers and options, and how many answers differ within the program that must
/// not: exit code 1 if any does.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <array>
#include <bit>
#include <cstdio>

namespace {

using namespace space;
using SplitterChoice = BspConfig::SplitterChoice;

constexpr int ray_count = 50'000;

/// FNV-1a over the answers' bits.
class Fingerprint {
  public:
    void add(const std::optional<Hit>& hit) {
        add(hit.has_value());
        if (!hit) return;
        for (const auto word : std::bit_cast<std::array<std::uint32_t, 4>>(*hit)) add(word);
    }
    unsigned long long hash() const { return hash_; }

  private:
    void add(std::uint32_t word) { hash_ = (hash_ ^ word) * 0x100000001b3u; }
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// Where a ray is to start and what it is to meet, in double.
struct Aim {
    Double3 from, target;
};

/// At a place on an edge, or its end: from around, from beside the triangle, along the edge.
Aim make_aim(std::span<const Triangle> triangles, Pcg32& random) {
    const Triangle& triangle = triangles[random.below(std::uint32_t(triangles.size()))];
    const Double3 a(triangle.a), b(triangle.b), c(triangle.c);
    const double s = random.uniform_double(), t = random.uniform_double(),
                 u = random.uniform_double();
    const Double3 target = random.below(4) ? a + s * (b - a) : a;
    switch (random.below(3)) {
        case 0:
            return {a + 4.0 * Double3(s, t, u) - 2.0, target};
        case 1:
            return {a + (t - 2.0) * (b - a) + u * (c - a), target};
        default:
            return {a + (t - 2.0) * (b - a), target};
    }
}

float round_one(double x) {
    return static_cast<float>(x);
}
/// Out of the optimiser's sight, for which a number is as good as the float that it becomes.
float (*const volatile rounded)(double) = round_one;

Ray careful_ray(const Aim& aim) {
    Ray ray;
    for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = rounded(aim.from[axis]);
        ray.direction[axis] = rounded(aim.target[axis] - double{ray.origin[axis]});
    }
    return ray;
}

/// Asks the naive loop about rays made on the spot, and each of the others about the same rays made
/// with care; returns how many of the others' answers are other ones.
template <class Reference, class... Others>
int compare(const char* name, const Reference& reference, std::span<const Triangle> triangles,
            const Others&... others) {
    Pcg32 random(1);
    Fingerprint answers;
    int hits = 0, differ = 0;
    for (int i = 0; i < ray_count; ++i) {
        const Aim aim = make_aim(triangles, random);
        const Point3 origin(aim.from);
        const Ray ray{origin, Vector3(aim.target - Double3(origin))};
        const std::optional<Hit> answer = closest_hit(reference, ray);
        answers.add(answer);
        hits += answer.has_value();
        const Ray careful = careful_ray(aim);
        differ += ((closest_hit(others, careful) != answer) + ...);
    }
    const std::size_t count = sizeof...(others) * ray_count;
    std::printf("%s: hits %d of %d rays, fingerprint %016llx; %d of %zu answers differ\n", name,
                hits, ray_count, answers.hash(), differ, count);
    return differ;
}

template <TriangleTest Test>
int compare_naive(const char* name, std::span<const Triangle> triangles) {
    const auto naive = Naive<Test>::build(triangles);
    return compare(name, naive, triangles, naive);
}

/// All that the lab offers of chapter 3.
int compare_bsp(std::span<const Triangle> triangles) {
    const auto by = [&](SplitterChoice splitter) {
        return Bsp<>::build(triangles, {.splitter = splitter});
    };
    const auto naive = Naive<FilteredExact>::build(triangles);
    return compare("naive and seven BSP trees, filtered-exact", naive, triangles, naive,
                   by(SplitterChoice::weighted), by(SplitterChoice::first),
                   by(SplitterChoice::random), by(SplitterChoice::balanced),
                   by(SplitterChoice::fewest_splits), by(SplitterChoice::free),
                   Bsp<>::build(triangles, {.straddlers = BspConfig::Straddlers::share}));
}

}  // namespace

int main() {
    const std::vector<Triangle> ball = scenes::ball(2);
    const int differ = compare_naive<MollerTrumbore>("naive, moller-trumbore", ball) +
                       compare_naive<MollerTrumboreFloat>("naive, moller-trumbore-float", ball) +
                       compare_naive<Watertight>("naive, watertight", ball) + compare_bsp(ball);
    std::printf("%s\n", differ ? "not all answers agree" : "all answers agree");
    return differ ? 1 : 0;
}
