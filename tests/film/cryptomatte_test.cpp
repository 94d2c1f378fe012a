// Numbers of names, and the objects of pixels as layers.
#include <wend/film/cryptomatte.h>
#include <wend/film/film.h>

#include <gtest/gtest.h>

#include <bit>

namespace wend {
namespace {

TEST(Cryptomatte, NamesHaveTheNumbersThatOthersGiveThem) {
    // As Blender 5.0.1 writes them.
    EXPECT_EQ(hexadecimal(cryptomatte_id("Cube")), "a8fce865");
    EXPECT_EQ(hexadecimal(cryptomatte_id("Light")), "c77d43e5");
    EXPECT_EQ(hexadecimal(cryptomatte_id("object")), "055ec73d");
    EXPECT_EQ(hexadecimal(murmur_hash("ViewLayer.CryptoObject")).substr(0, 7), "542cafa");
    EXPECT_EQ(murmur_hash(""), 0u);
}

TEST(Cryptomatte, NumbersAreOrdinaryFloats) {
    int changed = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::string name = "object " + std::to_string(i);
        const std::uint32_t id = cryptomatte_id(name);
        const std::uint32_t exponent = id >> 23 & 255;
        ASSERT_TRUE(exponent != 0 && exponent != 255) << name;
        changed += id != murmur_hash(name) ? 1 : 0;
    }
    EXPECT_GT(changed, 50) << "one in 128 must be changed";
    EXPECT_LT(changed, 300);
}

float number(std::uint32_t id) {
    return std::bit_cast<float>(id);
}

TEST(Cryptomatte, ObjectsComeByTheirCoverage) {
    Film film({2, 1}, {{0, 0}, {2, 1}}, {{}, false, false, true});
    const std::vector<Coverage> rays[] = {{{11, 0.25f}, {12, 0.75f}}, {{12, 1.0f}}, {{13, 0.5f}}, {}};
    for (const auto& seen : rays) {
        film.add_features({0, 0}, {});
        film.add_coverage({0, 0}, seen);
    }
    for (std::uint32_t id = 1; id <= 8; ++id) {
        const std::vector<Coverage> seen = {{id, 0.1f * static_cast<float>(id)}};
        film.add_coverage({1, 0}, seen);
    }
    std::vector<Layer> layers;
    for (Layer& layer : film.picture().layers) {
        if (is_cryptomatte(layer)) {
            layers.push_back(std::move(layer));
        }
    }
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].name, "CryptoObject00");
    EXPECT_EQ(std::vector(layers[0].values.begin(), layers[0].values.begin() + 4),
              (std::vector{number(12), 1.75f / 4, number(13), 0.5f / 4}));
    EXPECT_EQ(std::vector(layers[1].values.begin(), layers[1].values.begin() + 4),
              (std::vector{number(11), 0.25f / 4, 0.0f, 0.0f}));
    // Of eight objects the six that cover most.
    EXPECT_EQ(layers[0].values[4], number(8));
    EXPECT_EQ(layers[2].values[6], number(3));

    PixelCoverage again;
    for (const Layer& layer : layers) {
        add_coverage(layer, 0, 2, again);
    }
    ASSERT_EQ(again.objects().size(), 3u);
    EXPECT_EQ(again.objects()[0].id, 12u);
    EXPECT_EQ(again.objects()[0].part, 2 * 1.75f / 4);
}

}  // namespace
}  // namespace wend
