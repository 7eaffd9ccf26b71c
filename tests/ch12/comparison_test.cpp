#include "chapters/ch12_comparison/measured/comparison.hpp"

#include "chapters/ch12_comparison/measured/comparison_tables.hpp"
#include "chapters/ch12_comparison/measurement.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "tests/catch.hpp"
#include "tests/lab/process.hpp"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

using namespace space;
using namespace space::ch12;

namespace {

Options small_options() {
    Options options{.small = true};
    options.threads = 1;
    return options;
}

CompareEffort two_blocks() {
    CompareEffort effort{
        .width = 8, .height = 6, .turns = 0, .most_turns = 0, .most_placed = 100'000};
    effort.blocks = {{"boxes", "boxes:12"}, {"jacks", "graph/jacks:0"}};
    return effort;
}

/// The lab's naive tracing, bvh-binned and fast, of which each build is counted.
std::vector<Structure> counted_structures(int& builds) {
    std::vector<Structure> some;
    for (Structure structure : structures()) {
        if (structure.name != "naive" && structure.name != "bvh-binned" && structure.name != "fast")
            continue;
        auto& build = structure.variants.front().build_from_triangles;
        build = [&builds, build](std::span<const Triangle> triangles, const BuildOptions& options) {
            ++builds;
            return build(triangles, options);
        };
        some.push_back(structure);
    }
    return some;
}

std::size_t block_count(const std::filesystem::path& csv) {
    return blocks(read_comparison(csv)).size();
}

}  // namespace

TEST_CASE("rows agree with what the lab counts") {
    const Options options = small_options();
    CompareEffort effort = two_blocks();
    const ComparedSubject subject = make_subject("boxes", "boxes:12", 1);
    const auto rows = compare_on(subject, structures(), effort, options);
    std::vector<Choice> chosen;
    for (const Structure& structure : structures())
        chosen.push_back({&structure, &structure.variants.front()});
    LabOptions lab;
    lab.common.threads = lab.build.threads = 1;
    lab.repeat = 1;
    const auto rays = camera_rays({subject.camera, effort.width, effort.height});
    for (const Measurement& m : measure(chosen, {subject.triangles}, rays, lab)) {
        const ComparedRow* const row = find(rows, m.name());
        if (!row) continue;  // one of those that are not compared
        CAPTURE(m.name());
        const TracedKind& camera = (*row)[RayKind::camera];
        const auto per_ray = [&](std::uint64_t n) { return double(n) / double(rays.size()); };
        REQUIRE(camera.rays == rays.size());
        CHECK(camera.nodes_per_ray == Approx(per_ray(m.counts->nodes_visited)).epsilon(1e-3));
        CHECK(camera.tests_per_ray == Approx(per_ray(m.counts->triangles_tested)).epsilon(1e-3));
        CHECK(camera.wrong == 0);
        if (m.name() != "kd-lazy") {  // it has seen other rays
            CHECK(row->bytes == m.shape.bytes);
            CHECK(row->references == m.shape.references);
        }
    }
}

TEST_CASE("each compared structure is one of the lab's or a peer's, and each scene can be made") {
    std::set<std::string_view> known{"embree", "embree-high", "cgal"};
    for (const Structure& structure : structures()) known.insert(structure.name);
    for (const ComparedStructure& compared : compared_structures())
        CHECK(known.contains(compared.name));
    std::set<std::string_view> kinds;
    for (const ComparedScene& scene : compared_scenes()) {
        kinds.insert(scene.kind);
        if (scene.specs.size() == 1) continue;  // of a file
        const ComparedSubject subject =
            make_subject(std::string(scene.name), scene.specs.front(), 1);
        CHECK(subject.triangles.size() >= 900);
        CHECK(subject.triangles.size() <= 30'000);
        CHECK(!subject.lights.empty());
    }
    CHECK(kinds.size() >= 14);
    CHECK_THROWS_AS(compared_scene("nothing"), std::out_of_range);
}

TEST_CASE("all rows ask the same questions, and of the book none is answered wrong") {
    for (const auto& [scene, spec] : two_blocks().blocks) {
        const auto rows =
            compare_on(make_subject(scene, spec, 1), structures(), two_blocks(), small_options());
        for (const ComparedRow& row : rows) {
            CAPTURE(row.structure, spec);
            REQUIRE(row.stands());
            CHECK(row[RayKind::camera].rays == 48);
            CHECK(row[RayKind::diffuse].rays == 48);
            CHECK(row[RayKind::any].rays == 48);
            CHECK(row.wrong() == 0);
            CHECK(std::isnan(row.build_ms));  // nothing was timed
        }
    }
}

TEST_CASE("of a large scene naive tracing answers some of the rays, and these right") {
    int builds = 0;
    const std::vector<Structure> some = counted_structures(builds);
    const auto rows =
        compare_on(make_subject("soup", "soup:50000", 1), some, two_blocks(), small_options());
    const ComparedRow &naive = *find(rows, "naive"), &fast = *find(rows, "fast");
    for (const RayKind kind : ray_kinds) {
        CHECK(naive[kind].rays == 16);  // a million tests are 20 of 48; every third one
        CHECK(fast[kind].rays == 48);
    }
    CHECK(naive.wrong() == 0);
    CHECK(fast.wrong() == 0);
}

TEST_CASE("a structure that lies is found out, and one that throws gives up alone") {
    int builds = 0;
    std::vector<Structure> some = counted_structures(builds);
    auto& fast = some.back().variants.front().build_from_triangles;
    fast = [fast](std::span<const Triangle> triangles, const BuildOptions& options) {
        BuiltStructure built = fast(triangles, options);
        built.count = [trace = built.trace](const Batch& batch) {
            trace(batch);
            batch.hits.front() = HitRecord::closest(std::optional(Hit{1e9f, 0, 0, 0}));
            return TraversalCounts{};
        };
        return built;
    };
    const ComparedSubject subject = make_subject("boxes", "boxes:12", 1);
    auto rows = compare_on(subject, some, two_blocks(), small_options());
    REQUIRE(find(rows, "fast"));
    CHECK(find(rows, "fast")->wrong() == 4);  // one ray of each kind
    CHECK(find(rows, "bvh-binned")->wrong() == 0);
    const Comparison all{.rows = rows};
    CHECK(wrong_answers(all) == 4);

    fast = [](std::span<const Triangle>, const BuildOptions&) -> BuiltStructure {
        throw std::runtime_error("too deep");
    };
    rows = compare_on(subject, some, two_blocks(), small_options());
    CHECK(rows.back().gave_up == "too deep");
    CHECK(find(rows, "fast") == nullptr);
    CHECK(find(rows, "bvh-binned"));
}

TEST_CASE("times are there where they are asked for, the lazy tree's nodes apart") {
    CompareEffort effort = two_blocks();
    effort.turns = effort.most_turns = 2;
    const auto rows =
        compare_on(make_subject("boxes", "boxes:12", 1), structures(), effort, small_options());
    for (const ComparedRow& row : rows) {
        CAPTURE(row.structure);
        CHECK(row.build_ms >= 0.0);
        CHECK(row.mean_ns() > 0.0);
        CHECK(row.made_later.size() == (row.structure == "kd-lazy" ? 3u : 0u));
    }
    const ComparedRow& lazy = *find(rows, "kd-lazy");
    CHECK(lazy.made_later.front().rays == 1);
    CHECK(lazy.made_later.back().rays > double(lazy.rays()));  // the few rays before are of them
}

TEST_CASE("what takes long to build is built once, and traced like what is built for each turn") {
    CompareEffort effort = two_blocks();
    effort.turns = effort.most_turns = 3;
    for (const int build_ms : {160, 0}) {
        int builds = 0;
        std::vector<const Ray*> traced;  // through fast, while it does not count
        std::vector<Structure> some = counted_structures(builds);
        for (Structure& structure : some) {
            auto& build = structure.variants.front().build_from_triangles;
            build = [build, build_ms, &traced, is_fast = structure.name == "fast"](
                        std::span<const Triangle> triangles, const BuildOptions& options) {
                std::this_thread::sleep_for(std::chrono::milliseconds(build_ms));
                BuiltStructure built = build(triangles, options);
                if (!is_fast) return built;
                built.trace = [trace = built.trace, &traced](const Batch& batch) {
                    traced.push_back(batch.rays.data());
                    trace(batch);
                };
                return built;
            };
        }
        const auto rows =
            compare_on(make_subject("boxes", "boxes:12", 1), some, effort, small_options());
        CAPTURE(build_ms);
        CHECK(builds == 1 + 3 * (build_ms > 0 ? 1 : 3));  // the first one knows what is right
        REQUIRE(rows.size() == 3);
        for (const ComparedRow& row : rows) CHECK(row.mean_ns() > 0.0);
        // The first turn counts, then times; the others warm up first.
        REQUIRE(traced.size() == 4 + 2 * (3 + 4));
        const std::span all = std::span<const Ray* const>(traced);
        const std::span timed = all.first(4);
        for (const std::size_t turn : {4u, 11u}) {
            CHECK(std::ranges::equal(all.subspan(turn, 3), timed.first(3)));
            CHECK(std::ranges::equal(all.subspan(turn + 3, 4), timed));
        }
    }
}

TEST_CASE("a run that is taken up measures nothing twice") {
    const Workbench bench;
    const auto csv = bench / "c.csv";
    int builds = 0;
    const std::vector<Structure> some = counted_structures(builds);
    compare_into(csv, some, two_blocks(), small_options());
    const int all = builds;
    const std::string text = read_file(csv);
    REQUIRE(block_count(csv) == 2);
    compare_into(csv, some, two_blocks(), small_options());
    CHECK(builds == all);
    CHECK(read_file(csv) == text);

    // Half a block goes, and is measured again.
    const std::size_t second = text.find('\n', text.find("# whole: boxes:12") + 30);
    write_file(csv, text.substr(0, second + 20));
    builds = 0;
    const Comparison again = compare_into(csv, some, two_blocks(), small_options());
    CHECK(builds > 0);
    CHECK(builds < all);
    CHECK(again.rows == read_comparison(csv).rows);
    CHECK(block_count(csv) == 2);
}

TEST_CASE("what a file of other settings, sources or machines holds is measured anew") {
    const Workbench bench;
    const auto csv = bench / "c.csv";
    int builds = 0;
    const std::vector<Structure> some = counted_structures(builds);
    compare_into(csv, some, two_blocks(), small_options());
    const std::string text = read_file(csv);
    const int all = builds;
    for (const char* field : {"# machine: ", "# sources: ", "# settings: "}) {
        std::string other = text;
        other.insert(other.find(field) + std::string(field).size(), "another ");
        write_file(csv, other);
        builds = 0;
        compare_into(csv, some, two_blocks(), small_options());
        CAPTURE(field);
        CHECK(builds == all);
    }
}

TEST_CASE("a file that cannot be written is told before anything is measured") {
    const Workbench bench;
    int builds = 0;
    const std::vector<Structure> some = counted_structures(builds);
    write_file(bench / "file", "");
    CHECK_THROWS_AS(compare_into(bench / "file/c.csv", some, two_blocks(), small_options()), Error);
    CHECK(builds == 0);
}

TEST_CASE("a run that is killed leaves a file that the next one goes on with") {
    const Workbench bench;
    const Command compare =
        Command{{PROGRAM}}.with("compare --small --threads 1 --out").with(bench / "killed");
    const auto csv = bench / "killed/ch12_comparison.csv";
    std::vector<std::string> words = compare.words;
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    REQUIRE(::posix_spawn(&child, argv.front(), nullptr, nullptr, argv.data(), environ) == 0);
    while (!std::filesystem::exists(csv) && ::waitpid(child, nullptr, WNOHANG) == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::size_t before = block_count(csv);  // whole, whenever it was killed
    CHECK(before >= 1);
    const Ended ended = run(compare);
    CHECK(ended.code == 0);
    CHECK(ended.err.find("of 3 blocks already") != std::string::npos);
    CHECK(block_count(csv) == 3);
    const Ended whole =
        run(Command{{PROGRAM}}.with("compare --small --threads 2 --out").with(bench / "whole"));
    CHECK(whole.code == 0);
    auto in_one = read_comparison(bench / "whole/ch12_comparison.csv").rows;
    for (ComparedRow& row : in_one) row.build_threads = 1;
    const auto in_two = read_comparison(csv).rows;
    CHECK((in_one == in_two));
}

#ifdef PEERS_PROGRAM
TEST_CASE("peers are compared with the book's structures") {
    const Workbench bench;
    const Ended ended =
        run(Command{{PEERS_PROGRAM}}.with("compare --small --out").with(bench / "peers"));
    CHECK(ended.code == 0);
    const Comparison comparison = read_comparison(bench / "peers/ch12_comparison.csv");
    for (const auto block : blocks(comparison))
        for (const char* peer : {"embree", "embree-high", "cgal"}) {
            REQUIRE(find(block, peer));
            CHECK(find(block, peer)->is_peer);
            CHECK(find(block, peer)->rays() == find(block, "fast")->rays());
        }
}
#endif
