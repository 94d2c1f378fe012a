// Path segment storages, for C.
#include <wend/openpgl/boundary.h>
#include <wend/openpgl/values.h>

#include <algorithm>

using namespace wend;
using namespace wend::openpgl;

PGLPathSegmentStorage pglNewPathSegmentStorage(void) noexcept {
    return guarded<PGLPathSegmentStorage>(nullptr, [] { return new PGLPathSegmentStorageObject; });
}

void pglReleasePathSegmentStorage(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    delete pathSegmentStorage;
}

void pglPathSegmentStorageReserve(PGLPathSegmentStorage pathSegmentStorage, size_t size) noexcept {
    if (pathSegmentStorage) {
        guarded([&] { pathSegmentStorage->value.reserve(size); });
    }
}

void pglPathSegmentStorageClear(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    if (pathSegmentStorage) {
        pathSegmentStorage->value.clear();
    }
}

PGLPathSegmentData* pglPathSegmentStorageNextSegment(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return pathSegmentStorage ? pathSegmentStorage->value.next() : nullptr;
}

void pglPathSegmentStorageAddSegment(PGLPathSegmentStorage pathSegmentStorage, PGLPathSegmentData segment) noexcept {
    if (PGLPathSegmentData* next = pglPathSegmentStorageNextSegment(pathSegmentStorage)) {
        *next = segment;
    }
}

void pglPathSegmentStorageAddSample(PGLPathSegmentStorage pathSegmentStorage, PGLSampleData sample) noexcept {
    if (pathSegmentStorage) {
        guarded([&] { pathSegmentStorage->value.add_sample(sample); });
    }
}

size_t pglPathSegmentStoragePrepareSamples(PGLPathSegmentStorage pathSegmentStorage, bool useNEEMiWeights,
                                           bool guideDirectLight, bool rrAffectsDirectContribution) noexcept {
    if (!pathSegmentStorage) {
        return 0;
    }
    guarded([&] {
        pathSegmentStorage->value.prepare({useNEEMiWeights, guideDirectLight, rrAffectsDirectContribution});
    });
    return pathSegmentStorage->value.samples().size();
}

void pglPathSegmentStoragePropagateSamples(PGLPathSegmentStorage pathSegmentStorage, PGLSampleStorage sampleStorage,
                                           bool guideDirectLight, bool useNEEMiWeights,
                                           bool rrAffectsDirectContribution) noexcept {
    if (!pathSegmentStorage || !sampleStorage) {
        return;
    }
    guarded([&] {
        PathSegments& path = pathSegmentStorage->value;
        path.prepare({useNEEMiWeights, guideDirectLight, rrAffectsDirectContribution});
        sampleStorage->value.add(path.samples());
        sampleStorage->value.add(path.zero_samples());
        path.clear();
    });
}

const PGLSampleData* pglPathSegmentStorageGetSamples(PGLPathSegmentStorage pathSegmentStorage,
                                                     size_t& nSamples) noexcept {
    nSamples = pathSegmentStorage ? pathSegmentStorage->value.plain_samples().size() : 0;
    return pathSegmentStorage ? pathSegmentStorage->value.plain_samples().data() : nullptr;
}

const PGLZeroValueSampleData* pglPathSegmentStorageGetZeroValueSamples(PGLPathSegmentStorage pathSegmentStorage,
                                                                       size_t& nSamples) noexcept {
    nSamples = pathSegmentStorage ? pathSegmentStorage->value.zero_samples().size() : 0;
    return pathSegmentStorage ? pathSegmentStorage->value.zero_samples().data() : nullptr;
}

pgl_vec3f pglPathSegmentStorageCalculatePixelEstimate(PGLPathSegmentStorage pathSegmentStorage,
                                                      bool rrAffectsDirectContribution) noexcept {
    return from_colour(pathSegmentStorage ? pathSegmentStorage->value.estimate(rrAffectsDirectContribution) : Rgb());
}

void pglPathSegmentSetMaxDistance(PGLPathSegmentStorage pathSegmentStorage, float maxDistance) noexcept {
    if (pathSegmentStorage && maxDistance > 0) {
        pathSegmentStorage->value.max_distance = maxDistance;
    }
}

float pglPathSegmentGetMaxDistance(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return pathSegmentStorage ? pathSegmentStorage->value.max_distance : 0.0f;
}

int pglPathSegmentGetNumSegments(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return pathSegmentStorage ? static_cast<int>(pathSegmentStorage->value.segments().size()) : 0;
}

int pglPathSegmentGetNumSamples(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return pathSegmentStorage ? static_cast<int>(pathSegmentStorage->value.samples().size()) : 0;
}

int pglPathSegmentGetNumZeroValueSamples(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return pathSegmentStorage ? static_cast<int>(pathSegmentStorage->value.zero_samples().size()) : 0;
}

bool pglPathSegmentStorageValidateSegments(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    if (!pathSegmentStorage) {
        return false;
    }
    const auto segments = pathSegmentStorage->value.segments();
    return std::all_of(segments.begin(), segments.end(), [](const PGLPathSegmentData& s) { return is_usable(s); });
}

bool pglPathSegmentStorageValidateSamples(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    if (!pathSegmentStorage) {
        return false;
    }
    const auto samples = pathSegmentStorage->value.samples();
    return std::all_of(samples.begin(), samples.end(),
                       [](const Sample& sample) { return guide::is_usable(record_of(sample)); });
}
