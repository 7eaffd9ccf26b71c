#include "chapters/ch02_intersection_tests/measured/outcome.hpp"
#include "chapters/ch02_intersection_tests/square_roots.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace space::ch02 {
namespace {

std::string share_of(std::uint64_t part, std::uint64_t whole) {
    return fmt::format("{:.3f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}
std::string per_million(const Wrong& wrong) {
    return with_commas(static_cast<std::uint64_t>(wrong.per_million() + 0.5));
}

/// The names of the tests that `measured` holds something about, after what stands `first`.
std::vector<std::string> test_names(const auto& measured, std::vector<std::string> first) {
    for (const auto& of_test : measured) first.emplace_back(of_test.test);
    return first;
}

Table sign_table(const SignExample& example) {
    const auto said = [](bool hit) { return hit ? "hit" : "miss"; };
    Table table({"in", "volume", "first triangle", "second triangle"});
    for (const SignRow& row : example.rows)
        table.row({row.arithmetic == "exact" ? "exact numbers" : std::string(row.arithmetic),
                   fmt::format("{:.0f}", row.volume), said(row.first), said(row.second)});
    return table;
}

}  // namespace

void print_triangles(const Measurements& measured) {
    print_heading(
        "Wrong decisions of ray-triangle tests, per million rays (filtered-exact is the truth "
        "here)");
    const auto& tests = measured.triangles.front().wrong;
    Table wrong(test_names(tests, {"input", "hits"}));
    for (const TriangleAccuracy& input : measured.triangles) {
        std::vector<std::string> cells{input.input, share_of(input.exact_hits, input.pairs)};
        for (const Wrong& test : input.wrong) cells.push_back(per_million(test));
        wrong.row(cells);
    }
    for (const Leaks& mesh : measured.leaks) {
        std::vector<std::string> cells{"leaks, " + mesh.mesh, ""};
        for (const std::uint64_t leaks : mesh.leaks)
            cells.push_back(with_commas((1'000'000 * leaks + mesh.rays / 2) / mesh.rays));
        wrong.row(cells);
    }
    wrong.print();

    print_heading("Error of t in units in the last place: median (worst)");
    Table t(test_names(tests, {"input"}));
    for (const TriangleAccuracy& input : measured.triangles)
        if (input.input == "random" || input.input == "near" || input.input == "distant" ||
            input.input == "grazing") {
            std::vector<std::string> cells{input.input};
            for (const UlpError& error : input.t)
                cells.push_back(fmt::format("{:.2f} ({:.3g})", error.median, error.worst));
            t.row(cells);
        }
    t.print();

    print_heading("Who decides in filtered-exact");
    Table stages({"input", "filter", "128-bit integers", "expansions"});
    for (const TriangleAccuracy& input : measured.triangles)
        stages.row({input.input, share_of(input.stages.count[0], input.pairs),
                    share_of(input.stages.count[1], input.pairs),
                    share_of(input.stages.count[2], input.pairs)});
    stages.print();
}

void print_signs(const Measurements& measured) {
    print_heading(
        "A volume of six-digit whole numbers: on which side of an edge does the ray pass?");
    sign_table(measured.sign_example).print();
    const LostSigns& lost = measured.signs;
    fmt::print(
        "Of {} such volumes from -100 to 100, {} have a wrong sign in float and {} in double, "
        "where the error is at most {:.0f}; {} are beyond its bound.\n",
        with_commas(lost.volumes), with_commas(lost.in_float), with_commas(lost.in_double),
        lost.worst_error, with_commas(lost.certain));
    fmt::print("The filter's bound: the largest error known is {:.3f} of it.\n",
               measured.worst_known_share);
}

void print_roots(const Measurements& measured) {
    print_heading("Square roots: worst error in units in the last place");
    Table roots({"form", "over [1, 4)", "correctly rounded", "all normal floats", "denormal"});
    for (const RootAccuracy& root : measured.roots)
        if (!root.name.starts_with("estimate"))  // other processors, other bits
            roots.row({root.name, fmt::format("{:.4g}", root.worst_binades),
                       fmt::format("{:.1f} %", 100.0 * root.correctly_rounded),
                       fmt::format("{:.4g}", root.worst_normal),
                       fmt::format("{:.4g}", root.worst_denormal)});
    roots.print();
    Table special({"root of", "Newton 3", "careful Newton 3", "reciprocal 3", "library"});
    for (const float a : {0.0f, -0.0f, 1e-40f, std::numeric_limits<float>::infinity(), -1.0f,
                          std::numeric_limits<float>::quiet_NaN()}) {
        const auto shown = [](float x) {
            return std::isnan(x) ? std::string("nan") : fmt::format("{:.4g}", x);
        };
        special.row({shown(a), shown(newton_root<3>(a)), shown(careful_newton_root<3>(a)),
                     shown(a * reciprocal_newton_root<3>(a)), shown(std::sqrt(a))});
    }
    special.print();
}

void print_boxes_and_spheres(const Measurements& measured) {
    print_heading(
        fmt::format("Boxes: {} rays of a lattice ({} hit), {} rays at corners, edges and faces ({} "
                    "hit), {} from inside",
                    with_commas(measured.lattice.pairs), with_commas(measured.lattice.exact_hits),
                    with_commas(measured.boxes.pairs), with_commas(measured.boxes.exact_hits),
                    with_commas(measured.from_inside.rays)));
    Table boxes({"test", "lattice: missed", "false hits", "corners: missed", "false hits",
                 "inside: missed"});
    for (std::size_t i = 0; i < box_tests_measured; ++i)
        boxes.row({std::string(measured.boxes.wrong[i].test),
                   with_commas(measured.lattice.wrong[i].misses),
                   with_commas(measured.lattice.wrong[i].hits),
                   with_commas(measured.boxes.wrong[i].misses),
                   with_commas(measured.boxes.wrong[i].hits),
                   with_commas(measured.from_inside.rejected[i])});
    boxes.print();
    const OrientedBoxes& oriented = measured.oriented;
    fmt::print(
        "Turned boxes by the inverse ray: {} of {} rays hit ({} wrong); {} hit the box around, {} "
        "hits are not among them.\n",
        with_commas(oriented.hits), with_commas(oriented.rays), with_commas(oriented.wrong),
        with_commas(oriented.around), with_commas(oriented.not_around));

    print_heading(
        "Spheres: wrong decisions per million; error of t in units in the last place, median "
        "(worst)");
    Table spheres(test_names(measured.spheres.front().wrong, {"distance in radii", "hits"}));
    for (const SphereAccuracy& sphere : measured.spheres) {
        std::vector<std::string> cells{with_commas(static_cast<std::uint64_t>(sphere.distance)),
                                       share_of(sphere.exact_hits, sphere.pairs)};
        for (std::size_t i = 0; i < sphere_tests_measured; ++i)
            cells.push_back(per_million(sphere.wrong[i]) +
                            (sphere.t[i].values ? fmt::format("; {:.2f} ({:.3g})",
                                                              sphere.t[i].median, sphere.t[i].worst)
                                                : ""));
        spheres.row(cells);
    }
    spheres.print();
    fmt::print(
        "From three radii away in all directions: {} of {} rays hit; as printed {}, {} of them "
        "behind the origin.\n",
        with_commas(measured.behind.exact_hits), with_commas(measured.behind.rays),
        with_commas(measured.behind.printed_hits), with_commas(measured.behind.behind));
}

void print_bounces(const Measurements& measured) {
    print_heading(fmt::format(
        "Where a secondary ray starts: {} bounces in a room of size 1, some way from the origin",
        with_commas(measured.bounces.front().bounces.bounces)));
    Table table({"from the origin", "origin", "self-hits", "touches", "leaks", "mean offset"});
    for (const PlacedBounces& row : measured.bounces)
        table.row({fmt::format("{:g}", row.place), std::string(row.way),
                   with_commas(row.bounces.self_hits), with_commas(row.bounces.touches),
                   with_commas(row.bounces.leaks), fmt::format("{:.2g}", row.bounces.offset)});
    table.print();
}

void print_times(const Measurements& measured) {
    print_heading(
        "Time of ray-triangle tests in leaves: ns, and as a multiple of moller-trumbore-float");
    Table triangles(test_names(measured.triangle_times.front().tests, {"scene"}));
    for (const SceneTimes& scene : measured.triangle_times) {
        std::vector<std::string> cells{scene.scene};
        for (const Timed& timed : scene.tests)
            cells.push_back(
                fmt::format("{:.1f} ({:.2f})", timed.ns, relative_time(scene, timed.test)));
        triangles.row(cells);
    }
    triangles.print();
    Table roots({"square root", "ns"});
    for (const TimedRoot& timed : measured.root_times)
        roots.row({timed.test, fmt::format("{:.2f}", timed.ns)});
    roots.print();
    Table boxes(test_names(measured.pattern_times.front().boxes, {"boxes"}));
    for (const PatternTimes& times : measured.pattern_times) {
        std::vector<std::string> cells{std::string(name(times.pattern))};
        for (const Timed& timed : times.boxes) cells.push_back(fmt::format("{:.2f}", timed.ns));
        boxes.row(cells);
    }
    boxes.print();
    Table others({"spheres and planes", "ns"});
    for (const std::vector<Timed>& times : {measured.sphere_times, measured.plane_times})
        for (const Timed& timed : times) others.row({timed.test, fmt::format("{:.2f}", timed.ns)});
    others.print();
}

namespace {

double ratio(std::uint64_t part, std::uint64_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}
const auto& by_name(const auto& all, std::string_view name, auto member) {
    for (const auto& one : all)
        if (one.*member == name) return one;
    throw std::out_of_range(fmt::format("no {} was measured", name));
}

constexpr std::array in_float{"moller-trumbore-float", "lichter-first", "lichter-improved",
                              "unit-triangle",         "plucker",       "watertight"};

void quote_triangles(const Measurements& measured, Numbers& numbers) {
    const auto wrong = [&](const char* input, std::string_view test) {
        const auto& of_input = by_name(measured.triangles, input, &TriangleAccuracy::input);
        return by_name(of_input.wrong, test, &Wrong::test).per_million() / 1e6;
    };
    std::uint64_t at_random = 0;
    for (const Wrong& test : by_name(measured.triangles, "random", &TriangleAccuracy::input).wrong)
        at_random += test.hits + test.misses;
    numbers.count("random_wrong", at_random);
    double edges_least = 1.0, vertices_least = 1.0, vertices_most = 0.0;
    for (const char* test : in_float) {
        edges_least = std::min(edges_least, wrong("edges", test));
        vertices_least = std::min(vertices_least, wrong("vertices", test));
        vertices_most = std::max(vertices_most, wrong("vertices", test));
    }
    numbers.count("edges_float_least", edges_least, percent(edges_least));
    numbers.count("vertices_float_least", vertices_least, percent(vertices_least));
    numbers.count("vertices_float_most", vertices_most, percent(vertices_most));
    const double edges = wrong("edges", "moller-trumbore"),
                 vertices = wrong("vertices", "moller-trumbore"),
                 watertight = wrong("vertices", "watertight");
    numbers.count("edges_double", 1e6 * edges, fixed(1e6 * edges, 0));
    numbers.count("vertices_double", vertices, percent(vertices));
    numbers.count("vertices_watertight", watertight, percent(watertight));

    const auto& random = by_name(measured.triangles, "random", &TriangleAccuracy::input);
    const auto& near = by_name(measured.triangles, "near", &TriangleAccuracy::input);
    double least = 1e9, most = 0.0, worst_double = 0.0, near_worst = 1e99;
    for (std::size_t i = 0; i < random.wrong.size(); ++i) {
        const bool of_float = std::ranges::count(in_float, random.wrong[i].test) > 0;
        if (!of_float) worst_double = std::max({worst_double, random.t[i].worst, near.t[i].worst});
        if (!of_float) continue;
        least = std::min(least, random.t[i].median);
        most = std::max(most, random.t[i].median);
        near_worst = std::min(near_worst, near.t[i].worst);
    }
    numbers.count("t_float_least", least, fixed(least, 1));
    numbers.count("t_float_most", most, fixed(most, 1));
    numbers.count("t_double_worst", worst_double, fixed(worst_double, 2));
    numbers.count("t_near_worst", near_worst, power_of_ten(near_worst));
    const StageCounts& stages = random.stages;
    numbers.count("random_beyond_filter", stages.count[1] + stages.count[2]);
}

void quote_signs(const Measurements& measured, Numbers& numbers) {
    const SignExample& example = measured.sign_example;
    numbers.count_table("sign_example", sign_table(example));
    numbers.count("sign_bound", example.bound, with_commas(std::uint64_t(example.bound)));
    const LostSigns& lost = measured.signs;
    numbers.count("volumes", lost.volumes);
    numbers.count("signs_float", ratio(lost.in_float, lost.volumes),
                  percent(ratio(lost.in_float, lost.volumes)));
    numbers.count("signs_double", ratio(lost.in_double, lost.volumes),
                  percent(ratio(lost.in_double, lost.volumes)));
    numbers.count("signs_certain", lost.certain);
    numbers.count("signs_worst_error", lost.worst_error, fixed(lost.worst_error, 0));
    numbers.count("worst_known_share", measured.worst_known_share,
                  fixed(measured.worst_known_share, 2));
    numbers.count("input_rays", measured.triangles.front().pairs);
    const auto decided = [&](const char* input, std::size_t stage) {
        const auto& of_input = by_name(measured.triangles, input, &TriangleAccuracy::input);
        return ratio(of_input.stages.count[stage], of_input.pairs);
    };
    numbers.count("vertices_by_integers", decided("vertices", 1), percent(decided("vertices", 1)));
    numbers.count("uneven_by_expansions", decided("uneven", 2), percent(decided("uneven", 2)));
}

void quote_roots(const Measurements& measured, Numbers& numbers) {
    for (const int rounds : {2, 3, 4}) {
        const RootAccuracy& root =
            by_name(measured.roots, fmt::format("Newton {}", rounds), &RootAccuracy::name);
        const std::string name = fmt::format("newton{}", rounds);
        numbers.count(name, root.worst_binades, fmt::format("{:.3g}", root.worst_binades));
        numbers.count(name + "_rounded", root.correctly_rounded, percent(root.correctly_rounded));
    }
    const double library = by_name(measured.roots, "library", &RootAccuracy::name).worst_binades;
    numbers.count("library_root", library, fixed(library, 2));
}

void quote_boxes_and_spheres(const Measurements& measured, Numbers& numbers) {
    const Wrong& lattice = by_name(measured.lattice.wrong, "reciprocal", &Wrong::test);
    numbers.count("lattice_hits", measured.lattice.exact_hits);
    numbers.count("lattice_missed", lattice.misses);
    numbers.count("lattice_false", lattice.hits);
    for (const char* test : {"branching", "reciprocal", "conservative"}) {
        const Wrong& box = by_name(measured.boxes.wrong, test, &Wrong::test);
        const double missed = ratio(box.misses, measured.boxes.exact_hits);
        numbers.count(std::string("boxes_") + test, missed,
                      box.misses == 0 ? "none" : one_in(missed));
    }
    const OrientedBoxes& oriented = measured.oriented;
    const double spared = 1.0 - ratio(oriented.hits - oriented.not_around, oriented.around);
    numbers.count("turned_box_spares", spared, percent(spared));
    for (const SphereAccuracy& sphere : measured.spheres)
        for (const Wrong& wrong : sphere.wrong) {
            if (wrong.test == "as printed") continue;
            const double share = 1e-6 * wrong.per_million();
            const std::string name = fmt::format("sphere_{}_{:.0f}", wrong.test, sphere.distance);
            numbers.count(name, share, share == 0.0 ? "none" : one_in(share));
            numbers.count(name + "_per_million", wrong.per_million(),
                          fixed(wrong.per_million(), 0));
        }
}

void quote_bounces(const Measurements& measured, Numbers& numbers) {
    numbers.count("bounces", measured.bounces.front().bounces.bounces);
    std::uint64_t derived_wrong = 0, derived_touches = 0;
    for (const PlacedBounces& placed : measured.bounces) {
        const Bounces& found = placed.bounces;
        const std::string place = fmt::format("_{:g}", placed.place);
        const double self = ratio(found.self_hits, found.bounces);
        if (placed.way == "o + t d") numbers.count("plain_self" + place, self, percent(self));
        if (placed.way == "o + t d, 1e-4 along the ray") {
            numbers.count("epsilon_self" + place, self, percent(self));
            numbers.count("epsilon_self_hits" + place, found.self_hits);
            numbers.count("epsilon_leaks" + place, found.leaks);
        }
        if (placed.way != "moved by 4 e m along the normal") continue;
        derived_wrong += found.self_hits + found.leaks;
        derived_touches = std::max(derived_touches, found.touches);
        numbers.count("derived_offset" + place, found.offset, fmt::format("{:.2g}", found.offset));
    }
    numbers.count("derived_wrong", derived_wrong);
    numbers.count("derived_touches", derived_touches);
}

void quote_times(const Measurements& measured, Numbers& numbers) {
    std::vector<double> exact, moller_trumbore;
    for (const SceneTimes& scene : measured.triangle_times) {
        exact.push_back(ns_of(scene.tests, "filtered-exact"));
        moller_trumbore.push_back(ns_of(scene.tests, "moller-trumbore"));
    }
    if (exact.empty()) return;
    const double cost = median(exact) / median(moller_trumbore);
    numbers.time("exact_cost", cost, fixed(cost, 2));
    const double expansions = ns_of(measured.stage_times, "expansions only") /
                              ns_of(measured.stage_times, "filter first");
    numbers.time("expansions_cost", expansions, fixed(expansions, 0));
}

}  // namespace

Numbers quoted(const Measurements& measured) {
    Numbers numbers;
    quote_triangles(measured, numbers);
    quote_signs(measured, numbers);
    quote_roots(measured, numbers);
    quote_boxes_and_spheres(measured, numbers);
    quote_bounces(measured, numbers);
    quote_times(measured, numbers);
    return numbers;
}

}  // namespace space::ch02
