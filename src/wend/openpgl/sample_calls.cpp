// Sample storages, for C.
#include <wend/openpgl/boundary.h>
#include <wend/openpgl/files.h>

#include <algorithm>
#include <span>

using namespace wend;
using namespace wend::openpgl;

namespace {

/// An index that is beyond the last one if it is negative.
std::size_t to_index(int idx) {
    return idx < 0 ? static_cast<std::size_t>(-1) : static_cast<std::size_t>(idx);
}

PGLSampleData sample(PGLSampleStorage samples, Half half, int idx) noexcept {
    return is_object(samples) ? samples->value.sample(half, to_index(idx)) : PGLSampleData{};
}

PGLZeroValueSampleData zero(PGLSampleStorage samples, Half half, int idx) noexcept {
    return is_object(samples) ? samples->value.zero(half, to_index(idx)) : PGLZeroValueSampleData{};
}

template <class Plain>
void add(PGLSampleStorage storage, const Plain* samples, std::size_t count) noexcept {
    if (is_object(storage) && samples) {
        guarded([&] { storage->value.add(std::span(samples, count)); });
    }
}

}  // namespace

PGLSampleStorage pglNewSampleStorage(void) noexcept {
    return guarded<PGLSampleStorage>(nullptr, [] { return new PGLSampleStorageObject; });
}

PGLSampleStorage pglNewSampleStorageFromFile(const char* sampleStorageFileName) noexcept {
    return guarded<PGLSampleStorage>(nullptr, [&] {
        return sampleStorageFileName
                   ? new PGLSampleStorageObject(SampleStore::from_bytes(read_file(sampleStorageFileName)))
                   : nullptr;
    });
}

void pglReleaseSampleStorage(PGLSampleStorage sampleStorage) noexcept {
    release(sampleStorage);
}

bool pglSampleStorageStoreToFile(PGLSampleStorage sampleStorage, const char* sampleStorageFileName) noexcept {
    return is_object(sampleStorage) && sampleStorageFileName && guarded(false, [&] {
               write_file(sampleStorageFileName, sampleStorage->value.to_bytes());
               return true;
           });
}

void pglSampleStorageAddSample(PGLSampleStorage sampleStorage, const PGLSampleData& sample) noexcept {
    add(sampleStorage, &sample, 1);
}

void pglSampleStorageAddSamples(PGLSampleStorage sampleStorage, const PGLSampleData* samples,
                                size_t numSamples) noexcept {
    add(sampleStorage, samples, numSamples);
}

void pglSampleStorageAddZeroValueSample(PGLSampleStorage sampleStorage, const PGLZeroValueSampleData& sample) noexcept {
    add(sampleStorage, &sample, 1);
}

void pglSampleStorageAddZeroValueSamples(PGLSampleStorage sampleStorage, const PGLZeroValueSampleData* samples,
                                         size_t numSamples) noexcept {
    add(sampleStorage, samples, numSamples);
}

void pglSampleStorageMerge(PGLSampleStorage sampleStorage, PGLSampleStorage other) noexcept {
    if (is_object(sampleStorage) && is_object(other)) {
        guarded([&] { sampleStorage->value.add(other->value); });
    }
}

void pglSampleStorageReserve(PGLSampleStorage, size_t, size_t) noexcept {
}

void pglSampleStorageClear(PGLSampleStorage sampleStorage) noexcept {
    pglSampleStorageClearSurface(sampleStorage);
    pglSampleStorageClearVolume(sampleStorage);
}

void pglSampleStorageClearSurface(PGLSampleStorage sampleStorage) noexcept {
    if (is_object(sampleStorage)) {
        sampleStorage->value.clear(Half::surface);
    }
}

void pglSampleStorageClearVolume(PGLSampleStorage sampleStorage) noexcept {
    if (is_object(sampleStorage)) {
        sampleStorage->value.clear(Half::volume);
    }
}

size_t pglSampleStorageGetSizeSurface(PGLSampleStorage sampleStorage) noexcept {
    return is_object(sampleStorage) ? sampleStorage->value.size(Half::surface) : 0;
}

size_t pglSampleStorageGetSizeVolume(PGLSampleStorage sampleStorage) noexcept {
    return is_object(sampleStorage) ? sampleStorage->value.size(Half::volume) : 0;
}

size_t pglSampleStorageGetSizeZeroValueSurface(PGLSampleStorage sampleStorage) noexcept {
    return is_object(sampleStorage) ? sampleStorage->value.zeros(Half::surface) : 0;
}

size_t pglSampleStorageGetSizeZeroValueVolume(PGLSampleStorage sampleStorage) noexcept {
    return is_object(sampleStorage) ? sampleStorage->value.zeros(Half::volume) : 0;
}

PGLSampleData pglSampleStorageGetSampleSurface(PGLSampleStorage sampleStorage, int idx) noexcept {
    return sample(sampleStorage, Half::surface, idx);
}

PGLSampleData pglSampleStorageGetSampleVolume(PGLSampleStorage sampleStorage, int idx) noexcept {
    return sample(sampleStorage, Half::volume, idx);
}

PGLZeroValueSampleData pglSampleStorageGetZeroValueSampleSurface(PGLSampleStorage sampleStorage, int idx) noexcept {
    return zero(sampleStorage, Half::surface, idx);
}

PGLZeroValueSampleData pglSampleStorageGetZeroValueSampleVolume(PGLSampleStorage sampleStorage, int idx) noexcept {
    return zero(sampleStorage, Half::volume, idx);
}

bool pglSampleStorageValidate(PGLSampleStorage sampleStorage) noexcept {
    return is_object(sampleStorage) && guarded(false, [&] {
               for (const Half half : {Half::surface, Half::volume}) {
                   const guide::Records records = sampleStorage->value.records(half);
                   if (!std::all_of(records.begin(), records.end(),
                                    [](const guide::Record& record) { return guide::is_usable(record); })) {
                       return false;
                   }
               }
               return true;
           });
}

bool pglSampleStorageCompare(PGLSampleStorage sampleStorageA, PGLSampleStorage sampleStorageB) noexcept {
    return is_object(sampleStorageA) && is_object(sampleStorageB) &&
           guarded(false, [&] { return sampleStorageA->value.to_bytes() == sampleStorageB->value.to_bytes(); });
}
