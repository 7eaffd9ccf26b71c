#include "common/program/numbers.hpp"

#include "common/program/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace space {
namespace {

template <class Named>
void add_named(std::vector<Named>& all, Named one) {
    if (std::ranges::find(all, one.name, &Named::name) != all.end())
        throw std::logic_error(fmt::format("{} is given twice", one.name));
    all.push_back(std::move(one));
}

}  // namespace

void Numbers::add(Number number) {
    add_named(numbers_, std::move(number));
}
void Numbers::add(MarkdownTable table) {
    add_named(tables_, std::move(table));
}

void Numbers::count(const std::string& name, std::uint64_t value) {
    count(name, static_cast<double>(value), with_commas(value));
}
void Numbers::count(const std::string& name, double value, const std::string& text) {
    add(Number{name, text, value, true});
}
void Numbers::time(const std::string& name, double value, const std::string& text) {
    add(Number{name, text, value, false});
}
void Numbers::count_table(const std::string& name, const Table& table) {
    add(MarkdownTable{name, table.markdown(), true});
}
void Numbers::time_table(const std::string& name, const Table& table) {
    add(MarkdownTable{name, table.markdown(), false});
}

void Numbers::write(const std::filesystem::path& out, const Provenance& run) const {
    nlohmann::ordered_json document = run, numbers = nlohmann::ordered_json::object(),
                           tables = nlohmann::ordered_json::object();
    for (const Number& number : numbers_)
        numbers[number.name] = {
            {"text", number.text}, {"value", number.value}, {"count", number.count}};
    for (const MarkdownTable& table : tables_) {
        tables[table.name] = {{"count", table.count}};
        write_file(out / fmt::format("{}_{}.md", run.chapter.substr(0, 4), table.name), table.text);
    }
    document["numbers"] = numbers;
    document["tables"] = tables;
    write_file(out / "numbers.json", document.dump(1) + '\n');
}

std::string one_in(double share) {
    return fmt::format("{:.0f}", 1.0 / share);
}

std::string percent(double share) {
    const double value = 100.0 * share;
    const std::string text = fmt::format("{:.{}f}", value, std::abs(value) < 10.0 ? 1 : 0);
    return (text == "-0.0" ? "0.0" : text) + " %";
}

std::string power_of_ten(double value) {
    if (value == 0.0) return "0";
    const std::string text = fmt::format("{:.0e}", value);  // 4e-04
    const std::size_t e = text.find('e');
    const int exponent = std::stoi(text.substr(e + 1));
    return fmt::format("{}10<sup>{}{}</sup>",
                       text.substr(0, e) == "1" ? "" : text.substr(0, e) + "·",
                       exponent < 0 ? "−" : "", std::abs(exponent));
}

}  // namespace space
