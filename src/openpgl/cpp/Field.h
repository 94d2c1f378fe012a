// What has been learned about where light comes from, on surfaces and in volumes.
#pragma once

#include <openpgl/cpp/Device.h>
#include <openpgl/cpp/FieldConfig.h>
#include <openpgl/cpp/FieldStatistics.h>
#include <openpgl/cpp/SampleStorage.h>
#include <openpgl/openpgl.h>

#include <stdexcept>
#include <string>

namespace openpgl {
namespace cpp {

struct Field {
    Field(Device* device, const FieldConfig& args) : Field(device, args.m_args) {}
    /// As renderers of version 0.5 have it.
    Field(Device* device, const PGLFieldArguments& args)
        : m_fieldHandle(pglDeviceNewField(device ? device->m_deviceHandle : nullptr, args)) {}
    /// From a file of Store(). Throws std::runtime_error where there is none.
    Field(Device* device, const std::string& fieldFileName)
        : m_fieldHandle(pglDeviceNewFieldFromFile(device ? device->m_deviceHandle : nullptr, fieldFileName.c_str())) {
        if (!m_fieldHandle) {
            throw std::runtime_error("no field could be loaded from " + fieldFileName);
        }
    }
    Field(const Field&) = delete;
    ~Field() { pglReleaseField(m_fieldHandle); }

    bool Store(const std::string& fieldFileName) const {
        return pglFieldStoreToFile(m_fieldHandle, fieldFileName.c_str());
    }

    /// Before the first update, or after a reset.
    void SetSceneBounds(const pgl_box3f& bounds) { pglFieldSetSceneBounds(m_fieldHandle, bounds); }
    pgl_box3f GetSceneBounds() const { return pglFieldGetSceneBounds(m_fieldHandle); }

    /// Learns from the samples. Nobody may ask the field meanwhile.
    void Update(const SampleStorage& sampleStorage) {
        pglFieldUpdate(m_fieldHandle, sampleStorage.m_sampleStorageHandle);
    }
    void UpdateSurface(const SampleStorage& sampleStorage) {
        pglFieldUpdateSurface(m_fieldHandle, sampleStorage.m_sampleStorageHandle);
    }
    void UpdateVolume(const SampleStorage& sampleStorage) {
        pglFieldUpdateVolume(m_fieldHandle, sampleStorage.m_sampleStorageHandle);
    }
    void Reset() { pglFieldReset(m_fieldHandle); }

    size_t GetIteration() const { return pglFieldGetIteration(m_fieldHandle); }
    bool Validate() const { return pglFieldValidate(m_fieldHandle); }
    FieldStatistics GetSurfaceStatistics() const {
        return FieldStatistics(pglFieldGetSurfaceStatistics(m_fieldHandle));
    }
    FieldStatistics GetVolumeStatistics() const { return FieldStatistics(pglFieldGetVolumeStatistics(m_fieldHandle)); }
    bool operator==(const Field& b) const { return pglFieldCompare(m_fieldHandle, b.m_fieldHandle); }

private:
    friend struct SurfaceSamplingDistribution;
    friend struct VolumeSamplingDistribution;
    PGLField m_fieldHandle;
};

}  // namespace cpp
}  // namespace openpgl
