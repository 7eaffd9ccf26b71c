#include "chapters/ch10_fast_traversal/measured/tracer.hpp"

#ifdef BOOK_HAS_EMBREE
#include "common/embree_tree.hpp"
#endif

namespace space::ch10 {

#ifdef BOOK_HAS_EMBREE

std::vector<Tracer> embree_tracers(const std::vector<Triangle>& triangles) {
    const auto tracer = [&](std::string_view name, EmbreeFlavour flavour) {
        return tracer_of<DenormalsAreZero>(
            std::string(name), std::make_shared<const EmbreeTree>(triangles, 1, flavour));
    };
    return {tracer(embree_default, {}), tracer(embree_robust, {.flags = RTC_SCENE_FLAG_ROBUST}),
            tracer(embree_high, {.quality = RTC_BUILD_QUALITY_HIGH})};
}

double embree_build_ms(const std::vector<Triangle>& triangles) {
    const double before = process_ms();
    const EmbreeTree tree(triangles, 1, {});
    return process_ms() - before;
}

#else

std::vector<Tracer> embree_tracers(const std::vector<Triangle>&) {
    return {};
}
double embree_build_ms(const std::vector<Triangle>&) {
    return 0.0;
}

#endif

}  // namespace space::ch10
