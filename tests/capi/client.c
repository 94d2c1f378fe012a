/* A renderer's use of capi/guide.h, in C99: train, ask, sample, save and load. Exit status 0 if all is as promised. */
#include <wend/capi/guide.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static int failures = 0;

static void check(int holds, const char* what, const wend_error* error) {
    if (!holds) {
        ++failures;
        fprintf(stderr, "failed: %s (%s)\n", what, error ? error->message : "");
    }
}

/* Knuth's linear congruential generator: uniform in [0, 1). */
static float uniform(uint64_t* state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (float)(*state >> 40) * 0x1p-24f;
}

static wend_vec3 vector(double x, double y, double z) {
    wend_vec3 v;
    v.x = (float)x;
    v.y = (float)y;
    v.z = (float)z;
    return v;
}

static double dot(wend_vec3 a, wend_vec3 b) {
    return (double)a.x * b.x + (double)a.y * b.y + (double)a.z * b.z;
}

static wend_vec3 direction_at(double z, double azimuth) {
    const double r = sqrt(fmax(0, 1 - z * z));
    return vector(r * cos(azimuth), r * sin(azimuth), z);
}

static const wend_vec3 lamp = {0.5f, 0.5f, 3.0f};

static wend_vec3 towards_lamp(wend_vec3 from, double* distance) {
    const wend_vec3 d = vector(lamp.x - from.x, lamp.y - from.y, lamp.z - from.z);
    *distance = sqrt(dot(d, d));
    return vector(d.x / *distance, d.y / *distance, d.z / *distance);
}

/* A lamp above the unit cube, seen by uniform directions: 10 within a cone of cosine 0.9 around it, 0.1 elsewhere. */
static void fill_records(wend_record* records, size_t count, uint64_t seed) {
    size_t i;
    for (i = 0; i < count; ++i) {
        const float x = uniform(&seed), y = uniform(&seed), z = uniform(&seed);
        const float u = uniform(&seed), v = uniform(&seed);
        double distance;
        wend_record* r = &records[i];
        r->position = vector(x, y, z);
        r->direction = direction_at(2.0 * u - 1, 2 * PI * v);
        r->density = (float)(1 / (4 * PI));
        r->radiance = dot(r->direction, towards_lamp(r->position, &distance)) > 0.9 ? 10 : 0.1f;
        r->distance = (float)distance;
        r->colour[0] = 1;
        r->colour[1] = r->colour[2] = r->radiance > 1 ? 0.5f : 1.0f;
        /* As if the guide had never drawn what is bright, beside a scattering function that is uniform. */
        r->classical_density = r->density;
        r->guided_density = r->radiance > 1 ? 0 : r->density;
        r->scattered = r->radiance * r->density;
    }
}

static const double true_fluence = 2 * PI * (0.1 * 10 + 1.9 * 0.1);

static double integral_over_sphere(const wend_distribution* distribution) {
    enum { rows = 300 };
    double sum = 0;
    int i, j;
    for (i = 0; i < rows; ++i) {
        for (j = 0; j < 2 * rows; ++j) {
            float density = 0;
            wend_error error;
            const wend_vec3 w = direction_at(-1 + (2 * i + 1.0) / rows, PI * (j + 0.5) / rows);
            check(wend_distribution_density(distribution, w, &density, &error) == WEND_OK, "density", &error);
            sum += density;
        }
    }
    return sum * 2 * PI / ((double)rows * rows);
}

/* The density is normalized, and samples have the density they say. */
static void check_distribution(const wend_distribution* distribution, const char* name) {
    enum { samples = 2000 };
    uint64_t seed = 9;
    wend_error error;
    int i;
    check(fabs(integral_over_sphere(distribution) - 1) < 2e-3, name, NULL);
    for (i = 0; i < samples; ++i) {
        wend_vec3 w;
        float density, again;
        const float u = uniform(&seed), v = uniform(&seed);
        check(wend_distribution_sample(distribution, u, v, &w, &density, &error) == WEND_OK, "sample", &error);
        check(wend_distribution_density(distribution, w, &again, &error) == WEND_OK && density == again && density > 0,
              "density of a sample", &error);
    }
}

static wend_field* train(int threads) {
    enum { count = 60000, passes = 4 };
    const wend_bounds bounds = {{0, 0, 0}, {1, 1, 1}};
    wend_record* records = malloc(count * sizeof *records);
    wend_field* field = NULL;
    wend_error error;
    wend_fit_report report;
    wend_fit_settings settings = wend_fit_settings_default();
    int pass;
    settings.max_kappa = 500; /* for the quadrature's sake */
    check(records != NULL, "memory", NULL);
    check(wend_field_create(bounds, &field, &error) == WEND_OK, "create", &error);
    for (pass = 0; pass < passes; ++pass) {
        wend_field* next = NULL;
        fill_records(records, count, (uint64_t)pass + 1);
        records[7].radiance = -1;
        check(wend_field_fit(field, records, count, &settings, threads, &next, &report, &error) == WEND_OK, "fit",
              &error);
        wend_field_destroy(field);
        field = next;
        check(report.records == count && report.ignored == 1 && report.cells > 1, "the report of a fit", NULL);
    }
    free(records);
    return field;
}

static void* saved(const wend_field* field, size_t* size) {
    wend_error error;
    void* bytes;
    check(wend_field_save(field, NULL, 0, size, &error) == WEND_OK, "size of a saved field", &error);
    bytes = malloc(*size);
    check(bytes && wend_field_save(field, bytes, *size - 1, size, &error) == WEND_BUFFER_TOO_SMALL, "a small buffer",
          &error);
    check(bytes && wend_field_save(field, bytes, *size, size, &error) == WEND_OK, "save", &error);
    return bytes;
}

static void check_questions(const wend_field* field) {
    const wend_vec3 position = {0.3f, 0.6f, 0.2f}, up = {0, 0, 1}, aside = {1, 0, 0};
    const wend_phase_part fog[2] = {{0.7f, 0.8f}, {0.3f, -0.3f}};
    wend_lobes cosine, phase;
    wend_distribution incident, surface, volume;
    wend_error error;
    double distance;
    float fluence = 0, share = 0, integral = 0, density = 0, colour[3] = {0, 0, 0}, mean;

    check(wend_field_fluence(field, position, &fluence, &error) == WEND_OK, "fluence", &error);
    check(fabs(fluence / true_fluence - 1) < 0.1, "the fluence is right", NULL);
    check(wend_field_classical_share(field, position, &share, &error) == WEND_OK, "classical share", &error);
    check(share > 0.7 && share <= 0.9, "classical sampling is kept where the guide fails", NULL);
    check(wend_field_incident(field, position, &incident, &error) == WEND_OK, "incident", &error);
    check_distribution(&incident, "the incident distribution is normalized");
    /* Uniform would be 0.08; the truth is 1.3. */
    check(wend_distribution_density(&incident, towards_lamp(position, &distance), &density, &error) == WEND_OK &&
              density > 0.5,
          "it points to the lamp", &error);
    check(wend_field_radiance(field, position, towards_lamp(position, &distance), colour, &error) == WEND_OK,
          "radiance", &error);
    mean = (colour[0] + colour[1] + colour[2]) / 3;
    check(fabs(mean / (density * fluence) - 1) < 1e-3, "its mean is the density times the fluence", NULL);
    check(fabs(colour[0] / colour[1] - 2) < 0.1 && fabs(colour[1] / colour[2] - 1) < 0.01, "the lamp is red", NULL);

    check(wend_lobes_cosine(&cosine, &error) == WEND_OK, "cosine", &error);
    check(wend_lobes_phase(fog, 2, &phase, &error) == WEND_OK, "phase function", &error);
    check(wend_distribution_product(&incident, &cosine, up, &surface, &integral, &error) == WEND_OK && integral > 0,
          "product with a cosine", &error);
    check_distribution(&surface, "the product with a cosine is normalized");
    check(wend_field_in_scattered(field, position, &surface, colour, &error) == WEND_OK, "in-scattered", &error);
    mean = (colour[0] + colour[1] + colour[2]) / 3;
    check(fabs(mean / (integral * fluence) - 1) < 1e-3, "its mean is the integral times the fluence", NULL);
    check(wend_field_in_scattered(field, position, &incident, colour, &error) == WEND_BAD_ARGUMENT,
          "what is no product is refused", NULL);
    volume = incident;
    check(wend_distribution_product(&volume, &phase, aside, &volume, &integral, &error) == WEND_OK && integral > 0,
          "product in place", &error);
    check_distribution(&volume, "the product with a phase function is normalized");
}

static void check_saving(const wend_field* field) {
    size_t size = 0, again_size = 0;
    void* bytes = saved(field, &size);
    void* again = NULL;
    wend_field* loaded = NULL;
    wend_error error;
    check(wend_field_load(bytes, size, &loaded, &error) == WEND_OK, "load", &error);
    again = saved(loaded, &again_size);
    check(size == again_size && memcmp(bytes, again, size) == 0, "what is loaded is what was saved", NULL);
    wend_field_destroy(loaded);
    free(again);
    free(bytes);
}

/* The same bits for any number of threads. */
static void check_threads(const wend_field* field) {
    wend_field* other = train(2);
    size_t size = 0, other_size = 0;
    void* bytes = saved(field, &size);
    void* other_bytes = saved(other, &other_size);
    check(size == other_size && memcmp(bytes, other_bytes, size) == 0, "threads do not matter", NULL);
    free(bytes);
    free(other_bytes);
    wend_field_destroy(other);
}

/* Two vertices, a lamp of radiance 6 behind the second; the first one's connection found another. */
static void check_path(void) {
    const wend_path_vertex path[2] = {{{0, 0, 0},
                                       {0, 0, 1},
                                       0.5f,
                                       1,
                                       {1, 1, 1},
                                       {0.9f, 0.9f, 0.9f},
                                       {2, 2, 2},
                                       0.75f,
                                       0.25f,
                                       -1,
                                       {3, 3, 3},
                                       7,
                                       {0, 1, 0},
                                       5,
                                       {0, 0, 1}},
                                      {{0, 0, 1},
                                       {1, 0, 0},
                                       0.25f,
                                       INFINITY,
                                       {0.5f, 0.5f, 0.5f},
                                       {0.8f, 0.8f, 0.8f},
                                       {6, 6, 6},
                                       0,
                                       0,
                                       0,
                                       {0, 0, 0},
                                       0,
                                       {0, 0, 0},
                                       INFINITY,
                                       {0, 0, 0}}};
    wend_record records[2];
    wend_scatter_record scattered[2];
    wend_error error;
    check(wend_records_of_path(path, 2, records, &error) == WEND_OK, "records of a path", &error);
    check(fabs(records[0].radiance - (2 + 0.5 * 0.8 * 6)) < 1e-6 && records[1].radiance == 6, "their radiance", NULL);
    check(records[0].distance == 1 && records[1].density == 0.25f && records[0].classical_density == 0.75f &&
              records[0].guided_density == 0.25f && fabs(records[1].scattered - 6 * 0.8 * 0.25) < 1e-6,
          "their other numbers", NULL);
    check(wend_scatter_records_of_path(path, 2, scattered, &error) == WEND_OK, "scattered light of a path", &error);
    check(fabs(scattered[0].leaving - (3 + 0.9 * records[0].radiance)) < 1e-5 && scattered[0].connected == 7 &&
              scattered[0].light_distance == 5 && scattered[0].to_light.y == 1 && scattered[0].normal.z == 1 &&
              scattered[1].connected == 0,
          "what it is", NULL);
}

int main(void) {
    wend_field* field = train(1);
    wend_field_summary summary;
    wend_error error;
    check(wend_field_summarize(field, &summary, &error) == WEND_OK, "summary", &error);
    check(summary.learned == 1 && summary.cells > 1 && summary.lobes >= summary.cells && summary.records > 100000 &&
              summary.bounds.max.z == 1,
          "what the summary says", NULL);
    check_questions(field);
    check_saving(field);
    check_threads(field);
    check_path();
    wend_field_destroy(field);
    printf("%s\n", failures ? "FAILED" : "passed");
    return failures ? 1 : 0;
}
