/// @file
/// A mesh file in memory: its lines, its words, and complaints that name the file, the place and
/// the word.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace space::mesh_reader {

/// A file as a reader sees it: its content, and how to say what is wrong where.
struct Source {
    std::string name;
    std::string content;

    [[noreturn]] void fail(const std::string& fault) const;
    /// `where` points into the content.
    [[noreturn]] void fail_at(const char* where, const std::string& fault) const;
    std::ptrdiff_t line_of(const char* where) const;
    std::string_view view() const { return content; }
};

/// What all text formats share, in place so that lines keep their numbers: of the bytes from
/// `first` to `last`, CR LF and CR become '\n' (and a blank), a byte order mark becomes blanks.
void normalise_text(Source& source, std::size_t first = 0,
                    std::size_t last = std::string_view::npos);

/// Blanks are the space and all control characters: none of them belongs to a word.
constexpr bool is_blank(char c) {
    return static_cast<unsigned char>(c) <= ' ';
}

/// Takes the first word off the text; empty at its end.
std::string_view take_word(std::string_view& text);
/// Takes the first line off the text, without its line end.
std::string_view take_line(std::string_view& text);
/// The text without the blanks at its end.
std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);

/// A word of the file in a message: not too long, and no control characters.
std::string quote(std::string_view word);

bool parse_integer(std::string_view word, std::int64_t& number);
/// As a double; a number too large for one is infinite, one too small is 0.
bool parse_number(std::string_view word, double& number);
/// A coordinate: a number that is finite as a float. Fails at the line of `where`.
double parse_coordinate(const Source& source, std::string_view word, const char* where);

}  // namespace space::mesh_reader
