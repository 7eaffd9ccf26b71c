/// @file
/// Chapter 3's structures: BSP trees by every choice of splitters. They outgrow memory on scenes
/// whose polygons cut each other often, and patience on convex ones.
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {
namespace {

using SplitterChoice = BspConfig::SplitterChoice;
using Straddlers = BspConfig::Straddlers;

Structure offer_bsp(std::string_view name, std::string_view about, SplitterChoice splitter,
                    Straddlers straddlers = Straddlers::split) {
    return offer<Bsp>(name, about, [=](BspConfig& config, const Limits& limits) {
        config.splitter = splitter;
        config.straddlers = straddlers;
        config.max_fragments = limits.references;
        config.max_placed = limits.placements;
    });
}

}  // namespace

// [ch03_structures]
std::vector<Structure> ch03_structures() {
    return {
        offer_bsp("bsp", "BSP tree; planes weighed by balance and cuts (chapter 3)",
                  SplitterChoice::weighted),
        offer_bsp("bsp-first", "the same; the plane of the first polygon", SplitterChoice::first),
        offer_bsp("bsp-random", "the same; the plane of any polygon", SplitterChoice::random),
        offer_bsp("bsp-balanced", "the same; as many polygons in front as behind",
                  SplitterChoice::balanced),
        offer_bsp("bsp-fewest", "the same; the fewest cuts", SplitterChoice::fewest_splits),
        offer_bsp("bsp-shared", "as bsp; a polygon that would be cut goes whole to both sides",
                  SplitterChoice::weighted, Straddlers::share),
        offer_bsp("bsp-free", "as bsp; planes across an axis where polygons' planes are lopsided",
                  SplitterChoice::free),
    };
}
// [ch03_structures]

}  // namespace space
