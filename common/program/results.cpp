#include "common/program/results.hpp"

#include "common/program/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace space {
namespace {

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            if (const std::size_t colon = line.find(": "); colon != std::string::npos)
                return line.substr(colon + 2);
    return "unknown processor";
}

}  // namespace

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::confirmed:
            return "confirmed";
        case Verdict::refuted:
            return "refuted";
        case Verdict::depends:
            return "depends";
    }
    return "";
}

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

void write_results(const std::filesystem::path& file, const Results& results) {
    nlohmann::ordered_json answers = nlohmann::ordered_json::array();
    for (const ClaimAnswer& answer : results.answers)
        answers.push_back({{"claim", answer.claim},
                           {"verdict", name(answer.verdict)},
                           {"measured", answer.measured},
                           {"scene", answer.scene},
                           {"rule", answer.rule}});
    const nlohmann::ordered_json document{{"chapter", results.chapter},
                                          {"small", results.small},
                                          {"machine", machine_description()},
                                          {"date", today()},
                                          {"answers", answers}};
    write_file(file, document.dump(2) + '\n');
}

}  // namespace space
