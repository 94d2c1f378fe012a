// Samples that threads collect together.
#pragma once

#include <openpgl/cpp/SampleData.h>
#include <openpgl/openpgl.h>

#include <stdexcept>
#include <string>

namespace openpgl {
namespace cpp {

struct SampleStorage {
    SampleStorage() : m_sampleStorageHandle(pglNewSampleStorage()) {}
    /// From a file of Store(). Throws std::runtime_error where there is none.
    explicit SampleStorage(const std::string& sampleStorageFileName)
        : m_sampleStorageHandle(pglNewSampleStorageFromFile(sampleStorageFileName.c_str())) {
        if (!m_sampleStorageHandle) {
            throw std::runtime_error("no samples could be loaded from " + sampleStorageFileName);
        }
    }
    SampleStorage(const SampleStorage&) = delete;
    ~SampleStorage() { pglReleaseSampleStorage(m_sampleStorageHandle); }

    PGLSampleStorage Get() const { return m_sampleStorageHandle; }

    bool Store(const std::string& sampleStorageFileName) const {
        return pglSampleStorageStoreToFile(m_sampleStorageHandle, sampleStorageFileName.c_str());
    }

    void AddSample(const SampleData& sample) { pglSampleStorageAddSample(m_sampleStorageHandle, sample); }
    void AddSamples(const SampleData* samples, size_t numSamples) {
        pglSampleStorageAddSamples(m_sampleStorageHandle, samples, numSamples);
    }
    void AddZeroValueSample(const ZeroValueSampleData& sample) {
        pglSampleStorageAddZeroValueSample(m_sampleStorageHandle, sample);
    }
    void AddZeroValueSamples(const ZeroValueSampleData* samples, size_t numSamples) {
        pglSampleStorageAddZeroValueSamples(m_sampleStorageHandle, samples, numSamples);
    }
    /// Adds what the other has.
    void Merge(const SampleStorage& other) {
        pglSampleStorageMerge(m_sampleStorageHandle, other.m_sampleStorageHandle);
    }

    void Reserve(const size_t& sizeSurface, const size_t& sizeVolume) {
        pglSampleStorageReserve(m_sampleStorageHandle, sizeSurface, sizeVolume);
    }
    void Clear() { pglSampleStorageClear(m_sampleStorageHandle); }
    void ClearSurface() { pglSampleStorageClearSurface(m_sampleStorageHandle); }
    void ClearVolume() { pglSampleStorageClearVolume(m_sampleStorageHandle); }

    size_t GetSizeSurface() const { return pglSampleStorageGetSizeSurface(m_sampleStorageHandle); }
    size_t GetSizeVolume() const { return pglSampleStorageGetSizeVolume(m_sampleStorageHandle); }
    size_t GetSizeZeroValueSurface() const { return pglSampleStorageGetSizeZeroValueSurface(m_sampleStorageHandle); }
    size_t GetSizeZeroValueVolume() const { return pglSampleStorageGetSizeZeroValueVolume(m_sampleStorageHandle); }
    SampleData GetSampleSurface(int idx) const { return pglSampleStorageGetSampleSurface(m_sampleStorageHandle, idx); }
    SampleData GetSampleVolume(int idx) const { return pglSampleStorageGetSampleVolume(m_sampleStorageHandle, idx); }
    ZeroValueSampleData GetZeroValueSampleSurface(int idx) const {
        return pglSampleStorageGetZeroValueSampleSurface(m_sampleStorageHandle, idx);
    }
    ZeroValueSampleData GetZeroValueSampleVolume(int idx) const {
        return pglSampleStorageGetZeroValueSampleVolume(m_sampleStorageHandle, idx);
    }

    bool Validate() const { return pglSampleStorageValidate(m_sampleStorageHandle); }
    bool operator==(const SampleStorage& b) const {
        return pglSampleStorageCompare(m_sampleStorageHandle, b.m_sampleStorageHandle);
    }

private:
    friend struct Field;
    friend struct PathSegmentStorage;
    PGLSampleStorage m_sampleStorageHandle;
};

}  // namespace cpp
}  // namespace openpgl
