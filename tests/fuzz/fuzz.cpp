// The fuzzer: clang's libFuzzer brings main. The environment's FUZZ names the kind of input.
#include "tests/fuzz/kinds.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const space::fuzz::Kind& kind = [] {
        const char* const asked = std::getenv("FUZZ");
        for (const space::fuzz::Kind& each : space::fuzz::kinds)
            if (asked != nullptr && each.name == asked) return each;
        std::fputs("FUZZ=KIND is needed; kinds are the folders of tests/fuzz/corpus\n", stderr);
        std::_Exit(2);
    }();
    kind.feed({reinterpret_cast<const char*>(data), size});
    return 0;
}
