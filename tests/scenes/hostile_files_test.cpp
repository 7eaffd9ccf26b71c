// Broken, lying and truncated mesh files: one line of complaint each, nothing else.
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <limits>
#include <utility>

namespace space {
namespace {

using namespace std::string_literals;
using test::bytes, test::complaint, test::largest_allocation;

const std::string ply_head = "ply\nformat ascii 1.0\n";
const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string list = "property list uchar int vertex_indices\nend_header\n";
const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
const std::string whole_ply =
    ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list + points + "3 0 1 2\n";
const std::string whole_off = "OFF\n3 1 0\n" + points + "3 0 1 2\n";
const std::string whole_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string whole_stl =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid "
    "one\n";
const Triangle one{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string binary_ply(const std::string& format, std::uint32_t vertices, std::uint32_t faces,
                       const std::string& body, const std::string& length_type = "uchar") {
    return fmt::format(
               "ply\nformat {} 1.0\nelement vertex {}\n{}element face {}\nproperty list {} int "
               "vertex_indices\nend_header\n",
               format, vertices, xyz, faces, length_type) +
           body;
}
const std::string little_points = bytes(0.0f) + bytes(0.0f) + bytes(0.0f) + bytes(1.0f) +
                                  bytes(0.0f) + bytes(0.0f) + bytes(0.0f) + bytes(1.0f) +
                                  bytes(0.0f);
const std::string little_face = std::string("\3") + bytes(0) + bytes(1) + bytes(2);
const std::string whole_binary_ply =
    binary_ply("binary_little_endian", 3, 1, little_points + little_face);

TEST_CASE("the files that the hostile ones are made from load", "[mesh]") {
    const test::Folder folder;
    for (const auto& [name, content] : {std::pair{"a.ply", whole_ply},
                                        {"b.off", whole_off},
                                        {"c.obj", whole_obj},
                                        {"d.stl", whole_stl},
                                        {"e.ply", whole_binary_ply},
                                        {"f.stl", test::binary_stl({&one, 1}, 1)}})
        CHECK(complaint(folder.write(name, content)) == "loaded");
}

TEST_CASE("each fault of a file is told in one line that names the file, the place and the fault",
          "[mesh]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string nan_point = bytes(0.0f) + bytes(nan) + bytes(0.0f);
    const std::string two_points = little_points.substr(0, 24);
    struct Hostile {
        const char* name;
        std::string content, told;
    };
    const Hostile files[] = {
        {"empty.obj", "", "the file is empty"},
        {"unknown.xyz", whole_obj, "must end in .obj, .off, .ply or .stl"},
        {"none", whole_obj, "must end in"},

        {"garbage.obj",
         "\x7f"
         "ELF\x02\x01 garbage \x01",
         ": the file has no faces (1 statement skipped, the first '?ELF' in line 1)"},
        {"prose.obj", "It was a dark and stormy night.\n",
         ": the file has no faces (1 statement skipped, the first 'It' in line 1)"},
        {"no_faces.obj", "v 0 0 0\nv 1 0 0\n", ": the file has no faces"},
        {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n",
         ":5: vertex index 4, but the file has 3 vertices"},
        {"zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", ":4: vertex index 0"},
        {"negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 -2 -1\n",
         ":4: vertex index -4, but 3 vertices"},
        {"huge_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967297\n",
         ":4: vertex index 4294967297"},
        {"too_long_index.obj", "v 0 0 0\nf 1 2 99999999999999999999\n",
         ":2: '99999999999999999999' is not"},
        {"fraction.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1.5 2 3\n", ":4: '1.5' is not a corner"},
        {"two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n",
         ":4: a face needs three corners or more, this one has 2"},
        {"nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n",
         ":2: the coordinate 'nan' is not a finite float"},
        {"inf.obj", "v 0 0 0\nv 1 0 -inf\nv 0 1 0\nf 1 2 3\n", ":2: the coordinate '-inf'"},
        {"overflow.obj", "v 0 0 0\nv 1 0 1e39\nv 0 1 0\nf 1 2 3\n", ":2: the coordinate '1e39'"},
        {"overflow_double.obj", "v 0 0 0\nv 1 0 -1e999\nv 0 1 0\nf 1 2 3\n",
         ":2: the coordinate '-1e999'"},
        {"word.obj", "v 0 0 zero\n", ":1: 'zero' is not a number"},
        {"flat.obj", "v 0 0\n", ":1: a vertex needs three coordinates"},
        {"continued.obj", "v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n9\n", ":5: vertex index 9"},

        {"garbage.off", "\x01\x02\x03 garbage", "not an OFF file: it begins with 'garbage'"},
        {"counts.off", "OFF\n2147483647 1 0\n" + points,
         ":2: the header promises 2147483647 vertices"},
        {"faces.off", "OFF\n3 2147483647 0\n" + points, ":2: the header promises 2147483647 faces"},
        {"edges.off", "OFF\n3 1 2147483647\n" + points, ":2: the header promises 2147483647 edges"},
        {"past_64_bits.off", "OFF\n99999999999999999999 1 0\n", "is not a number of vertices"},
        {"negative_count.off", "OFF\n-3 1 0\n" + points, "'-3' is not a number of vertices"},
        {"only_header.off", "OFF\n", ": the file ends before its number of vertices"},
        {"one_count.off", "OFF\n0", ": the file ends before its number of faces"},
        {"no_faces.off", "OFF\n3 0 0\n" + points, "the file has no faces"},
        {"truncated_points.off", "OFF\n4 1 0\n" + points, "the file ends after 3 of 4 vertices"},
        {"truncated_faces.off", "OFF\n3 2 0\n" + points + "3 0 1 2\n",
         "the file ends after 1 of 2 faces"},
        {"range.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n",
         ":6: vertex index 3, but the file has 3 vertices"},
        {"negative.off", "OFF\n3 1 0\n" + points + "3 0 1 -1\n", ":6: vertex index -1"},
        {"two.off", "OFF\n3 1 0\n" + points + "2 0 1\n", ":6: a face needs three corners"},
        {"long_face.off", "OFF\n3 1 0\n" + points + "2000000000 0 1 2\n",
         ":6: the face has 3 corners, not 2000000000"},
        {"nan.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", ":4: the coordinate 'nan'"},
        {"binary.off", "OFF BINARY\n" + std::string(40, '\1'), "binary OFF files are not read"},
        {"four.off", "4OFF\n3 1 0\n" + points, "'4OFF' files are not read"},

        {"short.stl", "soli", "not an STL file"},
        {"garbage.stl", "\x01\x02\x03garbage", "not an STL file"},
        {"cut.stl", whole_stl.substr(0, 70), ""},
        {"unended.stl", whole_stl.substr(0, whole_stl.size() - 13),
         "the file ends before 'endsolid'"},
        {"four_corners.stl",
         "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 "
         "0\nendfacet\nendsolid\n",
         ":7: a facet of 4 vertices"},
        {"nan.stl",
         "solid\nfacet\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\nendfacet\nendsolid\n",
         ":4: the coordinate 'nan'"},
        {"no_facets.stl", "solid nothing\nendsolid nothing\n", "the file has no faces"},
        {"count.stl", test::binary_stl({&one, 1}, 2147483647),
         "the header promises 2147483647 triangles"},
        {"most.stl", test::binary_stl({&one, 1}, 4294967295u),
         "the header promises 4294967295 triangles"},
        {"cut_binary.stl", test::binary_stl({&one, 1}, 1).substr(0, 130),
         "the header promises 1 triangles, which take 134 bytes"},
        {"no_triangles.stl", test::binary_stl({}, 0), "the file has no faces"},
        {"nan_binary.stl",
         test::binary_stl(std::vector{one, Triangle{{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}}}, 2),
         "triangle 1: the coordinate nan"},

        {"not.ply", "plywood\n", "not a PLY file: it begins with 'plywood'"},
        {"cut_header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "ends inside the header"},
        {"format.ply", "ply\nformat morse 1.0\nend_header\n", ":2: 'morse' is not a format of PLY"},
        {"early.ply", ply_head + "property float x\nend_header\n",
         ":3: a property before the first element"},
        {"type.ply", ply_head + "element vertex 1\nproperty quad x\nend_header\n",
         ":4: 'quad' is not a type of PLY"},
        {"no_number.ply", ply_head + "element vertex\nend_header\n",
         ":3: the element 'vertex' has no number"},
        {"minus.ply", ply_head + "element vertex -1\nend_header\n",
         ":3: '-1' is not a number of elements"},
        {"no_z.ply",
         ply_head + "element vertex 1\nproperty float x\nproperty float y\nelement face 1\n" + list,
         "no property z"},
        {"list_x.ply",
         ply_head +
             "element vertex 1\nproperty list int float x\nproperty float y\nproperty float "
             "z\nelement face "
             "1\n" +
             list,
         "no property x that is a number"},
        {"no_list.ply",
         ply_head + "element vertex 3\n" + xyz +
             "element face 1\nproperty int material\nend_header\n",
         "no list of integers"},
        {"no_face.ply", ply_head + "element vertex 3\n" + xyz + "end_header\n" + points,
         "no element 'face'"},
        {"no_vertex.ply", ply_head + "element face 1\n" + list + "3 0 1 2\n",
         "no element 'vertex'"},
        {"nothing.ply", ply_head + "element vertex 3\n" + xyz + "element face 0\n" + list + points,
         "the file has no faces"},
        {"bare.ply",
         ply_head + "element vertex 3\n" + xyz +
             "element void 9000000000000000000\nelement face 1\n" + list,
         "no properties"},
        {"counts.ply",
         ply_head + "element vertex 2147483647\n" + xyz + "element face 1\n" + list + points,
         "promises 2147483647"},
        {"faces.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 2147483647\n" + list + points,
         "promises 2147483647"},
        {"cut.ply", whole_ply.substr(0, whole_ply.size() - 3),
         "face 0: a list of 3 does not fit into the 4 bytes that are left"},
        {"range.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list + points + "3 0 1 3\n",
         "face 0: vertex index 3, but the file has 3 vertices"},
        {"negative.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list + points + "3 0 1 -1\n",
         "face 0: vertex index -1"},
        {"two.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list + points + "2 0 1\n",
         ":13: face 0: 2 corners, but a face needs three"},
        {"long_list.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list + points + "256 0 1 2\n",
         "a list of 256 does not fit"},
        {"nan.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list +
             "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n",
         ":11: the coordinate 'nan'"},
        {"overflow.ply",
         ply_head + "element vertex 3\n" + xyz + "element face 1\n" + list +
             "0 0 0\n3.5e38 0 0\n0 1 0\n3 0 1 2\n",
         ":11: the coordinate '3.5e38'"},
        {"big_counts.ply", binary_ply("binary_little_endian", 2147483647, 1, little_points),
         "promises 2147483647 of element 'vertex'"},
        {"big_faces.ply",
         binary_ply("binary_little_endian", 3, 2147483647, little_points + little_face),
         "promises 2147483647 of element 'face'"},
        {"cut_points.ply", binary_ply("binary_little_endian", 3, 1, two_points),
         "promises 3 of element 'vertex'"},
        {"cut_face.ply",
         binary_ply("binary_little_endian", 3, 1, little_points + little_face.substr(0, 9)),
         "face 0: a list of 3 does not fit into the 8 bytes"},
        {"list.ply",
         binary_ply("binary_little_endian", 3, 1, little_points + bytes(2147483647) + bytes(0),
                    "int"),
         "face 0: a list of 2147483647 does not fit"},
        {"minus_list.ply",
         binary_ply("binary_little_endian", 3, 1, little_points + bytes(-1) + bytes(0), "int"),
         "negative length"},
        {"one_byte_short.ply",
         "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + xyz +
             "element face 1\nproperty list uchar uchar flags\n" + list + little_points + "\x0e" +
             little_face,
         "face 0: a list of 14 does not fit into the 13 bytes that are left"},
        {"far_index.ply",
         binary_ply("binary_little_endian", 3, 1,
                    little_points + std::string("\3") + bytes(0) + bytes(1) + bytes(3)),
         "face 0: vertex index 3"},
        {"nan_binary.ply",
         binary_ply("binary_little_endian", 3, 1, two_points + nan_point + little_face),
         "vertex 2: the coordinate nan is not a finite float"},
        {"other_end.ply", binary_ply("binary_big_endian", 3, 1, little_points + little_face),
         "face 0: vertex index"},
    };
    const test::Folder folder;
    for (const Hostile& hostile : files) {
        const std::filesystem::path file = folder.write(hostile.name, hostile.content);
        largest_allocation = 0;
        const std::string told = complaint(file);
        INFO(hostile.name << told);
        CHECK(told.starts_with(":"));
        CHECK(told.find(hostile.told) != std::string::npos);
        CHECK(largest_allocation < 100'000);  // bytes; all of these files are shorter than 1000
    }
}

TEST_CASE("what is no regular, readable file is told in one line", "[mesh]") {
    const test::Folder folder;
    CHECK(complaint(folder.path() / "missing.ply") == ": No such file or directory");
    std::filesystem::create_directory(folder.path() / "folder.ply");
    CHECK(complaint(folder.path() / "folder.ply") == ": not a regular file");
    const std::filesystem::path pipe = folder.path() / "pipe.ply";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(complaint(pipe) == ": not a regular file");
    if (::geteuid() != 0) {  // root reads everything
        const std::filesystem::path locked = folder.write("locked.ply", whole_ply);
        std::filesystem::permissions(locked, std::filesystem::perms::none);
        CHECK(complaint(locked) == ": Permission denied");
    }
}

TEST_CASE("truncated anywhere or with wrong bytes, a file gives a sound mesh or one line",
          "[mesh]") {
    const test::Folder folder;
    std::string big_endian;
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) {
        const std::string little = bytes(x);
        big_endian += std::string(little.rbegin(), little.rend());
    }
    big_endian += std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2", 13);
    const std::pair<const char*, std::string> whole[] = {
        {"a.ply", whole_ply},
        {"b.off", "COFF # a comment\n3 1 0\n0 0 0 1 0 0 1\n1 0 0\n\n0 1 0\n3 0 1 2 # face\n"},
        {"c.obj", whole_obj + "l 1 2\nf 1//1 -1/2/3 2\n"},
        {"d.stl", whole_stl + whole_stl},
        {"e.ply", whole_binary_ply},
        {"f.ply", binary_ply("binary_big_endian", 3, 1, big_endian)},
        {"g.stl", test::binary_stl(std::vector{one, one}, 2)},
        {"h.off", "OFF3 1 0\n0 0 0 1\n0 0 # x\n0 1 0 3 0\n1 2\n"},
        {"i.obj", "\xEF\xBB\xBFmg 1\r\nv 0 0 \\ \r\n0\r\nv 1 0 0\rv 0 1 0\r# C:\\\nf 1 \\\n2 3"},
        {"j.obj",
         "v 0 0 0\nv 6 0 0\nv 6 6 0\nv 0 6 0\nv 0 0 0\nv 2 2 0\nv 2 4 0\nv 4 4 0\nv 4 2 0\n"
         "v 2 2 0\nf 1 2 3 4 5 6 7 8 9 10\n"},
        {"k.ply", ply_head + "element vertex 3\n" + xyz +
                      "element tristrips 1\nproperty list char short vertex_index\nend_header\n" +
                      points + "5 0 1 2 -1 0\n"},
        {"l.ply",
         "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty list uchar ushort "
         "a\rproperty char x\rproperty char y\rproperty uchar z\relement face 1\rproperty "
         "list ushort uchar vertex_indices\rend_header\r" +
             std::string("\0\0\0\0\1ab\1\0\0\0\0\1\0\3\0\0\1\2", 19)},
        {"m.stl", test::binary_stl({&one, 1}, 1).substr(0, 132) + "\2\0ab"s}};
    const auto check = [&](const char* name, const std::string& content) {
        const std::filesystem::path file = folder.write(name, content);
        largest_allocation = 0;
        bool good = false;
        std::string told;
        try {
            good = test::is_sound(load_mesh(file));
        } catch (const Error& error) {
            told = error.what();
            good = error.code() == ExitCode::bad_input && told.find('\n') == std::string::npos;
        }
        if (!good || largest_allocation > 200'000) {
            INFO(name << ": " << told << "\n" << content);
            CHECK(good);
            CHECK(largest_allocation <= 200'000);
        }
    };
    Pcg32 random(1);
    for (const auto& [name, content] : whole) {
        REQUIRE(complaint(folder.write(name, content)) == "loaded");
        for (std::size_t size = 0; size < content.size(); ++size)
            check(name, content.substr(0, size));
        constexpr std::string_view nasty = "\n \t0123456789-+.e#/\\nfv\0\xff\x7f";
        for (int round = 0; round < 200; ++round) {
            std::string wrong = content;
            for (std::uint32_t i = 0, count = 1 + random.below(4); i < count; ++i) {
                char& byte = wrong[random.below(static_cast<std::uint32_t>(wrong.size()))];
                byte = random.below(2)
                           ? nasty[random.below(static_cast<std::uint32_t>(nasty.size()))]
                           : static_cast<char>(random.next());
            }
            check(name, wrong);
        }
    }
}

}  // namespace
}  // namespace space
