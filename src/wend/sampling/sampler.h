#pragma once

#include <wend/core/random.h>
#include <wend/sampling/sobol.h>

#include <cstdint>

namespace wend {

enum class SamplerKind {
    sobol,        ///< Owen-scrambled Sobol points: less noise, samples of a pixel not independent
    independent,  ///< independent uniform numbers: what statistics assume
};

/// The uniform numbers of one camera sample, a pure function of (seed, pixel, sample index): the picture does not
/// depend on which thread draws them, nor in what order pixels are rendered.
class Sampler {
public:
    Sampler(SamplerKind kind, std::uint64_t seed, std::uint64_t pixel, std::uint32_t sample)
        : random_(hash_of(seed, pixel, sample)),
          key_(hash_of(seed, pixel)),
          index_(sample),
          remaining_(kind == SamplerKind::sobol ? sobol_pairs : 0) {}

    /// Uniform in [0,1).
    float uniform() { return remaining_ > 0 ? next_pair().x : random_.uniform(); }
    /// Uniform in [0,1)².
    Vec2 uniform2() { return remaining_ > 0 ? next_pair() : random_.uniform2(); }

    /// Independent numbers, for loops of unknown length (tracking through a grid), which would shift later dimensions.
    Pcg32& random() { return random_; }

private:
    // Beyond these the walk's dimensions are of so little weight each that stratifying them gains nothing measurable.
    static constexpr int sobol_pairs = 48;

    Vec2 next_pair() {
        --remaining_;
        return owen_sobol(index_, mix(key_ + static_cast<std::uint64_t>(remaining_) * 0x9e3779b97f4a7c15ull));
    }

    Pcg32 random_;
    std::uint64_t key_;
    std::uint32_t index_;
    int remaining_;
};

}  // namespace wend
