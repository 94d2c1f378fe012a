#include <wend/guide/mixture.h>

#include <wend/guide/kernels.h>

namespace wend::guide {

MixtureProduct VmfMixture::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

MixtureProduct MixtureView::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

MixtureProduct::MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes) : lanes_(mixture.size(), lobes) {
    kernels().multiply(mixture.lanes_, lanes_);
}

MixtureProduct::MixtureProduct(const MixtureView& view, const AxialLobes& lobes) : lanes_(view.mixture_.size(), lobes) {
    kernels().turn_and_multiply(view.mixture_.lanes_, view.offset_, view.inverse_distance_, lanes_);
}

float MixtureProduct::density(const Vec3& direction) const {
    return kernels().product_density(lanes_, direction);
}

Vec3 MixtureProduct::sample(Vec2 u) const {
    return kernels().product_sample(lanes_, u);
}

}  // namespace wend::guide
