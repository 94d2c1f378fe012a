// Floats side by side, as many of a block as a vector target holds, for functions that are compiled for several
// targets: the same source, and the same bits, for each. Files that Highway compiles again and again include this each
// time.
#include <wend/numeric/fast_math.h>

#include <hwy/highway.h>

#include <cstdint>
#include <numbers>

#if defined(WEND_NUMERIC_WIDE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WEND_NUMERIC_WIDE_INL_H
#undef WEND_NUMERIC_WIDE_INL_H
#else
#define WEND_NUMERIC_WIDE_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace wend::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// What loops go over at a time; every target's vectors are as long or a whole part of it.
inline constexpr int floats_per_block = 8;

/// A vector of floats. Its operations round as those of single numbers do: none of them is fused or approximate.
struct Floats {
    using Tag = hn::CappedTag<float, floats_per_block>;
    static constexpr int count = static_cast<int>(HWY_MIN(HWY_LANES(float), floats_per_block));
    static_assert(floats_per_block % count == 0);

    hn::Vec<Tag> raw;

    Floats() = default;
    HWY_INLINE Floats(float x) : raw(hn::Set(Tag(), x)) {}
    HWY_INLINE explicit Floats(hn::Vec<Tag> v) : raw(v) {}

    /// The `count` numbers from `first` on.
    static HWY_INLINE Floats load(const float* first) { return Floats(hn::LoadU(Tag(), first)); }
    HWY_INLINE void store(float* first) const { hn::StoreU(raw, Tag(), first); }

    friend HWY_INLINE Floats operator+(Floats a, Floats b) { return Floats(hn::Add(a.raw, b.raw)); }
    friend HWY_INLINE Floats operator-(Floats a, Floats b) { return Floats(hn::Sub(a.raw, b.raw)); }
    friend HWY_INLINE Floats operator*(Floats a, Floats b) { return Floats(hn::Mul(a.raw, b.raw)); }
    friend HWY_INLINE Floats operator/(Floats a, Floats b) { return Floats(hn::Div(a.raw, b.raw)); }
};

HWY_INLINE Floats sqrt(Floats x) {
    return Floats(hn::Sqrt(x.raw));
}
/// The smaller and the larger one of what is not NaN.
HWY_INLINE Floats min(Floats a, Floats b) {
    return Floats(hn::Min(a.raw, b.raw));
}
HWY_INLINE Floats max(Floats a, Floats b) {
    return Floats(hn::Max(a.raw, b.raw));
}
/// `yes` where a > b, `no` elsewhere.
HWY_INLINE Floats where_greater(Floats a, Floats b, Floats yes, Floats no) {
    return Floats(hn::IfThenElse(hn::Gt(a.raw, b.raw), yes.raw, no.raw));
}

/// FastPower of many numbers.
struct Powers {
    using Bits = hn::RebindToUnsigned<Floats::Tag>;

    Floats rest;
    hn::Vec<Bits> shifted_n;

    /// 2^(n + r), n as RoundedExponent has it.
    HWY_INLINE Powers(Floats shifted, Floats r) {
        using P = FastPower;
        const Floats r2 = r * r;
        const Floats high = (P::second + r * P::third) + r2 * (P::fourth + r * P::fifth);
        rest = r * P::first + r2 * high;
        shifted_n = hn::ShiftLeft<23>(hn::BitCast(Bits(), shifted.raw));
    }

    HWY_INLINE Floats value() const { return times_power(1 + rest); }
    HWY_INLINE Floats minus_one() const {
        const Floats power = times_power(1);
        return power * rest + (power - 1);
    }

private:
    HWY_INLINE Floats times_power(Floats x) const {
        return Floats(hn::BitCast(Floats::Tag(), hn::Add(hn::BitCast(Bits(), x.raw), shifted_n)));
    }
};

HWY_INLINE Powers power_of_two(Floats x) {
    x = max(x, fast_exp2_smallest);
    const Floats shifted = x + RoundedExponent::to_integer;
    return {shifted, x - (shifted - RoundedExponent::to_integer)};
}

/// As the functions of single numbers, of x that are not NaN.
HWY_INLINE Floats fast_exp2(Floats x) {
    return power_of_two(x).value();
}
HWY_INLINE Floats fast_exp2m1(Floats x) {
    return power_of_two(x).minus_one();
}
HWY_INLINE Floats fast_exp(Floats x) {
    x = max(x, fast_exp_smallest);
    const Floats shifted = x * NaturalBase::log2_e + RoundedExponent::to_integer;
    const Floats n = shifted - RoundedExponent::to_integer;
    return Powers(shifted, ((x - n * NaturalBase::ln2_high) - n * NaturalBase::ln2_low) * NaturalBase::log2_e).value();
}

/// The numbers of a block added up in the one order there is for all widths: by halves, quarters, eighths. A template,
/// since vectors of some widths do not exist for some targets.
template <class FourFloats>
HWY_INLINE float sum_of_four(FourFloats v) {
    const auto pairs = hn::Add(v, Shuffle1032(v));
    return hn::GetLane(hn::Add(pairs, Shuffle2301(pairs)));
}
template <class Vector>
HWY_INLINE float sum_of_block(const Vector (&v)[1]) {
    const hn::Half<typename Vector::Tag> half;
    return sum_of_four(hn::Add(LowerHalf(half, v[0].raw), UpperHalf(half, v[0].raw)));
}
template <class Vector>
HWY_INLINE float sum_of_block(const Vector (&v)[2]) {
    return sum_of_four((v[0] + v[1]).raw);
}
template <class Vector>
HWY_INLINE float sum_of_block(const Vector (&v)[8]) {
    return hn::GetLane((((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]))).raw);
}

/// Σ of term(i) for i in [0, count), count a multiple of floats_per_block; term(i) has the numbers from i on.
template <class Term>
HWY_INLINE float sum_over(int count, const Term& term) {
    constexpr int parts = floats_per_block / Floats::count;
    Floats sums[parts];
    for (Floats& sum : sums) {
        sum = 0;
    }
    for (int first = 0; first < count; first += floats_per_block) {
        for (int k = 0; k < parts; ++k) {
            sums[k] = sums[k] + term(first + k * Floats::count);
        }
    }
    return sum_of_block(sums);
}

}  // namespace wend::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
