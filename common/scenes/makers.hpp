/// @file
/// The functions behind the names of scene_recipes(). Each fills an empty scene; sizes have been
/// checked before.
#pragma once

#include "common/scene.hpp"

namespace space {

// A lit room, with a mesh of any size and place put on its table.
void make_room(Scene& scene, std::uint32_t detail, std::uint64_t seed);
void make_room_with(Scene& scene, const TriangleMesh& on_table);

// Haines 1987, "A Proposed Standard Set of Problems to Test Ray Tracing Algorithms", and the later
// additions to it: tessellated, lit and coloured for this book.
void make_sphereflake(Scene& scene, std::uint32_t depth, std::uint64_t seed);
void make_tetra(Scene& scene, std::uint32_t depth, std::uint64_t seed);
void make_tree(Scene& scene, std::uint32_t depth, std::uint64_t seed);
void make_mount(Scene& scene, std::uint32_t depth, std::uint64_t seed);
void make_lattice(Scene& scene, std::uint32_t cells, std::uint64_t seed);
void make_shells(Scene& scene, std::uint32_t depth, std::uint64_t seed);

// What structures find easy and hard.
void make_soup(Scene& scene, std::uint32_t triangles, std::uint64_t seed);
void make_soup_uneven(Scene& scene, std::uint32_t triangles, std::uint64_t seed);
void make_icosphere(Scene& scene, std::uint32_t frequency, std::uint64_t seed);
void make_dust(Scene& scene, std::uint32_t triangles, std::uint64_t seed);
void make_blanket(Scene& scene, std::uint32_t triangles, std::uint64_t seed);
void make_scan(Scene& scene, std::uint32_t frequency, std::uint64_t seed);
void make_stadium(Scene& scene, std::uint32_t detail, std::uint64_t seed);
void make_slivers(Scene& scene, std::uint32_t triangles, std::uint64_t seed);
void make_boxes(Scene& scene, std::uint32_t boxes, std::uint64_t seed);
void make_building(Scene& scene, std::uint32_t storeys, std::uint64_t seed);

}  // namespace space
