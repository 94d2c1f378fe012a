// The segments of a path, and the samples that are made from them.
#pragma once

#include <openpgl/cpp/PathSegment.h>
#include <openpgl/cpp/SampleStorage.h>
#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

struct PathSegmentStorage {
    /// Samples of value zero are kept, whatever is asked for.
    explicit PathSegmentStorage(bool /*trackZeroValueSamples*/ = true)
        : m_pathSegmentStorageHandle(pglNewPathSegmentStorage()) {}
    PathSegmentStorage(const PathSegmentStorage&) = delete;
    ~PathSegmentStorage() { pglReleasePathSegmentStorage(m_pathSegmentStorageHandle); }

    /// Room for so many segments.
    void Reserve(size_t size) { pglPathSegmentStorageReserve(m_pathSegmentStorageHandle, size); }
    void Clear() { pglPathSegmentStorageClear(m_pathSegmentStorageHandle); }

    /// Null once there are as many as were reserved.
    PathSegment* NextSegment() { return pglPathSegmentStorageNextSegment(m_pathSegmentStorageHandle); }
    void AddSegment(const PathSegment& segment) {
        pglPathSegmentStorageAddSegment(m_pathSegmentStorageHandle, segment);
    }
    void AddSample(SampleData sample) { pglPathSegmentStorageAddSample(m_pathSegmentStorageHandle, sample); }

    /// How many samples there are then (openpgl.h has more).
    size_t PrepareSamples(bool useNEEMiWeights = false, bool guideDirectLight = false,
                          bool rrAffectsDirectContribution = true) {
        return pglPathSegmentStoragePrepareSamples(m_pathSegmentStorageHandle, useNEEMiWeights, guideDirectLight,
                                                   rrAffectsDirectContribution);
    }
    /// Makes the samples, adds them to the storage and clears the path.
    void PropagateSamples(SampleStorage* sampleStorage, bool guideDirectLight = false, bool useNEEMiWeights = false,
                          bool rrAffectsDirectContribution = true) {
        pglPathSegmentStoragePropagateSamples(m_pathSegmentStorageHandle,
                                              sampleStorage ? sampleStorage->m_sampleStorageHandle : nullptr,
                                              guideDirectLight, useNEEMiWeights, rrAffectsDirectContribution);
    }
    const SampleData* GetSamples(size_t& nSamples) {
        return pglPathSegmentStorageGetSamples(m_pathSegmentStorageHandle, nSamples);
    }
    const ZeroValueSampleData* GetZeroValueSamples(size_t& nSamples) {
        return pglPathSegmentStorageGetZeroValueSamples(m_pathSegmentStorageHandle, nSamples);
    }
    pgl_vec3f CalculatePixelEstimate(bool rrAffectsDirectContribution) const {
        return pglPathSegmentStorageCalculatePixelEstimate(m_pathSegmentStorageHandle, rrAffectsDirectContribution);
    }

    void SetMaxDistance(float maxDistance) { pglPathSegmentSetMaxDistance(m_pathSegmentStorageHandle, maxDistance); }
    float GetMaxDistance() const { return pglPathSegmentGetMaxDistance(m_pathSegmentStorageHandle); }
    int GetNumSegments() const { return pglPathSegmentGetNumSegments(m_pathSegmentStorageHandle); }
    int GetNumSamples() const { return pglPathSegmentGetNumSamples(m_pathSegmentStorageHandle); }
    int GetNumZeroValueSamples() const { return pglPathSegmentGetNumZeroValueSamples(m_pathSegmentStorageHandle); }

    bool Validate() const { return ValidateSegments() && ValidateSamples(); }
    bool ValidateSegments() const { return pglPathSegmentStorageValidateSegments(m_pathSegmentStorageHandle); }
    bool ValidateSamples() const { return pglPathSegmentStorageValidateSamples(m_pathSegmentStorageHandle); }

private:
    PGLPathSegmentStorage m_pathSegmentStorageHandle;
};

}  // namespace cpp
}  // namespace openpgl
