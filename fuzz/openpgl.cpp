// Feeds arbitrary bytes to what reads fields and samples of Open PGL's interface.
#include "memory_file.h"
#include "sealed.h"

#include <openpgl/cpp/OpenPGL.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const wend::fuzz::MemoryFile file;
    const std::string bytes = wend::fuzz::sealed(data, size);
    const std::string name = file.filled_with(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    openpgl::cpp::Device device(PGL_DEVICE_TYPE_CPU_8, 1);
    openpgl::cpp::SampleStorage more;
    if (const PGLSampleStorage samples = pglNewSampleStorageFromFile(name.c_str())) {
        pglSampleStorageMerge(more.Get(), samples);
        pglReleaseSampleStorage(samples);
    }
    // What was read is learned from, or learns on.
    openpgl::cpp::FieldConfig config;
    const auto learn = [&](openpgl::cpp::Field& field) {
        field.Update(more);
        float u = 0;
        openpgl::cpp::VolumeSamplingDistribution(&field).Init(&field, {0, 0, 0}, u);
    };
    try {
        openpgl::cpp::Field field(&device, name);
        learn(field);
    } catch (const std::runtime_error&) {
        openpgl::cpp::Field field(&device, config);
        learn(field);
    }
    return 0;
}
