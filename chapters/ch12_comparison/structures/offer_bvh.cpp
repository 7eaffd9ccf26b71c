#include "chapters/ch12_comparison/structures/offer_bvh.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {

Structure offer_any_bvh(std::string_view name, std::string_view about,
                        const ConfiguredBvhBuilder& builder) {
    return offer_with(name, about, [&](const auto& test) {
        using Built = Bvh<AnyBvhBuilder, TestOf<decltype(test)>>;
        return [builder](std::span<const Triangle> triangles, const BuildOptions& options) {
            const AnyBvhBuilder::Config config = builder(options);
            return erased(Built::build(triangles, config), config.threads);
        };
    });
}

}  // namespace space
