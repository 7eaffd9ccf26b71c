// Feeds what the fuzzer has kept: replay CORPUS feeds all of its folders, replay KIND FILE... some
// files. Ends with what was fed; where something is wrong, with the name of the input before it.
#include "common/program/file.hpp"
#include "tests/fuzz/kinds.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace space::fuzz;

void feed(const Kind& kind, const std::filesystem::path& file) {
    const std::string bytes = space::read_file(file);
    if (std::getenv("FUZZ_TELLS") != nullptr) std::fprintf(stderr, "%s\n", file.c_str());
    kind.feed(bytes);
}

}  // namespace

int main(int argc, char** argv) {
    for (const Kind& kind : kinds) {
        std::vector<std::filesystem::path> files;
        if (argc == 2)
            for (const auto& entry : std::filesystem::directory_iterator(
                     std::filesystem::path(argv[1]) / std::string(kind.name)))
                files.push_back(entry.path());
        else if (argc > 2 && kind.name == argv[1])
            files.assign(argv + 2, argv + argc);
        std::ranges::sort(files);
        for (const std::filesystem::path& file : files) feed(kind, file);
        if (!files.empty())
            std::printf("%-16s %zu inputs\n", std::string(kind.name).c_str(), files.size());
    }
}
