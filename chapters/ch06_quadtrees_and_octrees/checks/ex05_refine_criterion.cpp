#include "ex05_refine_criterion.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

using namespace space;

namespace {

constexpr TakenSample grey{Color(0.5f), 3};

struct Drawing : PartialPicture {
    Drawing(int w, int h) : PartialPicture{w, h, {}} {
        samples.resize(std::size_t(w) * std::size_t(h));
    }
    Drawing& put(int x, int y, const TakenSample& sample) {
        samples[std::size_t(y) * std::size_t(width) + std::size_t(x)] = sample;
        return *this;
    }
    /// At the corners of a cell, which have to lie in the picture.
    Drawing& corners(const SquareCell& cell, const TakenSample& sample) {
        for (const int y : {cell.y, cell.y + cell.edge})
            for (const int x : {cell.x, cell.x + cell.edge}) put(x, y, sample);
        return *this;
    }
};

constexpr SquareCell cell{4, 8, 4};

/// 16 x 16 pixels; the cell's corners are grey.
Drawing even() {
    return Drawing(16, 16).corners(cell, grey);
}
TakenSample grey_but(int channel, float value) {
    TakenSample sample = grey;
    sample.color[channel] = value;
    return sample;
}
TakenSample of_surface(std::uint32_t surface) {
    return {grey.color, surface};
}

/// By all pairs, in the words of the exercise.
bool is_uneven(const PartialPicture& picture, const SquareCell& c, float threshold) {
    if (c.edge == 1) return false;
    std::vector<TakenSample> evidence;
    for (int y = c.y; y <= c.y + c.edge && y < picture.height; ++y)
        for (int x = c.x; x <= c.x + c.edge && x < picture.width; ++x)
            if (picture.at(x, y)) evidence.push_back(*picture.at(x, y));
    for (const TakenSample& a : evidence)
        for (const TakenSample& b : evidence) {
            if (a.surface != b.surface) return true;
            for (int channel = 0; channel < 3; ++channel)
                if (!(std::abs(double{a.color[channel]} - double{b.color[channel]}) <=
                      double{threshold}))
                    return true;
        }
    return false;
}

}  // namespace

TEST_CASE("a cell whose corners are alike is left as it is") {
    CHECK_FALSE(must_be_split(even(), cell, 0.1f));
    CHECK_FALSE(must_be_split(even(), cell, 0.0f));
}

TEST_CASE("one corner that differs is enough, whichever it is and in whichever channel") {
    for (const auto& [x, y] : {std::pair{4, 8}, {8, 8}, {4, 12}, {8, 12}})
        for (int channel = 0; channel < 3; ++channel)
            for (const float value : {0.25f, 0.75f}) {
                CAPTURE(x, y, channel, value);
                Drawing picture = even();
                picture.put(x, y, grey_but(channel, value));
                REQUIRE(must_be_split(picture, cell, 0.125f));
            }
}

TEST_CASE("a difference as large as the threshold is none") {
    Drawing picture = even();
    picture.put(8, 8, grey_but(1, 0.75f));
    CHECK_FALSE(must_be_split(picture, cell, 0.25f));
    CHECK(must_be_split(picture, cell, std::nextafter(0.25f, 0.0f)));
}

TEST_CASE("a difference above the threshold by less than a float can say is one") {
    Drawing picture(16, 16);
    picture.put(4, 8, grey_but(0, 0.5f + 0x1p-24f)).put(8, 8, grey_but(0, 0x1p-24f - 0x1p-48f));
    CHECK(must_be_split(picture, cell, 0.5f));
    picture.put(8, 8, grey_but(0, 0x1p-24f));
    CHECK_FALSE(must_be_split(picture, cell, 0.5f));
}

TEST_CASE("colours brighter than 1, and negative ones, are compared as they are") {
    Drawing picture(16, 16);
    picture.corners(cell, grey_but(1, 3.0f));
    CHECK_FALSE(must_be_split(picture, cell, 0.5f));
    picture.put(8, 12, grey_but(1, 3.5f));
    CHECK_FALSE(must_be_split(picture, cell, 0.5f));
    CHECK(must_be_split(picture, cell, 0.25f));
    CHECK(must_be_split(even().put(8, 12, grey_but(1, -0.5f)), cell, 0.5f));
}

TEST_CASE("a black cell is even, and what differs from black is seen") {
    const TakenSample black{Color(0.0f), 3};
    Drawing picture(16, 16);
    picture.corners(cell, black);
    CHECK_FALSE(must_be_split(picture, cell, 0.0f));
    picture.put(8, 12, {Color(0.0f, 0x1p-149f, 0.0f), 3});
    CHECK(must_be_split(picture, cell, 0.0f));
}

TEST_CASE("samples are compared each with each, not all with one of them, nor with the last one") {
    Drawing picture = even();
    picture.put(8, 8, grey_but(0, 0.375f)).put(4, 12, grey_but(0, 0.625f));
    CHECK(must_be_split(picture, cell, 0.1875f));
    picture.put(4, 8, grey_but(0, 0.375f)).put(8, 8, grey);
    CHECK(must_be_split(picture, cell, 0.1875f));
}

TEST_CASE("channels are compared one by one: neither their sum nor their mean counts") {
    Drawing picture = even();
    picture.put(8, 8, {{0.5625f, 0.5625f, 0.5625f}, 3});
    CHECK_FALSE(must_be_split(picture, cell, 0.125f));
    picture.put(8, 8, {{0.75f, 0.25f, 0.5f}, 3});
    CHECK(must_be_split(picture, cell, 0.125f));
}

TEST_CASE("two surfaces of one colour are an edge, whichever corner shows the other one") {
    for (const auto& [x, y] : {std::pair{4, 8}, {8, 8}, {4, 12}, {8, 12}}) {
        CAPTURE(x, y);
        Drawing picture = even();
        picture.put(x, y, of_surface(0));
        REQUIRE(must_be_split(picture, cell, 0.5f));
    }
}

TEST_CASE("no number of a surface stands for none") {
    for (const std::uint32_t number : {0u, 0xFFFFFFFFu}) {
        CAPTURE(number);
        Drawing picture(16, 16);
        picture.corners(cell, of_surface(number));
        REQUIRE_FALSE(must_be_split(picture, cell, 0.5f));
        for (const auto& [x, y] : {std::pair{4, 8}, {6, 9}, {8, 12}}) {
            for (const std::uint32_t bit : {1u, 0x10000u, 0x80000000u}) {
                CAPTURE(x, y, bit);
                Drawing other = picture;
                other.put(x, y, of_surface(number ^ bit));
                REQUIRE(must_be_split(other, cell, 0.5f));
            }
        }
    }
}

TEST_CASE("a cell of one pixel is never split") {
    Drawing picture(16, 16);
    picture.corners({4, 8, 1}, grey).put(5, 9, of_surface(1));
    CHECK_FALSE(must_be_split(picture, {4, 8, 1}, 0.0f));
    picture.put(4, 8, grey_but(0, std::nanf("")));
    CHECK_FALSE(must_be_split(picture, {4, 8, 1}, 0.0f));
    CHECK(must_be_split(Drawing(16, 16).corners({4, 8, 2}, grey).put(6, 10, of_surface(1)),
                        {4, 8, 2}, 0.0f));
}

TEST_CASE("a sample in the cell or on its border counts, whoever has asked for it") {
    for (const auto& [x, y] : {std::pair{6, 9}, {4, 11}, {7, 8}, {8, 10}, {6, 12}}) {
        CAPTURE(x, y);
        Drawing picture = even();
        picture.put(x, y, of_surface(4));
        REQUIRE(must_be_split(picture, cell, 0.5f));
    }
}

TEST_CASE("a sample beyond the border does not count") {
    for (const auto& [x, y] : {std::pair{3, 9}, {9, 9}, {6, 7}, {6, 13}, {9, 13}, {3, 7}}) {
        CAPTURE(x, y);
        Drawing picture = even();
        picture.put(x, y, of_surface(4));
        REQUIRE_FALSE(must_be_split(picture, cell, 0.5f));
    }
}

TEST_CASE("where the next cell would lie beyond the picture its last column or row is the border") {
    Drawing picture(7, 10);
    picture.put(4, 8, grey).put(6, 8, grey).put(4, 9, grey).put(6, 9, grey);
    CHECK_FALSE(must_be_split(picture, cell, 0.0f));
    for (const auto& [x, y] : {std::pair{6, 8}, {4, 9}, {6, 9}}) {
        CAPTURE(x, y);
        Drawing other = picture;
        other.put(x, y, grey_but(2, 1.0f));
        REQUIRE(must_be_split(other, cell, 0.25f));
    }
}

TEST_CASE("pixels that have not been traced say nothing") {
    CHECK_FALSE(must_be_split(Drawing(16, 16), cell, 0.0f));
    CHECK_FALSE(must_be_split(Drawing(16, 16).put(6, 9, grey), cell, 0.0f));
}

TEST_CASE("a colour that is not finite is like no other, nor like itself") {
    for (const float value : {std::nanf(""), infinity, -infinity})
        for (int channel = 0; channel < 3; ++channel) {
            CAPTURE(value, channel);
            for (const auto& [x, y] : {std::pair{4, 8}, {8, 8}, {6, 9}, {8, 12}}) {
                CAPTURE(x, y);
                Drawing one = even();
                one.put(x, y, grey_but(channel, value));
                REQUIRE(must_be_split(one, cell, infinity));
            }
            Drawing all(16, 16);
            all.corners(cell, grey_but(channel, value));
            REQUIRE(must_be_split(all, cell, infinity));
            REQUIRE(
                must_be_split(Drawing(16, 16).put(6, 9, grey_but(channel, value)), cell, infinity));
        }
}

TEST_CASE("random pictures: split is what two samples of the evidence ask for") {
    Pcg32 random(1);
    for (int round = 0; round < sized(20'000, 2'000); ++round) {
        const int edge = 1 + int(random.below(10));
        const int columns = 1 + int(random.below(20)), rows = 1 + int(random.below(20));
        Drawing picture(columns, rows);
        const std::uint32_t traced_one_in = 1 + random.below(8);
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                if (random.below(traced_one_in) != 0) continue;
                TakenSample sample = grey;
                for (int channel = 0; channel < 3; ++channel)
                    if (random.below(12) == 0)
                        sample.color[channel] += 0.125f * float(random.below(4));
                if (random.below(60) == 0) sample.surface = 5;
                if (random.below(500) == 0) sample.color.y = std::nanf("");
                picture.put(x, y, sample);
            }
        const int x = int(random.below(std::uint32_t(columns)));
        const int y = int(random.below(std::uint32_t(rows)));
        const float threshold = 0.125f * float(random.below(4));
        CAPTURE(columns, rows, x, y, edge, threshold);
        REQUIRE(must_be_split(picture, {x, y, edge}, threshold) ==
                is_uneven(picture, {x, y, edge}, threshold));
    }
}
