// A picture in passes: the same sums however it is cut into threads and runs.
#include "chapters/ch11_sampling_and_caching/progressive.hpp"

#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/temporary.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

namespace space {
namespace {

/// A light that differs with direction and random numbers.
auto any_light() {
    return [] {
        return [](const Ray& ray, Sampler& sampler) {
            const double u = sampler.next();
            return Double3(ray.direction) + Double3(u, 1e-3 * u, 1.0 / 3.0);
        };
    };
}

Film film_after(std::uint32_t passes, unsigned threads, std::uint64_t seed = 1) {
    Film film(13, 7);
    const Sampler numbers(SamplePattern::sobol, passes, seed);
    for (std::uint32_t i = 0; i < passes; ++i) add_pass(film, {}, numbers, threads, any_light());
    return film;
}

std::string fault_of(const std::filesystem::path& file, std::string_view key) {
    try {
        load_film_state(file, key, 13, 7);
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        return error.what();
    }
    return "none";
}

}  // namespace

TEST_CASE("passes give the same sums, to the last bit, for any number of threads") {
    const Film film = film_after(5, 1);
    CHECK(film.samples == 5);
    CHECK(film_after(5, 4) == film);
    CHECK_FALSE(film_after(5, 1, 2) == film);
}

TEST_CASE("a film's state comes back to the last bit, and passes go on from it") {
    const TemporaryDirectory directory;
    Film film = film_after(2, 1);
    write_file(directory / "state", film_state(film, "scene=a size=b"));
    Film again = load_film_state(directory / "state", "scene=a size=b", 13, 7);
    CHECK(again == film);
    const Sampler numbers(SamplePattern::sobol, 5, 1);
    while (again.samples < 5) add_pass(again, {}, numbers, 3, any_light());
    CHECK(again == film_after(5, 1));
    film.sums[3].x = std::numeric_limits<double>::infinity();
    film.sums[4].y = -0.0;
    CHECK(film_state(film, "k") != film_state(again, "k"));
}

TEST_CASE("a sample's ray goes through its own pixel, and its points fill the pixel") {
    const Camera camera;
    constexpr int side = 4;
    constexpr std::uint32_t samples = 64;
    Film film(side, side);
    const PixelGrid grid(camera, side, side);
    const Sampler numbers(SamplePattern::sobol, samples, 1);
    const auto place = [&] {
        return [&](const Ray& ray, Sampler&) {
            const double half = grid.frame.tan_half_fov;
            return Double3((ray.direction.x / half + 1.0) * 0.5 * side,
                           (1.0 - ray.direction.y / half) * 0.5 * side, 0.0);
        };
    };
    Film before = film;
    for (std::uint32_t i = 0; i < samples; ++i) {
        add_pass(film, camera, numbers, 1, place);
        grid.for_each([&](int x, int y) {
            const Double3 at = film.sums[film.pixel(x, y)] - before.sums[film.pixel(x, y)];
            const bool inside =
                at.x > x - 1e-5 && at.x < x + 1 + 1e-5 && at.y > y - 1e-5 && at.y < y + 1 + 1e-5;
            if (!inside) FAIL("(" << at.x << ", " << at.y << ") in pixel " << x << ", " << y);
        });
        before = film;
    }
    // 64 points of a Sobol' sequence lie one in each of 64 strips: the mean is off by less.
    grid.for_each([&](int x, int y) {
        CHECK(std::abs(film.radiance(x, y).x - (x + 0.5)) < 1.0 / 64);
        CHECK(std::abs(film.radiance(x, y).y - (y + 0.5)) < 1.0 / 64);
    });
}

TEST_CASE("each row has an estimator of its own") {
    Film film(3, 9);
    int made = 0;
    add_pass(film, {}, {SamplePattern::independent, 1, 1}, 1,
             [&] { return [number = ++made](const Ray&, Sampler&) { return Double3(number); }; });
    CHECK(made == 9);
    for (int y = 0; y < 9; ++y) CHECK(film.radiance(2, y) == Double3(y + 1));
}

TEST_CASE("another key, and a state with any byte changed or missing, is refused") {
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory / "state";
    const std::string state = film_state(film_after(1, 1), "scene=a size=b");
    write_file(file, state);
    CHECK(fault_of(file, "scene=a size=c") ==
          file.string() + ": of another picture: it has size=b, not size=c");
    CHECK(fault_of(file, "scene=a") ==
          file.string() + ": of another picture: it has size=b, not nothing");
    CHECK(fault_of(file, "scene=a size=b") == "none");
    for (std::size_t at = 0; at < state.size(); at += at < 80 ? 1 : 97) {
        std::string damaged = state;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        write_file(file, damaged);
        if (fault_of(file, "scene=a size=b") == "none") FAIL("byte " << at);
        write_file(file, state.substr(0, at));
        if (fault_of(file, "scene=a size=b") == "none") FAIL("size " << at);
    }
    CHECK(fault_of(directory / "none", "").find("No such file") != std::string::npos);
}

TEST_CASE(
    "a state of another size, of no pass, or with bytes to spare is refused, checksum or no") {
    const TemporaryDirectory directory;
    const std::filesystem::path file = directory / "state";
    const Film right = film_after(1, 1);
    Film turned = right, none = right, longer = right;
    std::swap(turned.width, turned.height);
    none.samples = 0;
    longer.sums.emplace_back(1.0);
    write_file(file, film_state(right, "k"));
    CHECK(fault_of(file, "k") == "none");
    for (const Film& film : {turned, none, longer}) {
        write_file(file, film_state(film, "k"));  // whose checksum is right
        CHECK(fault_of(file, "k") == file.string() + ": damaged: it does not hold its pixels");
    }
}

TEST_CASE("a picture is the mean of its samples times the exposure, and black before the first") {
    Film film(2, 1);
    CHECK(film.image().at(1, 0) == glm::vec3(0.0f));
    film.sums = {{1, 2, 3}, {4, 6, 8}};
    film.samples = 4;
    CHECK(film.radiance(0, 0) == Double3(0.25, 0.5, 0.75));
    CHECK(film.image(0.5).at(1, 0) == glm::vec3(0.5f, 0.75f, 1.0f));
}

}  // namespace space
