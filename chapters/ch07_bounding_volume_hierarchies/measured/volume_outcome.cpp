#include "chapters/ch07_bounding_volume_hierarchies/measured/volumes.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace space::ch07 {
namespace {

/// More than this many times the tightest volume's surface is loose.
constexpr double loose = 2.0;

/// All scenes with parts of one size as one; for no size, all sizes.
std::vector<VolumePoint> by_kind(const std::vector<VolumePoint>& points, std::string_view scene,
                                 std::uint64_t part_size) {
    std::vector<VolumePoint> sums;
    for (const VolumePoint& p : points) {
        if ((!scene.empty() && p.scene != scene) || (part_size != 0 && p.part_size != part_size))
            continue;
        auto sum = std::ranges::find(sums, p.kind, &VolumePoint::kind);
        if (sum == sums.end()) sum = sums.insert(sum, VolumePoint{.scene = {}, .kind = p.kind});
        const double before = double(sum->parts), now = double(p.parts), all = before + now;
        sum->chance = (before * sum->chance + now * p.chance) / all;
        sum->least_chance = (before * sum->least_chance + now * p.least_chance) / all;
        sum->parts += p.parts;
        sum->rays += p.rays;
        sum->met += p.met;
        sum->hits += p.hits;
        sum->twice += p.twice;
    }
    return sums;
}
std::vector<std::string> scenes_of(const std::vector<VolumePoint>& points) {
    std::vector<std::string> scenes;
    for (const VolumePoint& p : points)
        if (std::ranges::count(scenes, p.scene) == 0) scenes.push_back(p.scene);
    return scenes;
}
const VolumePoint& of_kind(const std::vector<VolumePoint>& points, std::string_view kind) {
    return *std::ranges::find(points, kind, &VolumePoint::kind);
}

/// Surfaces beside that of the tightest volume of each part.
Table looseness_table(const std::vector<VolumePoint>& points) {
    Table table({"scene", "triangles of a part", "parts", "box", "sphere, Ritter's", "smallest",
                 "oriented box, principal", "tight", "14-DOP", "18-DOP", "26-DOP"});
    for (const VolumePoint& p : points) {
        if (p.kind != box_kind) continue;
        std::vector<std::string> row{p.scene, fmt::format("{} or less", p.part_size),
                                     with_commas(p.parts)};
        for (const VolumePoint& q : points)
            if (q.scene == p.scene && q.part_size == p.part_size)
                row.push_back(fmt::format("{:.2f}", q.looseness()));
        table.row(row);
    }
    return table;
}

/// Surfaces and rays beside the smallest sphere's, over all scenes.
Table rays_table(const std::vector<VolumePoint>& points) {
    Table table({"volume", "surface", "rays that meet it", "of them hit nothing: parts of 4",
                 "of 64", "of 1,024"});
    const auto sums = by_kind(points, "", 0);
    const double by_sphere = double(of_kind(sums, sphere_kind).met);
    for (const VolumePoint& sum : sums) {
        std::vector<std::string> row{std::string(sum.kind), fmt::format("{:.3f}", sum.chance),
                                     fmt::format("{:.3f}", double(sum.met) / by_sphere)};
        for (const std::uint64_t size : {4u, 64u, 1024u}) {
            const auto of_size = by_kind(points, "", size);
            row.push_back(of_size.empty() ? "" : percent(of_kind(of_size, sum.kind).empty_share()));
        }
        table.row(row);
    }
    return table;
}

/// Where a tighter volume costs more per test and is met less often, what is in it must cost so
/// much that both come to the same.
Table tests_table(const VolumeMeasurements& measured) {
    Table table({"volume", "bytes", "ns per test", "met", "pays from, ns"});
    const VolumeTest& box = *std::ranges::find(measured.tests, box_kind, &VolumeTest::kind);
    for (const VolumeTest& test : measured.tests) {
        const bool tighter = test.chance < box.chance && test.kind != box_kind;
        const double from = (test.ns - box.ns) / (box.chance - test.chance);
        table.row({std::string(test.kind), with_commas(test.bytes), fmt::format("{:.1f}", test.ns),
                   fmt::format("{:.3f}", test.chance),
                   tighter ? fmt::format("{:.0f}", std::max(from, 0.0)) : "never"});
    }
    return table;
}

Table needles_table(const std::vector<NeedlePoint>& needles) {
    Table table({"thickness", "surface of the box", "of the oriented box", "ratio"});
    for (const NeedlePoint& p : needles)
        table.row({fmt::format("{}", p.thickness), fmt::format("{:.4f}", p.box),
                   fmt::format("{:.4f}", p.oriented), fmt::format("{:.1f}", p.box / p.oriented)});
    return table;
}

ClaimAnswer answer_oriented(const VolumeMeasurements& measured) {
    double most = 0.0;
    std::string where;
    std::uint64_t twice = 0, parts = 0;
    for (const VolumePoint& p : measured.points) {
        if (p.kind != box_kind) continue;
        for (const VolumePoint& q : measured.points)
            if (q.kind == tight_kind && q.scene == p.scene && q.part_size == p.part_size &&
                p.chance / q.chance > most) {
                most = p.chance / q.chance;
                where = fmt::format("parts of at most {} triangles of {}", p.part_size, p.scene);
            }
        twice += p.twice;
        parts += p.parts;
    }
    const NeedlePoint& thin = measured.needles.back();
    return {
        "H11",
        thin.box < loose * thin.oriented ? Verdict::refuted
        : 100 * twice >= parts           ? Verdict::confirmed
                                         : Verdict::depends,
        fmt::format("at least twice the surface around {} of {} parts of all scenes; on average "
                    "{:.1f} times around {}. Around a needle of thickness {} along (1, 1, 1) "
                    "{:.0f} times: there is no bound",
                    twice, parts, most, where, thin.thickness, thin.box / thin.oriented),
        joined(scenes_of(measured.points)),
        "confirmed if the axis-aligned box of the needle, and of at least one part of scenes in a "
        "hundred, has at least twice the surface of the oriented one; refuted if not even the "
        "needle's has"};
}

ClaimAnswer answer_empty_space(const VolumeMeasurements& measured) {
    std::vector<std::string> texts;
    std::size_t agree = 0, all = 0;
    for (const std::string_view kind : {sphere_kind, box_kind}) {
        std::size_t tight = 0, scenes = 0;
        double most = 0.0;
        for (const std::string& scene : scenes_of(measured.points)) {
            const auto sums = by_kind(measured.points, scene, 0);
            const double looseness = of_kind(sums, kind).looseness();
            ++scenes;
            tight += looseness <= loose;
            most = std::max(most, looseness);
        }
        const auto sums = by_kind(measured.points, "", 0);
        texts.push_back(
            fmt::format("{}: {} of {} scenes, up to {:.1f} times, and {} of its rays hit "
                        "nothing ({} of the tight oriented box's)",
                        kind, tight, scenes, most, percent(of_kind(sums, kind).empty_share()),
                        percent(of_kind(sums, tight_kind).empty_share())));
        agree += tight;
        all += scenes;
    }
    return {
        "H12", verdict_of(agree, all),
        fmt::format("at most twice the surface of the tightest of eight volumes: {}",
                    fmt::join(texts, "; ")),
        joined(scenes_of(measured.points)),
        "confirmed if around the parts of every scene both smallest spheres and boxes have, on "
        "average, at most twice the surface of the tightest of eight volumes; refuted if around "
        "those of none"};
}

}  // namespace

void print_volumes(const VolumeMeasurements& measured, bool times) {
    print_heading("Volumes around parts of scenes: surface beside the tightest one's");
    looseness_table(measured.points).print();
    print_heading("Surfaces, and random lines that meet the volume, beside the smallest sphere's");
    rays_table(measured.points).print();
    print_heading("A needle along (1, 1, 1)");
    needles_table(measured.needles).print();
    if (!times || measured.tests.empty()) return;
    print_heading("A ray against a volume");
    tests_table(measured).print();
}

std::vector<ClaimAnswer> answer_volumes(const VolumeMeasurements& measured) {
    return {answer_oriented(measured), answer_empty_space(measured)};
}

void quote_volumes(const VolumeMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("volumes", looseness_table(measured.points));
    numbers.count_table("volume_rays", rays_table(measured.points));
    numbers.count_table("needles", needles_table(measured.needles));
    const auto sums = by_kind(measured.points, "", 0);
    const auto share = [&](const char* name, double value) {
        numbers.count(name, value, percent(value));
    };
    const auto ratio = [&](const char* name, double value) {
        numbers.count(name, value, fmt::format("{:.2f}", value));
    };
    share("volume_box_empty", of_kind(sums, box_kind).empty_share());
    share("volume_sphere_empty", of_kind(sums, sphere_kind).empty_share());
    share("volume_tight_empty", of_kind(sums, tight_kind).empty_share());
    ratio("volume_box_looseness", of_kind(sums, box_kind).looseness());
    ratio("volume_sphere_looseness", of_kind(sums, sphere_kind).looseness());
    ratio("volume_ritter_excess",
          of_kind(sums, ritter_kind).chance / of_kind(sums, sphere_kind).chance);
    ratio("volume_principal_excess",
          of_kind(sums, principal_kind).chance / of_kind(sums, tight_kind).chance);
    numbers.count("volume_box_twice", of_kind(sums, box_kind).twice);
    numbers.count("volume_parts", of_kind(sums, box_kind).parts);
    if (times && !measured.tests.empty()) numbers.time_table("volume_tests", tests_table(measured));
}

}  // namespace space::ch07
