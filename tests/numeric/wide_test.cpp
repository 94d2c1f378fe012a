#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/numeric/wide_test.cpp"
#include <hwy/foreach_target.h>

#include <wend/numeric/wide-inl.h>

HWY_BEFORE_NAMESPACE();
namespace wend::HWY_NAMESPACE {

using Block = std::array<float, floats_per_block>;

/// 2^x, 2^x - 1 and e^x.
std::array<Block, 3> wide_exponentials(const Block& x) {
    std::array<Block, 3> results;
    for (int i = 0; i < floats_per_block; i += Floats::count) {
        const Floats own = Floats::load(x.data() + i);
        fast_exp2(own).store(results[0].data() + i);
        fast_exp2m1(own).store(results[1].data() + i);
        fast_exp(own).store(results[2].data() + i);
    }
    return results;
}

float wide_sum(const Block& x) {
    return sum_over(floats_per_block, [&](int i) HWY_ATTR { return Floats::load(x.data() + i); });
}

}  // namespace wend::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <tests/support/vector_targets.h>

namespace wend {
namespace {

HWY_EXPORT(wide_exponentials);
HWY_EXPORT(wide_sum);

TEST(Wide, FunctionsAreThoseOfSingleNumbers) {
    test::for_each_target([&] {
        for (float x = -130; x < 88; x += 0.0131f) {
            const std::array block = {x, -x / 3, x * 0.01f, -x * 1e-4f, x * 1e-7f, 0.0f, 1.0f, x + 0.5f};
            const auto [exp2, exp2m1, exp] = HWY_DYNAMIC_DISPATCH(wide_exponentials)(block);
            for (std::size_t i = 0; i < block.size(); ++i) {
                ASSERT_EQ(exp2[i], fast_exp2(block[i])) << block[i];
                ASSERT_EQ(exp2m1[i], fast_exp2m1(block[i])) << block[i];
                ASSERT_EQ(exp[i], fast_exp(block[i])) << block[i];
            }
        }
    });
}

TEST(Wide, SumsHaveOneOrder) {
    // Numbers whose sum depends on the order.
    const std::array b = {1e8f, 3.3f, -1e8f, 1e-3f, 7.7f, 1e4f, -5e3f, 0.1f};
    const float expected = ((b[0] + b[4]) + (b[2] + b[6])) + ((b[1] + b[5]) + (b[3] + b[7]));
    test::for_each_target([&] { EXPECT_EQ(HWY_DYNAMIC_DISPATCH(wide_sum)(b), expected); });
}

}  // namespace
}  // namespace wend
#endif
