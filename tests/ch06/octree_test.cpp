// The suite over the octree, tight, with straddlers kept, and loose, by both walks.
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"

#include "tests/suite/accelerator_suite.hpp"

#include <span>
#include <string_view>

namespace space {
namespace {

using Straddlers = OctreeConfig::Straddlers;
using Walk = OctreeConfig::Walk;

void check_suite(std::string_view name, const OctreeConfig& config) {
    check_accelerator<Octree<>>(
        name, [=](std::span<const Triangle> t) { return Octree<>::build(t, config); },
        SuiteOptions{}.fewer());
}

}  // namespace

TEST_CASE("the suite: octree") {
    run_suite<Octree>("octree");
}

TEST_CASE("the suite: loose octree") {
    run_suite<Octree>("octree-loose", {.straddlers = Straddlers::keep, .looseness = 2.0});
}

TEST_CASE("the suite: octrees by the plain walk, and without mailboxes") {
    check_suite("octree, plain walk", {.walk = Walk::plain});
    check_suite("octree-loose, plain walk",
                {.straddlers = Straddlers::keep, .looseness = 2.0, .walk = Walk::plain});
    check_suite("octree, no mailboxes", {.mailboxes = false});
}

TEST_CASE("the suite: octrees with straddlers kept, and loose by numbers that are not round") {
    check_suite("octree, kept", {.straddlers = Straddlers::keep});
    check_suite("octree-loose, 1.1", {.straddlers = Straddlers::keep, .looseness = 1.1});
    check_suite("octree-loose, 3.7", {.straddlers = Straddlers::keep, .looseness = 3.7});
}

TEST_CASE("the suite: octrees as deep as they get, and shallow ones") {
    check_suite("octree, deep",
                {.costs = {.traversal = 0.0}, .max_leaf_size = 1, .max_growth = 64.0});
    check_suite("octree, shallow", {.max_depth = 2});
    check_suite("octree, a leaf", {.max_depth = 0});
}

}  // namespace space
