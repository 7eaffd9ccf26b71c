#include "chapters/ch05_lazy_kd_trees/measured/outcome.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::ch05 {

std::optional<PublishedRow> published(const ViewPoint& point) {
    const std::string_view scene = point.is_plants() ? "plants" : "killeroos";
    for (const PublishedRow& row : published_rows)
        if (row.scene == scene && row.view == point.view) return row;
    return std::nullopt;
}

namespace {

/// Enough digits for small shares: "0.0035 %".
std::string share_of(double share) {
    return share > 0.0 && share < 0.001 ? fmt::format("{:.4f} %", 100.0 * share) : percent(share);
}
std::string megabytes(double bytes) {
    return fixed(1e-6 * bytes, bytes < 1e8 ? 1 : 0);
}

// --- Johnston06's table ---

Table views_table(const std::vector<ViewPoint>& views) {
    Table table({"scene", "view", "triangles", "nodes, eager", "lazy, one by one", "share",
                 "in the report", "lazy"});
    for (const ViewPoint& p : views) {
        const std::optional<PublishedRow> row = published(p);
        table.row({p.scene, p.view, with_commas(p.triangles), with_commas(p.eager.nodes),
                   with_commas(p.nodes_singly), share_of(p.node_share()),
                   row ? share_of(row->node_share()) : "empty", with_commas(p.lazy.nodes)});
    }
    return table;
}

/// What rays do in both trees.
Table view_tests_table(const std::vector<ViewPoint>& views) {
    Table table(
        {"scene", "view", "tests per pixel, eager", "lazy", "hits, eager", "lazy", "other pixels"});
    for (const ViewPoint& p : views) {
        const auto per_pixel = [&](const Drawn& drawn) {
            return fixed(double(drawn.tests) / double(p.rays), 2);
        };
        table.row({p.scene, p.view, per_pixel(p.eager), per_pixel(p.lazy),
                   with_commas(p.eager.hits), with_commas(p.lazy.hits),
                   with_commas(p.other_pixels)});
    }
    return table;
}

Table view_times_table(const std::vector<ViewPoint>& views) {
    Table table({"scene", "view", "build, eager, ms", "lazy", "share", "in the report",
                 "total, eager, ms", "lazy", "share", "in the report"});
    for (const ViewPoint& p : views) {
        const std::optional<PublishedRow> row = published(p);
        table.row({p.scene, p.view, fixed(p.eager.build_ms, 1), fixed(p.lazy.build_ms, 1),
                   percent(p.build_share()), row ? percent(row->build_share()) : "empty",
                   fixed(p.eager.total_ms, 1), fixed(p.lazy.total_ms, 1), percent(p.total_share()),
                   row ? percent(row->total_share()) : "empty"});
    }
    return table;
}

/// What the report's own numbers say of one node.
Table published_table() {
    Table table({"scene", "view", "nodes, eager", "lazy", "share", "µs for a node, in the build",
                 "among rays"});
    for (const PublishedRow& row : published_rows)
        table.row({std::string(row.scene), std::string(row.view),
                   with_commas(std::uint64_t(row.eager_nodes)),
                   with_commas(std::uint64_t(row.lazy_nodes)), share_of(row.node_share()),
                   fixed(row.eager_node_us(), 1),
                   row.lazy_nodes > 1e4 ? fixed(row.lazy_node_us(), 1) : ""});
    return table;
}

// --- how much rays reach ---

Table reach_table(const std::vector<ReachPoint>& reach, bool times) {
    std::vector<std::string> headings{"rays to", "rays", "nodes made", "of all"};
    if (times) headings.insert(headings.end(), {"eager, ms", "lazy, ms", "share"});
    Table table(headings);
    for (const ReachPoint& p : reach) {
        std::vector<std::string> row{p.is_everything() ? "all triangles, all nodes made"
                                     : p.share == 0.0  ? "no triangle"
                                                       : share_of(p.share) + " of the triangles",
                                     with_commas(p.rays), with_commas(p.nodes),
                                     share_of(p.node_share())};
        if (times)
            row.insert(row.end(),
                       {fixed(p.eager_ms, 1), fixed(p.lazy_ms, 1), percent(p.time_share())});
        table.row(row);
    }
    return table;
}

Table memory_table(const std::vector<MemoryPoint>& memory) {
    Table table({"part of the picture", "eager, MB", "lazy, MB", "share"});
    for (std::size_t i = 0; i < memory.size(); i += 4)
        table.row({percent(memory[i].picture), megabytes(double(memory[i].eager_bytes)),
                   megabytes(double(memory[i].lazy_bytes)),
                   percent(double(memory[i].lazy_bytes) / double(memory[i].eager_bytes))});
    return table;
}

// --- lists ---

Table lists_table(const std::vector<ListPoint>& lists, bool times) {
    std::vector<std::string> headings{"triangles", "named in leaves", "rays", "other answers"};
    if (times)
        headings.insert(headings.end(),
                        {"in leaf order, ns a ray", "one list, ns", "scattered, ns", "ratio"});
    Table table(headings);
    for (const ListPoint& p : lists) {
        std::vector<std::string> row{with_commas(p.triangles), with_commas(p.references),
                                     with_commas(p.rays), with_commas(p.different)};
        if (times)
            row.insert(row.end(),
                       {fixed(p.placed_ns, 0), fixed(p.listed_ns, 0), fixed(p.scattered_ns, 0),
                        fixed(p.scattered_ns / p.placed_ns, 2)});
        table.row(row);
    }
    return table;
}

// --- lazy geometry ---

Table geometry_table(const std::vector<GeometryPoint>& geometry, bool times) {
    std::vector<std::string> headings{"scene",     "view",         "triangles",    "made",
                                      "share",     "patches made", "nodes",        "MB held",
                                      "MB if all", "hits",         "other answers"};
    if (times) headings.insert(headings.end(), {"build, ms", "total, ms"});
    Table table(headings);
    for (const GeometryPoint& p : geometry) {
        std::vector<std::string> row{p.source,
                                     p.view,
                                     with_commas(p.triangles),
                                     with_commas(p.made_triangles),
                                     share_of(double(p.made_triangles) / double(p.triangles)),
                                     with_commas(p.made_patches) + " of " + with_commas(p.patches),
                                     with_commas(p.nodes),
                                     megabytes(double(p.bytes)),
                                     megabytes(p.bytes_if_all),
                                     with_commas(p.hits),
                                     p.different ? with_commas(*p.different) : "not asked"};
        if (times) row.insert(row.end(), {fixed(p.build_ms, 1), fixed(p.total_ms, 1)});
        table.row(row);
    }
    return table;
}

Table first_pictures_table(const std::vector<FirstPicture>& pictures, bool times) {
    std::vector<std::string> headings{"way",  "levels", "triangles made",
                                      "rays", "other",  "mean error of t"};
    if (times) headings.push_back("ms");
    Table table(headings);
    for (const FirstPicture& p : pictures) {
        std::vector<std::string> row{p.way,
                                     with_commas(p.levels),
                                     with_commas(p.triangles),
                                     with_commas(p.rays),
                                     with_commas(p.missed),
                                     p.error > 0.0 ? fmt::format("{:.1e}", p.error) : "none"};
        if (times) row.push_back(fixed(p.ms, 1));
        table.row(row);
    }
    return table;
}

}  // namespace

void print_views(const std::vector<ViewPoint>& views, bool times) {
    print_heading("Johnston06's table, with other scenes: nodes and tests");
    views_table(views).print();
    view_tests_table(views).print();
    if (!times) return;
    print_heading("and times, on one thread");
    view_times_table(views).print();
}
void print_reach(const std::vector<ReachPoint>& reach, bool times) {
    print_heading("Rays to growing parts of a field of plants");
    reach_table(reach, times).print();
}
void print_memory(const std::vector<MemoryPoint>& memory) {
    print_heading("What is held while a picture is drawn");
    memory_table(memory).print();
}
void print_lists(const std::vector<ListPoint>& lists, bool times) {
    print_heading("One tree, and three places for what its leaves name");
    lists_table(lists, times).print();
}
void print_geometry(const std::vector<GeometryPoint>& geometry, bool times) {
    print_heading("Triangles that are made where rays go");
    geometry_table(geometry, times).print();
}
void print_first_pictures(const std::vector<FirstPicture>& pictures, bool times) {
    print_heading("To the first picture of a bumpy ball: coarser, or lazy");
    first_pictures_table(pictures, times).print();
}

namespace {

void quote_views(const std::vector<ViewPoint>& views, bool all, bool times, Numbers& numbers) {
    if (all) {
        numbers.count_table("views", views_table(views));
        numbers.count_table("view_tests", view_tests_table(views));
    }
    numbers.count_table("published", published_table());
    for (const ViewPoint& p : views) {
        std::string name = p.scene + "_" + p.view;
        std::ranges::replace(name, ' ', '_');
        std::ranges::replace(name, '-', '_');
        numbers.count(name + "_nodes", p.nodes_singly);
        numbers.count(name + "_share", p.node_share(), share_of(p.node_share()));
        if (!times) continue;
        numbers.time(name + "_build", p.build_share(), percent(p.build_share()));
        numbers.time(name + "_total", p.total_share(), percent(p.total_share()));
    }
    const PublishedRow& plants = published_rows.back();
    numbers.count("plants_node_built", plants.eager_node_us(), fixed(plants.eager_node_us(), 1));
    numbers.count("plants_node_lazy", plants.lazy_node_us(), fixed(plants.lazy_node_us(), 1));
    const PublishedRow& first = published_rows.front();
    numbers.count("killeroos_node_built", first.eager_node_us(), fixed(first.eager_node_us(), 1));
    numbers.count("killeroos_node_lazy", first.lazy_node_us(), fixed(first.lazy_node_us(), 1));
    numbers.count("ninety_seven", published_rows[1].node_share(),
                  share_of(published_rows[1].node_share()));
    if (times) numbers.time_table("view_times", view_times_table(views));
}

}  // namespace

Numbers quoted(const Measurements& measured, bool all, bool times) {
    Numbers numbers;
    quote_views(measured.views, all, times, numbers);
    numbers.count_table("reach", reach_table(measured.reach, false));
    numbers.count_table("memory", memory_table(measured.memory));
    if (!all) return numbers;
    numbers.count_table("lists", lists_table(measured.lists, false));
    numbers.count_table("geometry", geometry_table(measured.geometry, false));
    numbers.count_table("first_pictures", first_pictures_table(measured.first_pictures, false));
    if (!times) return numbers;
    numbers.time_table("reach_times", reach_table(measured.reach, true));
    numbers.time_table("lists_times", lists_table(measured.lists, true));
    numbers.time_table("geometry_times", geometry_table(measured.geometry, true));
    const ReachPoint& everything = measured.reach.back();
    numbers.time("everything", everything.time_share(), fixed(everything.time_share(), 2));
    const ListPoint& large = measured.lists.back();
    numbers.time("scattered", large.scattered_ns / large.placed_ns,
                 fixed(large.scattered_ns / large.placed_ns, 1));
    return numbers;
}

}  // namespace space::ch05
