// Devices, fields and their statistics, for C.
#include <wend/core/error.h>
#include <wend/openpgl/boundary.h>
#include <wend/openpgl/files.h>
#include <wend/openpgl/values.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

using namespace wend;
using namespace wend::openpgl;

namespace {

bool is_region_usable(const guide::Region& region) {
    bool usable = std::isfinite(region.fluence()) && region.fluence() >= 0;
    for (int i = 0; i < region.mixture().size(); ++i) {
        const guide::WeightedVmf lobe = region.mixture().lobe(i);
        usable = usable && lobe.weight >= 0 && std::isfinite(lobe.weight) && is_finite(lobe.vmf.mean) &&
                 std::isfinite(lobe.vmf.kappa);
    }
    return usable;
}

void update(PGLField field, PGLSampleStorage samples, bool surface, bool volume) noexcept {
    if (is_object(field) && is_object(samples)) {
        guarded([&] { field->value.update(samples->value, surface, volume); });
    }
}

PGLFieldStatistics statistics(PGLField field, Half half) noexcept {
    return guarded<PGLFieldStatistics>(nullptr, [&] {
        return is_object(field) ? new PGLFieldStatisticsObject(statistics_of(field->value, half)) : nullptr;
    });
}

PGLString to_string(const std::string& text) {
    PGLString string{new char[text.size() + 1], text.size() + 1};
    std::memcpy(string.m_str, text.c_str(), string.m_size);
    return string;
}

}  // namespace

PGLDevice pglNewDevice(PGL_DEVICE_TYPE /*deviceType*/, size_t numThreads) noexcept {
    constexpr std::size_t most_threads = 1024;
    return guarded<PGLDevice>(
        nullptr, [&] { return new PGLDeviceObject(static_cast<int>(std::min(numThreads, most_threads))); });
}

void pglReleaseDevice(PGLDevice device) noexcept {
    release(device);
}

void pglFieldArgumentsSetDefaults(PGLFieldArguments& fieldArguments, PGL_SPATIAL_STRUCTURE_TYPE spatialType,
                                  PGL_DIRECTIONAL_DISTRIBUTION_TYPE directionalType, bool deterministic,
                                  size_t maxSamplesPerLeaf) noexcept {
    fieldArguments = {};
    guarded([&] {
        auto* tree = new PGLKDTreeArguments;
        tree->maxSamples = maxSamplesPerLeaf;
        fieldArguments.spatialStructureType = spatialType;
        fieldArguments.spatialSturctureArguments = tree;
        fieldArguments.directionalDistributionType = directionalType;
        if (directionalType == PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE) {
            fieldArguments.directionalDistributionArguments = new PGLDQTFactoryArguments;
        } else {
            fieldArguments.directionalDistributionArguments = new PGLVMMFactoryArguments;
        }
        fieldArguments.deterministic = deterministic;
    });
}

void pglReleaseFieldArguments(PGLFieldArguments& fieldArguments) noexcept {
    delete static_cast<PGLKDTreeArguments*>(fieldArguments.spatialSturctureArguments);
    if (fieldArguments.directionalDistributionType == PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE) {
        delete static_cast<PGLDQTFactoryArguments*>(fieldArguments.directionalDistributionArguments);
    } else {
        delete static_cast<PGLVMMFactoryArguments*>(fieldArguments.directionalDistributionArguments);
    }
    fieldArguments = {};
}

PGLField pglDeviceNewField(PGLDevice device, PGLFieldArguments args) noexcept {
    return guarded<PGLField>(nullptr, [&] {
        return is_object(device) ? new PGLFieldObject(LearnedField(settings_of(args), device->threads)) : nullptr;
    });
}

PGLField pglDeviceNewFieldFromFile(PGLDevice device, const char* fieldFileName) noexcept {
    return guarded<PGLField>(nullptr, [&] {
        return is_object(device) && fieldFileName
                   ? new PGLFieldObject(LearnedField::from_bytes(read_file(fieldFileName), device->threads))
                   : nullptr;
    });
}

void pglReleaseField(PGLField field) noexcept {
    release(field);
}

bool pglFieldStoreToFile(PGLField field, const char* fieldFileName) noexcept {
    return is_object(field) && fieldFileName && guarded(false, [&] {
               write_file(fieldFileName, field->value.to_bytes());
               return true;
           });
}

size_t pglFieldGetIteration(PGLField field) noexcept {
    return is_object(field) ? field->value.iteration() : 0;
}

void pglFieldSetSceneBounds(PGLField field, pgl_box3f bounds) noexcept {
    if (is_object(field)) {
        field->value.set_bounds({to_vector(bounds.lower), to_vector(bounds.upper)});
    }
}

pgl_box3f pglFieldGetSceneBounds(PGLField field) noexcept {
    const Box3 box = is_object(field) ? field->value.bounds() : Box3();
    return {from_vector(box.min), from_vector(box.max)};
}

void pglFieldUpdate(PGLField field, PGLSampleStorage sampleStorage) noexcept {
    update(field, sampleStorage, true, true);
}

void pglFieldUpdateSurface(PGLField field, PGLSampleStorage sampleStorage) noexcept {
    update(field, sampleStorage, true, false);
}

void pglFieldUpdateVolume(PGLField field, PGLSampleStorage sampleStorage) noexcept {
    update(field, sampleStorage, false, true);
}

void pglFieldReset(PGLField field) noexcept {
    if (is_object(field)) {
        field->value.reset();
    }
}

bool pglFieldValidate(PGLField field) noexcept {
    return is_object(field) && guarded(false, [&] {
               bool usable = true;
               for (const Half half : {Half::surface, Half::volume}) {
                   if (const guide::Field* learned = field->value.field(half)) {
                       learned->for_each_cell([&](const Box3&, const guide::Region& region, double) {
                           usable = usable && is_region_usable(region);
                       });
                   }
               }
               return usable;
           });
}

bool pglFieldCompare(PGLField fieldA, PGLField fieldB) noexcept {
    return is_object(fieldA) && is_object(fieldB) && guarded(false, [&] { return fieldA->value == fieldB->value; });
}

PGLFieldStatistics pglFieldGetSurfaceStatistics(PGLField field) noexcept {
    return statistics(field, Half::surface);
}

PGLFieldStatistics pglFieldGetVolumeStatistics(PGLField field) noexcept {
    return statistics(field, Half::volume);
}

void pglReleaseFieldStatistics(PGLFieldStatistics fieldStatistics) noexcept {
    release(fieldStatistics);
}

PGLString pglFieldStatisticsToString(PGLFieldStatistics fieldStatistics) noexcept {
    return guarded(PGLString{}, [&] {
        return is_object(fieldStatistics) ? to_string(to_text(fieldStatistics->value)) : PGLString{};
    });
}

PGLString pglFieldStatisticsHeaderCSVString(PGLFieldStatistics /*fieldStatistics*/) noexcept {
    return guarded(PGLString{}, [&] { return to_string(csv_header()); });
}

PGLString pglFieldStatisticsToCSVString(PGLFieldStatistics fieldStatistics) noexcept {
    return guarded(PGLString{}, [&] {
        return is_object(fieldStatistics) ? to_string(to_csv(fieldStatistics->value)) : PGLString{};
    });
}

void pglReleaseString(PGLString str) noexcept {
    delete[] str.m_str;
}
