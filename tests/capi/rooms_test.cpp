// The example in C is the example in C++, bit for bit: examples/embed_c and examples/embed render the same pictures.
#include <examples/embed_c/rooms.h>

#include <gtest/gtest.h>

#include <memory>

// The example's own walk and passes, without its program.
#define main example_main
#include <examples/embed/main.cpp>
#undef main

namespace {

void expect_same(const rooms_picture& c, const Picture& cpp) {
    ASSERT_EQ(c.samples, cpp.samples);
    for (std::size_t i = 0; i < rooms_pixels; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            ASSERT_EQ(c.mean[i][channel], cpp.mean.pixels[i][channel]) << i;
        }
    }
    for (std::size_t row = 0; row < rooms_height; ++row) {
        ASSERT_EQ(c.squares[row], cpp.squares[row]) << row;
    }
}

TEST(CRooms, AreThoseOfTheExample) {
    constexpr int samples = 4, passes = 4;
    const auto in_c = std::make_unique<std::array<rooms_picture, 2>>();
    rooms_render(samples, passes, &(*in_c)[0], &(*in_c)[1]);

    Picture classical, training, guided;
    render_both(samples, passes, classical, training, guided);
    expect_same((*in_c)[0], classical);
    expect_same((*in_c)[1], guided);
    // It is a guided picture, by then.
    EXPECT_LT(guided.variance(), classical.variance() / 2);
}

}  // namespace
