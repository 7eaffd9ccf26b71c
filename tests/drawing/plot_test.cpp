#include "common/program/plot.hpp"

#include "tests/catch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <regex>
#include <string>
#include <vector>

using namespace space;

namespace {

/// The boxes of all texts of a size in a document, by the width that names are laid out with.
std::vector<Aabb2> text_boxes(const std::string& document, double size) {
    static const std::regex text(R"re(<text x="([-0-9.]+)" y="([-0-9.]+)"[^>]*>([^<]*)</text>)re");
    std::vector<Aabb2> boxes;
    for (std::sregex_iterator match(document.begin(), document.end(), text), end; match != end;
         ++match) {
        const double x = std::stod((*match)[1]), y = std::stod((*match)[2]);
        boxes.push_back(
            {at(x, y - 0.8 * size), at(x + text_width((*match)[3].str(), size), y + 0.2 * size)});
    }
    return boxes;
}

bool meet(const Aabb2& a, const Aabb2& b) {
    return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
}

}  // namespace

TEST_CASE("names beside points keep out of each other's way, and inside of the frame") {
    constexpr double size = 16;
    Svg svg("", 400, 400);
    const Aabb2 frame{at(0, 0), at(400, 400)};
    Labels labels(frame);
    std::vector<Point2> points;
    for (int i = 0; i < 12; ++i)  // six pairs, in a column, each point nearly on another one
        points.push_back(at(200 + i % 2, 30 + 60 * (i / 2)));
    for (const Point2& point : points) labels.keep_free(point, 7);
    for (std::size_t i = 0; i < points.size(); ++i)
        labels.draw(svg, points[i], fmt::format("name-{}", i), {.size = size});
    const std::vector<Aabb2> boxes = text_boxes(svg.document("f"), size);
    REQUIRE(boxes.size() == points.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        CHECK(frame.contains(boxes[i]));
        for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(meet(boxes[i], boxes[j]));
        for (const Point2& point : points) CHECK_FALSE(boxes[i].contains(point));
    }
}

TEST_CASE("a line to a name that stands farther off crosses no other name and no other symbol") {
    constexpr double size = 16;
    Labels labels({at(0, 0), at(400, 400)});
    std::vector<Point2> points;
    for (int i = 0; i < 7; ++i) points.push_back(at(180 + 18 * i, 200));  // in a row
    for (const Point2& point : points) labels.keep_free(point, 7);
    std::vector<Aabb2> names;
    std::vector<PlacedName> placed;
    for (const Point2& point : points) {
        placed.push_back(labels.place(point, "a-name", size));
        const Double2 start(placed.back().start);
        names.push_back({at(start.x, start.y - 0.8 * size),
                         at(start.x + text_width("a-name", size), start.y + 0.2 * size)});
    }
    std::size_t lines = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!placed[i].line) continue;
        ++lines;
        for (int k = 0; k <= 100; ++k) {
            const Point2 on_line = glm::mix(points[i], *placed[i].line, 0.01f * float(k));
            for (std::size_t j = 0; j < points.size(); ++j) {
                CHECK((j == i || !names[j].contains(on_line)));
                CHECK((j == i || glm::length(on_line - points[j]) > 7.0f));
            }
        }
    }
    CHECK(lines > 0);
}

TEST_CASE("a panel places the ends of its axes at its corners, decades at equal steps") {
    const Panel panel{10, 20, 300, 100, log_axis(1, 1000), {.low = 0, .high = 4}};
    CHECK(panel.place(panel.x.low, 0) == at(10, 120));
    CHECK(std::abs(panel.place(panel.x.high, 4).x - 310.0f) < 1e-3f);
    CHECK(panel.place(panel.x.low, 4).y == 20.0f);
    const float first = panel.place(10, 0).x - panel.place(1, 0).x,
                second = panel.place(100, 0).x - panel.place(10, 0).x;
    CHECK(std::abs(first - second) < 1e-3f);
}

TEST_CASE("a logarithmic axis has room at both ends and no more ticks than asked for") {
    CHECK(log_axis(50, 9000, 6).ticks.size() == 3);  // 100, 1000, 10000: 1, 2, 5 would be too many
    for (const double most : {2.0, 30.0, 210.0, 1e4, 1e9, 1e14}) {
        const Axis axis = log_axis(1.0, most, 6);
        CHECK(axis.low < 1.0);
        CHECK(axis.high > most);
        CHECK(axis.ticks.size() >= 2);
        CHECK(axis.ticks.size() <= 6);
        for (const Tick& tick : axis.ticks) {
            CHECK(axis.fraction(tick.value) >= 0.0);
            CHECK(axis.fraction(tick.value) <= 1.0);
        }
    }
}
