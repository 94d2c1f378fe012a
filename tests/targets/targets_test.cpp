// The guide computes the same bits whatever vector instructions it was compiled for.
#include <tests/targets/fingerprint.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>

namespace wend::test {
namespace {

/// Whether this processor can run programs compiled with -march=x86-64-vN.
bool can_run(int level) {
    switch (level) {
        case 1:
            return true;
        case 2:
            return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
        case 3:
            return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
        default:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl");
    }
}

std::string output_of(const std::string& program) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(program.c_str(), "r"), pclose);
    char line[64] = "";
    return pipe && std::fgets(line, sizeof line, pipe.get()) ? line : "";
}

std::string expected() {
    char line[64];
    std::snprintf(line, sizeof line, "%016llx\n", static_cast<unsigned long long>(fingerprint()));
    return line;
}

class Targets : public testing::TestWithParam<int> {};

TEST_P(Targets, ComputeTheSameBits) {
    if (!can_run(GetParam())) {
        GTEST_SKIP() << "this processor has no x86-64-v" << GetParam();
    }
    EXPECT_EQ(output_of(std::string(WEND_FINGERPRINTS) + "/fingerprint_v" + std::to_string(GetParam())), expected());
}

INSTANTIATE_TEST_SUITE_P(Levels, Targets, testing::Values(1, 2, 3, 4));

TEST(Targets, FusedOperationsWouldShow) {
    // The twin: the same sources, compiled with multiplication and addition in one rounding.
    if (!can_run(3)) {
        GTEST_SKIP() << "this processor has no fused operations";
    }
    const std::string fused = output_of(std::string(WEND_FINGERPRINTS) + "/fingerprint_fused");
    EXPECT_EQ(fused.size(), expected().size());
    EXPECT_NE(fused, expected());
}

}  // namespace
}  // namespace wend::test
