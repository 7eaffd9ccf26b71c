#include "common/scene.hpp"

namespace space {

/// Heinonen16 prints no coordinates; these are placed so that the splitters that the thesis chooses
/// give the sets that it prints. The front of a segment is on the left of the way from a to b. All
/// numbers are multiples of 1/4 below 16, so that every side test is exact in float.
///
/// BSP tree (figures 2, 3): G has {A, B, C} in front and {D, E, F} behind; there E has D in front
/// and F behind. In front of G, B cuts C: C2 lies behind B; before it lie A and C1, and C1 is in
/// front of A.
///
/// k-d tree (figures 4, 5): q: x = 8 has {C, E, F, G} on its positive side; there r: y = 6.5 has
/// {C, G} above and {E, F} below; s: x = 12.5 parts G from C, t: x = 11.25 parts E from F. On q's
/// negative side u: y = 11.5 has A above, and v: x = 4 parts D from B.
std::vector<Segment> heinonen_segments() {
    return {
        {{1.5f, 14.25f}, {5.5f, 12.75f}},    // A
        {{4.5f, 9.5f}, {7.25f, 10.5f}},      // B
        {{13.0f, 10.5f}, {14.5f, 14.5f}},    // C
        {{1.25f, 1.75f}, {3.5f, 4.0f}},      // D
        {{9.5f, 1.0f}, {10.5f, 5.5f}},       // E
        {{12.25f, 4.75f}, {14.75f, 2.25f}},  // F
        {{9.0f, 7.5f}, {12.0f, 8.5f}},       // G
    };
}

}  // namespace space
