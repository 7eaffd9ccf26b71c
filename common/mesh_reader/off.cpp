// OFF: counts, vertices, faces ("Object File Format", Geomview manual, section 4.2.5).
#include "common/mesh_reader/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace space::mesh_reader {
namespace {

/// Takes a word; comments and line ends may stand between words.
std::string_view take_off_word(std::string_view& rest) {
    for (;;) {
        const std::string_view before = rest, word = take_word(rest);
        if (!word.starts_with('#')) return word;
        rest = before.substr(static_cast<std::size_t>(word.data() - before.data()));
        take_line(rest);
    }
}

/// The next line with something on it besides blanks and a comment; empty at the end of the file.
std::string_view take_off_line(std::string_view& rest) {
    while (!rest.empty()) {
        std::string_view line = take_line(rest);
        line = trimmed(line.substr(0, line.find('#')));
        if (!line.empty()) return line;
    }
    return {};
}

struct OffReader {
    const Source& source;
    std::string_view rest;
    std::array<std::int64_t, 3> counts = {};  ///< vertices, faces, edges
    int columns = 0;                          ///< of a vertex, behind its coordinates
    bool by_lines = false;                    ///< an item a line, whose end may hold other columns

    void take_keyword();
    void take_counts();
    bool edges_are_left_out() const;
    bool stand_in_lines(bool faces) const;
    void read_vertex(Polygons& mesh, std::int64_t number);
    void read_face(Polygons& mesh, std::int64_t number);
    std::string_view take_item_word(std::string_view& line);
};

/// [ST][C][N]OFF, or nothing; the first count may be glued to it.
void OffReader::take_keyword() {
    std::string_view ahead = rest;
    const std::string_view word = take_off_word(ahead);
    std::int64_t number = 0;
    if (parse_integer(word, number)) return;
    std::string_view kind = word;
    constexpr std::pair<std::string_view, int> prefixes[] = {{"ST", 2}, {"C", 4}, {"N", 3}};
    for (const auto& [prefix, words] : prefixes)
        if (kind.starts_with(prefix)) {
            kind.remove_prefix(prefix.size());
            columns += words;
        }
    const std::string_view count = kind.substr(std::min<std::size_t>(3, kind.size()));
    if (!kind.starts_with("OFF") || !(count.empty() || parse_integer(count, number))) {
        if (word.ends_with("OFF"))
            source.fail_at(
                word.data(),
                fmt::format("{} files are not read, only OFF with three coordinates", quote(word)));
        source.fail(
            fmt::format("not an OFF file: it begins with {}, neither with OFF nor with a "
                        "number of vertices",
                        quote(word)));
    }
    const char* const end = source.content.data() + source.content.size();
    rest = {kind.data() + 3, static_cast<std::size_t>(end - kind.data() - 3)};
}

/// Some writers give two counts: then a vertex comes next, not a number in a line of its own.
bool OffReader::edges_are_left_out() const {
    std::string_view ahead = rest, line = take_line(ahead);
    if (!trimmed(line.substr(0, line.find('#'))).empty()) return false;
    line = take_off_line(ahead);
    take_word(line);
    return !take_word(line).empty();
}

void OffReader::take_counts() {
    constexpr const char* names[] = {"vertices", "faces", "edges"};
    // "0 0 0\n", "3 0 0 0": bytes that one takes at least
    constexpr std::int64_t fewest_bytes[] = {6, 6, 1};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (i == 2 && edges_are_left_out()) return;
        const std::string_view word = take_off_word(rest);
        if (word == "BINARY")
            source.fail("binary OFF files are not read: convert it to text or to PLY");
        if (word.empty())
            source.fail(fmt::format("the file ends before its number of {}", names[i]));
        if (!parse_integer(word, counts[i]) || counts[i] < 0)
            source.fail_at(word.data(),
                           fmt::format("{} is not a number of {}", quote(word), names[i]));
        if (counts[i] > std::int64_t(source.content.size()) / fewest_bytes[i])
            source.fail_at(
                word.data(),
                fmt::format("the header promises {} {}, more than fit into a file of {} bytes",
                            counts[i], names[i], source.content.size()));
    }
}

/// Does each vertex, or face, begin a line that holds it whole? If not, words run on from line to
/// line. Faces need lines of their own, too, else a line holds several vertices.
bool OffReader::stand_in_lines(bool faces) const {
    std::string_view ahead = rest;
    for (std::int64_t i = 0; i < counts[faces ? 1 : 0]; ++i) {
        std::string_view line = take_off_line(ahead);
        std::int64_t words = 3;
        if (faces && !parse_integer(take_word(line), words)) return !line.empty();
        for (; words > 0; --words)
            if (take_word(line).empty()) return false;
    }
    for (std::int64_t i = 0; !faces && i < counts[1]; ++i)
        if (take_off_line(ahead).empty()) return false;
    return true;
}

std::string_view OffReader::take_item_word(std::string_view& line) {
    return by_lines ? take_word(line) : take_off_word(rest);
}

void OffReader::read_vertex(Polygons& mesh, std::int64_t number) {
    std::string_view line = by_lines ? take_off_line(rest) : rest;
    Double3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = take_item_word(line);
        if (word.empty())
            source.fail(fmt::format("the file ends after {} of {} vertices", number, counts[0]));
        point[axis] = parse_coordinate(source, word, word.data());
    }
    if (!by_lines)
        for (int i = 0; i < columns; ++i) take_off_word(rest);
    mesh.points.push_back(point);
}

void OffReader::read_face(Polygons& mesh, std::int64_t number) {
    std::string_view line = by_lines ? take_off_line(rest) : rest;
    std::string_view word = take_item_word(line);
    const char* const where = word.data();
    if (word.empty())
        source.fail(fmt::format("the file ends after {} of {} faces", number, counts[1]));
    std::int64_t corners = 0, index = 0;
    if (!parse_integer(word, corners))
        source.fail_at(where, fmt::format("{} is not a number of corners", quote(word)));
    if (corners < 3)
        source.fail_at(where,
                       fmt::format("a face needs three corners or more, this one has {}", corners));
    for (std::int64_t corner = 0; corner < corners; ++corner) {
        word = take_item_word(line);
        if (word.empty())
            source.fail_at(where, fmt::format("the face has {} corners, not {}", corner, corners));
        if (!parse_integer(word, index))
            source.fail_at(word.data(), fmt::format("{} is not a vertex index", quote(word)));
        if (index < 0 || index >= counts[0])
            source.fail_at(word.data(), fmt::format("vertex index {}, but the file has {} vertices",
                                                    index, counts[0]));
        mesh.corners.push_back(static_cast<std::uint32_t>(index));
    }
    mesh.end_face();
}

}  // namespace

Polygons read_off(Source& source) {
    normalise_text(source);
    OffReader reader{source, source.view()};
    reader.take_keyword();
    reader.take_counts();
    Polygons mesh;
    reader.by_lines = reader.stand_in_lines(false);
    for (std::int64_t i = 0; i < reader.counts[0]; ++i) reader.read_vertex(mesh, i);
    reader.by_lines = reader.stand_in_lines(true);
    for (std::int64_t i = 0; i < reader.counts[1]; ++i) reader.read_face(mesh, i);
    std::string_view behind = reader.rest;
    const std::string_view word = take_off_word(behind);
    if (!word.empty())
        mesh.remark = fmt::format("what follows the last face passed over, from line {} on",
                                  source.line_of(word.data()));
    return mesh;
}

}  // namespace space::mesh_reader
