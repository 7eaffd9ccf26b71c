// What drawings of trees and walks share.
#include "common/program/walk_drawing.hpp"

#include "common/program/tree_layout.hpp"
#include "tests/catch.hpp"

using namespace space;

TEST_CASE("in a drawn tree leaves stand in a row, and each node over the middle of its children") {
    // 0 has 1 and 2; 1 has 3, 4 and 5.
    const auto places = tree_layout({{1, 2}, {3, 4, 5}, {}, {}, {}, {}});
    CHECK(places[3] == Double2(0.5, 2));
    CHECK(places[4] == Double2(1.5, 2));
    CHECK(places[5] == Double2(2.5, 2));
    CHECK(places[1].x == Approx(1.5));
    CHECK(places[2] == Double2(3.5, 1));
    CHECK(places[0].x == Approx(2.5));
    CHECK(tree_layout({}).empty());
    CHECK(tree_layout({{}}) == std::vector{Double2(0.5, 0)});
}

TEST_CASE("names and intervals are written as drawings and as sentences write them") {
    CHECK(drawn_name("C") == "*C*");
    CHECK(drawn_name("C12") == "*C*_{12}");
    CHECK(plain_name("C12") == "C₁₂");
    CHECK(interval(-1e-45, 14.657) == "[0, 14.66]");
    CHECK(interval(-2.5, double{infinity}) == "[−2.5, ∞)");
}

TEST_CASE("a ray meets a segment at its t, ends included, and misses behind, beside and along it") {
    const BasicRay<2> down{{2, 4}, {0, -1}};
    CHECK(distance_along(down, {{1, 1}, {3, 1}}) == 3.0);
    CHECK(distance_along(down, {{3, 1}, {2, 1}}) == 3.0);
    CHECK(distance_along(down, {{1, 5}, {3, 5}}) == double{infinity});
    CHECK(distance_along(down, {{3, 1}, {4, 1}}) == double{infinity});
    CHECK(distance_along(down, {{2, 1}, {2, 3}}) == double{infinity});
}

TEST_CASE("each step of a walk shows its own part in hand, and the last one without scripts") {
    const DrawnTree tree{.size = 4,
                         .segments = {{"A", {1, 1}, {3, 1}}},
                         .nodes = {{.name = "*A*",
                                    .cell = {{0, 0}, {4, 0}, {4, 4}, {0, 4}},
                                    .lines = {{0, 1}, {4, 1}},
                                    .children = {1, 2}},
                                   {.name = "", .cell = {{0, 0}, {4, 0}, {4, 1}, {0, 1}}},
                                   {.name = "", .cell = {{0, 1}, {4, 1}, {4, 4}, {0, 4}}}}};
    const BasicRay<2> ray{{2, 4}, {0, -1}};
    const std::vector<WalkStep> steps{{.tells = "It comes to A.",
                                       .in_hand = WalkStep::Visit{0, 0, infinity},
                                       .next = 2,
                                       .crossings = {3}},
                                      {.tells = "It hits A.", .tested = {0}, .hit = 3}};
    const std::string svg = walk_drawing("A walk", tree, ray, steps).document("f");
    CHECK(
        svg.find(
            "<g data-first=\"0\" data-last=\"0\" display=\"none\">\n<desc>It comes to A.</desc>") !=
        svg.npos);
    CHECK(svg.find("<g data-first=\"1\">\n<desc>It hits A.</desc>") != svg.npos);
    CHECK(svg.find(">[0, ∞)</text>") != svg.npos);
}
