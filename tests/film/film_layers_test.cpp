// Layers of a film that are there where they are asked for.
#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/film/film.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

const Layer* find(const Picture& picture, const std::string& name) {
    const auto found =
        std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& l) { return l.name == name; });
    return found == picture.layers.end() ? nullptr : &*found;
}

constexpr int picture_side = 16;

Film film_with(FilmLayers layers) {
    return Film({picture_side, picture_side}, {{0, 0}, {picture_side, picture_side}}, std::move(layers));
}

/// Samples of two parts, in stages of unlike noise, and of means that are 1.5 but for `shift` times the noise.
void fill(Film& film, bool halves, double shift = 0) {
    Pcg32 random(1);
    for (const float spread : {4.0f, 1.0f, 0.2f}) {
        for (int k = 0; k < picture_side * picture_side * 9; ++k) {
            const Vec2i pixel(k % picture_side, k / picture_side % picture_side);
            const double a = static_cast<double>(random.uniform());
            const double b = 1 + static_cast<double>(spread) * (static_cast<double>(random.uniform()) - 0.5 + shift);
            FilmSample sample;
            sample.radiance = Rgb(static_cast<float>(a + b));
            sample.is_of_half_a = halves && random.uniform() < 0.5f;
            film.add(pixel, sample);
            const std::array<std::array<double, 3>, 2> parts{{{a, a, a}, {b, b, b}}};
            film.add_parts(pixel, parts);
        }
        film.begin_stage();
    }
}

TEST(FilmLayers, AreNotThereUnlessAskedFor) {
    const Picture picture = film_with({}).picture();
    for (const char* name : {"half_a", "half_b", "position", "face_normal"}) {
        EXPECT_EQ(find(picture, name), nullptr) << name;
    }
}

TEST(FilmLayers, PartsAreWeightedAsTheirSum) {
    Film film = film_with({{"direct", "indirect"}, false, false});
    fill(film, false, 0.5);
    const Picture picture = film.picture();
    double mean = 0;
    for (std::size_t i = 0; i < 3 * picture.image.pixels.size(); ++i) {
        const float beauty = picture.image.pixels[i / 3].r;
        const float sum = find(picture, "direct")->values[i] + find(picture, "indirect")->values[i];
        EXPECT_NEAR(sum, beauty, 4 * 0x1p-24 * beauty);
        mean += static_cast<double>(beauty) / (3 * picture_side * picture_side);
    }
    // The stages have the means 3.5, 2 and 1.6, and the last one counts most.
    EXPECT_LT(mean, 2);
}

TEST(FilmLayers, HalvesMeetInTheBeauty) {
    Film film = film_with({{"direct", "indirect"}, true, false});
    fill(film, true);
    const Picture picture = film.picture();
    double squares = 0, variances = 0;
    for (std::size_t i = 0; i < 3 * picture.image.pixels.size(); ++i) {
        const float beauty = picture.image.pixels[i / 3].r;
        const float a = find(picture, "half_a")->values[i], b = find(picture, "half_b")->values[i];
        EXPECT_NEAR(0.5f * (a + b), beauty, 2 * 0x1p-24 * (std::abs(a) + std::abs(b)));
        squares += static_cast<double>((a - b) * (a - b)) / 4;
        variances += static_cast<double>(find(picture, "variance")->values[i]);
    }
    // 256 pixels tell their mean noise to 9 %.
    EXPECT_NEAR(squares / variances, 1, 0.3);
}

TEST(FilmLayers, ASampleWithoutAnotherHasNoHalves) {
    Film film = film_with({{}, true, false});
    FilmSample sample;
    sample.radiance = Rgb(3.0f);
    sample.is_of_half_a = true;
    film.add({0, 0}, sample);
    film.reject({1, 0}, true);
    FilmSample other;
    other.radiance = Rgb(2.0f);
    film.add({1, 0}, other);
    const Picture picture = film.picture();
    EXPECT_EQ(find(picture, "half_a")->values[0], 3) << "nothing is known of its noise";
    EXPECT_EQ(find(picture, "half_b")->values[0], 3);
    EXPECT_EQ(find(picture, "half_a")->values[3], 0) << "a rejected sample counts as black";
    EXPECT_EQ(find(picture, "half_b")->values[3], 2);
}

TEST(FilmLayers, GeometryIsAMeanOverRays) {
    Film film = film_with({{}, false, true});
    FilmFeatures seen;
    seen.position = {1, 2, 3};
    seen.face_normal = {0, 0, 1};
    film.add_features({0, 0}, seen);
    film.add_features({0, 0}, {});
    const Picture picture = film.picture();
    EXPECT_EQ(find(picture, "position")->values[1], 1);
    EXPECT_EQ(find(picture, "face_normal")->values[2], 0.5f);
}

TEST(FilmLayers, ArchivesHoldThem) {
    const FilmLayers layers{{"direct", "indirect"}, true, true};
    Film film = film_with(layers);
    fill(film, true);
    FilmFeatures seen;
    seen.position = {1, 2, 3};
    film.add_features({3, 4}, seen);
    ArchiveWriter whole, part;
    whole(film);
    const PixelRect lower{{0, 8}, {picture_side, picture_side}}, upper{{0, 0}, {picture_side, 8}};
    Film again = film_with(layers), joined = film_with(layers);
    ArchiveReader reader(whole.bytes());
    reader(again);
    EXPECT_TRUE(reader.empty());
    ArchiveWriter copy;
    copy(again);
    EXPECT_EQ(copy.bytes(), whole.bytes());

    for (const PixelRect& rect : {lower, upper}) {
        ArchiveWriter bytes;
        Film::archive_part(bytes, film, rect);
        ArchiveReader from(bytes.bytes());
        Film::archive_part(from, joined, rect);
        EXPECT_TRUE(from.empty());
    }
    // Weights of stages are no part of a part.
    for (const char* name : {"samples", "position"}) {
        EXPECT_EQ(find(joined.picture(), name)->values, find(film.picture(), name)->values) << name;
    }
    Film plain = film_with({});
    ArchiveReader other(whole.bytes());
    EXPECT_THROW(other(plain), InputError) << "a film of other layers";
}

}  // namespace
}  // namespace wend
