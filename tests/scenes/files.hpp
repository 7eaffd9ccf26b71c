/// @file
/// Files that a test writes, and what is wrong with them.
#pragma once

#include "common/mesh.hpp"
#include "common/program/error.hpp"
#include "common/program/temporary.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace space::test {

/// Bytes of the largest single allocation since it was set to 0 (allocations.cpp).
extern std::size_t largest_allocation;

/// A folder that is gone at the end of the test.
class Folder {
  public:
    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = directory_ / name;
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }
    const std::filesystem::path& path() const { return directory_.path(); }

  private:
    TemporaryDirectory directory_;
};

/// The line that the loader complains with; "loaded" if it does not, and why it is a bad complaint
/// if it is one.
inline std::string complaint(const std::filesystem::path& file) {
    try {
        (void)load_mesh(file);
    } catch (const Error& error) {
        std::string line = error.what();
        if (error.code() != ExitCode::bad_input) return "wrong exit code: " + line;
        if (line.find('\n') != std::string::npos) return "more than a line: " + line;
        if (!line.starts_with(file.string() + ":")) return "file not named: " + line;
        return line.substr(file.string().size());
    }
    return "loaded";
}

/// What the loader remarks, without the file's name, which each remark begins with.
inline std::vector<std::string> remarks(const std::filesystem::path& file) {
    std::vector<std::string> all = load_mesh(file).remarks;
    for (std::string& remark : all)
        remark = remark.starts_with(file.string() + ": ") ? remark.substr(file.string().size() + 2)
                                                          : "file not named: " + remark;
    return all;
}

/// What every loaded mesh promises.
inline bool is_sound(const TriangleMesh& mesh) {
    for (const Point3& vertex : mesh.vertices)
        if (!is_finite<3>(vertex)) return false;
    for (const auto& face : mesh.faces)
        for (const std::uint32_t index : face)
            if (index >= mesh.vertices.size()) return false;
    return !mesh.faces.empty();
}

template <class Number>
std::string bytes(Number number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
}

/// A binary STL file; the header's count may lie.
inline std::string binary_stl(std::span<const Triangle> triangles, std::uint32_t count) {
    std::string content(80, ' ');
    content += bytes(count);
    for (const Triangle& triangle : triangles) {
        content += std::string(12, '\0');
        for (const Point3& p : {triangle.a, triangle.b, triangle.c})
            content += bytes(p.x) + bytes(p.y) + bytes(p.z);
        content += std::string(2, '\0');
    }
    return content;
}

}  // namespace space::test
