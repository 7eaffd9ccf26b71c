#include "chapters/ch10_fast_traversal/measured/tracer.hpp"

#ifdef BOOK_HAS_EMBREE
#include "common/embree_tree.hpp"
#endif

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch10 {

#ifdef BOOK_HAS_EMBREE

std::vector<Tracer> embree_tracers(const std::vector<Triangle>& triangles,
                                   std::initializer_list<std::string_view> names) {
    std::vector<Tracer> tracers;
    for (const std::string_view name : names) {
        EmbreeFlavour flavour;
        if (name == embree_robust) flavour.flags = RTC_SCENE_FLAG_ROBUST;
        if (name == embree_high) flavour.quality = RTC_BUILD_QUALITY_HIGH;
        tracers.push_back(tracer_of<DenormalsAreZero>(
            std::string(name), std::make_shared<const EmbreeTree>(triangles, 1, flavour)));
    }
    return tracers;
}

double embree_build_ms(const std::vector<Triangle>& triangles) {
    const double before = process_ms();
    const EmbreeTree tree(triangles, 1, {});
    return process_ms() - before;
}

#else

std::vector<Tracer> embree_tracers(const std::vector<Triangle>&,
                                   std::initializer_list<std::string_view>) {
    return {};
}
double embree_build_ms(const std::vector<Triangle>&) {
    return 0.0;
}

#endif

}  // namespace space::ch10
