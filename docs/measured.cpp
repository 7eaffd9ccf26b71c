#include "docs/measured.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/xml.hpp"
#include "docs/pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <vector>

namespace space::docs {
namespace fs = std::filesystem;

MeasuredRun read_measured(const fs::path& file, const std::string& tables_as) {
    try {
        const auto json = nlohmann::json::parse(read_file(file));
        MeasuredRun measured{.run = json.get<Provenance>(), .numbers = {}, .tables = {}};
        for (const auto& [name, number] : json.at("numbers").items())
            measured.numbers[name] = number.at("text");
        for (const auto& [name, table] : json.at("tables").items())
            measured.tables[name] = read_file(file.parent_path() / (tables_as + name + ".md"));
        return measured;
    } catch (const nlohmann::json::exception& fault) {
        throw input_error(fmt::format("{}: {}", file.string(), fault.what()));
    }
}

std::string told(const Provenance& run, const Fingerprints& now) {
    std::string text = fmt::format("Measured in a {} run on {}, on {}.", xml_escaped(run.mode),
                                   xml_escaped(run.machine), xml_escaped(run.date));
    if (run.mode == "quick") text += " It takes fewer sizes and rounds than the book's.";
    std::vector<std::string> changed;
    for (const auto& [folder, print] : run.sources)
        if (const auto at = now.find(folder); at == now.end() || at->second != print)
            changed.push_back(fmt::format("<code>{}</code>", xml_escaped(folder)));
    if (!changed.empty())
        text += fmt::format(" Since then the code in {} has changed.", fmt::join(changed, ", "));
    return text;
}

const Measured::Chapter& Measured::chapter(const std::string& name) {
    if (const auto known = chapters_.find(name); known != chapters_.end()) return known->second;
    Chapter& chapter = chapters_[name];
    const fs::path committed = root_ / "figures/measured" / (name + "_numbers.json"),
                   own = runs_ / name / "numbers.json";
    if (exists(committed)) chapter.committed = read_measured(committed, name + "_");
    if (exists(own) && (!exists(committed) || last_write_time(own) > last_write_time(committed))) {
        chapter.own = read_measured(own, name + "_");
        const std::string& mode = chapter.own.run.mode;
        if (mode != "full" && mode != "quick") chapter.own = {};
    }
    return chapter;
}

/// Whether nothing but empty lines and the text's ends stand beside these places.
static bool is_paragraph(const std::string& text, std::string::const_iterator begin,
                         std::string::const_iterator end) {
    const std::string_view before(text.begin(), begin), after(end, text.end());
    return (before.empty() || before.ends_with("\n\n")) &&
           (after.empty() || after.starts_with("\n"));
}

std::string Measured::resolved(const std::string& text, const std::string& name) {
    static const std::regex command(R"([\\@](num|table|measured)\{([^}]*)\})"),
        quoted(R"((ch\d\d)\.(\w+))"), whole(R"(ch\d\d)");
    std::string result;
    auto rest = text.begin();
    for (std::sregex_iterator at(text.begin(), text.end(), command), end; at != end; ++at) {
        result.append(rest, (*at)[0].first);
        rest = (*at)[0].second;
        const auto refuse = [&](const std::string& why) {
            return input_error(fmt::format("{}:{}: {}: {}", name,
                                           1 + std::count(text.begin(), (*at)[0].first, '\n'),
                                           at->str(0), why));
        };
        const std::string kind = at->str(1), what = at->str(2);
        std::smatch names;
        if (!std::regex_match(what, names, kind == "measured" ? whole : quoted))
            throw refuse(kind == "measured"
                             ? "expected a chapter, such as ch03"
                             : "expected a chapter and a name, such as ch03.deepest");
        const std::string short_name = what.substr(0, 4);
        const Chapter& chapter = this->chapter(short_name);
        if (kind == "measured") {
            const Provenance& run =
                (chapter.own.run.mode.empty() ? chapter.committed : chapter.own).run;
            if (run.mode.empty())
                throw refuse(fmt::format("there is no figures/measured/{}_numbers.json", what));
            result += told(run, source_fingerprints(root_, run.chapter));
            continue;
        }
        if (kind == "table" && !is_paragraph(text, (*at)[0].first, (*at)[0].second))
            throw refuse("a table is a paragraph of its own, or its bars and dashes are shown");
        const auto values = kind == "num" ? &MeasuredRun::numbers : &MeasuredRun::tables;
        const std::map<std::string, std::string>* found = nullptr;
        for (const MeasuredRun* run : {&chapter.committed, &chapter.own})
            if ((run->*values).contains(names[2])) found = &(run->*values);
        if (!found)
            throw refuse(fmt::format("figures/measured/{}_numbers.json has no such {}", short_name,
                                     kind == "num" ? "number" : "table"));
        result += found->at(names[2]);
    }
    return result.append(rest, text.end());
}

}  // namespace space::docs
