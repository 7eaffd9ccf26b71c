// Files as people have them: public reports of what other readers refuse or read wrongly. All are a
// tent, a rectangle under a pyramid, and what the reader does not know is passed over.
#include "tests/catch.hpp"
#include "tests/scenes/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace space {
namespace {

using test::bytes, test::complaint;

/// Doubled, so that integers can be its coordinates.
constexpr std::array<std::array<int, 3>, 5> corners{
    {{0, 0, 0}, {8, 0, 0}, {8, 6, 0}, {0, 6, 0}, {4, 3, 4}}};
const std::vector<std::vector<int>> faces{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

std::vector<Triangle> tent() {
    TriangleMesh mesh;
    for (const auto& [x, y, z] : corners) mesh.vertices.push_back({x, y, z});
    mesh.faces = {{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    return mesh.triangles();
}

/// What is wrong with a file that must be the tent; empty if nothing is.
std::string fault(const std::filesystem::path& file) {
    const std::string told = complaint(file);
    if (told != "loaded") return told;
    return load_mesh(file).triangles() == tent() ? "" : "another mesh";
}

std::string lines(std::string_view before, std::string_view after = "") {
    std::string text;
    for (const auto& [x, y, z] : corners)
        text += fmt::format("{}{} {} {}{}\n", before, x, y, z, after);
    return text;
}
const std::string off_faces = "4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
const std::string obj_roof = "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
const std::string obj = lines("v ") + "f 1 4 3 2\n" + obj_roof;
const std::string off = "OFF\n5 5 8\n" + lines("") + off_faces;

std::string ply(const std::string& head, const std::string& body, std::string_view more_header = "",
                std::string_view coordinate = "float", std::string_view index = "int") {
    return fmt::format(
        "{}element vertex 5\nproperty {} x\nproperty {} y\nproperty {} z\n{}element face "
        "5\nproperty list uchar {} vertex_indices\nend_header\n{}",
        head, coordinate, coordinate, coordinate, more_header, index, body);
}
const std::string ascii = "ply\nformat ascii 1.0\n";
const std::string text_ply = ply(ascii, lines("") + off_faces);

std::string facets() {
    std::string text;
    for (const Triangle& t : tent()) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const Point3& p : {t.a, t.b, t.c})
            text += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
        text += "endloop\nendfacet\n";
    }
    return text;
}
const std::string stl = "solid tent\n" + facets() + "endsolid tent\n";
const std::string binary_stl = test::binary_stl(tent(), 6);

std::string replaced(std::string text, std::string_view old, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
        text.replace(at, old.size(), by);
    return text;
}

struct File {
    const char* name;
    std::string content;
};

void check_tents(const std::vector<File>& files) {
    const test::Folder folder;
    for (const auto& [name, content] : files) {
        INFO(name);
        CHECK(fault(folder.write(name, content)) == "");
    }
}

TEST_CASE("text may begin with a byte order mark and end its lines in CR, CR LF or not at all",
          "[mesh]") {
    const test::Folder folder;
    const File wrapped{"continued.obj", replaced(obj, "f 1 4 3 2", "f 1 4 \\\n 3 2")};
    const std::string mark = "\xEF\xBB\xBF";
    for (const auto& [name, content] :
         {File{"a.obj", obj}, wrapped, {"b.off", off}, {"c.ply", text_ply}, {"d.stl", stl}})
        for (const std::string& start : {std::string(), mark})
            for (const std::string_view end : {"\n", "\r\n", "\r"}) {
                std::string text = start + replaced(content, "\n", end);
                INFO(name << ", line ends of " << end.size() << " bytes, mark " << start.size());
                CHECK(fault(folder.write(name, text)) == "");
                text.erase(text.rfind(end));
                CHECK(fault(folder.write(name, text)) == "");
            }
    CHECK(complaint(folder.write("wide.obj", std::string("\xFF\xFEv\0", 4))) ==
          ": UTF-16 text is not read: save it as UTF-8");
}

TEST_CASE("places keep their line numbers, whatever ends the lines", "[mesh]") {
    const test::Folder folder;
    for (const std::string_view end : {"\n", "\r\n", "\r"}) {
        const std::string bad = "v 0 0 \\\n0\n# \\\nv 1 x 0\n";
        CHECK(complaint(folder.write("a.obj", replaced(bad, "\n", end))) ==
              ":4: 'x' is not a number");
        const std::string bad_ply = replaced(text_ply, "8 6 0", "8 x 0");
        CHECK(complaint(folder.write("a.ply", replaced(bad_ply, "\n", end))) ==
              ":12: 'x' is not a number");
        CHECK(
            complaint(folder.write("b.ply", replaced("ply\nformat morse\nend_header\n", "\n", end)))
                .starts_with(":2: 'morse' is not a format of PLY"));
    }
}

TEST_CASE("OBJ: a backslash continues lists of numbers, not comments and names", "[mesh]") {
    const std::string base = lines("v "), floor = "f 1 4 3 2\n";
    std::vector<File> files{
        {"blank_behind.obj", replaced(obj, "f 1 4 3 2", "f 1 4 \\ \n 3 2")},
        {"tab_behind.obj", replaced(obj, "f 1 4 3 2", "f 1 4\\ \t\n3 2")},
        {"vertex.obj", replaced(obj, "v 8 6 0", "v 8 \\\n6 \\\n 0")},
        {"twice.obj", replaced(obj, "f 1 4 3 2", "f 1 \\\n\\\n4 \\\n3 2")},
        {"comment_behind_the_last.obj", replaced(obj, "f 1 4 3 2", "f 1 4 \\\n3 2 # C:\\cad\\")},
        {"comment_in_a_face.obj", replaced(obj, "f 1 4 3 2", "f 1 4 3 2 # C:\\cad\\")},
        {"comment_in_a_vertex.obj", replaced(obj, "v 8 6 0", "v 8 6 0#\\")},
        {"texture.obj", base + "vt 0.5 \\\n0.5\n" + floor + obj_roof},
        {"curve.obj", base + "curv 0 1 \\\n1 2\n" + floor + obj_roof},
        {"at_the_end.obj", obj + "p 1 \\"}};
    for (const char* name : {"#", "# C:", "g", "o", "usemtl", "mtllib", "mg", "s", "call"}) {
        files.push_back({"before_a_face.obj", base + floor + name + " a\\\n" + obj_roof});
        files.push_back({"before_a_vertex.obj", name + std::string(" a\\\n") + obj});
        files.push_back(
            {"before_relative_faces.obj", base + name + " a \\\nf -5 -2 -3 -4\n" + obj_roof});
    }
    check_tents(files);
}

TEST_CASE("OBJ: what says nothing about triangles is passed over, and unknown words are counted",
          "[mesh]") {
    check_tents({
        {"colours.obj", lines("v ", " nan nan nan") + "f 1 4 3 2\n" + obj_roof},
        {"texture.obj", "vt nan inf\nvn 1e999 x\n" + obj},
        {"slashes.obj", lines("v ") + "f 1// 4//7 3/1 2/1/1\n" + obj_roof},
        {"tabs.obj", replaced(obj, " ", "\t")},
        {"old_face.obj", replaced(obj, "f ", "fo ")},
        {"relative.obj", lines("v ") + "f -5 -2 -3 -4\nf -5 2 -1\n" + obj_roof.substr(8)},
        {"faces_first.obj", "f 1 4 3 2\n" + obj_roof + lines("v ")},
        {"nul.obj", obj + std::string("\0\0\n\0", 4)},
        {"control_z.obj", obj + "\x1a"},
    });
    const test::Folder folder;
    for (const char* statement :
         {"mg 1 0.5", "maplib a.map", "call a.obj", "csh echo", "lod 3", "bevel on", "usemap off",
          "shadow_obj a.obj", "trace_obj a.obj", "ctech cparm 1", "cstype bezier", "p 1 2",
          "l 1 2 3", "// a comment", "curv 0 1 1 2", "end", "material x"}) {
        INFO(statement);
        const auto file =
            folder.write("a.obj", "\n" + std::string(statement) + "\n" + obj + statement);
        CHECK(fault(file) == "");
        std::string_view first = statement;
        first = first.substr(0, first.find(' '));
        CHECK(test::remarks(file) ==
              std::vector{fmt::format("2 statements skipped, the first '{}' in line 2", first)});
    }
    CHECK(load_mesh(
              folder.write("a.obj", "o a\ng\ns 1\nusemtl a\nmtllib b\nvt 0 0\nvn 0 0 1\n" + obj))
              .remarks.empty());
}

TEST_CASE("OFF: the keyword glued to the counts or left out, items over several lines or in one",
          "[mesh]") {
    const std::string body = lines("") + off_faces, one_line = replaced(body, "\n", " ");
    const std::string colours = lines("", " 1 0 0 1") + replaced(off_faces, "\n", " 0.5 0.5 0.5\n");
    check_tents({
        {"glued.off", "OFF5 5 8\n" + body},
        {"glued_colours.off", "COFF5 5 8\n" + colours},
        {"no_keyword.off", "5 5 8\n" + body},
        {"no_keyword_comment.off", "# a tent\n5 5\n8\n" + body},
        {"colours.off", "OFF\n5 5 8\n" + colours},
        {"wrapped_face.off", "OFF\n5 5 8\n" + replaced(body, "4 0 3 2 1", "4 0 3\n 2 1")},
        {"wrapped_vertex.off", "OFF\n5 5 8\n" + replaced(body, "8 6 0", "8\n6 # y\n\n0")},
        {"a_word_a_line.off", "OFF " + replaced("5 5 8 " + one_line, " ", "\n")},
        {"one_line.off", "OFF 5 5 8 " + one_line},
        {"two_vertices_a_line.off", "OFF\n5 5 8\n0 0 0 8 0 0\n8 6 0 0 6 0\n4 3 4\n" + off_faces},
        {"one_line_colours.off",
         "COFF 5 5 8 " + replaced(lines("", " 1 0 0 1"), "\n", " ") + off_faces},
        {"normals_texture.off",
         "STCNOFF\n5 5 8\n" + lines("", " 0 0 1 1 0 0 1 0.5 0.5") + off_faces},
        {"no_edges.off", "OFF\n5 5\n" + body},
        {"no_edges_comments.off", "OFF # a\n5 5 # b\n\n# c\n" + body},
    });
}

TEST_CASE("what stands behind the last face is passed over, with a remark", "[mesh]") {
    const test::Folder folder;
    const std::string four = "element face 4\n", comment = "# made by hand\n";
    const auto fewer = folder.write("a.ply", replaced(text_ply, "element face 5\n", four));
    CHECK(load_mesh(fewer).faces.size() == 5);
    CHECK(test::remarks(fewer) ==
          std::vector<std::string>{"what follows the last element passed over, from line 19 on"});
    const auto off_fewer = folder.write("a.off", comment + replaced(off, "5 5 8", "5 4 8"));
    CHECK(load_mesh(off_fewer).faces.size() == 5);
    CHECK(test::remarks(off_fewer) ==
          std::vector<std::string>{"what follows the last face passed over, from line 13 on"});
    CHECK(test::remarks(folder.write("b.off", off + "\n\n" + comment)).empty());
    CHECK(test::remarks(folder.write("b.ply", text_ply + "\n \n")).empty());
}

// ---- PLY.

const std::pair<const char*, std::string (*)(int)> types[] = {
    {"char", [](int n) { return bytes(static_cast<std::int8_t>(n)); }},
    {"uchar", [](int n) { return bytes(static_cast<std::uint8_t>(n)); }},
    {"short", [](int n) { return bytes(static_cast<std::int16_t>(n)); }},
    {"ushort", [](int n) { return bytes(static_cast<std::uint16_t>(n)); }},
    {"int", [](int n) { return bytes(n); }},
    {"uint", [](int n) { return bytes(static_cast<std::uint32_t>(n)); }},
    {"int8", [](int n) { return bytes(static_cast<std::int8_t>(n)); }},
    {"uint16", [](int n) { return bytes(static_cast<std::uint16_t>(n)); }},
    {"float", [](int n) { return bytes(static_cast<float>(n)); }},
    {"double", [](int n) { return bytes(static_cast<double>(n)); }}};
constexpr std::size_t integer_types = 8;

TEST_CASE("PLY: every type of coordinate, index and length, in text and both orders of bytes",
          "[mesh]") {
    const test::Folder folder;
    for (const std::string_view format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const auto put = [&](const auto& type, int number) {
            if (format == "ascii") return fmt::format("{} ", number);
            std::string own = type.second(number);
            if (format == "binary_big_endian") std::reverse(own.begin(), own.end());
            return own;
        };
        const auto check = [&](const auto& coordinate, const auto& length, const auto& index) {
            std::string text = fmt::format("ply\nformat {} 1.0\nelement vertex 5\n", format);
            for (const char axis : {'x', 'y', 'z'})
                text += fmt::format("property {} {}\n", coordinate.first, axis);
            text += fmt::format("element face 5\nproperty list {} {} vertex_index\nend_header\n",
                                length.first, index.first);
            for (const auto& corner : corners)
                for (const int number : corner) text += put(coordinate, number);
            for (const auto& face : faces) {
                text += put(length, static_cast<int>(face.size()));
                for (const int corner : face) text += put(index, corner);
            }
            INFO(format << ", coordinates " << coordinate.first << ", lengths " << length.first
                        << ", indices " << index.first);
            CHECK(fault(folder.write("a.ply", text)) == "");
        };
        for (const auto& coordinate : types) check(coordinate, types[1], types[4]);
        for (std::size_t length = 0; length < integer_types; ++length)
            for (std::size_t index = 0; index < integer_types; ++index)
                check(types[8], types[length], types[index]);
    }
}

TEST_CASE("PLY: columns that are not used may hold anything", "[mesh]") {
    const std::string normals = "property float nx\nproperty float ny\nproperty double quality\n";
    const std::string list = "property list uchar float descriptor\n";
    const std::string before =
        replaced(replaced(ply(ascii, lines("nan ") + off_faces), "property float x",
                          "property float confidence\nproperty float x"),
                 "4 0 3 2 1", "4 0 3 2 1");
    check_tents({
        {"nan.ply", ply(ascii, lines("", " nan nan nan") + off_faces, normals)},
        {"infinite.ply", ply(ascii, lines("", " inf -inf 1e999") + off_faces, normals)},
        {"indefinite.ply", ply(ascii, lines("", " -1.#IND 1.#QNAN nan(ind)") + off_faces, normals)},
        {"words.ply", ply(ascii, lines("", " a b c") + off_faces, normals)},
        {"list.ply", ply(ascii, lines("", " 2 nan 1e40") + off_faces, list)},
        {"before.ply", before},
        {"element.ply", ply(ascii, lines("") + "nan x\n" + off_faces,
                            "element camera 1\nproperty float a\nproperty int b\n")},
    });
}

TEST_CASE("PLY: text whose lines hold other columns than the header names is refused and told so",
          "[mesh]") {
    const test::Folder folder;
    const std::string hint = " begins inside a line: does the header name every column?)";
    const auto refused = [&](const std::string& content, const std::string& first) {
        const std::string told = complaint(folder.write("a.ply", content));
        INFO(told);
        CHECK(told.ends_with(" (" + first + hint));
    };
    refused(ply(ascii, lines("", " 255 0 0") + off_faces), "vertex 1");
    refused(ply(ascii, lines("", " 0.5 0.5 1") + off_faces), "vertex 1");
    refused(ply(ascii, lines("") + off_faces, "property float nx\nproperty float ny\n"),
            "vertex 1");
    // Here the numbers happen to fit, and some are left over.
    const std::string few = "ply\nformat ascii 1.0\nelement vertex 3\n";
    refused(few +
                "property float x\nproperty float y\nproperty float z\nelement face 1\n"
                "property list uchar int vertex_index\nend_header\n"
                "0 0 0 1\n0 0 0 1\n0 3 0 1\n2 0 0 0\n",
            "vertex 1");
    check_tents({{"one_line.ply", ply(ascii, replaced(lines("") + off_faces, "\n", " "))},
                 {"a_word_a_line.ply", ply(ascii, replaced(lines("") + off_faces, " ", "\n"))}});
}

TEST_CASE("PLY: headers as writers make them", "[mesh]") {
    const std::string body = lines("") + off_faces;
    check_tents({
        {"comment.ply", ply("ply\ncomment made by x\nformat ascii 1.0\n", body)},
        {"obj_info.ply", ply("ply\nobj_info a\n\nformat ascii 1.0\n", body, "comment\nobj_info\n")},
        {"empty_line.ply", ply(ascii + "\n", body, "\n  \n")},
        {"format_later.ply", ply("ply\n", body, "format ascii 1.0\n")},
        {"no_version.ply", ply("ply\nformat ascii\n", body)},
        {"faces_first.ply",
         ascii +
             "element face 5\nproperty list uchar int vertex_indices\nelement vertex 5\n"
             "property float x\nproperty float y\nproperty float z\nend_header\n" +
             off_faces + lines("")},
    });
    const test::Folder folder;
    const auto file = folder.write("a.ply", ply(ascii + "author x\nauthor y\n", body));
    CHECK(fault(file) == "");
    CHECK(test::remarks(file) ==
          std::vector<std::string>{"2 statements skipped, the first 'author' in line 3"});
}

TEST_CASE("PLY: a header that ends in CR may stand before a byte that is LF", "[mesh]") {
    std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty char flag\n";
    for (const char axis : {'x', 'y', 'z'}) head += fmt::format("property float {}\n", axis);
    head += "element face 5\nproperty list uchar uchar vertex_indices\nend_header\n";
    std::string body;
    for (const auto& corner : corners) {
        body += '\n';
        for (const int number : corner) body += bytes(static_cast<float>(number));
    }
    for (const auto& face : faces) {
        body += static_cast<char>(face.size());
        for (const int corner : face) body += static_cast<char>(corner);
    }
    check_tents({{"lf.ply", head + body},
                 {"cr_lf.ply", replaced(head, "\n", "\r\n") + body},
                 {"cr.ply", replaced(head, "\n", "\r") + body},
                 {"surplus.ply", head + body + "surplus"}});
}

TEST_CASE("PLY: triangle strips, which -1 ends", "[mesh]") {
    const test::Folder folder;
    const std::string head =
        replaced(ply(ascii, lines("")), "element face 5\nproperty list uchar int vertex_indices",
                 "element tristrips 1\nproperty list int int vertex_indices");
    using Faces = std::vector<std::array<std::uint32_t, 3>>;
    CHECK(load_mesh(folder.write("one.ply", head + "4 0 1 2 3\n")).faces ==
          Faces{{0, 1, 2}, {2, 1, 3}});
    CHECK(load_mesh(folder.write("two.ply", head + "9 0 1 2 3 -1 4 3 2 -1\n")).faces ==
          Faces{{0, 1, 2}, {2, 1, 3}, {4, 3, 2}});
    CHECK(complaint(folder.write("far.ply", head + "4 0 1 2 5\n")) ==
          ":15: tristrips 0: vertex index 5, but the file has 5 vertices");
}

// ---- STL.

TEST_CASE("STL as text: its words in any case, glued, split, doubled", "[mesh]") {
    check_tents({
        {"end_solid.stl", "solid tent\n" + facets() + "end solid tent\n"},
        {"end_loop.stl", replaced(replaced(stl, "endloop", "end loop"), "endfacet", "end facet")},
        {"glued.stl", "solid a\n" + facets() + "endsolidAssimpScene\n"},
        {"glued_start.stl", "solidtent\n" + facets() + "endsolid\n"},
        {"doubled.stl", "solid\n" + stl},
        {"doubled_end.stl", stl + "endsolid tent\n"},
        {"no_name.stl", "solid\n" + facets() + "endsolid\n"},
        {"empty_solid.stl", "solid a\nendsolid a\n" + stl},
        {"keywords.stl", "solid solid facet\n" + facets() + "endsolid vertex\n"},
        {"upper_case.stl", replaced(replaced(stl, "vertex", "VERTEX"), "solid", "Solid")},
        {"nan_normal.stl", replaced(stl, "normal 0 0 0", "normal nan -1.#IND x")},
        {"no_normal.stl", replaced(stl, "normal 0 0 0\n", "normal\n")},
        {"control_z.stl", stl + "\x1a"},
        {"nul_in_the_name.stl", "solid tent" + std::string(20, '\0') + stl.substr(10)},
    });
    const test::Folder folder;
    CHECK(complaint(folder.write("a.stl", "solid a\n" + facets() + stl))
              .starts_with(":44: 'solid' out"));
    CHECK(complaint(folder.write("a.stl", facets())) ==
          ": not an STL file: text that begins with 'facet', not with 'solid'");
    CHECK(test::remarks(folder.write("a.stl", replaced(stl, "endfacet", "endfacet\ncolor"))) ==
          std::vector<std::string>{"6 statements skipped, the first 'color' in line 9"});
}

TEST_CASE("STL in bytes is told from text by its contents, whatever its size", "[mesh]") {
    const test::Folder folder;
    for (const std::string_view start : {"", "solid", "solid tent\nfacet normal 0 0 0\n"}) {
        std::string content = binary_stl;
        content.replace(0, start.size(), start);
        for (const std::size_t surplus : {0u, 1u, 92u, 4000u}) {
            INFO(start << ", " << surplus << " bytes more");
            const auto file = folder.write("a.stl", content + std::string(surplus, 'x'));
            CHECK(fault(file) == "");
            CHECK(load_mesh(file).remarks.size() == (surplus > 0));
        }
        CHECK(complaint(folder.write("a.stl", content.substr(0, content.size() - 1))) ==
              ": the header promises 6 triangles, which take 384 bytes, but the file has 383");
    }
}

TEST_CASE("STL: 0 and -0 are one place", "[mesh]") {
    const test::Folder folder;
    const auto facet = [](const char* a) {
        return fmt::format("facet\nvertex {} 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n", a);
    };
    const auto file = folder.write("a.stl", "solid\n" + facet("0") + facet("-0") + "endsolid\n");
    CHECK(load_mesh(file).vertices.size() == 3);
}

/// Every triangle with the number of its attribute bytes, and as many bytes as stated.
std::string with_attributes(std::uint16_t number, std::size_t given) {
    std::string content = binary_stl.substr(0, 84);
    for (std::size_t i = 0; i < 6; ++i)
        content += binary_stl.substr(84 + 50 * i, 48) + bytes(number) + std::string(given, '\x5a');
    return content;
}

TEST_CASE("STL in bytes: attributes are colours or have bytes of their own, as the size tells",
          "[mesh]") {
    check_tents({{"payload.stl", with_attributes(4, 4)},
                 {"colour.stl", with_attributes(0x7C1F, 0)},
                 {"colour_and_surplus.stl", with_attributes(0x7C1F, 0) + std::string(30, 'x')}});
    const test::Folder folder;
    CHECK(complaint(folder.write("a.stl", with_attributes(4, 4) + "x")) ==
          ": 6 triangles take 384 bytes, or 408 with their attributes, but the file has 409");
}

}  // namespace
}  // namespace space
