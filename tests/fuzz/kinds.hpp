/// @file
/// What a fuzzer feeds with bytes, by kind of input, and what must be so whatever the bytes are.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace space::fuzz {

/// One kind of input: what is done with the bytes. Where a promise is broken, `feed` says which and
/// aborts; a crash, a hang or a sanitizer's report is a fault anyway.
struct Kind {
    std::string_view name;
    void (*feed)(std::string_view bytes);
};

void feed_obj(std::string_view bytes);
void feed_off(std::string_view bytes);
void feed_ply(std::string_view bytes);
void feed_stl(std::string_view bytes);
void feed_rays(std::string_view bytes);
void feed_instances(std::string_view bytes);
void feed_lab_options(std::string_view bytes);
void feed_render_options(std::string_view bytes);
void feed_triangles(std::string_view bytes);

// [kinds]
inline constexpr Kind kinds[] = {
    {"obj", feed_obj},
    {"off", feed_off},
    {"ply", feed_ply},
    {"stl", feed_stl},
    {"rays", feed_rays},
    {"instances", feed_instances},
    {"lab_options", feed_lab_options},        // an argument a line
    {"render_options", feed_render_options},  // likewise
    {"triangles", feed_triangles},            // a soup and rays, as soup.cpp reads them
};
// [kinds]

[[noreturn]] void fail(const std::string& broken);

/// A file of this name in a folder of the process's own.
std::filesystem::path written(const std::string& name, std::string_view bytes);

}  // namespace space::fuzz
