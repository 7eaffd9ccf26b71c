#include "chapters/ch12_comparison/output_check.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>

namespace space {
namespace {

constexpr const char* streams[] = {"/dev/stdout", "/dev/stderr"};

/// Does what is printed go to this file?
bool is_redirected_to(const char* stream, const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) &&
           std::filesystem::equivalent(stream, file, error);
}

}  // namespace

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code error;
    const auto place = [&](const std::filesystem::path& file) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
    };
    return std::filesystem::equivalent(a, b, error) || place(a) == place(b);
}

void check_inputs_unprinted(std::span<const std::filesystem::path> inputs) {
    for (const std::filesystem::path& input : inputs)
        for (const char* stream : streams)
            if (is_redirected_to(stream, input))
                throw usage_error(fmt::format(
                    "{}: this is an input, and what is printed goes there", input.string()));
}

void check_output(std::string_view option, const std::filesystem::path& file,
                  std::span<const std::filesystem::path> inputs) {
    for (const std::filesystem::path& input : inputs)
        if (!input.empty() && is_same_file(file, input))
            throw usage_error(fmt::format("{} {}: this is an input", option, file.string()));
    for (const char* stream : streams)
        if (is_redirected_to(stream, file))
            throw usage_error(
                fmt::format("{} {}: what is printed goes there, too", option, file.string()));
    std::error_code error;
    const std::filesystem::path directory = file.parent_path();
    if (!directory.empty() && !std::filesystem::exists(directory, error))
        throw output_error(fmt::format("cannot write {}: there is no directory {}", file.string(),
                                       directory.string()));
    check_writable(file);
}

std::string name_fault(const std::string& name, std::string_view ending) {
    if (name.empty()) return "give the name of a file";
    std::string end = std::filesystem::path(name).extension().string();
    std::ranges::transform(end, end.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending.empty() || end == ending ? std::string()
                                           : fmt::format("'{}' does not end in {}", name, ending);
}

}  // namespace space
