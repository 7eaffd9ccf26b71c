// Nodes and a block of triangles in memory, to scale: what the compiler says of
// the types.

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch10_fast_traversal/compressed_node.hpp"
#include "chapters/ch10_fast_traversal/compressed_tree.hpp"
#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/triangle_block.hpp"
#include "chapters/ch10_fast_traversal/wide_node.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace space::ch10 {
namespace {

constexpr std::size_t line_bytes = 64;

/// Some bytes of a type: what is in them.
struct Field {
    std::string name;
    std::size_t bytes;
    Ink ink;
};

/// Bytes in rows of a cache line, to scale.
class MemoryPaper {
  public:
    explicit MemoryPaper(Svg& svg) : svg_(svg) {}

    void draw(const std::string& title, std::size_t bytes, const std::vector<Field>& fields) {
        const std::size_t lines = (bytes + line_bytes - 1) / line_bytes;
        svg_.text(at(left, top_ + 18), title, {.anchor = Anchor::start, .size = 18});
        svg_.text(at(left + width, top_ + 18),
                  fmt::format("{} bytes, {} {}", bytes, lines, lines == 1 ? "line" : "lines"),
                  {.anchor = Anchor::end, .size = 18});
        top_ += 26;
        std::size_t from = 0;
        for (const Field& field : fields) draw_field(from, field), from += field.bytes;
        for (std::size_t i = 0; i < lines; ++i)
            svg_.rect(at(left, top_ + row * static_cast<double>(i)), at(width, row - 4),
                      {.stroke = Ink::ink});
        top_ += row * static_cast<double>(lines) + 12;
    }
    static constexpr double left = 20, width = 620, row = 30;

  private:
    /// In pieces, where it goes on in the next line.
    void draw_field(std::size_t from, const Field& field) {
        for (std::size_t begin = from, end = from + field.bytes; begin < end;) {
            const std::size_t next = std::min(end, (begin / line_bytes + 1) * line_bytes);
            const double x = left + width * double(begin % line_bytes) / double(line_bytes),
                         y = top_ + row * double(begin / line_bytes),
                         wide = width * double(next - begin) / double(line_bytes);
            svg_.rect(at(x, y), at(wide, row - 4),
                      {.stroke = Ink::quiet, .fill = field.ink, .opacity = 0.3});
            if (begin == from) svg_.text(at(x + wide / 2, y + 19), field.name, {.size = 16});
            begin = next;
        }
    }

    Svg& svg_;
    double top_ = 4;
};

template <int N>
std::vector<Field> fields_of(const WideNode<N>& node) {
    std::vector<Field> fields;
    for (std::size_t i = 0; i < node.planes.size(); ++i)
        fields.push_back({fmt::format("{} {}", i < 3 ? "lower" : "upper", "xyz"[i % 3]),
                          sizeof node.planes[i], i < 3 ? Ink::blue : Ink::green});
    fields.push_back({"children", sizeof node.children, Ink::orange});
    const std::size_t used = sizeof node.planes + sizeof node.children;
    if (used < sizeof node) fields.push_back({"", sizeof node - used, Ink::paper});
    return fields;
}

std::vector<Field> compressed_fields() {
    const CompressedNode node{};
    std::vector<Field> fields{{"origin", sizeof node.origin, Ink::sky},
                              {"", sizeof node.exponents + sizeof node.count, Ink::sky}};
    for (std::size_t i = 0; i < node.planes.size(); ++i)
        fields.push_back({fmt::format("{} {}", i < 3 ? "lower" : "upper", "xyz"[i % 3]),
                          sizeof node.planes[i], i < 3 ? Ink::blue : Ink::green});
    fields.push_back({"children", sizeof node.children, Ink::orange});
    return fields;
}

}  // namespace

Svg fig_10_08(const Options&) {
    Svg svg("Nodes and a block of four triangles in memory, to scale, in cache lines", 660, 626);
    MemoryPaper paper(svg);
    std::vector<Field> pair;
    for (int i = 0; i < 2; ++i) {
        pair.push_back({"lower", sizeof(Point3), Ink::blue});
        pair.push_back({"upper", sizeof(Point3), Ink::green});
        pair.push_back({"child", sizeof BvhNode<3>::first + sizeof BvhNode<3>::count, Ink::orange});
    }
    paper.draw("two siblings of a binary tree", 2 * sizeof(BvhNode<3>), pair);
    paper.draw("a node with four children", sizeof(WideNode<4>), fields_of(WideNode<4>{}));
    paper.draw("a node with eight children", sizeof(WideNode<8>), fields_of(WideNode<8>{}));
    paper.draw("the same, compressed", sizeof(CompressedNode), compressed_fields());
    std::vector<Field> block;
    for (std::size_t i = 0; i < 9; ++i)
        block.push_back({fmt::format("{} {}", "abc"[i / 3], "xyz"[i % 3]),
                         sizeof TriangleBlock::corners / 9, Ink::purple});
    block.push_back({"indices", sizeof TriangleBlock::indices, Ink::orange});
    paper.draw("a block of four triangles", sizeof(TriangleBlock), block);
    std::vector<Field> named;
    for (int i = 0; i < 4; ++i) {
        named.push_back({"corners", sizeof IndexedTriangle::corners, Ink::purple});
        named.push_back({"", sizeof IndexedTriangle::word, Ink::orange});
    }
    paper.draw("four triangles that name their corners", 4 * sizeof(IndexedTriangle), named);
    return svg;
}

}  // namespace space::ch10
