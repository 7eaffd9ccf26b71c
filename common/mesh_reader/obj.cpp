// Wavefront OBJ: a statement a line ("Advanced Visualizer Manual", appendix B1).
#include "common/mesh_reader/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::mesh_reader {
namespace {

template <std::size_t N>
bool is_one_of(std::string_view word, const std::string_view (&words)[N]) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// Lists of numbers: they may continue in the next line. Names and comments may not, since people's
/// end in a backslash (Windows folders).
constexpr std::string_view lists[] = {"v",    "vt",   "vn",   "vp",   "f",    "fo",    "l",
                                      "p",    "deg",  "bmat", "step", "curv", "curv2", "surf",
                                      "parm", "trim", "hole", "scrv", "sp",   "con"};
/// Passed over without a word: they say how triangles look, not where they are.
constexpr std::string_view looks[] = {"vt", "vn", "vp", "g", "o", "s", "usemtl", "mtllib"};

struct ObjReader {
    Source& source;
    Polygons mesh = {};
    std::int64_t largest = 0;          ///< index so far: faces may stand before their vertices
    const char* largest_at = nullptr;  ///< its place

    std::string_view take_statement(std::string_view& rest);
    void read_vertex(std::string_view numbers, const char* where);
    void read_face(std::string_view corners, const char* where);
};

/// Takes a statement without its comment: a line, or as many as a list of numbers goes on for.
std::string_view ObjReader::take_statement(std::string_view& rest) {
    std::string_view line = take_line(rest), words = line;
    const bool may_continue = is_one_of(take_word(words), lists);
    for (const char* const first = line.data();; line = take_line(rest)) {
        line = trimmed(line.substr(0, line.find('#')));
        const char* const last = line.data() + line.size();
        const std::string_view statement(first, static_cast<std::size_t>(last - first));
        if (!may_continue || !line.ends_with('\\')) return statement;
        source.content[static_cast<std::size_t>(last - 1 - source.content.data())] = ' ';
        if (rest.empty()) return statement;
    }
}

void ObjReader::read_vertex(std::string_view numbers, const char* where) {
    Double3 point;
    for (int axis = 0; axis < 3; ++axis)
        point[axis] = parse_coordinate(source, take_word(numbers), where);
    mesh.points.push_back(point);
}

/// Corners are vertex, vertex/texture, vertex//normal or vertex/texture/normal; negative indices
/// count back from the vertices so far.
void ObjReader::read_face(std::string_view corners, const char* where) {
    const auto vertices = static_cast<std::int64_t>(mesh.points.size());
    int count = 0;
    for (std::string_view word; !(word = take_word(corners)).empty(); ++count) {
        std::int64_t index = 0;
        if (!parse_integer(word.substr(0, word.find('/')), index))
            source.fail_at(where, fmt::format("{} is not a corner of a face", quote(word)));
        if (index == 0) source.fail_at(where, "vertex index 0, but OBJ counts from 1");
        if (index < -vertices)
            source.fail_at(where, fmt::format("vertex index {}, but {} vertices stand before it",
                                              index, vertices));
        if (index > largest) {
            largest = index;
            largest_at = where;
        }
        mesh.corners.push_back(
            static_cast<std::uint32_t>(index > 0 ? index - 1 : vertices + index));
    }
    if (count < 3)
        source.fail_at(where,
                       fmt::format("a face needs three corners or more, this one has {}", count));
    mesh.end_face();
}

}  // namespace

Polygons read_obj(Source& source) {
    normalise_text(source);
    ObjReader reader{source};
    for (std::string_view rest = source.view(); !rest.empty();) {
        std::string_view statement = reader.take_statement(rest);
        const std::string_view keyword = take_word(statement);
        if (keyword == "v")
            reader.read_vertex(statement, keyword.data());
        else if (keyword == "f" || keyword == "fo")
            reader.read_face(statement, keyword.data());
        else if (!keyword.empty() && !is_one_of(keyword, looks))
            reader.mesh.skip(source, keyword);
    }
    if (reader.largest > static_cast<std::int64_t>(reader.mesh.points.size()))
        source.fail_at(reader.largest_at,
                       fmt::format("vertex index {}, but the file has {} vertices", reader.largest,
                                   reader.mesh.points.size()));
    return std::move(reader.mesh);
}

}  // namespace space::mesh_reader
