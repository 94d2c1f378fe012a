// Sampling distributions, for C.
#include <wend/openpgl/boundary.h>
#include <wend/openpgl/values.h>

#include <optional>

using namespace wend;
using namespace wend::openpgl;

namespace {

constexpr pgl_vec3f unknown{0, 0, 0};

template <class Object>
Object* new_object() noexcept {
    return guarded<Object*>(nullptr, [] { return new Object; });
}

template <class Handle>
bool init(PGLField field, Handle distribution, Half half, const pgl_point3f& position) noexcept {
    return is_object(field) && is_object(distribution) &&
           distribution->value.init(field->value.field(half), to_vector(position));
}

template <class Handle>
void multiply(Handle distribution, const std::optional<AxialLobes>& lobes) noexcept {
    if (is_object(distribution) && lobes) {
        distribution->value.multiply(*lobes);
    }
}

template <class Handle>
pgl_vec3f sample(Handle distribution, const pgl_point2f& u) noexcept {
    return from_vector(is_object(distribution) ? distribution->value.sample({u.x, u.y})
                                               : Directions().sample({u.x, u.y}));
}

template <class Handle>
float density(Handle distribution, const pgl_vec3f& direction) noexcept {
    return is_object(distribution) ? distribution->value.density(to_vector(direction)) : inv_4pi;
}

template <class Handle>
float sample_with_density(Handle distribution, const pgl_point2f& u, pgl_vec3f& direction) noexcept {
    direction = sample(distribution, u);
    return density(distribution, direction);
}

template <class Handle>
float incident_density(Handle distribution, const pgl_vec3f& direction) noexcept {
    return is_object(distribution) ? distribution->value.incident_density(to_vector(direction)) : inv_4pi;
}

template <class Handle>
pgl_vec3f radiance(Handle distribution, const pgl_vec3f& direction) noexcept {
    return is_object(distribution) ? from_colour(distribution->value.radiance(to_vector(direction))) : unknown;
}

template <class Handle>
pgl_vec3f scattered(Handle distribution, const std::optional<AxialLobes>& lobes, float scale) noexcept {
    return is_object(distribution) && lobes ? from_colour(scale * distribution->value.scattered(*lobes)) : unknown;
}

}  // namespace

PGLSurfaceSamplingDistribution pglFieldNewSurfaceSamplingDistribution(PGLField /*field*/) noexcept {
    return new_object<PGLSurfaceSamplingDistributionObject>();
}

void pglReleaseSurfaceSamplingDistribution(PGLSurfaceSamplingDistribution surfaceSamplingDistribution) noexcept {
    release(surfaceSamplingDistribution);
}

bool pglFieldInitSurfaceSamplingDistribution(PGLField field, PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                             pgl_point3f position, float* /*sample1D*/) noexcept {
    return init(field, surfaceSamplingDistribution, Half::surface, position);
}

void pglSurfaceSamplingDistributionApplyCosineProduct(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                                      pgl_vec3f normal) noexcept {
    multiply(surfaceSamplingDistribution, cosine_lobes(to_vector(normal)));
}

bool pglSurfaceSamplingDistributionSupportsApplyCosineProduct(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution) noexcept {
    return is_object(surfaceSamplingDistribution);
}

pgl_vec3f pglSurfaceSamplingDistributionSample(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                               pgl_point2f sample) noexcept {
    return ::sample(surfaceSamplingDistribution, sample);
}

float pglSurfaceSamplingDistributionPDF(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                        pgl_vec3f direction) noexcept {
    return density(surfaceSamplingDistribution, direction);
}

float pglSurfaceSamplingDistributionSamplePDF(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                              pgl_point2f sample, pgl_vec3f& direction) noexcept {
    return sample_with_density(surfaceSamplingDistribution, sample, direction);
}

float pglSurfaceSamplingDistributionIncomingRadiancePDF(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                                        pgl_vec3f direction) noexcept {
    return incident_density(surfaceSamplingDistribution, direction);
}

uint32_t pglSurfaceSamplingDistributionGetId(PGLSurfaceSamplingDistribution surfaceSamplingDistribution) noexcept {
    return is_object(surfaceSamplingDistribution) ? surfaceSamplingDistribution->value.cell() : 0;
}

bool pglSurfaceSamplingDistributionValidate(PGLSurfaceSamplingDistribution surfaceSamplingDistribution) noexcept {
    return is_object(surfaceSamplingDistribution) && surfaceSamplingDistribution->value.is_initialized();
}

void pglSurfaceSamplingDistributionClear(PGLSurfaceSamplingDistribution surfaceSamplingDistribution) noexcept {
    if (is_object(surfaceSamplingDistribution)) {
        surfaceSamplingDistribution->value.clear();
    }
}

float pglSurfaceSamplingDistributionVolumeScatterProbability(
    PGLSurfaceSamplingDistribution /*surfaceSamplingDistribution*/, pgl_vec3f /*direction*/,
    bool /*contributionBased*/) noexcept {
    return -1;
}

PGLRegion pglSurfaceSamplingGetRegion(PGLSurfaceSamplingDistribution /*surfaceSamplingDistribution*/) noexcept {
    return nullptr;
}

pgl_vec3f pglSurfaceSamplingDistributionIncomingRadiance(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                                         pgl_vec3f direction, bool /*directLightMIS*/) noexcept {
    return radiance(surfaceSamplingDistribution, direction);
}

pgl_vec3f pglSurfaceSamplingDistributionIrradiance(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                                   pgl_vec3f normal, bool /*directLightMIS*/) noexcept {
    // The lobes have the integral 1, the cosine has pi.
    return scattered(surfaceSamplingDistribution, cosine_lobes(to_vector(normal)), pi);
}

pgl_vec3f pglSurfaceSamplingDistributionOutgoingRadiance(PGLSurfaceSamplingDistribution /*surfaceSamplingDistribution*/,
                                                         pgl_vec3f /*direction*/) noexcept {
    return unknown;
}

PGLVolumeSamplingDistribution pglFieldNewVolumeSamplingDistribution(PGLField /*field*/) noexcept {
    return new_object<PGLVolumeSamplingDistributionObject>();
}

void pglReleaseVolumeSamplingDistribution(PGLVolumeSamplingDistribution volumeSamplingDistribution) noexcept {
    release(volumeSamplingDistribution);
}

bool pglFieldInitVolumeSamplingDistribution(PGLField field, PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                            pgl_point3f position, float* /*sample1D*/) noexcept {
    return init(field, volumeSamplingDistribution, Half::volume, position);
}

void pglVolumeSamplingDistributionApplySingleLobeHenyeyGreensteinProduct(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_vec3f dir, float meanCosine) noexcept {
    if (is_object(volumeSamplingDistribution)) {
        multiply(volumeSamplingDistribution, volumeSamplingDistribution->phase.around(to_vector(dir), meanCosine));
    }
}

bool pglVolumeSamplingDistributionSupportsApplySingleLobeHenyeyGreensteinProduct(
    PGLVolumeSamplingDistribution volumeSamplingDistribution) noexcept {
    return is_object(volumeSamplingDistribution);
}

pgl_vec3f pglVolumeSamplingDistributionSample(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                              pgl_point2f sample) noexcept {
    return ::sample(volumeSamplingDistribution, sample);
}

float pglVolumeSamplingDistributionPDF(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                       pgl_vec3f direction) noexcept {
    return density(volumeSamplingDistribution, direction);
}

float pglVolumeSamplingDistributionSamplePDF(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                             pgl_point2f sample, pgl_vec3f& direction) noexcept {
    return sample_with_density(volumeSamplingDistribution, sample, direction);
}

float pglVolumeSamplingDistributionIncomingRadiancePDF(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                                       pgl_vec3f direction) noexcept {
    return incident_density(volumeSamplingDistribution, direction);
}

uint32_t pglVolumeSamplingDistributionGetId(PGLVolumeSamplingDistribution volumeSamplingDistribution) noexcept {
    return is_object(volumeSamplingDistribution) ? volumeSamplingDistribution->value.cell() : 0;
}

bool pglVolumeSamplingDistributionValidate(PGLVolumeSamplingDistribution volumeSamplingDistribution) noexcept {
    return is_object(volumeSamplingDistribution) && volumeSamplingDistribution->value.is_initialized();
}

void pglVolumeSamplingDistributionClear(PGLVolumeSamplingDistribution volumeSamplingDistribution) noexcept {
    if (is_object(volumeSamplingDistribution)) {
        volumeSamplingDistribution->value.clear();
    }
}

float pglVolumeSamplingDistributionVolumeScatterProbability(
    PGLVolumeSamplingDistribution /*volumeSamplingDistribution*/, pgl_vec3f /*direction*/,
    bool /*contributionBased*/) noexcept {
    return -1;
}

PGLRegion pglVolumeSamplingGetRegion(PGLVolumeSamplingDistribution /*volumeSamplingDistribution*/) noexcept {
    return nullptr;
}

pgl_vec3f pglVolumeSamplingDistributionIncomingRadiance(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                                        pgl_vec3f direction, bool /*directLightMIS*/) noexcept {
    return radiance(volumeSamplingDistribution, direction);
}

pgl_vec3f pglVolumeSamplingDistributionInscatteredRadiance(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                                           pgl_vec3f direction, float g,
                                                           bool /*directLightMIS*/) noexcept {
    return is_object(volumeSamplingDistribution)
               ? scattered(volumeSamplingDistribution,
                           volumeSamplingDistribution->phase.around(-to_vector(direction), g), 1)
               : unknown;
}

pgl_vec3f pglVolumeSamplingDistributionFluence(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                               bool /*directLightMIS*/) noexcept {
    return is_object(volumeSamplingDistribution) ? from_colour(volumeSamplingDistribution->value.fluence()) : unknown;
}

pgl_vec3f pglVolumeSamplingDistributionOutgoingRadiance(PGLVolumeSamplingDistribution /*volumeSamplingDistribution*/,
                                                        pgl_vec3f /*direction*/) noexcept {
    return unknown;
}
