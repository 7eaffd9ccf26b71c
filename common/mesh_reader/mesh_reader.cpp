/// @file
/// Mesh files. CGAL's polygon-soup readers (LGPL, headers only) do the reading. Tried beside them
/// was assimp 5.2: it silently turns an index that is out of range in a PLY or OFF file into 0,
/// accepts a truncated PLY, copies the vertices of an OBJ once per corner and groups its faces by
/// material, so that neither keeps the file's order.
///
/// CGAL's readers say neither what is wrong nor where, believe any count in a header, and read some
/// lines wrongly (OBJ: tabs, indices like 1.5; STL: a NaN is merged with another vertex). Therefore
/// each format has a check that goes over the file first: after it every count fits into the file
/// and every index and coordinate is sound.
#include "common/mesh.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <boost/container/small_vector.hpp>
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>

namespace space {
namespace {

using Soup_point = CGAL::Simple_cartesian<double>::Point_3;
using Polygon = boost::container::small_vector<std::uint32_t, 4>;

/// A mesh file in memory; says what is wrong with it.
struct Source {
    std::string name;
    std::string content;
    std::vector<std::size_t> joined = {};  ///< places of line ends that a backslash took away

    [[noreturn]] void fail(const std::string& fault) const {
        throw input_error(fmt::format("{}: {}", name, fault));
    }
    /// `where` points into the content.
    [[noreturn]] void fail_at(const char* where, const std::string& fault) const {
        const auto lines = 1 + std::count(content.data(), where, '\n') +
                           std::count_if(joined.begin(), joined.end(), [&](std::size_t place) {
                               return content.data() + place < where;
                           });
        throw input_error(fmt::format("{}:{}: {}", name, lines, fault));
    }
    std::string_view view() const { return content; }
    const char* end() const { return content.data() + content.size(); }
};

constexpr std::string_view blanks = " \t\r\v\f", white_space = " \t\r\v\f\n";

/// Takes the first word off the text; empty at its end. A word shows at most this many characters
/// in a message.
std::string_view take_word(std::string_view& text, std::string_view separators = blanks) {
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(word.size());
    return word;
}

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

/// A word of the file in a message: not too long, and no control characters.
std::string quote(std::string_view word) {
    constexpr std::size_t longest = 24;
    std::string text(word.substr(0, longest));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F) c = '?';
    return fmt::format("'{}{}'", text, word.size() > longest ? "..." : "");
}

bool parse_integer(std::string_view word, std::int64_t& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size();
}

/// A coordinate must be a number that is finite as a float.
void check_coordinate(const Source& source, std::string_view word, const char* where) {
    if (word.empty()) source.fail_at(where, "a vertex needs three coordinates");
    std::string_view digits = word;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc::result_out_of_range)
        number =
            std::strtod(std::string(digits).c_str(), nullptr);  // too large: infinite; too small: 0
    else if (error != std::errc{} || end != digits.data() + digits.size())
        source.fail_at(where, fmt::format("{} is not a number", quote(word)));
    if (!std::isfinite(static_cast<float>(number)))
        source.fail_at(where, fmt::format("the coordinate {} is not a finite float", quote(word)));
}

void check_coordinates(const Source& source, std::string_view line, const char* where) {
    for (int axis = 0; axis < 3; ++axis) check_coordinate(source, take_word(line), where);
}

/// Wavefront OBJ. Brings the text into the form that the reader knows, then looks at vertices and
/// faces.
void check_obj(Source& source) {
    std::string& text = source.content;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && text.compare(i + 1, 1, "\n") == 0) {
            source.joined.push_back(i + 1);
            text[i] = text[i + 1] = ' ';
        } else if (text[i] != '\n' && blanks.find(text[i]) != std::string_view::npos) {
            text[i] = ' ';
        }
    }
    std::int64_t vertices = 0, faces = 0, largest = 0;
    const char* largest_at = nullptr;
    for (std::string_view rest = source.view(); !rest.empty();) {
        std::string_view line = take_line(rest);
        const std::string_view keyword = take_word(line);
        const char* const where = keyword.data();
        if (keyword == "v") {
            check_coordinates(source, line, where);
            ++vertices;
        } else if (keyword == "l") {
            text[static_cast<std::size_t>(where - text.data())] =
                '#';  // the reader stumbles over polylines
        } else if (keyword == "f") {
            ++faces;
            int corners = 0;
            for (std::string_view word; !(word = take_word(line)).empty() && word.front() != '#';
                 ++corners) {
                constexpr std::size_t longest_corner =
                    100;  // characters of vertex/texture/normal; the reader's limit is 256
                std::int64_t index = 0;
                if (!parse_integer(word.substr(0, word.find('/')), index) ||
                    word.size() > longest_corner)
                    source.fail_at(where, fmt::format("{} is not a corner of a face", quote(word)));
                if (index == 0) source.fail_at(where, "vertex index 0, but OBJ counts from 1");
                if (index < -vertices)
                    source.fail_at(where,
                                   fmt::format("vertex index {}, but {} vertices stand before it",
                                               index, vertices));
                if (index > largest) {
                    largest = index;
                    largest_at = where;
                }
            }
            if (corners < 3)
                source.fail_at(
                    where,
                    fmt::format("a face needs three corners or more, this one has {}", corners));
        }
    }
    if (vertices > 0 && faces == 0) source.fail("the file has no faces");
    if (largest > vertices)
        source.fail_at(largest_at, fmt::format("vertex index {}, but the file has {} vertices",
                                               largest, vertices));
}

/// Takes the next word of an OFF header; comments and line ends may stand between its words.
std::string_view take_off_word(std::string_view& rest) {
    for (;;) {
        const std::string_view word = take_word(rest, white_space);
        if (!word.starts_with('#')) return word;
        take_line(rest);
    }
}

/// The next line with something on it besides blanks and a comment; empty at the end of the file.
std::string_view take_off_line(std::string_view& rest) {
    while (!rest.empty()) {
        std::string_view line = take_line(rest);
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(blanks) != std::string_view::npos) return line;
    }
    return {};
}

void check_off(Source& source) {
    std::string_view rest = source.view();
    std::string_view kind = take_off_word(rest);
    const std::string_view whole_kind = kind;
    for (const std::string_view prefix : {"ST", "C", "N"})
        if (kind.starts_with(prefix)) kind.remove_prefix(prefix.size());
    if (kind != "OFF") {
        if (whole_kind.ends_with("OFF"))
            source.fail_at(whole_kind.data(),
                           fmt::format("{} files are not read, only OFF with three coordinates",
                                       quote(whole_kind)));
        source.fail("not an OFF file: it does not begin with OFF");
    }
    // Normals, colours and texture coordinates are read over at the ends of the lines; told of
    // colours, the reader would read past the end of a line that has none.
    std::fill_n(source.content.begin() + (whole_kind.data() - source.content.data()),
                kind.data() - whole_kind.data(), ' ');
    std::int64_t counts[3];
    constexpr const char* names[3] = {"vertices", "faces", "edges"};
    constexpr std::int64_t fewest_bytes[3] = {
        6, 6, 1};  // "0 0 0\n", "3 0 0 0": bytes that one takes at least
    for (int i = 0; i < 3; ++i) {
        const std::string_view word = take_off_word(rest);
        if (word == "BINARY")
            source.fail("binary OFF files are not read: convert it to text or to PLY");
        if (!parse_integer(word, counts[i]) || counts[i] < 0)
            source.fail_at(word.data(),
                           fmt::format("{} is not a number of {}", quote(word), names[i]));
        if (counts[i] > std::int64_t(source.content.size()) / fewest_bytes[i])
            source.fail_at(
                word.data(),
                fmt::format("the header promises {} {}, more than fit into a file of {} bytes",
                            counts[i], names[i], source.content.size()));
    }
    for (std::int64_t i = 0; i < counts[0]; ++i) {
        const std::string_view line = take_off_line(rest);
        if (line.empty())
            source.fail(fmt::format("the file ends after {} of {} vertices", i, counts[0]));
        check_coordinates(source, line, line.data());
    }
    for (std::int64_t i = 0; i < counts[1]; ++i) {
        std::string_view line = take_off_line(rest);
        const char* const where = line.data();
        if (line.empty())
            source.fail(fmt::format("the file ends after {} of {} faces", i, counts[1]));
        std::int64_t corners = 0, index = 0;
        const std::string_view word = take_word(line);
        if (!parse_integer(word, corners))
            source.fail_at(where, fmt::format("{} is not a number of corners", quote(word)));
        if (corners < 3)
            source.fail_at(
                where, fmt::format("a face needs three corners or more, this one has {}", corners));
        for (std::int64_t corner = 0; corner < corners; ++corner) {
            const std::string_view index_word = take_word(line);
            if (index_word.empty())
                source.fail_at(where,
                               fmt::format("the face has {} corners, not {}", corner, corners));
            if (!parse_integer(index_word, index))
                source.fail_at(where, fmt::format("{} is not a vertex index", quote(index_word)));
            if (index < 0 || index >= counts[0])
                source.fail_at(where, fmt::format("vertex index {}, but the file has {} vertices",
                                                  index, counts[0]));
        }
    }
}

/// Binary STL is 80 bytes of anything, the number of triangles, and 50 bytes for each.
void check_stl(Source& source) {
    constexpr std::size_t header = 84, record = 50, normal = 12;
    std::string& text = source.content;
    std::uint32_t count = 0;
    if (text.size() >= header) std::memcpy(&count, text.data() + 80, sizeof count);
    const std::uint64_t promised = header + std::uint64_t{record} * count;
    std::string_view rest = source.view();
    std::string first_word(take_word(rest, white_space));
    std::transform(first_word.begin(), first_word.end(), first_word.begin(),
                   [](char c) { return char(c | 0x20); });

    if (text.size() >= header && (text.size() == promised || first_word != "solid")) {
        if (promised > text.size())
            source.fail(fmt::format(
                "the header promises {} triangles, which take {} bytes, but the file has {}", count,
                promised, text.size()));
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < 9; ++k) {
                float coordinate;
                std::memcpy(&coordinate,
                            text.data() + header + record * i + normal + sizeof coordinate * k,
                            sizeof coordinate);
                if (!std::isfinite(coordinate))
                    source.fail(fmt::format("triangle {}: the coordinate {} is not a finite float",
                                            i, coordinate));
            }
        text.replace(0, 80, 80, '\0');  // a header that begins with "solid" would be taken for text
        return;
    }

    if (first_word != "solid")
        source.fail("not an STL file: neither its size fits, nor does it begin with 'solid'");
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c | 0x20);
    enum { outside, in_solid, in_facet } state = outside;
    int corners = 0;
    for (rest = source.view(); !rest.empty();) {
        const std::string_view word = take_word(rest, white_space);
        const char* const where = word.data();
        if (word == "solid" || word == "endsolid") {
            if (state == in_facet || (word == "solid") == (state == in_solid))
                source.fail_at(where, fmt::format("'{}' out of place", word));
            state = word == "solid" ? in_solid : outside;
            const std::string_view solid_name =
                take_line(rest);  // words of a name are not commands
            std::fill_n(text.begin() + (solid_name.data() - text.data()), solid_name.size(), ' ');
        } else if (word == "facet" || word == "endfacet") {
            if (state != (word == "facet" ? in_solid : in_facet))
                source.fail_at(where, fmt::format("'{}' out of place", word));
            if (word == "endfacet" && corners != 3)
                source.fail_at(where, fmt::format("a facet of {} vertices", corners));
            state = word == "facet" ? in_facet : in_solid;
            corners = 0;
        } else if (word == "vertex") {
            if (state != in_facet) source.fail_at(where, "'vertex' out of place");
            for (int axis = 0; axis < 3; ++axis)
                check_coordinate(source, take_word(rest, white_space), where);
            ++corners;
        }
    }
    if (state != outside) source.fail_at(source.end(), "the file ends before 'endsolid'");
}

// ---- PLY: the header says how the rest is laid out.

struct PlyType {
    std::string_view name, other_name;
    std::size_t bytes;
    double largest;  ///< as a list's length; 0 for types that cannot be one
    bool is_signed;
};
constexpr PlyType ply_types[] = {
    {"char", "int8", 1, 127, true},        {"uchar", "uint8", 1, 255, false},
    {"short", "int16", 2, 32767, true},    {"ushort", "uint16", 2, 65535, false},
    {"int", "int32", 4, 2147483647, true}, {"uint", "uint32", 4, 4294967295, false},
    {"float", "float32", 4, 0, true},      {"double", "float64", 8, 0, true}};

struct PlyProperty {
    std::string_view name;
    const PlyType* type;
    const PlyType* length = nullptr;  ///< of a list
};
struct PlyElement {
    std::string_view name;
    std::uint64_t count;
    std::vector<PlyProperty> properties = {};

    bool is_vertex() const { return name == "vertex" || name == "vertices"; }
    bool is_face() const { return name == "face" || name == "faces"; }
};

const PlyType* find_ply_type(const Source& source, std::string_view word) {
    for (const PlyType& type : ply_types)
        if (word == type.name || word == type.other_name) return &type;
    source.fail_at(word.data(), fmt::format("{} is not a type of PLY", quote(word)));
}

/// Takes the header off `rest`; what is not allowed in one fails.
std::vector<PlyElement> take_ply_header(const Source& source, std::string_view& rest,
                                        std::string_view& format) {
    std::vector<PlyElement> elements;
    for (int number = 1;; ++number) {
        if (rest.empty()) source.fail("the file ends inside the header");
        std::string_view line = take_line(rest);
        const char* const where = line.data();
        const std::string_view keyword = take_word(line);
        if (number == 1) {
            if (keyword != "ply") source.fail("not a PLY file: it does not begin with 'ply'");
        } else if (number == 2) {
            format = take_word(line);
            if (keyword != "format" ||
                (format != "ascii" && format != "binary_little_endian" &&
                 format != "binary_big_endian") ||
                take_word(line).empty())
                source.fail_at(where,
                               "the second line of a PLY file gives its format: ascii, "
                               "binary_little_endian or "
                               "binary_big_endian, and a version");
        } else if (keyword == "element") {
            const std::string_view name = take_word(line), word = take_word(line);
            std::int64_t count = 0;
            if (!parse_integer(word, count) || count < 0)
                source.fail_at(where, fmt::format("{} is not a number of elements", quote(word)));
            elements.push_back({name, static_cast<std::uint64_t>(count)});
        } else if (keyword == "property") {
            if (elements.empty()) source.fail_at(where, "a property before the first element");
            PlyProperty property{};
            std::string_view type = take_word(line);
            if (type == "list") {
                property.length = find_ply_type(source, take_word(line));
                if (property.length->largest == 0)
                    source.fail_at(where, "a list's length must be an integer");
                type = take_word(line);
            }
            property.type = find_ply_type(source, type);
            property.name = take_word(line);
            if (property.name.empty()) source.fail_at(where, "a property without a name");
            elements.back().properties.push_back(property);
        } else if (keyword == "end_header") {
            return elements;
        } else if (keyword.empty()) {
            source.fail_at(where, "an empty line in the header");
        }
    }
}

/// The reader takes vertices from properties x, y, z (float or double) and faces from a list of int
/// or uint.
void check_ply_layout(const Source& source, const std::vector<PlyElement>& elements) {
    const auto property = [](const PlyElement& element,
                             std::string_view name) -> const PlyProperty* {
        const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                        [&](const PlyProperty& each) { return each.name == name; });
        return found == element.properties.end() ? nullptr : &*found;
    };
    bool has_vertices = false, has_faces = false;
    for (const PlyElement& element : elements) {
        if (element.properties.empty() && element.count > 0)
            source.fail(fmt::format("the element {} has no properties", quote(element.name)));
        has_vertices |= element.is_vertex();
        has_faces |= element.is_face();
        if (element.is_vertex())
            for (const std::string_view axis : {"x", "y", "z"}) {
                const PlyProperty* coordinate = property(element, axis);
                if (!coordinate || coordinate->length || coordinate->type->largest != 0)
                    source.fail(fmt::format(
                        "the vertices have no property {} of type float or double", axis));
            }
        if (element.is_face()) {
            const PlyProperty* corners = property(element, "vertex_indices");
            if (!corners) corners = property(element, "vertex_index");
            if (!corners || !corners->length || corners->type->largest == 0 ||
                corners->type->bytes != 4)
                source.fail("the faces have no list of int or uint called vertex_indices");
        }
    }
    if (!has_vertices || !has_faces)
        source.fail(
            fmt::format("the header has no element '{}'", has_vertices ? "face" : "vertex"));
}

/// "face 17": which item of the file is at fault, counted from 0.
std::string item_name(const PlyElement& element, std::uint64_t item) {
    return fmt::format("{} {}", element.name, item);
}

void check_ply_binary(const Source& source, const std::vector<PlyElement>& elements,
                      std::string_view rest, bool big_endian) {
    for (const PlyElement& element : elements) {
        std::size_t fewest_bytes = 0;
        bool lists = false;
        for (const PlyProperty& property : element.properties) {
            fewest_bytes += (property.length ? property.length : property.type)->bytes;
            lists |= property.length != nullptr;
        }
        if (element.count > 0 && element.count > rest.size() / fewest_bytes)
            source.fail(
                fmt::format("the header promises {} of element '{}', more than fit into the {} "
                            "bytes that are left",
                            element.count, element.name, rest.size()));
        if (!lists) {
            rest.remove_prefix(element.count * fewest_bytes);
            continue;
        }
        for (std::uint64_t item = 0; item < element.count; ++item)
            for (const PlyProperty& property : element.properties) {
                std::uint64_t bytes = property.type->bytes;
                if (property.length) {
                    if (rest.size() < property.length->bytes)
                        source.fail(
                            fmt::format("the file ends inside {}", item_name(element, item)));
                    std::uint32_t entries = 0;
                    for (std::size_t i = 0; i < property.length->bytes; ++i)
                        entries |= std::uint32_t{static_cast<unsigned char>(rest[i])}
                                   << 8 * (big_endian ? property.length->bytes - 1 - i : i);
                    rest.remove_prefix(property.length->bytes);
                    if (entries > property.length->largest)
                        source.fail(
                            fmt::format("{}: a list of negative length", item_name(element, item)));
                    bytes *= entries;
                }
                if (rest.size() < bytes)
                    source.fail(fmt::format("{} needs {} bytes, but {} are left in the file",
                                            item_name(element, item), bytes, rest.size()));
                rest.remove_prefix(bytes);
            }
    }
}

void check_ply_text(const Source& source, const std::vector<PlyElement>& elements,
                    std::string_view rest) {
    for (const PlyElement& element : elements) {
        constexpr std::size_t fewest_bytes = 2;  // a digit and a blank
        if (element.count > rest.size() / fewest_bytes + 1)
            source.fail(
                fmt::format("the header promises {} of element '{}', more than fit into the {} "
                            "bytes that are left",
                            element.count, element.name, rest.size()));
        for (std::uint64_t item = 0; item < element.count; ++item)
            for (const PlyProperty& property : element.properties) {
                const auto next = [&] {
                    const std::string_view word = take_word(rest, white_space);
                    if (word.empty())
                        source.fail(
                            fmt::format("the file ends inside {}", item_name(element, item)));
                    return word;
                };
                std::int64_t entries = 1, number = 0;
                if (property.length) {
                    const std::string_view word = next();
                    if (!parse_integer(word, entries) || entries < 0 ||
                        double(entries) > property.length->largest ||
                        entries > std::int64_t(rest.size()))
                        source.fail_at(
                            word.data(),
                            fmt::format("{}: {} is not the length of a list that the file can hold",
                                        item_name(element, item), quote(word)));
                }
                for (std::int64_t entry = 0; entry < entries; ++entry) {
                    const std::string_view word = next();
                    if (property.type->largest == 0)
                        check_coordinate(source, word, word.data());
                    else if (!parse_integer(word, number) ||
                             double(number) > property.type->largest ||
                             double(number) <
                                 (property.type->is_signed ? -property.type->largest - 1 : 0))
                        source.fail_at(word.data(),
                                       fmt::format("{}: {} is not a {}", item_name(element, item),
                                                   quote(word), property.type->name));
                }
            }
    }
}

void check_ply(Source& source) {
    std::string_view rest = source.view(), format;
    const std::vector<PlyElement> elements = take_ply_header(source, rest, format);
    check_ply_layout(source, elements);
    if (format == "ascii")
        check_ply_text(source, elements, rest);
    else
        check_ply_binary(source, elements, rest, format == "binary_big_endian");
}

// ---- Polygons into triangles, where they stand.

/// Twice the signed area of a, b, c seen against an axis.
double turn(const Double3& a, const Double3& b, const Double3& c, int axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
}

/// Cuts a polygon into triangles. Where the first corner sees all others within a half-turn they
/// fan out from it; else ears are cut off (Meisters 1975), seen along the main axis of the
/// polygon's normal. A polygon without area, or one that crosses itself so that no ear is left, is
/// fanned: no triangle is lost.
void triangulate(const Source& source, std::size_t face, const std::vector<Point3>& vertices,
                 Polygon polygon, std::vector<std::array<std::uint32_t, 3>>& faces) {
    const auto corner = [&](std::size_t i) { return Double3(vertices[polygon[i]]); };
    const auto fan = [&] {
        for (std::size_t i = 2; i < polygon.size(); ++i)
            faces.push_back({polygon[0], polygon[i - 1], polygon[i]});
    };
    if (polygon.size() == 3) return fan();

    Double3 area{0.0};
    for (std::size_t i = 2; i < polygon.size(); ++i)
        area += glm::cross(corner(i - 1) - corner(0), corner(i) - corner(0));
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(area[other]) > std::abs(area[axis])) axis = other;
    const double sign = area[axis] < 0.0 ? -1.0 : 1.0;
    const auto left = [&](std::size_t a, std::size_t b, std::size_t c) {
        return sign * turn(corner(a), corner(b), corner(c), axis);
    };
    bool fans = true;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        fans = fans && left(0, i - 1, i) >= 0.0 && left(0, 1, i) >= 0.0;
    if (fans || area[axis] == 0.0) return fan();

    constexpr std::size_t most_corners =
        2000;  // of a polygon that needs ears: the search takes cubic time at worst
    if (polygon.size() > most_corners)
        source.fail(fmt::format("face {} is not convex and has {} corners, more than {}", face,
                                polygon.size(), most_corners));
    for (std::size_t i = 0, misses = 0; polygon.size() > 3 && misses < polygon.size();) {
        const std::size_t size = polygon.size();
        i %= size;
        const std::size_t before = (i + size - 1) % size, after = (i + 1) % size;
        bool ear = left(before, i, after) > 0.0;
        for (std::size_t j = 0; ear && j < size; ++j) {
            if (polygon[j] == polygon[before] || polygon[j] == polygon[i] ||
                polygon[j] == polygon[after])
                continue;
            ear = !(left(before, i, j) >= 0.0 && left(i, after, j) >= 0.0 &&
                    left(after, before, j) >= 0.0);
        }
        if (ear) {
            faces.push_back({polygon[before], polygon[i], polygon[after]});
            polygon.erase(polygon.begin() + std::ptrdiff_t(i));
            misses = 0;
        } else {
            ++misses;
            ++i;
        }
    }
    fan();
}

struct Format {
    std::string_view extension;
    void (*check)(Source&);
    bool (*read)(std::istream&, std::vector<Soup_point>&, std::vector<Polygon>&);
};
constexpr Format formats[] = {
    {".obj", check_obj,
     [](auto& in, auto& points, auto& polygons) {
         return CGAL::IO::read_OBJ(in, points, polygons);
     }},
    {".off", check_off,
     [](auto& in, auto& points, auto& polygons) {
         return CGAL::IO::read_OFF(in, points, polygons, CGAL::parameters::verbose(false));
     }},
    {".ply", check_ply,
     [](auto& in, auto& points, auto& polygons) {
         return CGAL::IO::read_PLY(in, points, polygons, CGAL::parameters::verbose(false));
     }},
    {".stl", check_stl,
     [](auto& in, auto& points, auto& polygons) {
         return CGAL::IO::read_STL(in, points, polygons);
     }},
};

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file) {
    Source source{file.string(), read_file(file)};
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c | 0x20) : c; });
    const auto format =
        std::find_if(std::begin(formats), std::end(formats),
                     [&](const Format& each) { return each.extension == extension; });
    if (format == std::end(formats))
        source.fail("not a mesh file: its name must end in .obj, .off, .ply or .stl");
    if (source.content.empty()) source.fail("the file is empty");
    format->check(source);

    std::vector<Soup_point> points;
    std::vector<Polygon> polygons;
    std::istringstream stream(std::move(source.content));
    bool good = false;
    try {
        good = format->read(stream, points, polygons);
    } catch (const std::exception&) {  // one of CGAL's assertions
    }
    if (!good) {
        stream.clear();
        const std::streamoff position = stream.tellg();
        source.content = std::move(stream).str();
        std::size_t reached =
            std::min(std::size_t(std::max<std::streamoff>(position, 0)), source.content.size());
        if (reached > 0 && source.content[reached - 1] == '\n')
            --reached;  // the line that the reader gave up on
        source.fail_at(source.content.data() + reached,
                       "the file cannot be read on from here: it is broken or of another kind");
    }

    TriangleMesh mesh;
    mesh.vertices.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point3 vertex{static_cast<float>(points[i].x()), static_cast<float>(points[i].y()),
                            static_cast<float>(points[i].z())};
        if (!is_finite<3>(vertex))
            source.fail(fmt::format("vertex {} ({}, {}, {}) is not finite as floats", i,
                                    points[i].x(), points[i].y(), points[i].z()));
        mesh.vertices.push_back(vertex);
    }
    if (polygons.empty()) source.fail("the file has no faces");
    mesh.faces.reserve(polygons.size());
    for (std::size_t face = 0; face < polygons.size(); ++face) {
        const Polygon& polygon = polygons[face];
        if (polygon.size() < 3)
            source.fail(fmt::format("face {} has {} corners, a face needs three or more", face,
                                    polygon.size()));
        for (const std::uint32_t index : polygon)
            if (index >= mesh.vertices.size())
                source.fail(fmt::format("face {}: vertex index {}, but the file has {} vertices",
                                        face, static_cast<std::int32_t>(index),
                                        mesh.vertices.size()));
        triangulate(source, face, mesh.vertices, polygon, mesh.faces);
    }
    return mesh;
}

}  // namespace space
