#include "common/program/svg.hpp"

#include "common/program/image.hpp"
#include "common/program/svg_colors.hpp"
#include "common/program/xml.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace space;

namespace {

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
    return found;
}

std::string decoded(const std::string& base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0, count = 0;
    for (const char c : base64) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(digits.find(c));
        if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255u);
    }
    return bytes;
}

}  // namespace

TEST_CASE("a number has at most two decimals and no negative zero") {
    CHECK(svg_number(0.0) == "0");
    CHECK(svg_number(-0.0) == "0");
    CHECK(svg_number(-0.001) == "0");
    CHECK(svg_number(100.0) == "100");
    CHECK(svg_number(1.5) == "1.5");
    CHECK(svg_number(-2.346) == "-2.35");
    CHECK(svg_number(1e9) == "1000000000");
    CHECK_THROWS_AS(svg_number(std::nan("")), std::invalid_argument);
    CHECK_THROWS_AS(svg_number(std::numeric_limits<double>::infinity()), std::invalid_argument);
}

TEST_CASE("text cannot break out of its element") {
    CHECK(xml_escaped("a < b & \"c\" > 'd'") == "a &lt; b &amp; &quot;c&quot; &gt; &apos;d&apos;");
    CHECK(xml_escaped("bell\x07") == "bell\uFFFD");
    CHECK(xml_escaped("säteenjäljitys") == "säteenjäljitys");

    Svg svg("<script>", 10, 10);
    svg.text({0, 0}, "*<t>*_<", {}, "a\"b");
    const std::string document = svg.document("f");
    CHECK(contains(document, "&lt;script&gt;</title>"));
    CHECK(contains(document, "<tspan class=\"italic\">&lt;t&gt;</tspan>"));
    CHECK(contains(document, "id=\"f-a&quot;b\""));
}

TEST_CASE("markup: italics, subscripts, and back to the base line") {
    Svg svg("", 10, 10);
    svg.text({0, 0}, "*t*_{min} to *t*_1", {.size = 20});
    CHECK(contains(
        svg.document("f"),
        "<tspan class=\"italic\">t</tspan><tspan font-size=\"15\" dy=\"5\">min</tspan><tspan "
        "dy=\"-5\"> to </tspan>"
        "<tspan class=\"italic\">t</tspan><tspan font-size=\"15\" dy=\"5\">1</tspan></text>"));
}

TEST_CASE("every id carries the figure's, so that many figures can stand in one page") {
    Svg svg("title", 640, 400);
    svg.begin_group("rays");
    svg.line({0, 0}, {1, 1}, {.arrow = true}, "first");
    svg.end_group();
    svg.rect({0, 0}, {1, 1}, {}, "box");
    svg.circle({0, 0}, 1, {}, "ball");
    svg.polygon({{0, 0}, {1, 0}, {0, 1}}, {}, "triangle");
    svg.text({0, 0}, "x", {}, "name");
    svg.picture({0, 0}, {1, 1}, Image(1, 1), "pixels");
    const std::string document = svg.document("fig_09_01");
    CHECK(count(document, " id=\"fig_09_01") == count(document, " id=\""));
    for (const char* id : {"rays", "first", "box", "ball", "triangle", "name", "pixels"})
        CHECK(contains(document, std::string("id=\"fig_09_01-") + id + '"'));
}

TEST_CASE("every colour of an element is one that the style block maps to a variable") {
    for (int ink = 0; ink < 11; ++ink) {
        Svg svg("", 10, 10);
        svg.rect({0, 0}, {1, 1}, {.stroke = static_cast<Ink>(ink), .fill = static_cast<Ink>(ink)});
        const std::string document = svg.document("f");
        const std::string color(svg_color(static_cast<Ink>(ink)));
        CHECK(contains(document, "[stroke=\"" + color + "\"]{stroke:var(--"));
        CHECK(contains(document, "[fill=\"" + color + "\"]{fill:var(--"));
        CHECK(contains(document, "stroke=\"" + color + "\" stroke-width=\"2\""));
    }
}

TEST_CASE(
    "the page's light or dark class wins over the system's setting, and styles stay inside the "
    "figure") {
    const std::string document = Svg("", 10, 10).document("f");
    const auto system = document.find("@media (prefers-color-scheme:dark){svg.book-figure{");
    const auto light = document.find("html.light-mode svg.book-figure{");
    const auto dark = document.find("html.dark-mode svg.book-figure{");
    REQUIRE(system != document.npos);
    CHECK(system < light);
    CHECK(light < dark);
    CHECK(dark != document.npos);
    CHECK(contains(document, "class=\"book-figure\" role=\"img\""));
    CHECK(count(document, "\ntext") == 0);
}

TEST_CASE("an arrow ends in a head whose tip is the line's end") {
    Svg svg("", 100, 100);
    svg.line({0, 50}, {100, 50}, {.stroke = Ink::blue, .arrow = true});
    CHECK(contains(svg.document("f"), "<polyline points=\"0,50 90.4,50\""));
    CHECK(contains(svg.document("f"),
                   "<polygon points=\"100,50 88,54.5 88,45.5\" fill=\"#0072b2\"/>"));

    Svg point("", 100, 100);
    point.line({5, 5}, {5, 5}, {.arrow = true});  // no direction: no head, and no NaN
    CHECK(count(point.document("f"), "<polygon") == 0);
}

TEST_CASE("a picture is the PNG file of the image, in base64") {
    for (int width = 1; width <= 3; ++width) {  // lengths with different remainders
        const Image image(width, 1);
        Svg svg("", 10, 10);
        svg.picture({1, 2}, {3, 4}, image);
        const std::string document = svg.document("f");
        const std::string before = "href=\"data:image/png;base64,";
        REQUIRE(contains(document, before));
        const std::size_t from = document.find(before) + before.size();
        CHECK(decoded(document.substr(from, document.find('"', from) - from)) == png_bytes(image));
    }
}

TEST_CASE("the same calls give the same bytes") {
    const auto draw = [] {
        Svg svg("title", 640, 400);
        for (int i = 0; i < 100; ++i)
            svg.circle({320.0f + 100.0f * std::cos(0.1f * static_cast<float>(i)),
                        0.333f * static_cast<float>(i)},
                       3);
        return svg.document("f");
    };
    CHECK(draw() == draw());
}

TEST_CASE("of steps, those that end before the drawing does are hidden where no script runs") {
    Svg svg("Steps", 10, 10);
    svg.begin_step(0, 1, "a < b");
    svg.end_group();
    svg.begin_step(2);
    svg.end_group();
    const std::string text = svg.document("f");
    CHECK(
        text.find(
            "<g data-first=\"0\" data-last=\"1\" display=\"none\">\n<desc>a &lt; b</desc>\n</g>") !=
        text.npos);
    CHECK(text.find("<g data-first=\"2\">\n</g>") != text.npos);
}

TEST_CASE("a group that is not closed, or not open, is a fault that shows") {
    Svg open("", 1, 1);
    open.begin_group("g");
    CHECK_THROWS_AS(open.document("f"), std::logic_error);
    Svg closed("", 1, 1);
    CHECK_THROWS_AS(closed.end_group(), std::logic_error);
}

namespace {

/// Relative luminance and contrast by WCAG 2.1, of "#rrggbb".
double luminance(std::string_view color) {
    const std::array<double, 3> weights{0.2126, 0.7152, 0.0722};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double c = std::stoi(std::string(color.substr(1 + 2 * i, 2)), nullptr, 16) / 255.0;
        sum += weights[i] * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return sum;
}
double contrast(std::string_view a, std::string_view b) {
    const double one = luminance(a), other = luminance(b);
    const double darker = std::min(one, other), lighter = std::max(one, other);
    return (lighter + 0.05) / (darker + 0.05);
}

}  // namespace

TEST_CASE("text in every ink stands at least 4.5 to 1 against light and dark paper") {
    CHECK(contrast("#000000", "#ffffff") == Approx(21.0));
    CHECK(contrast("#777777", "#ffffff") < 4.5);  // the best known colour that just fails
    for (int i = 0; i <= static_cast<int>(Ink::purple); ++i) {
        const Ink ink = static_cast<Ink>(i);
        if (ink == Ink::paper) continue;  // on dark shapes
        for (const bool dark : {false, true}) {
            CAPTURE(i, dark, svg_text_color(ink, dark));
            CHECK(contrast(svg_text_color(ink, dark), svg_paper(dark)) >= 4.5);
            Svg svg("t", 10, 10);
            svg.text({0, 0}, "text", {.ink = ink});
            CHECK(contains(svg.document("f"), fmt::format("fill=\"{}\">", svg_text_color(ink))));
        }
    }
}

TEST_CASE("a drawing with fixed colours has those of its page alone, and no style for others") {
    Svg svg("", 10, 10);
    for (int ink = 0; ink <= static_cast<int>(Ink::purple); ++ink) {
        svg.rect({0, 0}, {1, 1}, {.stroke = static_cast<Ink>(ink), .fill = static_cast<Ink>(ink)});
        svg.text({0, 0}, "text", {.ink = static_cast<Ink>(ink)});
    }
    const std::string document = svg.document("f"), dark = svg_fixed(document, true),
                      light = svg_fixed(document, false);
    for (const std::string& fixed : {dark, light}) {
        CHECK(count(fixed, "var(--") == 0);
        CHECK(count(fixed, "prefers-color-scheme") == 0);
        CHECK(count(fixed, "font-style:italic") == 1);
        CHECK(count(fixed, "<rect") == count(document, "<rect"));
    }
    for (int ink = 0; ink <= static_cast<int>(Ink::purple); ++ink) {
        CHECK(count(dark, svg_color(static_cast<Ink>(ink))) == 0);
        CHECK(count(light, svg_color(static_cast<Ink>(ink))) > 0);
        CHECK(count(dark, svg_text_color(static_cast<Ink>(ink), true)) > 0);
    }
    CHECK(contains(dark, fmt::format("fill=\"{}\"/>", svg_paper(true))));
}
