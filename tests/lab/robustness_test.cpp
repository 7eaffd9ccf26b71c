// What the lab, the renderer and a chapter's program do where users, disks and terminals fail.
#include "common/mesh.hpp"
#include "common/program/file.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/lab/process.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace space;

namespace {

const Command program{.words = {LAB_PROGRAM}};
const Command lab = program.with("lab --scene soup:50 --structure naive --repeat 1");
const Command render = program.with("render --scene box --size 16x12 --samples 1");

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    return first == text.npos ? "" : text.substr(first, last - first + 1);
}

/// A line of commands.txt.
struct Line {
    int code;
    std::vector<std::string> words;
    std::string told;
};

std::string filled_in(std::string word, const Workbench& bench) {
    if (word == "''") return "";
    const std::pair<std::string, std::string> meant[] = {{"{long}", std::string(100'000, 'x')},
                                                         {"{bytes}", "\xff\xfe\x80"},
                                                         {"{dir}", (bench / "").string()},
                                                         {"{mesh}", (bench / "mesh.ply").string()},
                                                         {"{full}", "/dev/full"}};
    for (const auto& [name, text] : meant)
        if (const std::size_t at = word.find(name); at != word.npos)
            word.replace(at, name.size(), text);
    return word;
}

std::vector<Line> read_lines(const Workbench& bench) {
    std::istringstream text(read_file(book_root() / "tests/lab/commands.txt"));
    std::vector<Line> lines;
    for (std::string line; std::getline(text, line);) {
        if (line.empty() || line.front() == '#') continue;
        const std::size_t first = line.find('|'), last = line.rfind('|');
        Line& read = lines.emplace_back();
        read.code = std::stoi(line.substr(0, first));
        std::istringstream words(line.substr(first + 1, last - first - 1));
        for (std::string word; words >> word;) read.words.push_back(filled_in(word, bench));
        read.told = trimmed(line.substr(last + 1));
    }
    return lines;
}

std::set<std::string> names_in(const Workbench& bench) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(bench / ""))
        names.insert(entry.path().filename().string());
    return names;
}

/// The command, run by a shell that does this before.
Command after(const std::string& shell, const Command& command) {
    return Command{.words = {"bash", "-c"}}.with_word(shell).with_word("bash").with(command);
}

}  // namespace

TEST_CASE(
    "whatever is asked, the exit code and one line of less than 2,100 letters say what is wrong") {
    const Workbench bench;
    write_ply(bench / "mesh.ply", {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}},
                                   .faces = {{0, 1, 2}, {1, 2, 3}, {0, 1, 3}}});
    const std::vector<Line> lines = read_lines(bench);
    REQUIRE(lines.size() > 100);
    for (const Line& line : lines) {
        Command command = program;
        for (const std::string& word : line.words)
            if (word != "chapter") command = command.with_word(word);
        const std::set<std::string> before = names_in(bench);
        const Ended ended = run(command);
        INFO(command.text().substr(0, 300) << "\n" << ended.err);
        CHECK(ended.code == line.code);
        CHECK(std::ranges::count(ended.err, '\n') == (line.code == 0 ? 0 : 1));
        CHECK(ended.err.size() < 2'100);
        CHECK(ended.err.find(line.told) != std::string::npos);
        if (line.code == 0) continue;
        const std::string name = line.words[0] == "chapter" ? "ch12_comparison" : line.words[0];
        CHECK(ended.err.starts_with(name + ": "));
        CHECK(ended.out.empty());
        CHECK(names_in(bench) == before);
    }
}

TEST_CASE("closed streams end a run in exit code 0 or 4, and no file holds what was printed") {
    for (const char* closed :
         {"0<&-", "1>&-", "2>&-", "0<&- 1>&-", "1>&- 2>&-", "0<&- 1>&- 2>&-"}) {
        const bool prints_nowhere = std::string(closed).find("1>") != std::string::npos;
        for (const bool is_lab : {true, false}) {
            const Workbench bench;
            const Command command = is_lab ? lab.with("--size 16x12")
                                                 .with("--json", bench / "a")
                                                 .with("--hits", bench / "b")
                                           : render.with("--out", bench / "a.png");
            const Ended ended = run(after(std::string("exec \"$@\" ") + closed, command));
            INFO(command.text() << closed << ended.err);
            CHECK(ended.code == (prints_nowhere ? 4 : 0));
            if (is_lab) {
                CHECK(nlohmann::json::parse(read_file(bench / "a"))["version"].is_number());
                CHECK(read_file(bench / "b").size() == 16 * 12 * 16);
            } else {
                CHECK(read_file(bench / "a.png").starts_with("\x89PNG"));
            }
            CHECK(names_in(bench).size() == 2);
        }
    }
}

TEST_CASE(
    "where standard error cannot be written, a run goes on, and an error keeps its exit code") {
    const Workbench bench;
    write_file(bench / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n");
    const auto code = [](const Command& command) {
        return run(after("exec \"$@\" 2>/dev/full", command)).code;
    };
    CHECK(code(lab.with("--size 4x3")) == 0);
    CHECK(code(program.with("lab --structure naive --repeat 1 --mesh").with(bench / "a.obj")) == 0);
    CHECK(code(lab.with("--nonsense")) == 2);
    CHECK(code(program.with("lab --mesh").with(bench / "none.ply")) == 3);
    CHECK(code(lab.with("--json").with(bench / "none/a")) == 4);
    CHECK(code(lab.with("--size 4x3 --json -")) == 4);  // the tables go there
    CHECK(code(render.with("--out", bench / "a.png")) == 0);
    // Long enough for its progress to be told.
    CHECK(code(program.with("render --scene box --size 160x120 --samples 1000000 --time 1.5 --out")
                   .with(bench / "b.png")) == 0);
}

TEST_CASE("a run that is killed leaves the files of before or whole ones, and the next goes on") {
    const Workbench bench;
    const Command writes = program.with("lab --scene soup:50 --structure naive --repeat 1")
                               .with("--hits", bench / "hits")
                               .with("--json", bench / "json");
    REQUIRE(run(writes).code == 0);
    const std::string hits = read_file(bench / "hits");
    // In the middle of writing: by the system's signal at a file of more than 4 KB.
    const Ended cut = run(after("ulimit -c 0; ulimit -f 4; exec \"$@\"", writes));
    CHECK(cut.code > 128);
    CHECK(read_file(bench / "hits") == hits);
    const auto killed_after = [](double seconds, const Command& command) {
        run(after(fmt::format("\"$@\" & sleep {}; kill -KILL $!; wait $!", seconds), command));
    };
    for (const double seconds : {0.01, 0.02, 0.05, 0.1}) {
        killed_after(seconds, writes);
        CHECK(read_file(bench / "hits") == hits);
        CHECK(nlohmann::json::parse(read_file(bench / "json"))["version"].is_number());
    }
    CHECK(run(writes).code == 0);

    const Command picture =
        program.with("render --scene box --size 64x48 --out").with(bench / "a.png");
    REQUIRE(run(picture.with("--samples 1")).code == 0);
    for (const double seconds : {0.02, 0.1, 0.3}) {
        killed_after(seconds, picture.with("--samples 1000000 --resume"));
        CHECK(read_file(bench / "a.png").starts_with("\x89PNG"));
        CHECK(run(picture.with("--samples 2 --resume")).code == 0);
    }
}

TEST_CASE("nothing is written where the folder takes no file") {
    // /proc takes none of anybody; a user other than root is refused in a folder of their own, too.
    const Workbench bench;
    std::filesystem::create_directory(bench / "kept");
    std::filesystem::permissions(
        bench / "kept", std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    std::vector<std::filesystem::path> folders{"/proc"};
    if (::geteuid() != 0) folders.push_back(bench / "kept");
    for (const std::filesystem::path& folder : folders)
        for (const Command& command :
             {lab.with("--size 4x3 --json").with(folder / "a"),
              lab.with("--size 4x3 --csv").with(folder / "a"),
              program.with("lab --scene soup:50 --structure fast --picture").with(folder / "a.png"),
              render.with("--out", folder / "a.png"), program.with("--small --out").with(folder)}) {
            const Ended ended = run(command);
            INFO(command.text() << ": " << ended.err);
            CHECK(ended.code == 4);
            CHECK(std::ranges::count(ended.err, '\n') == 1);
            CHECK(ended.out.empty());
        }
}

#ifndef BOOK_SANITIZED  // other tests take the same ways
TEST_CASE(
    "every command of the lab's page runs as it stands there, and so do its lines of Python") {
    const Workbench bench;
    std::filesystem::create_directory(bench / "build");
    const TriangleMesh mesh = make_scene("tree:3").mesh;
    write_ply(bench / "bunny.ply", mesh);
    std::string obj;
    for (const Point3& v : mesh.vertices) obj += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    for (const auto& f : mesh.faces)
        obj += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    write_file(bench / "your_mesh.obj", obj);

    const std::string page = read_file(book_root() / "chapters/ch12_comparison/lab.dox");
    const auto in_place = [&](const Command& command) {
        return run(after(fmt::format("cd '{}' && exec \"$@\"", (bench / ".").string()), command));
    };
    const bool has_python = in_place(Command{.words = {"python3", "-c", ""}}).code == 0;
    const std::regex code(R"(\\code\{\.(sh|py|json)\}\n([^]*?)\\endcode)");
    std::size_t commands = 0;
    for (std::sregex_iterator at(page.begin(), page.end(), code), end; at != end; ++at) {
        const std::string kind = at->str(1), text = at->str(2);
        if (kind == "json")
            for (const char* file : {"your_scene.json", "garden.json"})
                write_file(bench / file, text);
    }
    for (std::sregex_iterator at(page.begin(), page.end(), code), end; at != end; ++at) {
        const std::string kind = at->str(1), text = at->str(2);
        std::istringstream lines(text);
        for (std::string line; kind == "sh" && std::getline(lines, line);) {
            // Smaller, so that naive tracing takes no minutes.
            for (const auto& [large, small] : {std::pair("#.*| --(size|repeat) [0-9x]+", ""),
                                               {"--(samples|diffuse) [0-9]+", "--$1 20"},
                                               {"--time [0-9]+", "--time 0.1"},
                                               {"sphereflake:3", "sphereflake:1"}})
                line = std::regex_replace(line, std::regex(large), small);
            if (!line.starts_with("./book ")) continue;
            ++commands;
            const auto holds = [&](const char* word) { return line.find(word) != line.npos; };
            const bool is_lab = line.starts_with("./book lab ");
            const bool as_it_stands = holds("list") || holds("--advise");
            const Command small = program.with(line.substr(7))
                                      .with(as_it_stands || holds("--rays") ? "" : "--size 16x12")
                                      .with(as_it_stands ? ""
                                            : is_lab     ? "--repeat 1"
                                                         : "--photons 99");
            const Ended ended = in_place(small);
            INFO(line << ": " << ended.err);
            // The triangles of its instances lie elsewhere, by their roundings.
            const bool may_disagree = holds("bvh-instanced-local") && holds("--check");
            CHECK((ended.code == 0 || (may_disagree && ended.code == 1)));
        }
        if (kind != "py" || !has_python) continue;
        const Ended ended = in_place(Command{.words = {"python3", "-c"}}.with_word(text));
        INFO(text << ended.err);
        CHECK(ended.code == 0);
    }
    CHECK(commands > 20);
}
#endif
