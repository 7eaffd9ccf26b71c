// STL, text or binary: triangles without shared vertices.
#include "common/mesh_reader/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <unordered_map>

namespace space::mesh_reader {
namespace {

/// Gives equal points one index, that of the first.
class Welder {
  public:
    void add(Polygons& mesh, const Double3& point) {
        const Double3 key = point + 0.0;  // -0 equals 0
        const auto [place, is_new] =
            indices_.try_emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back(point);
        mesh.corners.push_back(place->second);
    }

  private:
    struct Hash {
        std::size_t operator()(const Double3& p) const {
            std::uint64_t hash = 0;
            for (int axis = 0; axis < 3; ++axis)
                hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(p[axis])) *
                       0x9E3779B97F4A7C15u;  // 2^64 / golden ratio (Knuth, TAOCP 3, 6.4)
            return hash ^ hash >> 32;
        }
    };
    std::unordered_map<Double3, std::uint32_t, Hash> indices_;
};

// ---- Binary: 80 bytes of anything, the number of triangles, and for each its normal, three
// corners and the number of its attribute bytes: 50 bytes.

constexpr std::size_t count_at = 80, header = 84, record = 50, normal = 12, attribute_at = 48;

template <class Number>
Number number_at(const std::string& bytes, std::size_t place) {
    Number number;
    std::memcpy(&number, bytes.data() + place, sizeof number);
    return number;
}

/// The contents decide, since binary files may begin with "solid" too. Where text would go on stand
/// the count, whose highest byte is 0 below 2^24 triangles (0.8 GB), and the first normal; no text
/// holds such bytes.
bool is_binary(const Source& source) {
    const std::string_view bytes = source.view();
    const std::string_view count =
        bytes.size() < header ? bytes : bytes.substr(count_at, header - count_at + normal);
    return std::any_of(count.begin(), count.end(),
                       [](char c) { return is_blank(c) && c != ' ' && (c < '\t' || c > '\r'); });
}

/// Where the last triangle ends if each is followed by as many bytes as its attribute says; nothing
/// if the file is too short for that.
std::optional<std::size_t> end_with_attributes(const std::string& bytes, std::uint32_t count) {
    std::size_t end = header;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (bytes.size() - end < record) return std::nullopt;
        const std::size_t payload = number_at<std::uint16_t>(bytes, end + attribute_at);
        end += record;
        if (bytes.size() - end < payload) return std::nullopt;
        end += payload;
    }
    return end;
}

/// Most writers give no attributes or keep a colour in their number, and some leave bytes after the
/// last triangle; a few honour the number. The size tells which.
bool has_attribute_bytes(const Source& source, std::uint32_t count, std::size_t promised) {
    const std::string& bytes = source.content;
    if (promised == bytes.size()) return false;
    const std::optional<std::size_t> end = end_with_attributes(bytes, count);
    if (!end || *end == promised) return false;
    if (*end != bytes.size())
        source.fail(fmt::format(
            "{} triangles take {} bytes, or {} with their attributes, but the file has {}", count,
            promised, *end, bytes.size()));
    return true;
}

Polygons read_binary(const Source& source) {
    const std::string& bytes = source.content;
    if (bytes.size() < header)
        source.fail(fmt::format("not an STL file: binary, but {} bytes are no header of {}",
                                bytes.size(), header));
    const auto count = number_at<std::uint32_t>(bytes, count_at);
    const std::size_t promised = header + record * count;
    if (promised > bytes.size())
        source.fail(fmt::format(
            "the header promises {} triangles, which take {} bytes, but the file has {}", count,
            promised, bytes.size()));
    const bool attributes = has_attribute_bytes(source, count, promised);
    Polygons mesh;
    Welder welder;
    std::size_t place = header;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            using Point = std::array<float, 3>;
            const auto point = number_at<Point>(bytes, place + normal + sizeof(Point) * corner);
            for (const float coordinate : point)
                if (!std::isfinite(coordinate))
                    source.fail(fmt::format("triangle {}: the coordinate {} is not a finite float",
                                            i, coordinate));
            welder.add(mesh, {point[0], point[1], point[2]});
        }
        mesh.end_face();
        place += record + (attributes ? number_at<std::uint16_t>(bytes, place + attribute_at) : 0);
    }
    if (place < bytes.size())
        mesh.remark =
            fmt::format("{} bytes after the last triangle passed over", bytes.size() - place);
    return mesh;
}

// ---- Text: words; only solid, facet, vertex and their ends matter.

struct TextReader {
    const Source& source;
    Polygons mesh = {};
    Welder welder = {};
    enum { outside, in_solid, in_facet } state = outside;
    std::size_t facets = 0;  ///< of this solid
    int corners = 0;         ///< of this facet

    [[noreturn]] void out_of_place(std::string_view word) const {
        source.fail_at(word.data(), fmt::format("{} out of place", quote(word)));
    }
    void solid(std::string_view word);
    void end_solid(std::string_view word);
    void facet(std::string_view word);
    void end_facet(std::string_view word);
    void vertex(std::string_view word, std::string_view& rest);
};

/// A solid that begins twice before its first facet is one.
void TextReader::solid(std::string_view word) {
    if (state == in_facet || (state == in_solid && facets > 0)) out_of_place(word);
    state = in_solid;
    facets = 0;
}

void TextReader::end_solid(std::string_view word) {
    if (state == in_facet) out_of_place(word);
    state = outside;
}

void TextReader::facet(std::string_view word) {
    if (state != in_solid) out_of_place(word);
    state = in_facet;
    corners = 0;
    ++facets;
}

void TextReader::end_facet(std::string_view word) {
    if (state != in_facet) out_of_place(word);
    if (corners != 3) source.fail_at(word.data(), fmt::format("a facet of {} vertices", corners));
    state = in_solid;
    mesh.end_face();
}

void TextReader::vertex(std::string_view word, std::string_view& rest) {
    if (state != in_facet) out_of_place(word);
    Double3 point;
    for (int axis = 0; axis < 3; ++axis)
        point[axis] = parse_coordinate(source, take_word(rest), word.data());
    welder.add(mesh, point);
    ++corners;
}

/// Takes a word in lower case; "end solid" is one word.
std::string take_keyword(std::string_view& rest, std::string_view& word) {
    word = take_word(rest);
    std::string keyword = lower_case(word);
    if (keyword != "end") return keyword;
    std::string_view ahead = rest;
    const std::string next = lower_case(take_word(ahead));
    if (next != "solid" && next != "facet" && next != "loop") return keyword;
    rest = ahead;
    return keyword + next;
}

/// Three words of anything: normals are not used, and some are no numbers.
void pass_normal(std::string_view& rest) {
    for (int i = 0; i < 3; ++i) {
        std::string_view ahead = rest;
        if (lower_case(take_word(ahead)) == "outer") return;
        rest = ahead;
    }
}

Polygons read_text(Source& source) {
    normalise_text(source);
    TextReader reader{source};
    std::string_view rest = source.view(), word = rest;
    if (!take_keyword(rest, word).starts_with("solid"))
        source.fail(fmt::format("not an STL file: text that begins with {}, not with 'solid'",
                                quote(word)));
    rest = source.view();
    for (std::string keyword; !(keyword = take_keyword(rest, word)).empty();) {
        // The rest of the line is a name, whose words are no commands; it may be glued on.
        if (keyword.starts_with("endsolid")) {
            reader.end_solid(word);
            take_line(rest);
        } else if (keyword.starts_with("solid")) {
            reader.solid(word);
            take_line(rest);
        } else if (keyword == "facet") {
            reader.facet(word);
        } else if (keyword == "endfacet") {
            reader.end_facet(word);
        } else if (keyword == "vertex") {
            reader.vertex(word, rest);
        } else if (keyword == "normal") {
            pass_normal(rest);
        } else if (keyword != "outer" && keyword != "loop" && keyword != "endloop") {
            reader.mesh.skip(source, word);
        }
    }
    if (reader.state != TextReader::outside)
        source.fail_at(source.content.data() + source.content.size(),
                       "the file ends before 'endsolid'");
    return std::move(reader.mesh);
}

}  // namespace

Polygons read_stl(Source& source) {
    return is_binary(source) ? read_binary(source) : read_text(source);
}

}  // namespace space::mesh_reader
