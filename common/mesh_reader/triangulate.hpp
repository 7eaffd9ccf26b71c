/// @file
/// Polygons into triangles.
#pragma once

#include "common/mesh.hpp"
#include "common/mesh_reader/polygons.hpp"

namespace space::mesh_reader {

/// Cuts every face into triangles where it stands: inside is what an odd number of windings of its
/// outline encloses (even-odd rule), corners are the same where their *positions* in the file are.
/// So holes stay open that a bridge joins to the outline, walked twice; where an outline crosses
/// itself the crossing becomes a vertex of its own. Faces and triangles keep the file's order.
TriangleMesh triangulate(const Source& source, Polygons polygons);

}  // namespace space::mesh_reader
