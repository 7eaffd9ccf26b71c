/// @file
/// What a mesh file holds, in the file's own precision, and the readers of the four formats.
#pragma once

#include "common/geometry.hpp"
#include "common/mesh_reader/source.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space::mesh_reader {

/// Faces with any number of corners. Whoever adds one has checked its corners' indices.
struct Polygons {
    std::vector<Double3> points;
    std::vector<std::uint32_t> corners;  ///< of all faces, one face after the other
    std::vector<std::size_t> ends;       ///< where each face's corners end
    std::size_t skipped = 0;             ///< statements that no triangle comes from
    std::string first_skipped;           ///< its word and place
    std::string remark;                  ///< what else the reader passed over

    std::size_t size() const { return ends.size(); }
    std::span<const std::uint32_t> operator[](std::size_t face) const {
        const std::size_t first = face == 0 ? 0 : ends[face - 1];
        return {corners.data() + first, ends[face] - first};
    }
    /// The corners since the last face make a face.
    void end_face() { ends.push_back(corners.size()); }
    /// Counts a statement that is passed over.
    void skip(const Source& source, std::string_view word);
};

Polygons read_obj(Source& source);
Polygons read_off(Source& source);
Polygons read_ply(Source& source);
Polygons read_stl(Source& source);

}  // namespace space::mesh_reader
