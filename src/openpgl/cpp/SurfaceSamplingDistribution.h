// Directions at a point of a surface.
#pragma once

#include <openpgl/cpp/Field.h>
#include <openpgl/cpp/Region.h>
#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

struct SurfaceSamplingDistribution {
    explicit SurfaceSamplingDistribution(const Field* field)
        : m_handle(pglFieldNewSurfaceSamplingDistribution(field ? field->m_fieldHandle : nullptr)) {}
    SurfaceSamplingDistribution(const SurfaceSamplingDistribution&) = delete;
    ~SurfaceSamplingDistribution() { pglReleaseSurfaceSamplingDistribution(m_handle); }

    /// Directions in proportion to the radiance that arrives at the position; false as long as nothing is known. Lobes
    /// always turn with the position.
    bool Init(const Field* field, const pgl_point3f& pos, float& sample1D, bool /*useParallaxCompensation*/ = true) {
        return pglFieldInitSurfaceSamplingDistribution(field ? field->m_fieldHandle : nullptr, m_handle, pos,
                                                       &sample1D);
    }
    void Clear() { pglSurfaceSamplingDistributionClear(m_handle); }

    bool SupportsApplyCosineProduct() const {
        return pglSurfaceSamplingDistributionSupportsApplyCosineProduct(m_handle);
    }
    void ApplyCosineProduct(const pgl_vec3f& normal) {
        pglSurfaceSamplingDistributionApplyCosineProduct(m_handle, normal);
    }

    pgl_vec3f Sample(const pgl_point2f& sample2D) const {
        return pglSurfaceSamplingDistributionSample(m_handle, sample2D);
    }
    float PDF(const pgl_vec3f& direction) const { return pglSurfaceSamplingDistributionPDF(m_handle, direction); }
    float SamplePDF(const pgl_point2f& sample2D, pgl_vec3f& direction) const {
        return pglSurfaceSamplingDistributionSamplePDF(m_handle, sample2D, direction);
    }
    /// Without the product.
    float IncomingRadiancePDF(const pgl_vec3f& direction) const {
        return pglSurfaceSamplingDistributionIncomingRadiancePDF(m_handle, direction);
    }

    pgl_vec3f IncomingRadiance(const pgl_vec3f& direction, bool directLightMIS) const {
        return pglSurfaceSamplingDistributionIncomingRadiance(m_handle, direction, directLightMIS);
    }
    pgl_vec3f Irradiance(const pgl_vec3f& normal, bool directLightMIS) const {
        return pglSurfaceSamplingDistributionIrradiance(m_handle, normal, directLightMIS);
    }
    pgl_vec3f OutgoingRadiance(const pgl_vec3f& direction) const {
        return pglSurfaceSamplingDistributionOutgoingRadiance(m_handle, direction);
    }

    /// -1: unknown.
    float VolumeScatterProbability(const pgl_vec3f& direction, bool contributionBased) const {
        return pglSurfaceSamplingDistributionVolumeScatterProbability(m_handle, direction, contributionBased);
    }

    uint32_t GetId() const { return pglSurfaceSamplingDistributionGetId(m_handle); }
    Region GetRegion() const { return Region(pglSurfaceSamplingGetRegion(m_handle)); }
    bool Validate() const { return pglSurfaceSamplingDistributionValidate(m_handle); }

private:
    PGLSurfaceSamplingDistribution m_handle;
};

}  // namespace cpp
}  // namespace openpgl
