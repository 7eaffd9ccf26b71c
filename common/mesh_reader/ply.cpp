// PLY (Turk 1994, "The PLY Polygon File Format"): the header says how the rest is laid out.
#include "common/mesh_reader/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace space::mesh_reader {
namespace {

template <class Number>
double decode(const char* bytes, bool swapped) {
    std::array<char, sizeof(Number)> own;
    std::copy_n(bytes, own.size(), own.begin());
    if (swapped) std::reverse(own.begin(), own.end());
    return static_cast<double>(std::bit_cast<Number>(own));
}

struct PlyType {
    std::string_view name, other_name;
    std::size_t bytes;
    bool is_integer;
    double (*decode)(const char* bytes, bool swapped);  ///< exact: a double holds them all
};
constexpr PlyType ply_types[] = {{"char", "int8", 1, true, decode<std::int8_t>},
                                 {"uchar", "uint8", 1, true, decode<std::uint8_t>},
                                 {"short", "int16", 2, true, decode<std::int16_t>},
                                 {"ushort", "uint16", 2, true, decode<std::uint16_t>},
                                 {"int", "int32", 4, true, decode<std::int32_t>},
                                 {"uint", "uint32", 4, true, decode<std::uint32_t>},
                                 {"float", "float32", 4, false, decode<float>},
                                 {"double", "float64", 8, false, decode<double>}};

struct PlyProperty {
    std::string_view name;
    const PlyType* type;
    const PlyType* length = nullptr;  ///< of a list
    int axis = -1;                    ///< of the coordinate that it is
    bool is_corners = false;          ///< it is the list that faces or strips are made from
};
struct PlyElement {
    std::string_view name;
    std::uint64_t count;
    std::vector<PlyProperty> properties = {};

    bool is_vertex() const { return name == "vertex" || name == "vertices"; }
    bool is_face() const { return name == "face" || name == "faces"; }
    bool is_strip() const { return name == "tristrips"; }
};
enum class Layout { none, text, little_endian, big_endian };

struct PlyHeader {
    Layout layout = Layout::none;
    std::vector<PlyElement> elements = {};
    std::uint64_t vertices = 0;
};

// ---- The header.

const PlyType* find_ply_type(const Source& source, std::string_view word, const char* where) {
    for (const PlyType& type : ply_types)
        if (word == type.name || word == type.other_name) return &type;
    source.fail_at(where, fmt::format("{} is not a type of PLY", quote(word)));
}

Layout parse_layout(const Source& source, std::string_view word, const char* where) {
    if (word == "ascii") return Layout::text;
    if (word == "binary_little_endian") return Layout::little_endian;
    if (word == "binary_big_endian") return Layout::big_endian;
    source.fail_at(where, fmt::format("{} is not a format of PLY: ascii, binary_little_endian or "
                                      "binary_big_endian",
                                      quote(word)));
}

PlyElement parse_element(const Source& source, std::string_view words) {
    const std::string_view name = take_word(words), number = take_word(words);
    std::int64_t count = 0;
    if (number.empty())
        source.fail_at(name.data(), fmt::format("the element {} has no number", quote(name)));
    if (!parse_integer(number, count) || count < 0)
        source.fail_at(name.data(), fmt::format("{} is not a number of elements", quote(number)));
    return {name, static_cast<std::uint64_t>(count)};
}

PlyProperty parse_property(const Source& source, std::string_view words, const char* where) {
    PlyProperty property{};
    std::string_view type = take_word(words);
    if (type == "list") {
        const std::string_view length = take_word(words);
        property.length = find_ply_type(source, length, where);
        if (!property.length->is_integer)
            source.fail_at(
                where, fmt::format("a list's length must be an integer, not {}", quote(length)));
        type = take_word(words);
    }
    property.type = find_ply_type(source, type, where);
    property.name = take_word(words);
    if (property.name.empty()) source.fail_at(where, "a property without a name");
    return property;
}

/// Makes the header's lines like those of other texts; in a binary file the rest stays as it is.
/// Lines end in CR alone only if the first one does: else one may be followed by a byte '\n' that
/// belongs to a number.
std::size_t normalise_header(Source& source) {
    normalise_text(source, 0, 0);
    const std::string& text = source.content;
    const std::size_t first_end = text.find_first_of("\r\n");
    const bool cr_only = first_end < text.size() && text[first_end] == '\r' &&
                         text.compare(first_end + 1, 1, "\n") != 0;
    for (std::size_t first = 0; first < text.size();) {
        const std::size_t end = std::min(text.find(cr_only ? '\r' : '\n', first), text.size());
        std::string_view words(text.data() + first, end - first);
        const std::string_view keyword = take_word(words);
        if (first == 0 && keyword != "ply")
            source.fail(
                fmt::format("not a PLY file: it begins with {}, not with 'ply'", quote(keyword)));
        first = end + 1;
        if (keyword == "end_header" && first <= text.size()) {
            for (std::size_t i = 0; i < first; ++i)
                if (text[i] == '\r') source.content[i] = cr_only ? '\n' : ' ';
            return first;
        }
    }
    source.fail("the file ends inside the header");
}

PlyHeader parse_header(const Source& source, std::string_view lines, Polygons& mesh) {
    PlyHeader header;
    for (take_line(lines); !lines.empty();) {
        std::string_view line = take_line(lines);
        const std::string_view keyword = take_word(line);
        const char* const where = keyword.data();
        if (keyword == "format") {
            header.layout = parse_layout(source, take_word(line), where);
        } else if (keyword == "element") {
            header.elements.push_back(parse_element(source, line));
        } else if (keyword == "property") {
            if (header.elements.empty())
                source.fail_at(where, "a property before the first element");
            header.elements.back().properties.push_back(parse_property(source, line, where));
        } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" &&
                   keyword != "end_header") {
            mesh.skip(source, keyword);
        }
    }
    if (header.layout == Layout::none) source.fail("the header has no line 'format'");
    return header;
}

void find_coordinates(const Source& source, PlyElement& vertices) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view name = std::string_view("xyz").substr(std::size_t(axis), 1);
        const auto coordinate =
            std::find_if(vertices.properties.begin(), vertices.properties.end(),
                         [&](const PlyProperty& each) { return each.name == name; });
        if (coordinate == vertices.properties.end() || coordinate->length)
            source.fail(fmt::format("the vertices have no property {} that is a number", name));
        coordinate->axis = axis;
    }
}

void find_corners(const Source& source, PlyElement& faces) {
    for (const std::string_view name : {"vertex_indices", "vertex_index"})
        for (PlyProperty& property : faces.properties)
            if (property.name == name && property.length && property.type->is_integer) {
                property.is_corners = true;
                return;
            }
    source.fail(fmt::format("the element {} has no list of integers called vertex_indices",
                            quote(faces.name)));
}

/// Finds what meshes are made of; all else is passed over.
void find_roles(const Source& source, PlyHeader& header) {
    bool has_vertices = false, has_faces = false;
    for (PlyElement& element : header.elements) {
        if (element.properties.empty() && element.count > 0)
            source.fail(fmt::format("the element {} has no properties", quote(element.name)));
        if (element.is_vertex()) {
            find_coordinates(source, element);
            header.vertices += element.count;
            has_vertices = true;
        } else if (element.is_face() || element.is_strip()) {
            find_corners(source, element);
            has_faces = true;
        }
    }
    if (!has_vertices || !has_faces)
        source.fail(
            fmt::format("the header has no element '{}'", has_vertices ? "face" : "vertex"));
}

// ---- The body: the same walk for text and for bytes.

struct PlyBody {
    const Source& source;
    const PlyHeader& header;
    Polygons& mesh;
    std::string_view rest;
    const PlyElement* element = nullptr;
    std::uint64_t item = 0;
    std::string inside_line = {};  ///< text: the first item that begins behind another in its line

    bool is_text() const { return header.layout == Layout::text; }
    bool begins_inside_line() const;
    std::string hint() const;
    [[noreturn]] void fail_at_end() const;
    /// "face 17": which item of the file is at fault, counted from 0.
    [[noreturn]] void fail(std::string_view raw, const std::string& fault) const;
    std::string_view take(const PlyType& type);
    void pass(const PlyType& type, std::size_t entries);
    double number(std::string_view raw, const PlyType& type) const;
    std::size_t take_length(const PlyProperty& property);
    double coordinate(std::string_view raw, const PlyType& type) const;
    std::int64_t index(std::string_view raw, const PlyType& type, double lowest) const;

    void check_promise() const;
    void read_element();
    void remark_rest() const;
    void read_item();
    void read_face(const PlyProperty& corners);
    void read_strip(const PlyProperty& corners);
};

bool PlyBody::begins_inside_line() const {
    std::size_t first = 0;
    while (first < rest.size() && is_blank(rest[first])) ++first;
    const std::string_view before(rest.data() - 1, first + 1);  // with the end of the last word
    return first < rest.size() && before.find('\n') == std::string_view::npos;
}

/// Words may run on from line to line; but if one is at fault then, lines are likely to hold more
/// or fewer of them than the header says.
std::string PlyBody::hint() const {
    if (inside_line.empty()) return "";
    return fmt::format(" ({} begins inside a line: does the header name every column?)",
                       inside_line);
}

void PlyBody::fail_at_end() const {
    source.fail(fmt::format("the file ends inside {} {}{}", element->name, item, hint()));
}

void PlyBody::fail(std::string_view raw, const std::string& fault) const {
    const std::string told = fmt::format("{} {}: {}{}", element->name, item, fault, hint());
    if (is_text()) source.fail_at(raw.data(), told);
    source.fail(told);
}

/// The next number as it stands in the file, a word or bytes.
std::string_view PlyBody::take(const PlyType& type) {
    if (is_text()) {
        const std::string_view word = take_word(rest);
        if (word.empty()) fail_at_end();
        return word;
    }
    if (rest.size() < type.bytes) fail_at_end();
    const std::string_view bytes = rest.substr(0, type.bytes);
    rest.remove_prefix(type.bytes);
    return bytes;
}

/// What is not used may be anything, NaN or no number at all.
void PlyBody::pass(const PlyType& type, std::size_t entries) {
    if (is_text())
        for (; entries > 0; --entries) take(type);
    else
        rest.remove_prefix(type.bytes * entries);
}

double PlyBody::number(std::string_view raw, const PlyType& type) const {
    if (!is_text())
        return type.decode(raw.data(), (header.layout == Layout::big_endian) !=
                                           (std::endian::native == std::endian::big));
    double value = 0.0;
    if (!parse_number(raw, value)) fail(raw, fmt::format("{} is not a number", quote(raw)));
    return value;
}

std::size_t PlyBody::take_length(const PlyProperty& property) {
    const std::string_view raw = take(*property.length);
    const double length = number(raw, *property.length);
    if (length < 0) fail(raw, fmt::format("a list of negative length, {}", length));
    // In text an entry takes a digit and a blank, which the last one may lack.
    const double bytes = is_text() ? 2 * length - 1 : length * double(property.type->bytes);
    if (!(bytes <= double(rest.size())) || length != std::floor(length))
        fail(raw, fmt::format("a list of {} does not fit into the {} bytes that are left", length,
                              rest.size()));
    return static_cast<std::size_t>(length);
}

double PlyBody::coordinate(std::string_view raw, const PlyType& type) const {
    if (is_text()) return parse_coordinate(source, raw, raw.data());
    const double value = number(raw, type);
    if (!std::isfinite(static_cast<float>(value)))
        fail(raw, fmt::format("the coordinate {} is not a finite float", value));
    return value;
}

std::int64_t PlyBody::index(std::string_view raw, const PlyType& type, double lowest) const {
    const double value = number(raw, type);
    if (!(value >= lowest && value < double(header.vertices)) || value != std::floor(value))
        fail(raw,
             fmt::format("vertex index {}, but the file has {} vertices", value, header.vertices));
    return static_cast<std::int64_t>(value);
}

void PlyBody::read_face(const PlyProperty& corners) {
    const std::size_t count = take_length(corners);
    if (count < 3) fail(rest, fmt::format("{} corners, but a face needs three or more", count));
    for (std::size_t i = 0; i < count; ++i)
        mesh.corners.push_back(
            static_cast<std::uint32_t>(index(take(*corners.type), *corners.type, 0)));
    mesh.end_face();
}

/// Each corner makes a triangle with the two before it, turned every other time; -1 starts anew.
void PlyBody::read_strip(const PlyProperty& corners) {
    const std::size_t count = take_length(corners);
    std::array<std::uint32_t, 2> before{};
    std::size_t length = 0;  // since the start
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t corner = index(take(*corners.type), *corners.type, -1);
        if (corner < 0) {
            length = 0;
            continue;
        }
        const auto last = static_cast<std::uint32_t>(corner);
        if (length >= 2) {
            const bool turned = length % 2 == 1;
            mesh.corners.insert(mesh.corners.end(), {before[turned], before[!turned], last});
            mesh.end_face();
        }
        before = {before[1], last};
        ++length;
    }
}

void PlyBody::read_item() {
    Double3 point{};
    for (const PlyProperty& property : element->properties) {
        if (property.axis >= 0)
            point[property.axis] = coordinate(take(*property.type), *property.type);
        else if (property.is_corners && element->is_face())
            read_face(property);
        else if (property.is_corners)
            read_strip(property);
        else if (property.length)
            pass(*property.type, take_length(property));
        else
            take(*property.type);
    }
    if (element->is_vertex()) mesh.points.push_back(point);
}

/// After this no count in the header can make us ask for more memory than the file has bytes.
void PlyBody::check_promise() const {
    std::size_t fewest_bytes = 0;
    for (const PlyProperty& property : element->properties)
        fewest_bytes += is_text() ? 2 : (property.length ? property.length : property.type)->bytes;
    if (element->count > 0 && element->count > (rest.size() + 1) / fewest_bytes)
        source.fail(
            fmt::format("the header promises {} of element '{}', more than fit into the {} "
                        "bytes that are left",
                        element->count, element->name, rest.size()));
}

void PlyBody::read_element() {
    for (item = 0; item < element->count; ++item) {
        if (is_text() && inside_line.empty() && begins_inside_line())
            inside_line = fmt::format("{} {}", element->name, item);
        read_item();
    }
}

/// What stands behind the last element.
void PlyBody::remark_rest() const {
    std::string_view behind = rest;
    const std::string_view word = take_word(behind);
    if (!is_text() && !rest.empty())
        mesh.remark = fmt::format("{} bytes after the last element passed over", rest.size());
    if (!is_text() || word.empty()) return;
    if (!inside_line.empty()) source.fail_at(word.data(), "numbers are left over" + hint());
    mesh.remark = fmt::format("what follows the last element passed over, from line {} on",
                              source.line_of(word.data()));
}

}  // namespace

Polygons read_ply(Source& source) {
    Polygons mesh;
    const std::size_t body_at = normalise_header(source);
    PlyHeader header = parse_header(source, source.view().substr(0, body_at), mesh);
    find_roles(source, header);
    if (header.layout == Layout::text) normalise_text(source, body_at);
    PlyBody body{source, header, mesh, source.view().substr(body_at)};
    for (const PlyElement& element : header.elements) {
        body.element = &element;
        body.check_promise();
        if (element.is_vertex()) mesh.points.reserve(element.count);
        if (element.is_face()) mesh.ends.reserve(element.count);
        body.read_element();
    }
    body.remark_rest();
    return mesh;
}

}  // namespace space::mesh_reader
