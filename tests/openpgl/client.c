/* Open PGL's interface from C: samples in, a field, directions out. Exit status 1 and a line for what is wrong. */
#include <openpgl/openpgl.h>

#include <math.h>
#include <stdio.h>

static int failures = 0;

static void expect(int holds, const char* what) {
    if (!holds) {
        printf("failed: %s\n", what);
        ++failures;
    }
}

int main(void) {
    PGLDevice device = pglNewDevice(PGL_DEVICE_TYPE_CPU_8, 1);
    PGLFieldArguments arguments;
    pglFieldArgumentsSetDefaults(&arguments, PGL_SPATIAL_STRUCTURE_KDTREE,
                                 PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM, true, 32000);
    PGLField field = pglDeviceNewField(device, arguments);
    pglReleaseFieldArguments(&arguments);

    PGLPathSegmentStorage path = pglNewPathSegmentStorage();
    PGLSampleStorage samples = pglNewSampleStorage();
    pglPathSegmentStorageReserve(path, 2);
    for (int i = 0; i < 2000; ++i) {
        PGLPathSegmentData* segment = pglPathSegmentStorageNextSegment(path);
        segment->position.x = 0.001f * (float)i;
        segment->directionIn.y = sinf(0.001f * (float)(i % 200));
        segment->directionIn.z = cosf(0.001f * (float)(i % 200));
        segment->pdfDirectionIn = 0.5f;
        segment = pglPathSegmentStorageNextSegment(path);
        segment->position.z = 1;
        segment->directContribution.x = segment->directContribution.y = segment->directContribution.z = 1;
        expect(pglPathSegmentStorageNextSegment(path) == NULL, "there is room for two segments");
        size_t count = 0;
        expect(pglPathSegmentStoragePrepareSamples(path, true, true, true) == 1, "a path of two segments is a sample");
        const PGLSampleData* made = pglPathSegmentStorageGetSamples(path, &count);
        expect(count == 1 && made->weight == 2 && made->flags == EDirectLight, "the sample is the light over the density");
        pglSampleStorageAddSamples(samples, made, count);
        pglPathSegmentStorageClear(path);
    }
    PGLZeroValueSampleData zero = {{0, 0, 0}, {0, 0, 1}, false};
    pglSampleStorageAddZeroValueSample(samples, &zero);
    pglFieldUpdate(field, samples);
    expect(pglFieldGetIteration(field) == 1, "the field counts its updates");

    PGLSurfaceSamplingDistribution distribution = pglFieldNewSurfaceSamplingDistribution(field);
    float u = 0.5f;
    const pgl_point3f position = {1, 0, 0};
    const pgl_vec3f normal = {0, 0, 1};
    const pgl_point2f point = {0.25f, 0.75f};
    pgl_vec3f direction;
    expect(pglFieldInitSurfaceSamplingDistribution(field, distribution, position, &u), "the field knows the position");
    pglSurfaceSamplingDistributionApplyCosineProduct(distribution, normal);
    const float density = pglSurfaceSamplingDistributionSamplePDF(distribution, point, &direction);
    expect(density == pglSurfaceSamplingDistributionPDF(distribution, direction), "a sample has its density");
    expect(direction.z > 0.9f, "directions go where light came from");

    PGLFieldStatistics statistics = pglFieldGetSurfaceStatistics(field);
    PGLString text = pglFieldStatisticsToString(statistics);
    expect(text.m_str != NULL && text.m_size > 1, "statistics are text");
    pglReleaseString(text);
    pglReleaseFieldStatistics(statistics);

    pglReleaseSurfaceSamplingDistribution(distribution);
    pglReleaseSampleStorage(samples);
    pglReleasePathSegmentStorage(path);
    pglReleaseField(field);
    pglReleaseDevice(device);
    return failures > 0;
}
