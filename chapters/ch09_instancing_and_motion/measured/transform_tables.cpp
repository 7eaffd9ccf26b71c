#include "chapters/ch09_instancing_and_motion/measured/transforms.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

namespace space::ch09 {
namespace {

/// As few digits as tell: 0.42, 7.3, 120, 1,234,567.
std::string short_number(double value) {
    if (value >= 100.0) return with_commas(static_cast<std::uint64_t>(value + 0.5));
    return fixed(value, value >= 10.0 ? 0 : value >= 1.0 ? 1 : 2);
}

Table inverses_table(const std::vector<InverseError>& rows) {
    Table table(
        {"placements", "S⁻¹ (Rᵀ (q − t))", "the matrix S⁻¹ Rᵀ T⁻¹", "general inverse of T R S"});
    for (const InverseError& row : rows)
        table.row({row.placements, short_number(row.parts), short_number(row.product),
                   short_number(row.general)});
    return table;
}

Table transform_times_table(const std::vector<TransformTime>& rows) {
    Table table({"operation", "float, ns", "double, ns"});
    for (const TransformTime& row : rows)
        table.row({row.what, fixed(row.float_ns, 1), fixed(row.double_ns, 1)});
    return table;
}

Table drifts_table(const std::vector<Drift>& rows) {
    Table table({"rotations", "in float", "made orthonormal each time", "in double"});
    for (const Drift& row : rows)
        table.row({with_commas(row.turns), fmt::format("{:.1e}", row.in_float),
                   fmt::format("{:.1e}", row.made_orthonormal),
                   fmt::format("{:.1e}", row.in_double)});
    return table;
}

Table normals_table(const std::vector<StretchedNormals>& rows) {
    Table table(
        {"stretched", "M n, derived, °", "measured, °", "turned away", "inverse transpose, °"});
    for (const StretchedNormals& row : rows)
        table.row(
            {fmt::format("{} times", row.stretch), fixed(row.derived, 1), fixed(row.by_matrix, 1),
             percent(row.turned_away),
             row.by_transposed < 1e-12 ? "below 10⁻¹²" : fmt::format("{:.0e}", row.by_transposed)});
    return table;
}

Table windings_table(const std::vector<Winding>& rows) {
    Table table({"negative scales", "triangles", "wound inwards", "wrong side by n . d",
                 "with the determinant"});
    for (const Winding& row : rows)
        table.row({fmt::format("{}", row.negative), with_commas(row.triangles),
                   with_commas(row.inwards), with_commas(row.seen_wrong),
                   with_commas(row.corrected_wrong)});
    return table;
}

/// Errors up to this many units of 2^-24 are those of some roundings.
constexpr double some_roundings = 16.0;

std::string with_ratio(const TransformTime& ours, const TransformTime& general) {
    return fmt::format("{:.1f} times as fast in float, {:.1f} times in double",
                       general.float_ns / ours.float_ns, general.double_ns / ours.double_ns);
}

/// Claim O6.
ClaimAnswer answer_winding(const std::vector<Winding>& rows) {
    std::size_t agree = 0, all = 0;
    std::vector<std::string> texts;
    for (const Winding& row : rows) {
        texts.push_back(fmt::format("{} of {} triangles with {} negative scale{}",
                                    with_commas(row.inwards), with_commas(row.triangles),
                                    row.negative, row.negative == 1 ? "" : "s"));
        if (row.negative == 0) continue;
        ++all;
        agree += row.inwards == row.triangles;
    }
    return {"O6", verdict_of(agree, all),
            fmt::format("wound inwards: {}. The sign of the determinant tells: an odd number of "
                        "negative scales flips the winding, an even one is a rotation",
                        fmt::join(texts, ", ")),
            "icosphere:3",
            "confirmed if with one, two and three negative scales every triangle is wound the "
            "other way, refuted if with none of them; depends (on their number) otherwise"};
}

/// Claim O7.
ClaimAnswer answer_transposing(const TransformMeasurements& measured) {
    std::size_t agree = 0, all = 0;
    std::vector<std::string> texts;
    for (const InverseError& row : measured.inverses) {
        const double best = std::min(row.product, row.general);
        ++all;
        agree += row.product <= std::max(some_roundings, 2.0 * best);
        texts.push_back(fmt::format("{}: {} against {}", row.placements, short_number(row.product),
                                    short_number(row.general)));
    }
    Verdict verdict = verdict_of(agree, all);
    std::string times = "no times in this run";
    if (!measured.times.empty()) {
        const TransformTime &transposed = measured.times[0], &general = measured.times[1];
        times = "the transpose is " + with_ratio(transposed, general) +
                "; a ray is taken to local space by a stored matrix as fast whichever made it";
        const bool faster =
            transposed.float_ns < general.float_ns && transposed.double_ns < general.double_ns;
        if (!faster) verdict = agree == 0 ? Verdict::refuted : Verdict::depends;
    }
    return {"O7", verdict,
            fmt::format("largest error of a local point, in units of 2⁻²⁴ of the object's half "
                        "size, by S⁻¹ Rᵀ T⁻¹ against the general inverse: {}. Time of making "
                        "the matrix: {}",
                        fmt::join(texts, "; "), times),
            "random placements",
            fmt::format("confirmed if for all kinds of placements S⁻¹ Rᵀ T⁻¹ is off by at most "
                        "{:.0f} units or twice the general inverse's error, and is made in less "
                        "time; refuted if for none",
                        some_roundings)};
}

}  // namespace

void print_transforms(const TransformMeasurements& measured, bool times) {
    print_heading("Local points found again, in float: largest error, in 2⁻²⁴ of the half size");
    inverses_table(measured.inverses).print();
    if (times && !measured.times.empty()) {
        print_heading("What an inverse costs, and what a ray");
        transform_times_table(measured.times).print();
    }
    print_heading("Products of rotations: |R R^T - 1|");
    drifts_table(measured.drifts).print();
    print_heading("Normals of a stretched sphere");
    normals_table(measured.normals).print();
    print_heading("The winding of placed spheres");
    windings_table(measured.windings).print();
}

void quote_transforms(const TransformMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("inverses", inverses_table(measured.inverses));
    numbers.count_table("drift", drifts_table(measured.drifts));
    numbers.count_table("normals", normals_table(measured.normals));
    numbers.count_table("winding", windings_table(measured.windings));
    std::uint64_t seen = 0, wrong = 0;
    for (const Winding& row : measured.windings) {
        if (row.negative > 1) continue;
        seen += row.triangles;
        wrong += row.seen_wrong;
    }
    numbers.count("sides_seen", seen);
    numbers.count("sides_wrong", wrong);
    if (!times || measured.times.empty()) return;
    numbers.time_table("transform_times", transform_times_table(measured.times));
    const double gain = measured.times[1].double_ns / measured.times[0].double_ns,
                 stored = measured.times[2].double_ns / measured.times[3].double_ns;
    numbers.time("transpose_gain", gain, fixed(gain, 1));
    numbers.time("stored_gain", stored, fixed(stored, 1));
}

std::uint64_t wrong_transforms(const TransformMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const Winding& row : measured.windings) wrong += row.corrected_wrong;
    return wrong;
}

std::vector<ClaimAnswer> answer_transforms(const TransformMeasurements& measured) {
    return {answer_winding(measured.windings), answer_transposing(measured)};
}

}  // namespace space::ch09
