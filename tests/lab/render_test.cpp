// ./book render from outside, as a program that reads and writes files.
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/mesh.hpp"
#include "common/program/file.hpp"
#include "tests/catch.hpp"
#include "tests/lab/process.hpp"

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace space;

namespace {

const Command render{.words = {LAB_PROGRAM, "render"}};
const Command small_box = render.with("--scene box --size 16x12");

std::string bytes_of(const Command& command, const std::filesystem::path& picture) {
    const Ended ended = run(command.with("--out", picture));
    INFO(command.text() << ": " << ended.err);
    REQUIRE(ended.code == 0);
    return read_file(picture);
}

void write_triangle(const std::filesystem::path& file) {
    write_ply(file, {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}});
}

std::size_t files_in(const Workbench& bench) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(bench / "."))
        ++count;
    return count;
}

}  // namespace

TEST_CASE("a picture has the same bytes for any number of threads and every exact structure") {
    const Workbench bench;
    const Command two = small_box.with("--samples 2");
    const std::string picture = bytes_of(two, bench / "a.png");
    CHECK(picture.starts_with("\x89PNG"));
    CHECK(bytes_of(two.with("--threads 1"), bench / "b.png") == picture);
    CHECK(bytes_of(two.with("--threads 3"), bench / "b.png") == picture);
    CHECK(bytes_of(two.with("--seed 2"), bench / "b.png") != picture);
    for (const Structure& structure : structures()) {
        CAPTURE(structure.name);
        CHECK(bytes_of(two.with("--structure").with_word(std::string(structure.name)),
                       bench / "b.png") == picture);
    }
}

TEST_CASE("a picture that was put aside and gone on with has the bytes of one in a single go") {
    const Workbench bench;
    for (const char* method : {"path", "photons", "cache"}) {
        CAPTURE(method);
        const Command one = small_box.with("--photons 2000 --method").with(method);
        const auto outputs = [&](const char* name) {
            return Command{}
                .with("--out", bench / (std::string(name) + ".png"))
                .with("--hdr", bench / (std::string(name) + ".hdr"));
        };
        REQUIRE(run(one.with("--samples 5").with(outputs("whole"))).code == 0);
        REQUIRE(run(one.with("--samples 2").with(outputs("parts"))).code == 0);
        CHECK(read_file(bench / "parts.hdr") != read_file(bench / "whole.hdr"));
        REQUIRE(run(one.with("--samples 3 --threads 3 --resume").with(outputs("parts"))).code == 0);
        REQUIRE(run(one.with("--samples 5 --structure bvh-binned --resume").with(outputs("parts")))
                    .code == 0);
        for (const char* ending : {".png", ".hdr", ".png.state"})
            CHECK(read_file(bench / (std::string("parts") + ending)) ==
                  read_file(bench / (std::string("whole") + ending)));
        const Ended more = run(one.with("--samples 4 --resume").with(outputs("parts")));
        CHECK(more.code == 0);
        CHECK(more.out.find("5 samples a pixel") != std::string::npos);
    }
}

TEST_CASE("the state of another picture, a damaged one or none is refused in one line") {
    const Workbench bench;
    const Command two = small_box.with("--samples 2").with("--out", bench / "a.png");
    REQUIRE(run(two).code == 0);
    const std::string picture = read_file(bench / "a.png"),
                      state = read_file(bench / "a.png.state");
    const auto refused = [&](const Command& command, std::string_view told) {
        const Ended ended = run(command.with("--resume"));
        INFO(command.text() << ": " << ended.err);
        CHECK(ended.code == 3);
        CHECK(std::ranges::count(ended.err, '\n') == 1);
        CHECK(ended.err.starts_with("render: "));
        CHECK(ended.err.find(told) != std::string::npos);
        CHECK(read_file(bench / "a.png") == picture);
    };
    refused(two.with("--seed 7"), "it has seed=1, not seed=7");
    refused(two.with("--method photons"), "it has method=path, not method=photons");
    refused(render.with("--scene box --size 16x13").with("--out", bench / "a.png"),
            "it has size=16x12, not size=16x13");
    refused(render.with("--scene near --size 16x12").with("--out", bench / "a.png"), "not scene=");
    CHECK(read_file(bench / "a.png.state") == state);
    for (const std::size_t at : {std::size_t{0}, state.size() / 2, state.size() - 1}) {
        std::string damaged = state;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        write_file(bench / "a.png.state", damaged);
        refused(two, "a.png.state: ");
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{30}, state.size() - 24}) {
        write_file(bench / "a.png.state", state.substr(0, size));
        refused(two, "a.png.state: ");
    }
    std::filesystem::remove(bench / "a.png.state");
    refused(two, "a.png.state: not there: begin without --resume");
}

TEST_CASE("a mesh that has changed is another picture") {
    const Workbench bench;
    write_triangle(bench / "mesh.ply");
    const Command command = render.with("--mesh", bench / "mesh.ply")
                                .with("--size 8x6 --samples 1")
                                .with("--out", bench / "a.png");
    REQUIRE(run(command).code == 0);
    REQUIRE(run(command.with("--samples 2 --resume")).code == 2);  // given twice
    REQUIRE(run(command.with("--resume")).code == 0);
    write_ply(bench / "mesh.ply",
              {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1.5f, 0}}, .faces = {{0, 1, 2}}});
    const Ended ended = run(command.with("--resume"));
    CHECK(ended.code == 3);
    CHECK(ended.err.find("of another picture") != std::string::npos);
}

TEST_CASE("SIGINT and SIGTERM end a picture after the pass, with whole files that go on") {
    const Workbench bench;
    for (const int signal : {SIGINT, SIGTERM}) {
        const std::filesystem::path picture = bench / "a.png";
        // Signalled once its first files are there, or after a while.
        const Command ended_early =
            Command{.words = {"bash", "-c"}}
                .with_word("\"${@:2}\" & job=$!; sleep " + std::to_string(sized(1, 4)) +
                           "; kill -" + std::to_string(signal) + " $job; wait $job")
                .with_word("bash")
                .with_word("-")
                .with(small_box)
                .with("--samples 1000000")
                .with("--out", picture);
        const Ended ended = run(ended_early);
        INFO(ended.err);
        CHECK(ended.code == 128 + signal);
        CHECK(ended.err.find("--resume goes on") != std::string::npos);
        CHECK(read_file(picture).starts_with("\x89PNG"));
        CHECK(run(small_box.with("--samples 1 --resume").with("--out", picture)).code == 0);
        CHECK(files_in(bench) == 2);
    }
}

TEST_CASE("after one signal another ends the program at once, whichever they are") {
    const Workbench bench;
    // A pass that takes longer than anyone waits.
    const Command long_pass = render.with("--scene box --size 4000x3000 --threads 1 --samples 1")
                                  .with("--out", bench / "a.png");
    for (const auto& [first, second] : {std::pair{SIGINT, SIGTERM}, std::pair{SIGTERM, SIGINT}}) {
        const Command twice =
            Command{.words = {"bash", "-c"}}
                .with_word(
                    "\"${@:3}\" > \"$2\" & job=$!; until grep -q method \"$2\"; do sleep 0.1; "
                    "done; kill -" +
                    std::to_string(first) + " $job; sleep 0.2; kill -" + std::to_string(second) +
                    " $job; wait $job")
                .with_word("bash")
                .with_word("-")
                .with(bench / "out")
                .with(long_pass);
        const Ended ended = run(twice);
        INFO(ended.err);
        CHECK(ended.code == 128 + second);
        CHECK(ended.err.find("render:") == std::string::npos);
        CHECK_FALSE(std::filesystem::exists(bench / "a.png"));
    }
}

TEST_CASE("a map of fewer photons than an estimate takes lights a picture, too") {
    const Workbench bench;
    const auto picture = [&](const char* photons) {
        return bytes_of(small_box.with("--samples 1 --method photons --photons").with(photons),
                        bench / "a.png");
    };
    CHECK(picture("20") != picture("10"));
}

TEST_CASE("--camera shows the scene from elsewhere, and a state from there is another picture's") {
    const Workbench bench;
    const Command one = render.with("--scene sphereflake:1 --size 16x12 --samples 1");
    const Command high = one.with("--camera 0,30,1,0,0,0,40").with("--out", bench / "a.png");
    CHECK(bytes_of(one, bench / "b.png") !=
          bytes_of(one.with("--camera 0,30,1,0,0,0,40"), bench / "a.png"));
    CHECK(run(high.with("--resume")).code == 0);
    const Ended other = run(one.with("--resume").with("--out", bench / "a.png"));
    CHECK(other.code == 3);
    CHECK(other.err.find("of another picture") != std::string::npos);
}

TEST_CASE("--time ends a picture earlier, with at least one sample") {
    const Workbench bench;
    const Ended ended =
        run(small_box.with("--samples 1000000 --time 0").with("--out", bench / "a.png"));
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    CHECK(ended.out.find("1 sample a pixel") != std::string::npos);
    const Command more =
        small_box.with("--samples 1000000 --time 0.3 --resume").with("--out", bench / "a.png");
    CHECK(run(more).code == 0);
    CHECK(run(more).code == 0);
}

TEST_CASE("wrong input gets one clear line and its exit code, and leaves no file") {
    const Workbench bench;
    write_file(bench / "empty.obj", "");
    write_file(bench / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_file(bench / "file", "");
    write_triangle(bench / "mesh.ply");
    const std::size_t files = files_in(bench);
    const Command scene = render.with("--scene box --size 4x3 --samples 1"),
                  out = Command{}.with("--out", bench / "a.png");
    struct Wrong {
        Command command;
        int code;
        std::string_view told;
    };
    const std::vector<Wrong> wrongs{
        {render.with(out), 2, "give --scene NAME or --mesh FILE"},
        {scene, 2, "give --out FILE.png"},
        {scene.with("--out").with_word(""), 2, "--out"},
        {scene.with("--out", bench / "a.jpg"), 2, "does not end in .png"},
        {scene.with(out).with("--hdr", bench / "a.exr"), 2, "does not end in .hdr"},
        {scene.with(out).with("--mesh", bench / "mesh.ply"), 2, "--mesh"},
        {render.with("--scene nonsense").with(out), 2, "no scene is called 'nonsense'"},
        {render.with("--scene nonsense").with(out), 2, "one of furnace, "},
        {render.with("--scene nonsense").with(out), 2, ", sphereflake, "},
        {render.with("--scene ring:3").with(out), 2, "ring: it has no size, '3'"},
        {render.with("--scene soup:0").with(out), 2, "soup"},
        {render.with("--scene").with_word("").with(out), 2, "--scene"},
        {render.with("--mesh box").with(out), 3, "box"},
        {render.with("--mesh").with_word("").with(out), 2, "--mesh"},
        {render.with("--mesh", bench / "none.ply").with(out), 3, "none.ply"},
        {render.with("--mesh", bench / "empty.obj").with(out), 3, "empty.obj"},
        {render.with("--mesh", bench / "nan.obj").with(out), 3, "nan.obj"},
        {scene.with(out).with("--method guess"), 2, "--method"},
        {scene.with(out).with("--structure nonsense"), 2, "--structure nonsense"},
        {render.with("--scene box --samples 0").with(out), 2, "--samples 0"},
        {render.with("--scene box --samples 1e9").with(out), 2, "--samples 1e9"},
        {scene.with(out).with("--time -1"), 2, "--time -1"},
        {scene.with(out).with("--time nan"), 2, "--time nan"},
        {scene.with(out).with("--time 5s"), 2, "--time 5s"},
        {scene.with(out).with("--exposure 0"), 2, "--exposure 0"},
        {scene.with(out).with("--exposure inf"), 2, "--exposure inf"},
        {scene.with(out).with("--accuracy 0"), 2, "--accuracy 0"},
        {scene.with(out).with("--photons 0"), 2, "--photons 0"},
        {scene.with(out).with("--threads 0"), 2, "--threads"},
        {render.with("--scene box --size 0x3").with(out), 2, "--size"},
        {render.with("--scene box --size 16384x16384").with(out), 2, "--size"},
        {scene.with(out).with("--camera 0,0,9,0,0,8"), 2, "seven numbers"},
        {scene.with(out).with("--camera nan,0,9,0,0,8,45"), 2, "nan"},
        {scene.with(out).with("--camera 1,2,3,1,2,3,45"), 2, "eye"},
        {scene.with(out).with("--camera 0,0,9,0,0,8,180"), 2, "field of view"},
        {render.with("--mesh", bench / "mesh.ply").with(out).with("--camera 3e38,3e38,9,0,0,8,45"),
         3, "too large"},
        {scene.with(out).with("--no-such-option"), 2, "--no-such-option"},
        {scene.with("--out", bench / "none/a.png"), 4, "there is no directory"},
        {scene.with("--out", bench / "file/a.png"), 4, "Not a directory"},
        {scene.with("--out /dev/null/a.png"), 4, "/dev/null"},
        {scene.with("--out /proc/a.png"), 4, "/proc/a.png"},
    };
    for (const Wrong& wrong : wrongs) {
        const Ended ended = run(wrong.command);
        INFO(wrong.command.text() << ": " << ended.err);
        CHECK(ended.code == wrong.code);
        CHECK(std::ranges::count(ended.err, '\n') == 1);
        CHECK(ended.err.starts_with("render: "));
        CHECK(ended.err.find(wrong.told) != std::string::npos);
        CHECK(ended.out.empty());
        CHECK(files_in(bench) == files);
    }
}

TEST_CASE("no output is an input or another output") {
    const Workbench bench;
    write_triangle(bench / "mesh.ply");
    std::filesystem::create_symlink(bench / "mesh.ply", bench / "a.png");
    std::filesystem::create_symlink(bench / "mesh.ply", bench / "b.png.state");
    write_file(bench / "c.png", "");
    std::filesystem::create_symlink(bench / "c.png", bench / "c.hdr");
    const std::string mesh = read_file(bench / "mesh.ply");
    const Command command = render.with("--mesh", bench / "mesh.ply").with("--size 4x3");
    const auto refused = [&](const Command& with_output, std::string_view told) {
        const Ended ended = run(with_output);
        INFO(with_output.text() << ": " << ended.err);
        CHECK(ended.code == 2);
        CHECK(ended.err.find(told) != std::string::npos);
        CHECK(read_file(bench / "mesh.ply") == mesh);
    };
    refused(command.with("--out", bench / "a.png"), "this is an input");
    refused(command.with("--out", bench / "b.png"), "this is an input");
    refused(command.with("--out", bench / "c.png").with("--hdr", bench / "c.hdr"), "the same file");
}

TEST_CASE("a full disk is an error in one line, and the files of before stay whole") {
    const Workbench bench;
    const Command full = Command{.words = {"bash", "-c"}}
                             .with_word("ulimit -f 4; trap '' XFSZ; exec \"$@\"")
                             .with_word("bash");
    const Command command =
        render.with("--scene box --size 64x48 --samples 1").with("--out", bench / "a.png");
    const Ended ended = run(full.with(command));
    INFO(ended.err);
    CHECK(ended.code == 4);
    CHECK(std::ranges::count(ended.err, '\n') == 1);
    CHECK(ended.err.starts_with("render: cannot write "));
    CHECK(files_in(bench) == 0);
    const Ended unprinted =
        run(small_box.with("--samples 1").with("--out", bench / "a.png"), "/dev/full");
    CHECK(unprinted.code == 4);
}

TEST_CASE("list names all lit scenes and structures") {
    const Ended scenes = run(render.with("--scene list"));
    CHECK(scenes.code == 0);
    for (const LitSceneRecipe& recipe : lit_scene_recipes())
        CHECK(scenes.out.find("\n" + std::string(recipe.name) + " ") != std::string::npos);
    CHECK(scenes.out.find("\nsphereflake ") != std::string::npos);
    const Ended listed = run(render.with("--structure list"));
    CHECK(listed.code == 0);
    CHECK(listed.out.find("\nfast ") != std::string::npos);
}

TEST_CASE("what ./book render --help shows before it is built is its own help") {
    const std::string kept = read_file(book_root() / "chapters/ch12_comparison/render_help.txt");
    const Ended help = run(render.with("--help"));
    REQUIRE(help.code == 0);
    // Versions of CLI11 set lines differently: the options' names and all that is below them count.
    const auto options = [](const std::string& text) {
        std::istringstream stream(text);
        std::set<std::string> names;
        for (std::string word; stream >> word;)
            if (word.starts_with("--")) names.insert(word);
        return names;
    };
    INFO(
        "build/release/bin/ch12_comparison render --help > "
        "chapters/ch12_comparison/render_help.txt");
    CHECK(options(kept) == options(help.out));
    CHECK(kept.substr(kept.find("\nMethods")) == help.out.substr(help.out.find("\nMethods")));
}
