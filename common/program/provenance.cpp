#include "common/program/provenance.hpp"

#include "common/program/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <regex>
#include <set>
#include <thread>
#include <vector>

namespace space {
namespace {

namespace fs = std::filesystem;

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            if (const std::size_t colon = line.find(": "); colon != std::string::npos)
                return line.substr(colon + 2);
    return "unknown processor";
}

/// The text without comments and white space. ("//" in a string passes for a comment.)
std::string bare_code(std::string_view text) {
    std::string code;
    while (!text.empty()) {
        std::size_t skipped = 0;
        if (text.starts_with("//"))
            skipped = std::min(text.find('\n'), text.size());
        else if (text.starts_with("/*"))
            skipped = std::min(text.find("*/", 2), text.size() - 2) + 2;
        else if (std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos)
            skipped = 1;
        if (skipped == 0) code += text.front();
        text.remove_prefix(std::max<std::size_t>(skipped, 1));
    }
    return code;
}

/// The code of the files directly in these folders, by their paths.
std::map<fs::path, std::string> code_in(std::initializer_list<fs::path> folders) {
    std::map<fs::path, std::string> code;
    for (const fs::path& folder : folders) {
        if (!is_directory(folder)) continue;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const fs::path& file = entry.path();
            if (file.filename() == "benchmarks.cpp") continue;
            if (file.extension() == ".hpp" || file.extension() == ".cpp")
                code[file] = bare_code(read_file(file));
        }
    }
    return code;
}

/// FNV-1a of 64 bits over names and code.
std::string fingerprint(const fs::path& root, const std::map<fs::path, std::string>& code) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&](std::string_view text) {
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    };
    for (const auto& [file, text] : code) {
        add(file.lexically_relative(root).generic_string());
        add(text);
    }
    return fmt::format("{:016x}", hash);
}

}  // namespace

std::string machine_description() {
#if defined(__clang__)
    const std::string compiler = fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#else
    const std::string compiler = fmt::format("g++ {}.{}", __GNUC__, __GNUC_MINOR__);
#endif
    return fmt::format("{}, {} cores, {}", processor_name(), std::thread::hardware_concurrency(),
                       compiler);
}

std::string today() {
    std::time_t now = std::time(nullptr);
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH"))
        now = static_cast<std::time_t>(std::atoll(epoch));
    std::tm date{};
    gmtime_r(&now, &date);
    return fmt::format("{:04}-{:02}-{:02}", date.tm_year + 1900, date.tm_mon + 1, date.tm_mday);
}

Fingerprints source_fingerprints(const fs::path& root, const std::string& chapter) {
    if (!is_directory(root / "chapters" / chapter)) return {};
    static const std::regex include(R"re(#include"chapters/(ch[^/"]*)/)re");
    Fingerprints prints;
    std::set<std::string> to_do{chapter};
    while (!to_do.empty()) {
        const std::string name = to_do.extract(to_do.begin()).value();
        const std::string folder = "chapters/" + name;
        const auto code = code_in({root / folder, root / folder / "measured"});
        prints[folder] = fingerprint(root, code);
        for (const auto& [file, text] : code)
            for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at)
                if (!prints.contains("chapters/" + at->str(1))) to_do.insert(at->str(1));
    }
    prints["common"] = fingerprint(root, code_in({root / "common", root / "common/scenes"}));
    return prints;
}

Provenance provenance(const std::string& chapter, const Options& options) {
    const char* mode = options.small    ? "small"
                       : options.counts ? "counts"
                       : options.quick  ? "quick"
                                        : "full";
    return {.chapter = chapter,
            .mode = mode,
            .machine = machine_description(),
            .date = today(),
            .sources = source_fingerprints(book_root(), chapter)};
}

void to_json(nlohmann::ordered_json& json, const Provenance& run) {
    json = {{"chapter", run.chapter},
            {"mode", run.mode},
            {"machine", run.machine},
            {"date", run.date},
            {"sources", run.sources}};
}

void from_json(const nlohmann::json& json, Provenance& run) {
    run = {.chapter = json.at("chapter"),
           .mode = json.at("mode"),
           .machine = json.at("machine"),
           .date = json.at("date"),
           .sources = json.at("sources")};
}

}  // namespace space
