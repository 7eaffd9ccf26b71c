// Chapter 2's filter in lanes: the kernels decide by it just what FilteredExact decides by its own,
// and leave the rest to its exact stages, on rays that pass edges, and t that pass the middles of
// floats, nearer than doubles tell.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/kernels/many_table.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {
namespace {

struct Case {
    Ray ray;
    Triangle triangle;
};

/// Beside a vertical edge, by 2^-30 to 2^-70 of the distance: from the lower half on no double
/// tells on which side.
Case beside_an_edge(Pcg32& random) {
    const auto whole = [&](std::uint32_t most) { return float(1 + random.below(most)); };
    const float away = whole(1'000), below = -whole(100), above = whole(100);
    const float side = random.below(2) == 0 ? 1.0f : -1.0f;
    const float off = std::ldexp(side, -30 - int(random.below(40)));
    const float far = away + whole(100), across = -whole(100), height = whole(50);
    return {{.origin = {0, 0, 0.25f}, .direction = {1, off, 0.0078125f}},
            {{away, 0, below}, {far, across, height}, {away, 0, above}}};
}
/// With t = m + 2^-20 .. 2^-64, or a little less, for a middle m between two floats. The plane's
/// normal is (2^40, 2^40, 1), so that t has more than a double's bits.
Case beside_a_middle(Pcg32& random) {
    const float start = 0x1p24f + 2.0f * float(random.below(8));
    const float side = random.below(2) == 0 ? 1.0f : -1.0f;
    const float z = std::ldexp(side, 20 - int(random.below(44)));
    const Point3 a{start, 1.0f, z}, e1{0x1p20f, -0x1p20f, 0}, e2{0, 0x1p-20f, -0x1p20f};
    const Point3 b = a + e1, c = a + e2;
    return {{.origin = Point3(0), .direction = {1, 0x1p-80f, 0x1p-80f}}, {a, b, c}};
}

/// What FilteredExact says, and whether its filter has decided.
struct Expected {
    std::optional<Hit> hit;
    Stage stage = Stage::filter;

    void decided(Stage by) { stage = by; }
};
Expected expected(const Case& c) {
    Expected e;
    e.hit = FilteredExact::intersect(c.ray, c.triangle, e);
    return e;
}

std::size_t asked = 0;  // how often the kernels have asked for the exact stages
void count_lane(const KernelRay& ray, const float* block, unsigned lane, KernelHit& best) {
    ++asked;
    exact_lane(ray, block, lane, best);
}
void count_packet_lane(PacketRays& rays, unsigned ray, const float* block, unsigned lane) {
    ++asked;
    exact_packet_lane(rays, ray, block, lane);
}

template <int N>
void check_single(const Case& c, const Expected& e, InstructionSet set) {
    const std::vector<Triangle> one{c.triangle};
    const auto bvh = WideBvh<N, QuickBuilder>::build(one, {.instructions = set});
    KernelTree tree = bvh.kernel_tree();
    tree.exact = count_lane;
    asked = 0;
    KernelHit best = nothing_yet;
    const KernelAnswer answer = kernel_table<N>(set)->closest(tree, &c.ray.origin.x, best);
    REQUIRE(answer == (e.hit ? kernel_hit : kernel_miss));
    if (e.hit) REQUIRE((best.t == e.hit->t && best.u == e.hit->u && best.v == e.hit->v));
    REQUIRE(asked == (e.stage == Stage::filter ? 0 : 1));
}
/// The ray many times: few rays are traced one by one.
void check_packet(const Case& c, const Expected& e, InstructionSet set) {
    const std::vector<Triangle> one{c.triangle};
    const auto bvh = FastBvh<>::build(one, {.instructions = set});
    const std::vector<Ray> rays(32, c.ray);
    KernelTree tree = bvh.kernel_tree();
    tree.exact = count_lane;
    PacketRays packet{};
    PacketCounts counts{};
    packet.count = 32;
    packet.rays = &rays[0].origin.x;
    asked = 0;
    REQUIRE(
        many_kernels(set)->packet(tree, packet, largest_kernel_float, count_packet_lane, counts));
    for (int i = 0; i < 32; ++i) {
        const bool is_right = (packet.triangle[i] != no_kernel_hit) == e.hit.has_value() &&
                              (!e.hit || (packet.t[i] == e.hit->t && packet.u[i] == e.hit->u));
        if (!is_right) FAIL("another answer in a packet");
    }
    REQUIRE(asked == (e.stage == Stage::filter ? 0 : 32));
}

template <class Make>
void check_cases(std::uint64_t seed, const Make& make) {
    Pcg32 random(seed);
    std::size_t decided = 0, left = 0;
    for (int i = 0; i < sized(2'000, 200); ++i) {
        const Case c = make(random);
        const Expected e = expected(c);
        ++(e.stage == Stage::filter ? decided : left);
        for (const InstructionSet set : usable_instruction_sets()) {
            if (set == InstructionSet::scalar) continue;
            CAPTURE(i, name_of(set), e.hit.has_value());
            check_single<4>(c, e, set);
            check_single<8>(c, e, set);
            check_packet(c, e, set);
        }
    }
    CHECK(decided > 20);
    CHECK(left > 20);
}

}  // namespace

TEST_CASE("beside an edge the lanes leave to the exact stages what chapter 2's filter leaves") {
    check_cases(1, beside_an_edge);
}

TEST_CASE("beside the middle of two floats, too, where t must be known to its last bit") {
    check_cases(2, beside_a_middle);
}

}  // namespace space
