#include "chapters/ch11_sampling_and_caching/progressive.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <type_traits>

namespace space {
namespace {

constexpr std::string_view magic = "Splitting Space film 1\n";
static_assert(std::endian::native == std::endian::little, "as the file has it");
static_assert(sizeof(Double3) == 3 * sizeof(double) && std::is_trivially_copyable_v<Double3>);

/// FNV-1a (Fowler, Noll & Vo): a bit that fell over is seen.
std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes a T from the front. @return whether there was one
template <class T>
bool take(std::string_view& bytes, T& value) {
    if (bytes.size() < sizeof value) return false;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
    return true;
}

/// Two keys' first different words.
std::string difference(std::string_view kept, std::string_view wanted) {
    std::istringstream kept_words{std::string(kept)}, wanted_words{std::string(wanted)};
    std::string a, b;
    do {
        a = b = "nothing";
        kept_words >> a;
        wanted_words >> b;
    } while (a == b && (kept_words || wanted_words));
    return fmt::format("it has {}, not {}", a, b);
}

}  // namespace

std::string film_state(const Film& film, std::string_view key) {
    std::string bytes(magic);
    append(bytes, static_cast<std::uint32_t>(key.size()));
    bytes += key;
    append(bytes, film.width);
    append(bytes, film.height);
    append(bytes, film.samples);
    bytes.append(reinterpret_cast<const char*>(film.sums.data()),
                 film.sums.size() * sizeof(Double3));
    append(bytes, checksum(bytes));
    return bytes;
}

Film load_film_state(const std::filesystem::path& file, std::string_view key, int width,
                     int height) {
    const std::string content = read_file(file);
    std::string_view bytes = content;
    const auto fault = [&](const std::string& what) {
        return input_error(fmt::format("{}: {}", file.string(), what));
    };
    if (!bytes.starts_with(magic)) throw fault("not a picture that can be gone on with");
    std::uint64_t sum = 0;
    if (bytes.size() < magic.size() + sizeof sum) throw fault("damaged: it is too short");
    std::string_view end = bytes.substr(bytes.size() - sizeof sum);
    bytes.remove_suffix(sizeof sum);
    if (!take(end, sum) || checksum(bytes) != sum) throw fault("damaged: its checksum is wrong");
    bytes.remove_prefix(magic.size());
    std::uint32_t key_size = 0;
    take(bytes, key_size);
    const std::string_view kept = bytes.substr(0, key_size);
    if (kept != key) throw fault("of another picture: " + difference(kept, key));
    bytes.remove_prefix(kept.size());
    Film film(width, height);
    int kept_width = 0, kept_height = 0;
    const bool is_whole = take(bytes, kept_width) && take(bytes, kept_height) &&
                          take(bytes, film.samples) && film.samples > 0 && kept_width == width &&
                          kept_height == height &&
                          bytes.size() == film.sums.size() * sizeof(Double3);
    if (!is_whole) throw fault("damaged: it does not hold its pixels");
    std::memcpy(film.sums.data(), bytes.data(), bytes.size());
    return film;
}

}  // namespace space
