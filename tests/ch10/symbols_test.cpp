#include "tests/catch.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>

namespace {

/// What `nm` says of the library: a line a symbol, which begins with archive and member.
std::string listed() {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
        popen("nm -A -C --defined-only '" ARCHIVE "' 2>/dev/null", "r"), pclose);
    std::string text;
    std::array<char, 4096> part;
    for (std::size_t size;
         pipe && (size = std::fread(part.data(), 1, part.size(), pipe.get())) > 0;)
        text.append(part.data(), size);
    return text;
}

bool has(const std::string& line, const std::string& part) {
    return line.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("what is compiled for one instruction set defines nothing that other files may share") {
    std::istringstream lines(listed());
    std::size_t kernels = 0;
    for (std::string line; std::getline(lines, line);) {
        for (const std::string set : {"sse2", "avx2", "avx512"}) {
            if (!has(line, "kernel_" + set + ".cpp")) continue;
            ++kernels;
            // Weak, unique or common: of several definitions the linker keeps any.
            const bool is_shared = has(line, " W ") || has(line, " V ") || has(line, " u ") ||
                                   has(line, " w ") || has(line, " v ") || has(line, " C ");
            const bool is_global = has(line, " T ") || has(line, " D ") || has(line, " R ") ||
                                   has(line, " B ") || is_shared;
            INFO(line);
            if (is_shared || is_global) CHECK(has(line, "space::" + set + "::"));
        }
    }
#ifdef __x86_64__
    CHECK(kernels > 0);
#endif
}
