// Sine and cosine of a share of a turn, short enough to be inlined and the same on every machine.
#pragma once

namespace wend {

struct Turn {
    float cosine, sine;
};

/// Cosine and sine of 2 pi u for u in [0, 1]. Error below 1e-7.
inline Turn fast_turn(float u) {
    constexpr float two_pi = 6.28318531f;
    const int quarter = static_cast<int>(4 * u + 0.5f);
    // At most an eighth of a turn, without rounding.
    const float a = two_pi * (u - 0.25f * static_cast<float>(quarter));
    const float x = a * a;
    const float sine = a + a * x * (-0.166666647f + x * (0.00833274827f - x * 0.000195878909f));
    const float cosine =
        1 - (0.5f * x - x * x * (0.0416666647f + x * (-0.0013888303f + x * 2.45479421e-05f)));
    const float across = quarter % 2 == 0 ? sine : cosine, along = quarter % 2 == 0 ? cosine : sine;
    return {quarter % 4 == 1 || quarter % 4 == 2 ? -along : along, quarter % 4 >= 2 ? -across : across};
}

}  // namespace wend
