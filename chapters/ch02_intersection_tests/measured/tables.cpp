#include "chapters/ch02_intersection_tests/measured/tables.hpp"

#include "chapters/ch02_intersection_tests/square_roots.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace space::ch02 {
namespace {

std::string percent(std::uint64_t part, std::uint64_t whole) {
    return fmt::format("{:.3f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}
std::string per_million(const Wrong& wrong) {
    return with_commas(static_cast<std::uint64_t>(wrong.per_million() + 0.5));
}

std::vector<std::string> test_names(const auto& tests, std::vector<std::string> first) {
    for_each_named(tests, [&](std::size_t, const auto& named) { first.emplace_back(named.name); });
    return first;
}

}  // namespace

void print_triangles(const Measurements& measured) {
    print_heading(
        "Wrong decisions of ray-triangle tests, per million rays (filtered-exact is the truth "
        "here)");
    Table wrong(test_names(triangle_tests, {"input", "hits"}));
    for (const TriangleAccuracy& input : measured.triangles) {
        std::vector<std::string> cells{input.input, percent(input.exact_hits, input.pairs)};
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

    print_heading("Error of t in units in the last place: mean (worst)");
    Table t(test_names(triangle_tests, {"input"}));
    for (const TriangleAccuracy& input : measured.triangles)
        if (input.input == "random" || input.input == "near" || input.input == "distant" ||
            input.input == "grazing") {
            std::vector<std::string> cells{input.input};
            for (const UlpError& error : input.t)
                cells.push_back(fmt::format("{:.2f} ({:.3g})", error.mean(), error.worst));
            t.row(cells);
        }
    t.print();

    print_heading("Who decides in filtered-exact");
    Table stages({"input", "filter", "128-bit integers", "expansions"});
    for (const TriangleAccuracy& input : measured.triangles)
        stages.row({input.input, percent(input.stages.count[0], input.pairs),
                    percent(input.stages.count[1], input.pairs),
                    percent(input.stages.count[2], input.pairs)});
    stages.print();
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
    for (const float a :
         {0.0f, -0.0f, 1e-40f, infinity, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
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
    for (std::size_t i = 0; i < box_test_count; ++i)
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
        "Spheres: wrong decisions per million; error of t in units in the last place, mean "
        "(worst)");
    Table spheres(test_names(sphere_tests, {"distance in radii", "hits"}));
    for (const SphereAccuracy& sphere : measured.spheres) {
        std::vector<std::string> cells{with_commas(static_cast<std::uint64_t>(sphere.distance)),
                                       percent(sphere.exact_hits, sphere.pairs)};
        for (std::size_t i = 0; i < sphere_test_count; ++i)
            cells.push_back(per_million(sphere.wrong[i]) +
                            (sphere.t[i].values ? fmt::format("; {:.2f} ({:.3g})",
                                                              sphere.t[i].mean(), sphere.t[i].worst)
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
    Table triangles(test_names(triangle_tests, {"scene"}));
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
    Table boxes(test_names(box_tests, {"boxes"}));
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

}  // namespace space::ch02
