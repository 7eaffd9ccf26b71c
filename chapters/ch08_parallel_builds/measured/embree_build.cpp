#include "chapters/ch08_parallel_builds/measured/embree_build.hpp"

#ifdef BOOK_HAS_EMBREE
#include "common/embree_tree.hpp"
#include "common/measure.hpp"
#endif

namespace space::ch08 {

#ifdef BOOK_HAS_EMBREE

void build_with_embree(std::span<const Triangle> triangles, unsigned threads) {
    const EmbreeTree tree(triangles, threads, EmbreeFlavour{});
    do_not_optimize(tree);
}

#else

void build_with_embree(std::span<const Triangle>, unsigned) {}

#endif

}  // namespace space::ch08
