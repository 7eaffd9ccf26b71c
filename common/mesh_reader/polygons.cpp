#include "common/mesh_reader/polygons.hpp"

#include <fmt/format.h>

namespace space::mesh_reader {

void Polygons::skip(const Source& source, std::string_view word) {
    if (++skipped == 1)
        first_skipped = fmt::format("{} in line {}", quote(word), source.line_of(word.data()));
}

}  // namespace space::mesh_reader
