#include <wend/guide/kernels.h>

// Vectors whose length is not known before the program runs cannot be members, and would not be blocks.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wend/guide/kernels.cpp"
#include <hwy/foreach_target.h>

#include <wend/guide/lobe_kernels-inl.h>
#include <wend/guide/mixture_kernels-inl.h>
#include <wend/guide/product_kernels-inl.h>

HWY_BEFORE_NAMESPACE();
namespace wend::guide::HWY_NAMESPACE {

Kernels own_kernels() {
    return {
        .target = hwy::TargetName(HWY_TARGET),
        .density = density,
        .turn = turn,
        .multiply = multiply,
        .turn_and_multiply = turn_and_multiply,
        .product_density = product_density,
        .product_sample = product_sample,
        .add_observations = add_observations,
    };
}

}  // namespace wend::guide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wend::guide {

HWY_EXPORT(own_kernels);

Kernels best_kernels() {
    return HWY_DYNAMIC_DISPATCH(own_kernels)();
}

}  // namespace wend::guide
#endif
