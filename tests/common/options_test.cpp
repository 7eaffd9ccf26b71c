#include "common/program/options.hpp"

#include "common/program/error.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <CLI/CLI.hpp>

namespace space {
namespace {

const ProgramInfo program{.name = "ch00_test",
                          .about = "A test.",
                          .defaults = {.scene = "bunny", .seed = 7, .width = 320, .height = 200}};

Options parsed(std::vector<std::string> words, const std::function<void(CLI::App&)>& more = {}) {
    words.emplace(words.begin(), program.name);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    return parse_options(int(words.size()), arguments.data(), program, more);
}

/// The line of the usage error that the words cause.
std::string refusal(std::vector<std::string> words) {
    try {
        parsed(std::move(words));
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::usage);
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("without options the program's defaults hold, and every core works") {
    const Options options = parsed({});
    CHECK(options.scene == "bunny");
    CHECK(options.seed == 7);
    CHECK(options.width == 320);
    CHECK(options.height == 200);
    CHECK_FALSE(options.small);
    CHECK_FALSE(options.quick);
    CHECK(options.out == "build/out/ch00");  // not the folder that one stands in
    CHECK_FALSE(options.figure);
    CHECK(options.threads >= 1);
}

TEST_CASE("every option is understood") {
    const Options options =
        parsed({"--scene", "soup:500", "--small", "--quick", "--out", "there", "--threads", "3",
                "--seed", "18446744073709551615", "--size", "16384x1", "--figure", "fig_01_02"});
    CHECK(options.scene == "soup:500");
    CHECK(options.small);
    CHECK(options.quick);
    CHECK(options.out == "there");
    CHECK(options.threads == 3);
    CHECK(options.seed == 18446744073709551615u);
    CHECK(options.width == 16384);
    CHECK(options.height == 1);
    CHECK(options.figure == "fig_01_02");
}

TEST_CASE("numbers are decimal, whatever zeros they begin with") {
    const Options options = parsed({"--threads", "010", "--seed", "099", "--size", "0064x0048"});
    CHECK(options.threads == 10);
    CHECK(options.seed == 99);
    CHECK(options.width == 64);
    CHECK(options.height == 48);
}

TEST_CASE("a program can add options of its own") {
    int depth = 0;
    parsed({"--depth", "4"}, [&](CLI::App& app) { app.add_option("--depth", depth); });
    CHECK(depth == 4);
}

TEST_CASE("absurd options are refused in one line that names them") {
    const std::vector<std::vector<std::string>> absurd{{"--unknown"},
                                                       {"stray"},
                                                       {"--threads", "0"},
                                                       {"--threads", "-1"},
                                                       {"--threads", "many"},
                                                       {"--threads", "4000"},
                                                       {"--threads"},
                                                       {"--threads", "0x2"},
                                                       {"--threads", "+2"},
                                                       {"--threads", "4294967297"},
                                                       {"--seed", "-1"},
                                                       {"--seed", "x"},
                                                       {"--seed", "+1"},
                                                       {"--seed", "0x10"},
                                                       {"--seed", "1.5"},
                                                       {"--seed", "18446744073709551616"},
                                                       {"--seed", "99999999999999999999"},
                                                       {"--size", "640"},
                                                       {"--size", "0x480"},
                                                       {"--size", "640x480x3"},
                                                       {"--size", "-1x-1"},
                                                       {"--size", "99999999x2"},
                                                       {"--size", "16385x1"},
                                                       {"--size", "axb"},
                                                       {"--size", ""},
                                                       {"--size", "x"},
                                                       {"--size", "4x"},
                                                       {"--size", "+4x4"},
                                                       {"--size", " 4x4"},
                                                       {"--size", "4x 4"},
                                                       {"--size", "4x18446744073709551617"},
                                                       {"--seed", "1", "--seed", "2"}};
    for (const auto& words : absurd) {
        const std::string line = refusal(words);
        INFO(words.front() << (words.size() > 1 ? " " + words[1] : "") << " -> " << line);
        CHECK(!line.empty());
        CHECK(line.find('\n') == std::string::npos);
        CHECK(line.find(words.front()) != std::string::npos);
    }
}

TEST_CASE("--help names every option and exits with 0") {
    int code = -1;
    const std::string help = written_to(1, [&] {
        code = exit_code_of([] {
            parsed({"--help"});
            return 1;
        });
    });
    CHECK(code == 0);
    for (const char* option : {"A test.", "--scene", "--small", "--quick", "--out", "--figure",
                               "--threads", "--seed", "--size"})
        CHECK(help.find(option) != std::string::npos);
}

}  // namespace space
