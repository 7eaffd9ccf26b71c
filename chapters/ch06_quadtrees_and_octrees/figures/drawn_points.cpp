#include "chapters/ch06_quadtrees_and_octrees/figures/drawn_points.hpp"

#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"
#include "common/program/tree_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace space::ch06 {
namespace {

const OrthtreeFrame<2> frame{.corner = Double2(0.0), .edge = 16.0};

std::string name_of(std::uint32_t index) {
    return std::string(1, static_cast<char>('A' + index));
}

/// A node's way from the root, by the numbers of children.
std::string path_of(const OrthtreeCell<2>& cell) {
    std::string path;
    for (std::uint32_t depth = 1; depth <= cell.depth; ++depth)
        path += static_cast<char>('0' + cell.ancestor(depth).orthant());
    return path;
}

/// The builder's account: each node when it has got its children.
struct Watcher {
    std::vector<OrthtreeCell<2>> cells = {};
    void observe(const LinearOrthtree<2>::Made& event) { cells.push_back(event.cell); }
};

class Stage {
  public:
    using Node = LinearOrthtree<2>::Node;
    explicit Stage(const PointScene& scene) : points_(scene.points), config_(scene.config) {
        tree_ = OrthtreePoints<2>::build(points_, frame, config_, watcher_);
        std::vector<std::vector<std::size_t>> children(nodes().size());
        for (std::size_t i = 0; i < nodes().size(); ++i)
            for (std::size_t k = 0; k < tree_.cells.children(nodes()[i]).size(); ++k)
                children[i].push_back(nodes()[i].children + k);
        layout_ = tree_layout(children);
        paper_ = TreePaper(layout_, {366, 36}, {306, 252});
        write_script();
    }
    void draw(Svg& svg) const {
        draw_cells(svg);
        draw_points(svg);
        draw_tree(svg);
        draw_order(svg);
    }
    std::string tells() const { return tells_.back(); }

  private:
    const std::vector<Node>& nodes() const { return tree_.cells.nodes; }
    const OrthtreeCell<2>& cell(std::size_t node) const { return watcher_.cells[node]; }
    std::string set_of(const Node& node) const {
        std::string text;
        for (std::uint32_t i = node.first; i < node.last; ++i)
            text += (text.empty() ? "" : ", ") + name_of(tree_.index(i));
        return text;
    }
    void write_script();
    /// In which step a node is there: the one after its parent's turn.
    int step_of(std::size_t node) const { return since_[node]; }
    int last_step() const { return static_cast<int>(tells_.size()) - 1; }

    void draw_cells(Svg& svg) const;
    void draw_points(Svg& svg) const;
    Point2 name_place(std::uint32_t i) const;
    void draw_tree(Svg& svg) const;
    void draw_node(Svg& svg, std::size_t node, Ink ink) const;
    void draw_order(Svg& svg) const;
    Point2 place(std::size_t node) const { return paper_(layout_[node]); }
    std::string told_cut(std::size_t node) const;
    std::string told_boundary() const;

    const std::vector<Point2>& points_;
    LinearOrthtreeConfig config_;
    Watcher watcher_;
    OrthtreePoints<2> tree_;
    std::vector<Double2> layout_;
    TreePaper paper_{0, 0};
    std::vector<std::string> tells_;
    std::vector<std::size_t> turns_;  ///< the node that a step cuts, from step 1 on
    std::vector<int> since_, cut_;    ///< by node: the step in which it appears, and is cut
    PlaneView view_ = points_view();
};

/// Of the first point on one of the root's lines.
std::string Stage::told_boundary() const {
    for (std::uint32_t i = 0; i < points_.size(); ++i)
        if (const Double2 p(points_[i]); p.x == 8.0 || p.y == 8.0)
            return fmt::format("{} lies on a boundary: it belongs to the upper side, cell {}.",
                               name_of(i), frame.cell_of(points_[i], 1).orthant());
    return {};
}

std::string Stage::told_cut(std::size_t i) const {
    const Node& node = nodes()[i];
    std::string text = i == 0 ? "The root has" : "Cell " + path_of(cell(i)) + " has", empty;
    text +=
        config_.leaf_size == 1
            ? fmt::format(" {} points, more than one, and is cut. ", node.size())
            : fmt::format(" {} points, more than {}, and is cut. ", node.size(), config_.leaf_size);
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (const Node* child = tree_.cells.child(node, k))
            text += fmt::format("{} gets {}. ", k, set_of(*child));
        else
            empty += (empty.empty() ? "" : " and ") + std::to_string(k);
    }
    if (!empty.empty()) text += "Nothing is in " + empty + ", so there is no node. ";
    return text;
}

void Stage::write_script() {
    tells_.push_back(fmt::format(
        "{} points in a square, the root's cell. Below: the points in the order of their codes, "
        "which are sorted first. The digits are children's numbers, from the root down.",
        points_.size()));
    since_.assign(nodes().size(), 0);
    cut_.assign(nodes().size(), -1);
    std::size_t leaves = 0, empties = 0, largest = 0;
    for (std::size_t i = 0; i < nodes().size(); ++i) {
        const Node& node = nodes()[i];
        if (node.is_leaf()) {
            ++leaves;
            largest = std::max<std::size_t>(largest, node.size());
            continue;
        }
        const auto children = tree_.cells.children(node).size();
        empties += 4 - children;
        const int step = static_cast<int>(tells_.size());
        cut_[i] = step;
        turns_.push_back(i);
        for (std::size_t k = 0; k < children; ++k) since_[node.children + k] = step;
        tells_.push_back(told_cut(i) + (i == 0 ? told_boundary() : ""));
    }
    if (nodes().empty())
        return tells_.push_back("Done: where there is no point, there is no node.");
    tells_.push_back(fmt::format(
        "Done: {} cells are cut, {} are leaves with {}, {} are empty. Depth d = {}, so "
        "(d + 1) n = {}; there are {} cells in all.",
        nodes().size() - leaves, leaves,
        largest == 1 ? "a point" : fmt::format("up to {} points", largest), empties,
        tree_.cells.depth, (tree_.cells.depth + 1) * points_.size(), nodes().size() + empties));
}

/// The cell in hand, its points' cells, and the lines of all cells that are cut.
void Stage::draw_cells(Svg& svg) const {
    const auto steps = tells_.size();
    for (std::size_t k = 0; k < steps; ++k) {
        svg.begin_step_alone(k, steps, tells_[k]);
        if (k > 0 && k + 1 < steps) {
            const std::size_t turn = turns_[k - 1];
            svg.polygon(view_(corners_of(frame.box(cell(turn)))),
                        {.stroke = {}, .fill = Ink::green, .opacity = 0.2});
        }
        svg.end_group();
    }
    svg.rect(view_({0, 16}), at(336, 336), {.stroke = Ink::quiet});
    for (std::size_t i = 0; i < nodes().size(); ++i) {
        if (cut_[i] < 0) continue;
        const OrthtreeBox<2> box = frame.box(cell(i));
        const Double2 middle = box.centre();
        const auto cross = [&](Ink ink) {
            svg.line(view_({middle.x, box.min.y}), view_({middle.x, box.max.y}), {.stroke = ink});
            svg.line(view_({box.min.x, middle.y}), view_({box.max.x, middle.y}), {.stroke = ink});
        };
        svg.begin_step(cut_[i], cut_[i]);
        cross(Ink::green);
        for (std::uint32_t k = 0; k < 4 && cell(i).depth < 2; ++k) {  // where there is room
            const OrthtreeBox<2> child = frame.box(cell(i).child(k));
            const double in = 0.5 / double(1u << cell(i).depth) + 0.25;
            const Double2 corner = (k & 1u) != 0 ? Double2(child.max.x - in, child.max.y - in)
                                                 : Double2(child.min.x + in, child.max.y - in);
            svg.text(moved(view_(corner), 0, 7), std::to_string(k),
                     {.ink = Ink::green, .size = 18, .bold = true, .halo = true});
        }
        svg.end_group();
        svg.begin_step(cut_[i] + 1);
        cross(Ink::blue);
        svg.end_group();
    }
}

void Stage::draw_points(Svg& svg) const {
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        const Point2 p = view_(Double2(points_[i]));
        svg.circle(p, 5, {.stroke = Ink::paper, .fill = Ink::ink});
        svg.text(name_place(i), "*" + name_of(i) + "*", {.size = 20, .halo = true});
    }
}

/// Beside its point, where no other one is in the way, if there is such a side.
Point2 Stage::name_place(std::uint32_t i) const {
    const Point2 p = view_(Double2(points_[i]));
    for (const Double2& side :
         {Double2(13, -5), Double2(-13, -5), Double2(13, 19), Double2(-13, 19)}) {
        const Point2 place = moved(p, side.x, side.y), middle = moved(place, 0, -6);
        if (!std::ranges::any_of(points_, [&](const Point2& point) {
                const Point2 other = view_(Double2(point));
                return other != p && glm::length(other - middle) < 14.0f;
            }))
            return place;
    }
    return moved(p, 13, -5);
}

void Stage::draw_node(Svg& svg, std::size_t i, Ink ink) const {
    const Node& node = nodes()[i];
    const Style style{.stroke = ink, .fill = Ink::paper};
    if (node.is_leaf()) {
        std::string names;
        for (std::uint32_t k = node.first; k < node.last; ++k)
            names += "*" + name_of(tree_.index(k)) + "*";
        const double needed = std::max(13.0, 8.0 * node.size()),
                     half = std::min(paper_.shrunk(needed), 0.5 * paper_.slot - 1);
        svg.rect(moved(place(i), -half, paper_.shrunk(-13)), at(2 * half, paper_.shrunk(26)),
                 style);
        svg.text(moved(place(i), 0, paper_.shrunk(7)), names,
                 {.ink = ink, .size = 20 * half / needed});
    } else {
        svg.circle(place(i), paper_.shrunk(18), style);
        const std::string path = path_of(cell(i));
        svg.text(moved(place(i), 0, paper_.shrunk(6)), i == 0 ? "root" : path,
                 {.ink = ink,
                  .size = paper_.shrunk(i == 0 ? 16 : std::min(18.0, 48.0 / double(path.size())))});
    }
}

/// A node that will be cut shows how many points it has until then.
void Stage::draw_tree(Svg& svg) const {
    for (std::size_t i = 0; i < nodes().size(); ++i)
        for (std::size_t k = 0; k < tree_.cells.children(nodes()[i]).size(); ++k) {
            const std::size_t child = nodes()[i].children + k;
            svg.begin_step(since_[child], since_[child]);
            svg.line(place(i), place(child), {.stroke = Ink::green});
            svg.end_group();
            svg.begin_step(since_[child] + 1);
            svg.line(place(i), place(child), {.stroke = Ink::quiet});
            svg.end_group();
        }
    for (std::size_t i = 0; i < nodes().size(); ++i) {
        const int first = since_[i], cut = cut_[i];
        if (cut < 0) {
            svg.begin_step(first);
            draw_node(svg, i, Ink::ink);
            svg.end_group();
            continue;
        }
        svg.begin_step(first, cut - 1);
        svg.circle(place(i), paper_.shrunk(18), {.stroke = Ink::orange, .fill = Ink::paper});
        svg.text(moved(place(i), 0, paper_.shrunk(7)), std::to_string(nodes()[i].size()),
                 {.size = paper_.shrunk(20)});
        svg.end_group();
        svg.begin_step(cut, cut);
        draw_node(svg, i, Ink::green);
        svg.end_group();
        svg.begin_step(cut + 1);
        draw_node(svg, i, Ink::ink);
        svg.end_group();
    }
}

/// The points as the sort has left them: what a cell holds stands side by side.
void Stage::draw_order(Svg& svg) const {
    constexpr double y = 366;
    const double width = std::min(70.0, 630.0 / std::max(double(points_.size()), 1.0)),
                 digits = 10.0 * double(tree_.cells.depth);  // how wide a code is
    const auto steps = tells_.size();
    for (std::size_t k = 1; k + 1 < steps; ++k) {
        const Node& node = nodes()[turns_[k - 1]];
        svg.begin_step_alone(k, steps);
        svg.rect(at(24 + width * node.first, y), at(width * node.size(), 62),
                 {.stroke = Ink::green, .fill = Ink::green, .opacity = 0.2});
        for (const Node& child : tree_.cells.children(node))
            if (child.first > node.first)
                svg.line(at(24 + width * child.first, y), at(24 + width * child.first, y + 62),
                         {.stroke = Ink::green});
        svg.end_group();
    }
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        const double x = 24 + width * (i + 0.5);
        svg.text(at(x, y + 25), "*" + name_of(tree_.index(i)) + "*", {.size = 20});
        const OrthtreeCell<2> at_depth = frame.cell_of(tree_.point(i), tree_.cells.depth);
        svg.text(at(x, y + 50), path_of(at_depth),
                 {.size = 18 * std::min(1.0, (width - 10) / std::max(digits, 1.0))});
    }
}

}  // namespace

PlaneView points_view() {
    return {.corner = {8, 10}, .scale = 21, .size = 16};
}

DrawnPoints drawn_points(const PointScene& scene) {
    const Stage stage(scene);
    const std::size_t size = scene.points.size();
    Svg svg(fmt::format("{} points and the quadtree that the builder makes of them, step by step",
                        size == 9 ? "Nine" : std::to_string(size)),
            676, 438);
    stage.draw(svg);
    return {.drawing = std::move(svg), .tells = stage.tells()};
}

}  // namespace space::ch06
