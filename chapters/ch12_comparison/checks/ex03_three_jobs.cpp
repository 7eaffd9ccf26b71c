#include "ex03_three_jobs.hpp"

#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

using namespace space;
using namespace space::ch12;

namespace {

/// What a job asks for, in the words of the measurement.
struct Work {
    std::string_view scene;
    std::uint64_t most_triangles;  ///< the largest size that has no more
    RayKind kind;
    double rays;
    double most_bytes;  ///< a triangle
};
Work work_of(Job job) {
    switch (job) {
        case Job::click:
            return {"scan", 2'000'000, RayKind::camera, 1.0, infinity};
        case Job::bake:
            return {"building", 200'000, RayKind::diffuse, 1e10, infinity};
        case Job::pocket:
            break;
    }
    return {"building", 200'000, RayKind::diffuse, 1e10, 32.0};
}

bool fits(const ComparedRow& row, const Work& work) {
    return static_cast<double>(row.bytes) <= work.most_bytes * static_cast<double>(row.triangles);
}
/// Build and rays, in milliseconds.
double cost_ms(const ComparedRow& row, const Work& work) {
    return row.ready_ms() + work.rays * row[work.kind].ns_per_ray * 1e-6;
}

const Comparison& kept() {
    static const Comparison comparison = read_comparison(kept_comparison_file());
    return comparison;
}
std::span<const ComparedRow> block_of(const Work& work) {
    std::span<const ComparedRow> largest;
    for (const auto block : blocks(kept()))
        if (block.front().scene == work.scene && block.front().triangles <= work.most_triangles &&
            (largest.empty() || block.front().triangles > largest.front().triangles))
            largest = block;
    return largest;
}

void check(Job job) {
    const Work work = work_of(job);
    const std::span<const ComparedRow> block = block_of(work);
    const std::string name(structure_for(job));
    CAPTURE(work.scene, name);
    REQUIRE_FALSE(block.empty());
    const ComparedRow* chosen = find(block, name);
    const bool is_of_this_book_and_stands = chosen && !chosen->is_peer;
    REQUIRE(is_of_this_book_and_stands);
    INFO("bytes in all: " << chosen->bytes << ", triangles: " << chosen->triangles);
    REQUIRE(fits(*chosen, work));
    double best = cost_ms(*chosen, work);
    for (const ComparedRow& row : block)
        if (row.stands() && !row.is_peer && fits(row, work))
            best = std::min(best, cost_ms(row, work));
    INFO("ms in all: yours " << cost_ms(*chosen, work) << ", the best " << best);
    REQUIRE(cost_ms(*chosen, work) <= 1.15 * best);
}

}  // namespace

TEST_CASE("one click on a mesh of a million triangles") {
    check(Job::click);
}

TEST_CASE("the light of a building, by 10^10 rays") {
    check(Job::bake);
}

TEST_CASE("the same with 32 bytes a triangle") {
    check(Job::pocket);
}
