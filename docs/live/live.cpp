#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace space::live {
namespace {

std::string quoted(std::string_view text) {
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

/// A whole text that is a finite number, between the two; else `first`.
double number_of(const std::string& text, double first, double least, double most) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value)) return first;
    return std::clamp(value, least, most);
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

}  // namespace

State::State(std::string_view text) {
    while (!text.empty()) {
        const std::string_view part = text.substr(0, text.find(';'));
        text.remove_prefix(std::min(part.size() + 1, text.size()));
        if (const std::size_t equals = part.find('='); equals != part.npos)
            values_.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    }
}

std::string_view State::value(std::string_view name) const {
    for (const auto& [key, value] : values_)
        if (key == name) return value;
    return {};
}

double State::number(std::string_view name, double first, double least, double most) const {
    return number_of(std::string(value(name)), first, least, most);
}

Double2 State::point(std::string_view name, const Double2& first, double least, double most) const {
    const std::string_view text = value(name);
    const std::size_t comma = std::min(text.find(','), text.size());
    return {number_of(std::string(text.substr(0, comma)), first.x, least, most),
            number_of(std::string(text.substr(std::min(comma + 1, text.size()))), first.y, least,
                      most)};
}

std::size_t State::choice(std::string_view name, std::size_t first,
                          std::span<const std::string_view> names) const {
    const auto found = std::find(names.begin(), names.end(), value(name));
    return found == names.end() ? first : static_cast<std::size_t>(found - names.begin());
}

std::string answer_text(std::string_view request) {
    const std::string_view id = request.substr(0, request.find(';'));
    const State state(request.substr(std::min(id.size() + 1, request.size())));
    for (const LiveFigure& figure : live_figures()) {
        if (figure.id != id) continue;
        const Answer answer = figure.answer(state);
        return fmt::format(
            "{{\"svg\":{},\"summary\":{},\"handles\":{},\"choices\":{},\"sliders\":{}}}",
            quoted(answer.drawing.document(id)), quoted(answer.summary),
            list(answer.handles,
                 [](const Handle& h) {
                     return fmt::format(
                         "{{\"name\":{},\"label\":{},\"value\":{},\"zero\":{},\"unit\":{}}}",
                         quoted(h.name), quoted(h.label), pair_text(h.value), pair_text(h.zero),
                         pair_text(h.unit));
                 }),
            list(answer.choices,
                 [](const Choice& c) {
                     return fmt::format("{{\"name\":{},\"label\":{},\"names\":{},\"chosen\":{}}}",
                                        quoted(c.name), quoted(c.label),
                                        list(c.names, [](auto name) { return quoted(name); }),
                                        c.chosen);
                 }),
            list(answer.sliders, [](const Slider& s) {
                return fmt::format(
                    "{{\"name\":{},\"label\":{},\"value\":{},\"least\":{},"
                    "\"most\":{},\"step\":{}}}",
                    quoted(s.name), quoted(s.label), s.value, s.least, s.most, s.step);
            }));
    }
    return fmt::format("{{\"error\":{}}}", quoted(fmt::format("no live figure {}", id)));
}

}  // namespace space::live
