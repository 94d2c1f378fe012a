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
    release(pathSegmentStorage);
}

void pglPathSegmentStorageReserve(PGLPathSegmentStorage pathSegmentStorage, size_t size) noexcept {
    if (is_object(pathSegmentStorage)) {
        guarded([&] { pathSegmentStorage->value.reserve(size); });
    }
}

void pglPathSegmentStorageClear(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    if (is_object(pathSegmentStorage)) {
        pathSegmentStorage->value.clear();
    }
}

PGLPathSegmentData* pglPathSegmentStorageNextSegment(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return is_object(pathSegmentStorage) ? pathSegmentStorage->value.next() : nullptr;
}

void pglPathSegmentStorageAddSegment(PGLPathSegmentStorage pathSegmentStorage, PGLPathSegmentData segment) noexcept {
    if (PGLPathSegmentData* next = pglPathSegmentStorageNextSegment(pathSegmentStorage)) {
        *next = segment;
    }
}

void pglPathSegmentStorageAddSample(PGLPathSegmentStorage pathSegmentStorage, PGLSampleData sample) noexcept {
    if (is_object(pathSegmentStorage)) {
        guarded([&] { pathSegmentStorage->value.add_sample(sample); });
    }
}

size_t pglPathSegmentStoragePrepareSamples(PGLPathSegmentStorage pathSegmentStorage, bool useNEEMiWeights,
                                           bool guideDirectLight, bool rrAffectsDirectContribution) noexcept {
    if (!is_object(pathSegmentStorage)) {
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
    if (!is_object(pathSegmentStorage) || !is_object(sampleStorage)) {
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
    nSamples = is_object(pathSegmentStorage) ? pathSegmentStorage->value.plain_samples().size() : 0;
    return is_object(pathSegmentStorage) ? pathSegmentStorage->value.plain_samples().data() : nullptr;
}

const PGLZeroValueSampleData* pglPathSegmentStorageGetZeroValueSamples(PGLPathSegmentStorage pathSegmentStorage,
                                                                       size_t& nSamples) noexcept {
    nSamples = is_object(pathSegmentStorage) ? pathSegmentStorage->value.zero_samples().size() : 0;
    return is_object(pathSegmentStorage) ? pathSegmentStorage->value.zero_samples().data() : nullptr;
}

pgl_vec3f pglPathSegmentStorageCalculatePixelEstimate(PGLPathSegmentStorage pathSegmentStorage,
                                                      bool rrAffectsDirectContribution) noexcept {
    return from_colour(is_object(pathSegmentStorage) ? pathSegmentStorage->value.estimate(rrAffectsDirectContribution)
                                                     : Rgb());
}

void pglPathSegmentSetMaxDistance(PGLPathSegmentStorage pathSegmentStorage, float maxDistance) noexcept {
    if (is_object(pathSegmentStorage) && maxDistance > 0) {
        pathSegmentStorage->value.max_distance = maxDistance;
    }
}

float pglPathSegmentGetMaxDistance(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return is_object(pathSegmentStorage) ? pathSegmentStorage->value.max_distance : 0.0f;
}

int pglPathSegmentGetNumSegments(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return is_object(pathSegmentStorage) ? static_cast<int>(pathSegmentStorage->value.segments().size()) : 0;
}

int pglPathSegmentGetNumSamples(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return is_object(pathSegmentStorage) ? static_cast<int>(pathSegmentStorage->value.samples().size()) : 0;
}

int pglPathSegmentGetNumZeroValueSamples(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    return is_object(pathSegmentStorage) ? static_cast<int>(pathSegmentStorage->value.zero_samples().size()) : 0;
}

bool pglPathSegmentStorageValidateSegments(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    if (!is_object(pathSegmentStorage)) {
        return false;
    }
    const auto segments = pathSegmentStorage->value.segments();
    return std::all_of(segments.begin(), segments.end(), [](const PGLPathSegmentData& s) { return is_usable(s); });
}

bool pglPathSegmentStorageValidateSamples(PGLPathSegmentStorage pathSegmentStorage) noexcept {
    if (!is_object(pathSegmentStorage)) {
        return false;
    }
    const auto samples = pathSegmentStorage->value.samples();
    return std::all_of(samples.begin(), samples.end(),
                       [](const Sample& sample) { return guide::is_usable(record_of(sample)); });
}
