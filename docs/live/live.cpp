#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace space::live {
namespace {

std::string json_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            result += c;
    }
    return result + '"';
}

/// Takes what stands before a sign, and the sign, from a text.
std::string_view cut(std::string_view& text, char sign) {
    const std::string_view part = text.substr(0, text.find(sign));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    return part;
}

/// A whole text that is a finite number, between the two; else `first`.
double number_of(std::string_view text, double first, double least, double most) {
    const std::string whole(text);
    char* end = nullptr;
    const double value = std::strtod(whole.c_str(), &end);
    if (whole.empty() || *end != '\0' || !std::isfinite(value)) return first;
    return std::clamp(value, least, most);
}

Double2 point_of(std::string_view text, const Double2& first, double least, double most) {
    const std::string_view x = cut(text, ',');
    return {number_of(x, first.x, least, most), number_of(text, first.y, least, most)};
}

template <class Items, class Text>
std::string list(const Items& items, const Text& text) {
    std::string result = "[";
    for (const auto& item : items) result += (result.size() > 1 ? "," : "") + text(item);
    return result + "]";
}

std::string pair_text(const Double2& p) {
    return fmt::format("[{},{}]", p.x, p.y);
}

std::string text(const Handle& h) {
    return fmt::format(R"({{"name":{},"label":{},"value":{},"zero":{},"unit":{}}})",
                       json_text(h.name), json_text(h.label), pair_text(h.value), pair_text(h.zero),
                       pair_text(h.unit));
}

std::string text(const Choice& c) {
    return fmt::format(R"({{"name":{},"label":{},"names":{},"chosen":{}}})", json_text(c.name),
                       json_text(c.label), list(c.names, json_text), c.chosen);
}

std::string text(const Slider& s) {
    return fmt::format(R"({{"name":{},"label":{},"value":{},"least":{},"most":{},"step":{}}})",
                       json_text(s.name), json_text(s.label), s.value, s.least, s.most, s.step);
}

std::string text(const Points& p) {
    return fmt::format(
        R"({{"name":{},"label":{},"values":{},"zero":{},"unit":{},"least":{},"most":{},)"
        R"("limit":{}}})",
        json_text(p.name), json_text(p.label), list(p.values, pair_text), pair_text(p.zero),
        pair_text(p.unit), p.least, p.most, p.limit);
}

std::string text(const Picture& p) {
    return fmt::format(
        R"({{"corner":{},"size":{},"width":{},"height":{},"first_row":{},"rows":{},"rays":{}}})",
        pair_text(Double2(p.corner)), pair_text(Double2(p.size)), p.width, p.height, p.first_row,
        p.rgba.size() / (4 * std::size_t(p.width)), p.rays);
}

template <class Part>
std::string text(const std::optional<Part>& part) {
    return part ? text(*part) : "null";
}
template <class Part>
std::string text(const std::vector<Part>& parts) {
    return list(parts, [](const Part& part) { return text(part); });
}

}  // namespace

State::State(std::string_view text) {
    while (!text.empty()) {
        std::string_view part = cut(text, ';');
        const std::string_view name = cut(part, '=');
        values_.emplace_back(name, part);
    }
}

std::optional<std::string_view> State::value(std::string_view name) const {
    for (const auto& [key, value] : values_)
        if (key == name) return value;
    return {};
}

double State::number(std::string_view name, double first, double least, double most) const {
    return number_of(value(name).value_or(""), first, least, most);
}

std::size_t State::whole(std::string_view name, std::size_t first, std::size_t least,
                         std::size_t most) const {
    return static_cast<std::size_t>(
        std::lround(number(name, double(first), double(least), double(most))));
}

Double2 State::point(std::string_view name, const Double2& first, double least, double most) const {
    return point_of(value(name).value_or(""), first, least, most);
}

std::size_t State::choice(std::string_view name, std::size_t first,
                          std::span<const std::string_view> names) const {
    const auto found = std::find(names.begin(), names.end(), value(name).value_or(""));
    return found == names.end() ? first : static_cast<std::size_t>(found - names.begin());
}

std::vector<Double2> State::points(std::string_view name, std::span<const Double2> first,
                                   double least, double most, std::size_t limit) const {
    std::optional<std::string_view> rest = value(name);
    if (!rest) return {first.begin(), first.end()};
    std::vector<Double2> points;
    while (!rest->empty() && points.size() < limit)
        if (const std::string_view part = cut(*rest, ' '); part.find(',') != part.npos)
            points.push_back(point_of(part, Double2((least + most) / 2), least, most));
    return points;
}

Reply reply_to(std::string_view request) {
    const std::string_view id = cut(request, ';');
    for (const LiveFigure& figure : live_figures()) {
        if (figure.id != id) continue;
        Answer answer = figure.answer(State(request));
        Reply reply{fmt::format(
            R"({{"svg":{},"summary":{},"handles":{},"choices":{},"sliders":{},"points":{},)"
            R"("picture":{}}})",
            json_text(answer.drawing.document(id)), json_text(answer.summary), text(answer.handles),
            text(answer.choices), text(answer.sliders), text(answer.points), text(answer.picture))};
        if (answer.picture) reply.pixels = std::move(answer.picture->rgba);
        return reply;
    }
    return {fmt::format(R"({{"error":{}}})", json_text(fmt::format("no live figure {}", id)))};
}

}  // namespace space::live
