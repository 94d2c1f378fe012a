// Open PGL's interface over Wend's learned field, for C. docs/openpgl.md says what differs.
//
// No function throws. A handle that is null or of another kind, an index out of range or a number that is none changes
// nothing and gets an answer that does no harm: null, false, 0, or the uniform distribution. What went wrong with a
// file, or for lack of memory, is also a line on the standard error stream.
#pragma once

#include <openpgl/common.h>
#include <openpgl/config.h>
#include <openpgl/data.h>
#include <openpgl/version.h>

#ifdef __cplusplus
#include <cassert>
#ifndef OPENPGL_DISABLE_ASSERTS
#define OPENPGL_ASSERT(condition) assert(condition);
#else
#define OPENPGL_ASSERT(condition)
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct PGLDeviceObject* PGLDevice;
typedef struct PGLFieldObject* PGLField;
typedef struct PGLFieldStatisticsObject* PGLFieldStatistics;
typedef struct PGLPathSegmentStorageObject* PGLPathSegmentStorage;
typedef struct PGLRegionObject* PGLRegion;
typedef struct PGLSampleStorageObject* PGLSampleStorage;
typedef struct PGLSurfaceSamplingDistributionObject* PGLSurfaceSamplingDistribution;
typedef struct PGLVolumeSamplingDistributionObject* PGLVolumeSamplingDistribution;
/// Within its storage: valid until that is cleared, reserved anew or released.
typedef PGLPathSegmentData* PGLPathSegment;

// ---- Devices: how many threads learn (0: all) ----

OPENPGL_CORE_INTERFACE PGLDevice pglNewDevice(PGL_DEVICE_TYPE deviceType,
                                              size_t numThreads OPENPGL_OPTIONAL(0)) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleaseDevice(PGLDevice device) OPENPGL_NOEXCEPT;

// ---- Fields: what has been learned, of surfaces and of volumes ----

OPENPGL_CORE_INTERFACE void pglFieldArgumentsSetDefaults(
    OPENPGL_REF(PGLFieldArguments) fieldArguments, PGL_SPATIAL_STRUCTURE_TYPE spatialType,
    PGL_DIRECTIONAL_DISTRIBUTION_TYPE directionalType, bool deterministic OPENPGL_OPTIONAL(true),
    size_t maxSamplesPerLeaf OPENPGL_OPTIONAL(PGL_TREE_MAX_SAMPLE_PER_LEAF)) OPENPGL_NOEXCEPT;
/// Ends what pglFieldArgumentsSetDefaults() made. (Wend's addition.)
OPENPGL_CORE_INTERFACE void pglReleaseFieldArguments(OPENPGL_REF(PGLFieldArguments) fieldArguments) OPENPGL_NOEXCEPT;

OPENPGL_CORE_INTERFACE PGLField pglDeviceNewField(PGLDevice device, PGLFieldArguments args) OPENPGL_NOEXCEPT;
/// Null for a file that is missing, of another kind or version, or was changed.
OPENPGL_CORE_INTERFACE PGLField pglDeviceNewFieldFromFile(PGLDevice device, const char* fieldFileName) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleaseField(PGLField field) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE bool pglFieldStoreToFile(PGLField field, const char* fieldFileName) OPENPGL_NOEXCEPT;

/// How many times it was updated.
OPENPGL_CORE_INTERFACE size_t pglFieldGetIteration(PGLField field) OPENPGL_NOEXCEPT;
/// Before the first update, or after a reset: later ones count from the next reset on. Without, the samples of the
/// first update tell.
OPENPGL_CORE_INTERFACE void pglFieldSetSceneBounds(PGLField field, pgl_box3f bounds) OPENPGL_NOEXCEPT;
/// Empty as long as nothing is known.
OPENPGL_CORE_INTERFACE pgl_box3f pglFieldGetSceneBounds(PGLField field) OPENPGL_NOEXCEPT;

/// Learns from the samples, which stay. Nobody may ask the field meanwhile.
OPENPGL_CORE_INTERFACE void pglFieldUpdate(PGLField field, PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
/// The same from samples of surfaces alone.
OPENPGL_CORE_INTERFACE void pglFieldUpdateSurface(PGLField field, PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
/// The same from samples of volumes alone.
OPENPGL_CORE_INTERFACE void pglFieldUpdateVolume(PGLField field, PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
/// Forgets all but the configuration and the bounds that were set.
OPENPGL_CORE_INTERFACE void pglFieldReset(PGLField field) OPENPGL_NOEXCEPT;

OPENPGL_CORE_INTERFACE bool pglFieldValidate(PGLField field) OPENPGL_NOEXCEPT;
/// Whether both answer the same, bit for bit.
OPENPGL_CORE_INTERFACE bool pglFieldCompare(PGLField fieldA, PGLField fieldB) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLFieldStatistics pglFieldGetSurfaceStatistics(PGLField field) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLFieldStatistics pglFieldGetVolumeStatistics(PGLField field) OPENPGL_NOEXCEPT;

OPENPGL_CORE_INTERFACE void pglReleaseFieldStatistics(PGLFieldStatistics fieldStatistics) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLString pglFieldStatisticsToString(PGLFieldStatistics fieldStatistics) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLString pglFieldStatisticsHeaderCSVString(PGLFieldStatistics fieldStatistics) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLString pglFieldStatisticsToCSVString(PGLFieldStatistics fieldStatistics) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleaseString(PGLString str) OPENPGL_NOEXCEPT;

// ---- Samples: any number of threads may add to a storage at once, and what is learned does not depend on their order
// ----

OPENPGL_CORE_INTERFACE PGLSampleStorage pglNewSampleStorage(void) OPENPGL_NOEXCEPT;
/// Null for a file that is missing, of another kind or version, or was changed.
OPENPGL_CORE_INTERFACE PGLSampleStorage pglNewSampleStorageFromFile(const char* sampleStorageFileName) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleaseSampleStorage(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE bool pglSampleStorageStoreToFile(PGLSampleStorage sampleStorage,
                                                        const char* sampleStorageFileName) OPENPGL_NOEXCEPT;

OPENPGL_CORE_INTERFACE void pglSampleStorageAddSample(PGLSampleStorage sampleStorage,
                                                      OPENPGL_REF(const PGLSampleData) sample) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSampleStorageAddSamples(PGLSampleStorage sampleStorage, const PGLSampleData* samples,
                                                       size_t numSamples) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSampleStorageAddZeroValueSample(PGLSampleStorage sampleStorage,
                                                               OPENPGL_REF(const PGLZeroValueSampleData)
                                                                   sample) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSampleStorageAddZeroValueSamples(PGLSampleStorage sampleStorage,
                                                                const PGLZeroValueSampleData* samples,
                                                                size_t numSamples) OPENPGL_NOEXCEPT;
/// Adds what the other has, which stays.
OPENPGL_CORE_INTERFACE void pglSampleStorageMerge(PGLSampleStorage sampleStorage,
                                                  PGLSampleStorage other) OPENPGL_NOEXCEPT;

/// Does nothing: memory grows as samples come.
OPENPGL_CORE_INTERFACE void pglSampleStorageReserve(PGLSampleStorage sampleStorage, size_t sizeSurface,
                                                    size_t sizeVolume) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSampleStorageClear(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSampleStorageClearSurface(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSampleStorageClearVolume(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;

// Samples of value zero are counted apart. Their order is that in which threads came by.
OPENPGL_CORE_INTERFACE size_t pglSampleStorageGetSizeSurface(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE size_t pglSampleStorageGetSizeVolume(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE size_t pglSampleStorageGetSizeZeroValueSurface(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE size_t pglSampleStorageGetSizeZeroValueVolume(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLSampleData pglSampleStorageGetSampleSurface(PGLSampleStorage sampleStorage,
                                                                      int idx) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLSampleData pglSampleStorageGetSampleVolume(PGLSampleStorage sampleStorage,
                                                                     int idx) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLZeroValueSampleData pglSampleStorageGetZeroValueSampleSurface(PGLSampleStorage sampleStorage,
                                                                                        int idx) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE PGLZeroValueSampleData pglSampleStorageGetZeroValueSampleVolume(PGLSampleStorage sampleStorage,
                                                                                       int idx) OPENPGL_NOEXCEPT;

/// Whether a field can learn from every sample.
OPENPGL_CORE_INTERFACE bool pglSampleStorageValidate(PGLSampleStorage sampleStorage) OPENPGL_NOEXCEPT;
/// Whether both have the same samples, in any order.
OPENPGL_CORE_INTERFACE bool pglSampleStorageCompare(PGLSampleStorage sampleStorageA,
                                                    PGLSampleStorage sampleStorageB) OPENPGL_NOEXCEPT;

// ---- Paths: the segments of one, and the samples that are made from them. One storage for each thread ----

OPENPGL_CORE_INTERFACE PGLPathSegmentStorage pglNewPathSegmentStorage(void) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleasePathSegmentStorage(PGLPathSegmentStorage pathSegmentStorage) OPENPGL_NOEXCEPT;
/// Room for so many segments; another number than before drops those that were there.
OPENPGL_CORE_INTERFACE void pglPathSegmentStorageReserve(PGLPathSegmentStorage pathSegmentStorage,
                                                         size_t size) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglPathSegmentStorageClear(PGLPathSegmentStorage pathSegmentStorage) OPENPGL_NOEXCEPT;
/// A new segment of default values, to be filled; null once there are as many as were reserved.
OPENPGL_CORE_INTERFACE PGLPathSegmentData* pglPathSegmentStorageNextSegment(PGLPathSegmentStorage pathSegmentStorage)
    OPENPGL_NOEXCEPT;
/// A copy as the next segment; nothing once there are as many as were reserved.
OPENPGL_CORE_INTERFACE void pglPathSegmentStorageAddSegment(PGLPathSegmentStorage pathSegmentStorage,
                                                            PGLPathSegmentData segment) OPENPGL_NOEXCEPT;
/// A sample of the client's own, beside those of the path.
OPENPGL_CORE_INTERFACE void pglPathSegmentStorageAddSample(PGLPathSegmentStorage pathSegmentStorage,
                                                           PGLSampleData sample) OPENPGL_NOEXCEPT;

/// Makes the samples of the path, in place of those made before, and returns how many samples there are. Cost is
/// proportional to the length of the path. `useNEEMiWeights` weights light that is met at the very next vertex by its
/// miWeight, as light further on always is; without `guideDirectLight` it is left out. Where
/// `rrAffectsDirectContribution` is false, light that was met is not divided by the survival just before it.
OPENPGL_CORE_INTERFACE size_t pglPathSegmentStoragePrepareSamples(
    PGLPathSegmentStorage pathSegmentStorage, bool useNEEMiWeights OPENPGL_OPTIONAL(false),
    bool guideDirectLight OPENPGL_OPTIONAL(false),
    bool rrAffectsDirectContribution OPENPGL_OPTIONAL(true)) OPENPGL_NOEXCEPT;
/// Makes the samples, adds them to the sample storage, those of value zero as well, and clears the path.
OPENPGL_CORE_INTERFACE void pglPathSegmentStoragePropagateSamples(
    PGLPathSegmentStorage pathSegmentStorage, PGLSampleStorage sampleStorage,
    bool guideDirectLight OPENPGL_OPTIONAL(false), bool useNEEMiWeights OPENPGL_OPTIONAL(false),
    bool rrAffectsDirectContribution OPENPGL_OPTIONAL(true)) OPENPGL_NOEXCEPT;
/// Valid until the path changes.
OPENPGL_CORE_INTERFACE const PGLSampleData* pglPathSegmentStorageGetSamples(PGLPathSegmentStorage pathSegmentStorage,
                                                                            OPENPGL_REF(size_t)
                                                                                nSamples) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE const PGLZeroValueSampleData* pglPathSegmentStorageGetZeroValueSamples(
    PGLPathSegmentStorage pathSegmentStorage, OPENPGL_REF(size_t) nSamples) OPENPGL_NOEXCEPT;
/// What the path brought to where it began, by its segments: the renderer's own estimate, if it recorded all.
OPENPGL_CORE_INTERFACE pgl_vec3f pglPathSegmentStorageCalculatePixelEstimate(
    PGLPathSegmentStorage pathSegmentStorage, bool rrAffectsDirectContribution OPENPGL_OPTIONAL(true)) OPENPGL_NOEXCEPT;

/// Of samples, half of what their distance may be; 1e6 at first.
OPENPGL_CORE_INTERFACE void pglPathSegmentSetMaxDistance(PGLPathSegmentStorage pathSegmentStorage,
                                                         float maxDistance) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE float pglPathSegmentGetMaxDistance(PGLPathSegmentStorage pathSegmentStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE int pglPathSegmentGetNumSegments(PGLPathSegmentStorage pathSegmentStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE int pglPathSegmentGetNumSamples(PGLPathSegmentStorage pathSegmentStorage) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE int pglPathSegmentGetNumZeroValueSamples(PGLPathSegmentStorage pathSegmentStorage)
    OPENPGL_NOEXCEPT;
/// Whether all numbers of the segments are finite and in their ranges.
OPENPGL_CORE_INTERFACE bool pglPathSegmentStorageValidateSegments(PGLPathSegmentStorage pathSegmentStorage)
    OPENPGL_NOEXCEPT;
/// Whether a field can learn from every sample that was made.
OPENPGL_CORE_INTERFACE bool pglPathSegmentStorageValidateSamples(PGLPathSegmentStorage pathSegmentStorage)
    OPENPGL_NOEXCEPT;

// ---- Distributions of directions: one for each thread. They refer to nothing, the field included ----

OPENPGL_CORE_INTERFACE PGLSurfaceSamplingDistribution pglFieldNewSurfaceSamplingDistribution(PGLField field)
    OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleaseSurfaceSamplingDistribution(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution) OPENPGL_NOEXCEPT;
/// Directions in proportion to the radiance that arrives at the position; false as long as nothing is known. The random
/// number is neither needed nor changed.
OPENPGL_CORE_INTERFACE bool pglFieldInitSurfaceSamplingDistribution(
    PGLField field, PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_point3f position,
    float* sample1D) OPENPGL_NOEXCEPT;
/// Multiplies the radiance by the cosine to the normal, in place of what it was multiplied by before.
OPENPGL_CORE_INTERFACE void pglSurfaceSamplingDistributionApplyCosineProduct(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_vec3f normal) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE bool pglSurfaceSamplingDistributionSupportsApplyCosineProduct(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE pgl_vec3f pglSurfaceSamplingDistributionSample(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_point2f sample) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE float pglSurfaceSamplingDistributionPDF(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_vec3f direction) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE float pglSurfaceSamplingDistributionSamplePDF(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_point2f sample,
    OPENPGL_REF(pgl_vec3f) direction) OPENPGL_NOEXCEPT;
/// The density in proportion to the radiance alone.
OPENPGL_CORE_INTERFACE float pglSurfaceSamplingDistributionIncomingRadiancePDF(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_vec3f direction) OPENPGL_NOEXCEPT;
/// The index of the field's cell.
OPENPGL_CORE_INTERFACE uint32_t
pglSurfaceSamplingDistributionGetId(PGLSurfaceSamplingDistribution surfaceSamplingDistribution) OPENPGL_NOEXCEPT;
/// Whether it was initialized.
OPENPGL_CORE_INTERFACE bool pglSurfaceSamplingDistributionValidate(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglSurfaceSamplingDistributionClear(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution) OPENPGL_NOEXCEPT;
/// -1, which stands for unknown: how much of what comes from a direction is from a medium that lies before a surface.
OPENPGL_CORE_INTERFACE float pglSurfaceSamplingDistributionVolumeScatterProbability(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_vec3f direction,
    bool contributionBased) OPENPGL_NOEXCEPT;
/// Null.
OPENPGL_CORE_INTERFACE PGLRegion pglSurfaceSamplingGetRegion(PGLSurfaceSamplingDistribution surfaceSamplingDistribution)
    OPENPGL_NOEXCEPT;

OPENPGL_CORE_INTERFACE PGLVolumeSamplingDistribution pglFieldNewVolumeSamplingDistribution(PGLField field)
    OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglReleaseVolumeSamplingDistribution(
    PGLVolumeSamplingDistribution volumeSamplingDistribution) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE bool pglFieldInitVolumeSamplingDistribution(
    PGLField field, PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_point3f position,
    float* sample1D) OPENPGL_NOEXCEPT;
/// Multiplies the radiance by Henyey and Greenstein's phase function, in place of what it was multiplied by before.
/// `dir` is the direction in which the path arrived.
OPENPGL_CORE_INTERFACE void pglVolumeSamplingDistributionApplySingleLobeHenyeyGreensteinProduct(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_vec3f dir, float meanCosine) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE bool pglVolumeSamplingDistributionSupportsApplySingleLobeHenyeyGreensteinProduct(
    PGLVolumeSamplingDistribution volumeSamplingDistribution) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE pgl_vec3f pglVolumeSamplingDistributionSample(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_point2f sample) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE float pglVolumeSamplingDistributionPDF(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                                              pgl_vec3f direction) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE float pglVolumeSamplingDistributionSamplePDF(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_point2f sample,
    OPENPGL_REF(pgl_vec3f) direction) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE float pglVolumeSamplingDistributionIncomingRadiancePDF(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_vec3f direction) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE uint32_t
pglVolumeSamplingDistributionGetId(PGLVolumeSamplingDistribution volumeSamplingDistribution) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE bool pglVolumeSamplingDistributionValidate(
    PGLVolumeSamplingDistribution volumeSamplingDistribution) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE void pglVolumeSamplingDistributionClear(PGLVolumeSamplingDistribution volumeSamplingDistribution)
    OPENPGL_NOEXCEPT;
/// -1, which stands for unknown: how much of what comes from a direction is from a medium that lies before a surface.
OPENPGL_CORE_INTERFACE float pglVolumeSamplingDistributionVolumeScatterProbability(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_vec3f direction,
    bool contributionBased) OPENPGL_NOEXCEPT;
/// Null.
OPENPGL_CORE_INTERFACE PGLRegion pglVolumeSamplingGetRegion(PGLVolumeSamplingDistribution volumeSamplingDistribution)
    OPENPGL_NOEXCEPT;

// ---- Radiance where a distribution was initialized. Light met directly has its weight as the samples had it, whatever
// directLightMIS says. Colours are known of samples that were propagated; others are grey ----

OPENPGL_CORE_INTERFACE pgl_vec3f
pglSurfaceSamplingDistributionIncomingRadiance(PGLSurfaceSamplingDistribution surfaceSamplingDistribution,
                                               pgl_vec3f direction, bool directLightMIS) OPENPGL_NOEXCEPT;
/// The integral of the radiance times the cosine to the normal.
OPENPGL_CORE_INTERFACE pgl_vec3f pglSurfaceSamplingDistributionIrradiance(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_vec3f normal, bool directLightMIS) OPENPGL_NOEXCEPT;
/// 0, which stands for unknown: a field does not know what reflects.
OPENPGL_CORE_INTERFACE pgl_vec3f pglSurfaceSamplingDistributionOutgoingRadiance(
    PGLSurfaceSamplingDistribution surfaceSamplingDistribution, pgl_vec3f direction) OPENPGL_NOEXCEPT;
OPENPGL_CORE_INTERFACE pgl_vec3f
pglVolumeSamplingDistributionIncomingRadiance(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                              pgl_vec3f direction, bool directLightMIS) OPENPGL_NOEXCEPT;
/// What Henyey and Greenstein's phase function scatters towards the direction.
OPENPGL_CORE_INTERFACE pgl_vec3f
pglVolumeSamplingDistributionInscatteredRadiance(PGLVolumeSamplingDistribution volumeSamplingDistribution,
                                                 pgl_vec3f direction, float g, bool directLightMIS) OPENPGL_NOEXCEPT;
/// The integral of the radiance.
OPENPGL_CORE_INTERFACE pgl_vec3f pglVolumeSamplingDistributionFluence(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, bool directLightMIS) OPENPGL_NOEXCEPT;
/// 0, which stands for unknown: a field does not know what scatters.
OPENPGL_CORE_INTERFACE pgl_vec3f pglVolumeSamplingDistributionOutgoingRadiance(
    PGLVolumeSamplingDistribution volumeSamplingDistribution, pgl_vec3f direction) OPENPGL_NOEXCEPT;

#ifdef __cplusplus
}
#endif
