#include "docs/slides.hpp"

#include "common/program/base64.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/xml.hpp"
#include "docs/finish.hpp"
#include "docs/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>

namespace space::docs {
namespace {

/// A figure as it stands in a slide.
struct Picture {
    std::string markup;
    double aspect;  ///< width over height
};

Picture rendering(const Figure& figure) {
    const std::string png = read_file(figure.file);
    const auto size_at = [&](std::size_t at) {  // in the file's first chunk (PNG, section 11.2.2)
        double size = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            size = 256 * size + static_cast<unsigned char>(png.at(i));
        return size;
    };
    if (png.size() < 24) throw input_error(figure.file.string() + ": not a PNG file");
    return {.markup = fmt::format(
                "<div class=\"drawing\"><img alt=\"{}\" src=\"data:image/png;base64,{}\"/></div>\n",
                xml_escaped(figure.caption), base64(png)),
            .aspect = size_at(16) / size_at(20)};
}

/// Drawings bring their style: one that stands in `styles` already is left out.
Picture drawing(const Figure& figure, std::set<std::string>& styles) {
    static const std::regex size(R"re( width="([\d.]+)" height="([\d.]+)")re");
    std::string markup = whole_drawing(figure.file);
    std::smatch sides;
    if (!std::regex_search(markup, sides, size))
        throw input_error(figure.file.string() + ": a drawing without width and height");
    const double aspect = std::stod(sides[1]) / std::stod(sides[2]);
    constexpr std::string_view open = "<style>\n", close = "</style>\n";
    const std::size_t at = markup.find(open), end = markup.find(close, at);
    if (end != std::string::npos && !styles.insert(markup.substr(at, end - at)).second)
        markup.erase(at, end + close.size() - at);
    return {.markup = markup, .aspect = aspect};
}

std::string slide(const Figure& figure, std::set<std::string>& styles) {
    const std::string number = number_of(figure);
    if (figure.file.empty())
        throw input_error(fmt::format("figure {0} is not here: ./book run {1} makes it", number,
                                      number.substr(0, number.find('.'))));
    const Picture picture =
        figure.kind == "rendering" ? rendering(figure) : drawing(figure, styles);
    constexpr double wide = 1.9;  // from here on a caption beside it makes it no larger on 16 : 9
    return fmt::format(
        "<section class=\"slide{0}\" id=\"{1}\" aria-label=\"Figure {1}\">\n{2}"
        "<p class=\"caption\"><b>Figure {1}</b> {3}</p>\n</section>\n",
        picture.aspect < wide ? "" : " wide", number, picture.markup, xml_escaped(figure.caption));
}

std::string outline(std::string_view title, const std::vector<Figure>& figures) {
    std::string entries;
    for (const Figure& figure : figures)
        entries += fmt::format("<li><a href=\"#{0}\"><b>{0}</b> <span>{1}</span></a></li>\n",
                               number_of(figure), xml_escaped(figure.caption));
    return fmt::format(
        "<section class=\"slide outline\" id=\"outline\" aria-label=\"Outline\">\n<h1>{}</h1>\n"
        "<ol>\n{}</ol>\n<p class=\"keys\"><kbd>→</kbd> <kbd>←</kbd> on and back, step by step; "
        "<kbd>1</kbd> <kbd>2</kbd> <kbd>Enter</kbd> the twelfth figure; <kbd>Home</kbd> this "
        "outline; <kbd>F</kbd> full screen; <kbd>D</kbd> dark or light</p>\n</section>\n",
        xml_escaped(title), entries);
}

SlideShow show_of(const Chapter& chapter, const std::vector<Figure>& figures) {
    SlideShow show{.file = fmt::format("slides_{:02}.html", chapter.number),
                   .title = fmt::format("Chapter {}: {}", chapter.number, chapter.title),
                   .figures = {}};
    for (const Figure& figure : figures)
        if (figure.chapter == chapter.folder) show.figures.push_back(figure);
    return show;
}

}  // namespace

std::string slides(std::string_view title, const std::vector<Figure>& figures,
                   const std::filesystem::path& root, SlideMode mode) {
    const auto part = [&](const char* name) { return read_file(root / "docs" / name); };
    std::set<std::string> styles;
    std::string body = outline(title, figures);
    for (const Figure& figure : figures) body += slide(figure, styles);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"{}>\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<title>{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<main>\n{}</main>\n"
        "<script>\n{}{}</script>\n</body>\n</html>\n",
        mode == SlideMode::system  ? ""
        : mode == SlideMode::light ? " class=\"light-mode\""
                                   : " class=\"dark-mode\"",
        xml_escaped(title), part("steps.css"), part("slides.css"), body, part("steps.js"),
        part("slides.js"));
}

std::vector<SlideShow> slide_shows(const Places& places, const std::vector<std::string>& named) {
    const std::vector<Figure> figures = read_figures(places);
    const std::vector<Chapter> chapters = read_chapters(places.root);
    SlideShow chosen{.file = "slides.html", .title = "Splitting Space", .figures = {}};
    std::vector<SlideShow> shows;
    for (const std::string& name : named) {
        const auto chapter = std::ranges::find(chapters, name, &Chapter::folder);
        const auto figure = std::ranges::find(figures, name, &Figure::id);
        if (chapter != chapters.end())
            shows.push_back(show_of(*chapter, figures));
        else if (figure == figures.end())
            throw usage_error(fmt::format("{}: neither a chapter nor a figure", name));
        else if (std::ranges::find(chosen.figures, name, &Figure::id) == chosen.figures.end())
            chosen.figures.push_back(*figure);
    }
    if (!chosen.figures.empty()) shows.push_back(chosen);
    if (named.empty())
        for (const Chapter& chapter : chapters)
            if (const SlideShow show = show_of(chapter, figures); !show.figures.empty())
                shows.push_back(show);
    return shows;
}

}  // namespace space::docs
