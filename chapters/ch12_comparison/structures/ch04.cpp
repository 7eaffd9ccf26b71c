/// @file
/// Chapter 4's structures: k-d trees by every rule, and the one that Lichter23 has published.
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {
namespace {

using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;

Structure offer_kd(std::string_view name, std::string_view about, Rule rule,
                   Straddlers straddlers) {
    return offer<KdTree>(name, about, [=](KdTreeConfig& config, const Limits& limits) {
        config.rule = rule;
        config.straddlers = straddlers;
        config.max_references = limits.references;
    });
}

}  // namespace

std::vector<Structure> ch04_structures() {
    return {
        offer_kd("kd-sah", "k-d tree by the surface area heuristic, straddlers clipped (chapter 4)",
                 Rule::sah, Straddlers::clip),
        offer_kd("kd-middle", "k-d tree; axes in turn, cut in the middle", Rule::middle,
                 Straddlers::clip),
        offer_kd("kd-median", "the same; cut at the median", Rule::median, Straddlers::clip),
        offer<PublishedKdTree>("kd-published",
                               "Lichter23's k-d tree, with its faults cured so that it is right",
                               [](PublishedKdTreeConfig& config, const Limits&) {
                                   config = PublishedKdTreeConfig::cured();
                               }),
        offer_kd("kd-kept", "as kd-sah; straddlers stay in inner nodes", Rule::sah,
                 Straddlers::keep),
        offer_kd("kd-unclipped", "as kd-sah; straddlers by their whole bounding boxes", Rule::sah,
                 Straddlers::duplicate),
    };
}

}  // namespace space
