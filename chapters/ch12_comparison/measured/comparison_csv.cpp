#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>

namespace space::ch12 {
namespace {

constexpr std::string_view whole_block = "# whole: ";
constexpr std::string_view columns =
    "scene,spec,triangles,structure,home,is_peer,build_threads,build_ms,made_later,bytes,nodes,"
    "references,depth,sah_cost,"
    "camera_ns,camera_nodes,camera_tests,camera_rays,camera_wrong,"
    "shadow_ns,shadow_nodes,shadow_tests,shadow_rays,shadow_wrong,"
    "diffuse_ns,diffuse_nodes,diffuse_tests,diffuse_rays,diffuse_wrong,"
    "any_ns,any_nodes,any_tests,any_rays,any_wrong,gave_up";

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

std::string cell(double value) {
    return std::isnan(value) ? "" : fmt::format("{}", value);
}

std::string line_of(const ComparedRow& row) {
    std::string made;
    for (const auto& [rays, ms] : row.made_later)
        made += fmt::format("{}{}:{}", made.empty() ? "" : ";", rays, ms);
    std::string line = fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{}", row.scene, row.spec, row.triangles,
        row.structure, row.home, row.is_peer ? 1 : 0, row.build_threads, cell(row.build_ms), made,
        row.bytes, cell(row.nodes), row.references, cell(row.depth), cell(row.sah_cost));
    for (const TracedKind& kind : row.traced)
        line += fmt::format(",{},{},{},{},{}", cell(kind.ns_per_ray), cell(kind.nodes_per_ray),
                            cell(kind.tests_per_ray), kind.rays, kind.wrong);
    std::string why = row.gave_up;
    std::ranges::replace(why, '\n', ' ');
    return line + ',' + why + '\n';
}

/// The cells of a line, one after the other. What is wrong is thrown as a word for it.
class Cells {
  public:
    explicit Cells(std::string_view line) : rest_(line) {}

    std::string_view text() {
        const std::size_t comma = rest_.find(',');
        if (comma == std::string_view::npos) throw input_error("too few cells");
        const std::string_view cell = rest_.substr(0, comma);
        rest_.remove_prefix(comma + 1);
        return cell;
    }
    /// The last one, which may hold commas.
    std::string_view rest() const { return rest_; }
    std::uint64_t whole() { return number<std::uint64_t>(text()); }
    double real() {
        const std::string_view cell = text();
        return cell.empty() ? unknown : number<double>(cell);
    }
    template <class Number>
    static Number number(std::string_view cell) {
        Number value{};
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        bool sound = error == std::errc{} && end == cell.data() + cell.size();
        if constexpr (std::is_same_v<Number, double>)
            sound = sound && std::isfinite(value) && value >= 0.0;
        if (!sound) throw input_error(fmt::format("'{}' is no number that can be here", cell));
        return value;
    }

  private:
    std::string_view rest_;
};

std::vector<NodesMade> made_of(std::string_view cell) {
    std::vector<NodesMade> made;
    while (!cell.empty()) {
        const std::string_view part = cell.substr(0, cell.find(';'));
        const std::size_t colon = part.find(':');
        if (colon == std::string_view::npos)
            throw input_error(fmt::format("'{}' is no RAYS:MILLISECONDS", part));
        made.push_back({Cells::number<double>(part.substr(0, colon)),
                        Cells::number<double>(part.substr(colon + 1))});
        cell.remove_prefix(std::min(cell.size(), part.size() + 1));
    }
    return made;
}

ComparedRow row_of(std::string_view line) {
    Cells cells(line);
    ComparedRow row;
    row.scene = cells.text();
    row.spec = cells.text();
    row.triangles = cells.whole();
    row.structure = cells.text();
    row.home = cells.text();
    row.is_peer = cells.whole() != 0;
    row.build_threads = static_cast<unsigned>(cells.whole());
    row.build_ms = cells.real();
    row.made_later = made_of(cells.text());
    row.bytes = cells.whole();
    row.nodes = cells.real();
    row.references = cells.whole();
    row.depth = cells.real();
    row.sah_cost = cells.real();
    for (TracedKind& kind : row.traced) {
        kind.ns_per_ray = cells.real();
        kind.nodes_per_ray = cells.real();
        kind.tests_per_ray = cells.real();
        kind.rays = cells.whole();
        kind.wrong = cells.whole();
    }
    row.gave_up = cells.rest();
    return row;
}

/// "# machine: ..." into the field that it names.
void read_remark(std::string_view line, Comparison& comparison) {
    for (const auto& [name, field] :
         {std::pair<std::string_view, std::string*>{"# machine: ", &comparison.machine},
          {"# date: ", &comparison.date},
          {"# sources: ", &comparison.sources},
          {"# settings: ", &comparison.settings}})
        if (line.starts_with(name)) *field = line.substr(name.size());
    constexpr std::string_view minutes = "# minutes: ";
    if (line.starts_with(minutes))
        comparison.minutes = Cells::number<double>(line.substr(minutes.size()));
}

/// What can be read up to the first line that is broken.
struct ReadFile {
    Comparison comparison;
    std::size_t whole_rows = 0;   ///< up to the last line that says so
    std::size_t lines_after = 0;  ///< behind that
    std::string fault;            ///< "FILE:LINE: what is wrong", or empty
};

ReadFile read_lines(const std::filesystem::path& csv) {
    const std::string text = read_file(csv);
    ReadFile read;
    std::vector<ComparedRow>& rows = read.comparison.rows;
    std::size_t number = 0;
    bool has_columns = false;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        ++number;
        ++read.lines_after;
        if (!read.fault.empty()) continue;  // they are counted
        try {
            if (end == std::string_view::npos) throw input_error("the line has no end");
            if (line.starts_with(whole_block)) {
                if (rows.size() == read.whole_rows ||
                    line.substr(whole_block.size()) != rows.back().spec)
                    throw input_error("the rows before it are of another scene");
                read.whole_rows = rows.size();
                read.lines_after = 0;
            } else if (line.starts_with('#'))
                read_remark(line, read.comparison);
            else if (!has_columns) {
                if (line != columns) throw input_error("these are not a comparison's columns");
                has_columns = true;
            } else
                rows.push_back(row_of(line));
        } catch (const Error& error) {
            read.fault = fmt::format("{}:{}: {}", csv.string(), number, error.what());
        }
    }
    if (read.fault.empty() && !has_columns)
        read.fault = fmt::format("{}: holds no comparison", csv.string());
    return read;
}

}  // namespace

bool TracedKind::operator==(const TracedKind& other) const {
    return same(ns_per_ray, other.ns_per_ray) && same(nodes_per_ray, other.nodes_per_ray) &&
           same(tests_per_ray, other.tests_per_ray) && rays == other.rays && wrong == other.wrong;
}

bool ComparedRow::operator==(const ComparedRow& other) const {
    return line_of(*this) == line_of(other);
}

double ComparedRow::mean_ns() const {
    double sum = 0.0, kinds = 0.0;
    for (const TracedKind& kind : traced) {
        if (kind.rays == 0) continue;
        sum += kind.ns_per_ray;
        ++kinds;
    }
    return sum / kinds;
}

std::uint64_t ComparedRow::rays() const {
    std::uint64_t sum = 0;
    for (const TracedKind& kind : traced) sum += kind.rays;
    return sum;
}

std::uint64_t ComparedRow::wrong() const {
    std::uint64_t sum = 0;
    for (const TracedKind& kind : traced) sum += kind.wrong;
    return sum;
}

std::vector<std::span<const ComparedRow>> blocks(const Comparison& comparison) {
    std::vector<std::span<const ComparedRow>> all;
    const std::span<const ComparedRow> rows = comparison.rows;
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        while (last < rows.size() && rows[last].spec == rows[first].spec) ++last;
        all.push_back(rows.subspan(first, last - first));
        first = last;
    }
    return all;
}

const ComparedRow* find(std::span<const ComparedRow> block, std::string_view structure) {
    const auto found = std::ranges::find(block, structure, &ComparedRow::structure);
    return found == block.end() || !found->stands() ? nullptr : &*found;
}

std::string csv_text(const Comparison& comparison) {
    std::string text = fmt::format(
        "# Chapter 12: each structure on each scene. Builds by the real clock; rays "
        "by one thread's processor time\n# machine: {}\n# date: {}\n# sources: {}\n# settings: "
        "{}\n# minutes: {:.2f}\n{}\n",
        comparison.machine, comparison.date, comparison.sources, comparison.settings,
        comparison.minutes, columns);
    for (const auto block : blocks(comparison)) {
        for (const ComparedRow& row : block) text += line_of(row);
        text += fmt::format("{}{}\n", whole_block, block.front().spec);
    }
    return text;
}

Comparison read_comparison(const std::filesystem::path& csv) {
    ReadFile read = read_lines(csv);
    if (!read.fault.empty()) throw input_error(read.fault);
    if (read.lines_after > 0)
        throw input_error(fmt::format("{}: its last block is not whole", csv.string()));
    return std::move(read.comparison);
}

Comparison read_whole_blocks(const std::filesystem::path& csv, std::size_t& dropped) {
    ReadFile read = read_lines(csv);
    read.comparison.rows.resize(read.whole_rows);
    dropped = read.whole_rows == 0 && read.fault.empty() ? 0 : read.lines_after;
    return std::move(read.comparison);
}

std::filesystem::path kept_comparison_file() {
    return book_root() / "figures/measured/ch12_comparison.csv";
}

}  // namespace space::ch12
