// Directions at a collision in a medium.
#pragma once

#include <openpgl/cpp/Field.h>
#include <openpgl/cpp/Region.h>
#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

struct VolumeSamplingDistribution {
    explicit VolumeSamplingDistribution(const Field* field)
        : m_handle(pglFieldNewVolumeSamplingDistribution(field ? field->m_fieldHandle : nullptr)) {}
    VolumeSamplingDistribution(const VolumeSamplingDistribution&) = delete;
    ~VolumeSamplingDistribution() { pglReleaseVolumeSamplingDistribution(m_handle); }

    /// Directions in proportion to the radiance that arrives at the position; false as long as nothing is known. Lobes
    /// always turn with the position.
    bool Init(const Field* field, const pgl_point3f& pos, float& sample1D, bool /*useParallaxCompensation*/ = true) {
        return pglFieldInitVolumeSamplingDistribution(field ? field->m_fieldHandle : nullptr, m_handle, pos, &sample1D);
    }
    void Clear() { pglVolumeSamplingDistributionClear(m_handle); }

    bool SupportsApplySingleLobeHenyeyGreensteinProduct() const {
        return pglVolumeSamplingDistributionSupportsApplySingleLobeHenyeyGreensteinProduct(m_handle);
    }
    /// `dir` is the direction in which the path arrived.
    void ApplySingleLobeHenyeyGreensteinProduct(const pgl_vec3f& dir, float meanCosine) {
        pglVolumeSamplingDistributionApplySingleLobeHenyeyGreensteinProduct(m_handle, dir, meanCosine);
    }

    pgl_vec3f Sample(const pgl_point2f& sample2D) const {
        return pglVolumeSamplingDistributionSample(m_handle, sample2D);
    }
    float PDF(const pgl_vec3f& direction) const { return pglVolumeSamplingDistributionPDF(m_handle, direction); }
    float SamplePDF(const pgl_point2f& sample2D, pgl_vec3f& direction) const {
        return pglVolumeSamplingDistributionSamplePDF(m_handle, sample2D, direction);
    }
    /// Without the product.
    float IncomingRadiancePDF(const pgl_vec3f& direction) const {
        return pglVolumeSamplingDistributionIncomingRadiancePDF(m_handle, direction);
    }

    pgl_vec3f IncomingRadiance(const pgl_vec3f& direction, bool directLightMIS) const {
        return pglVolumeSamplingDistributionIncomingRadiance(m_handle, direction, directLightMIS);
    }
    pgl_vec3f InscatteredRadiance(const pgl_vec3f& direction, float g, bool directLightMIS) const {
        return pglVolumeSamplingDistributionInscatteredRadiance(m_handle, direction, g, directLightMIS);
    }
    pgl_vec3f Fluence(bool directLightMIS) const {
        return pglVolumeSamplingDistributionFluence(m_handle, directLightMIS);
    }
    pgl_vec3f OutgoingRadiance(const pgl_vec3f& direction) const {
        return pglVolumeSamplingDistributionOutgoingRadiance(m_handle, direction);
    }

    /// -1: unknown.
    float VolumeScatterProbability(const pgl_vec3f& direction, bool contributionBased) const {
        return pglVolumeSamplingDistributionVolumeScatterProbability(m_handle, direction, contributionBased);
    }

    uint32_t GetId() const { return pglVolumeSamplingDistributionGetId(m_handle); }
    Region GetRegion() const { return Region(pglVolumeSamplingGetRegion(m_handle)); }
    bool Validate() const { return pglVolumeSamplingDistributionValidate(m_handle); }

private:
    PGLVolumeSamplingDistribution m_handle;
};

}  // namespace cpp
}  // namespace openpgl
