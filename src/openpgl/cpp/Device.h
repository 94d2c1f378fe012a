// How many threads learn.
#pragma once

#include <openpgl/openpgl.h>

namespace openpgl {
namespace cpp {

struct Device {
    /// All types are the same; 0 threads are all there are.
    explicit Device(PGL_DEVICE_TYPE deviceType, size_t numThreads = 0)
        : m_deviceHandle(pglNewDevice(deviceType, numThreads)) {}
    Device(const Device&) = delete;
    ~Device() { pglReleaseDevice(m_deviceHandle); }

private:
    friend struct Field;
    PGLDevice m_deviceHandle;
};

}  // namespace cpp
}  // namespace openpgl
