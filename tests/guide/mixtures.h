// Mixtures that tests ask.
#pragma once

#include <wend/core/random.h>
#include <wend/guide/mixture.h>

#include <array>
#include <vector>

namespace wend::test {

/// Three lobes, the last of which may be uniform.
inline guide::VmfMixture three_lobes(float last_kappa) {
    const std::array<guide::WeightedVmf, 3> lobes = {{{2.0f, {normalize(Vec3(1, 2, 3)), 20}},
                                                      {1.0f, {normalize(Vec3(-3, 1, 0)), 4}},
                                                      {0.5f, {normalize(Vec3(0, -1, -1)), last_kappa}}}};
    return guide::VmfMixture(lobes);
}

/// As many lobes as there can be, pseudo-random.
inline guide::VmfMixture many_lobes(std::uint64_t seed, float largest_kappa) {
    Pcg32 random(seed);
    std::vector<guide::WeightedVmf> lobes;
    for (int i = 0; i < guide::max_lobes; ++i) {
        const Vec3 mean = Vmf{}.sample(random.uniform2());
        lobes.push_back({random.uniform(), {mean, largest_kappa * random.uniform()}});
    }
    return guide::VmfMixture(lobes);
}

}  // namespace wend::test
