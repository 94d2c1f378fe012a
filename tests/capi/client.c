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

/* A walk that is expected to bring three times its pixel is split into three; one that brings little may end. */
static void check_survival(void) {
    const wend_survival_settings settings = {1, 1, 1};
    wend_expected_contribution contribution = {3, 1, 64};
    wend_walk_state state = {{0.01f, 0.02f, 0.01f}, 1, 1, 3, 0, 0};
    const wend_roulette unguided = wend_roulette_unguided();
    wend_continuations continuations;
    wend_error error;
    float probability = 0, share = 0;
    check(wend_survival_before_direction(&settings, &contribution, 0.5, &continuations, &error) == WEND_OK, "split",
          &error);
    check(!continuations.judged_by_weight && continuations.copies == 3 && continuations.expected == 3,
          "three directions", NULL);
    contribution.ratio = 0.001f;
    check(wend_survival_before_direction(&settings, &contribution, 0.99, &continuations, &error) == WEND_OK &&
              continuations.copies == 0 && continuations.expected < 1,
          "an end", &error);
    contribution.ratio = -1;
    check(wend_survival_before_direction(&settings, &contribution, 0.5, &continuations, &error) == WEND_OK &&
              continuations.judged_by_weight && continuations.copies == 1 && !continuations.uses_number,
          "what is not known is judged by weight", &error);
    check(wend_survival_after_direction(&settings, &state, &probability, &error) == WEND_OK &&
              fabs(probability - 0.02 * 8) < 1e-6,
          "survival by weight", &error);
    check(wend_roulette_survival(&unguided, &state, &probability, &error) == WEND_OK &&
              fabs(probability - 0.02 * 2) < 1e-6 && wend_roulette_guided().ends_below == 0.125f,
          "classical roulette", &error);
    check(wend_least_classical_share(6, &share, &error) == WEND_OK && share == 1, "heavy walks are classical", &error);
}

static void check_pixels(void) {
    const float rgb[12] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    float estimates[4] = {0, 0, 0, 0};
    wend_error error;
    check(wend_pixel_estimates(rgb, 2, 2, 16, estimates, &error) == WEND_OK, "pixel estimates", &error);
    check(fabs(estimates[0] - 1) < 0.01 && estimates[3] == estimates[0], "of an even picture", NULL);
}

static float one_of_three(void* user, const wend_light_receiver* receiver, int light) {
    (void)receiver, (void)light;
    return *(const float*)user;
}

/* Of three lights that are alike at first only the last one is not hidden. */
static void check_lights(void) {
    enum { count = 3000 };
    const wend_bounds bounds = {{0, 0, 0}, {1, 1, 1}};
    const wend_light_receiver receiver = {{0.5f, 0.5f, 0.5f}, {0, 0, 0}};
    const float first[3] = {1.0f / 3, 1.0f / 3, 1.0f / 3};
    float third = 1.0f / 3, probability = 0, again = 0, sum = 0;
    wend_light_record records[count];
    wend_lights* lights = NULL;
    wend_error error;
    uint64_t seed = 5;
    int i, light = -1;
    check(wend_lights_create(bounds, 3, &lights, &error) == WEND_OK, "lights", &error);
    for (i = 0; i < count; ++i) {
        check(wend_lights_sample(lights, &receiver, first, uniform(&seed), &light, &probability, &error) == WEND_OK &&
                  probability == first[0],
              "a light", &error);
        check(wend_lights_record(lights, &receiver, light, light == 2, &records[i], &error) == WEND_OK,
              "what a connection brought", &error);
    }
    check(wend_lights_add(lights, records, count, &error) == WEND_OK, "add", &error);
    check(wend_lights_learn(lights, one_of_three, &third, 2, &error) == WEND_OK, "learn", &error);
    for (i = 0; i < 3; ++i) {
        check(wend_lights_probability(lights, &receiver, i, first[i], &probability, &error) == WEND_OK, "probability",
              &error);
        sum += probability;
    }
    check(fabs(sum - 1) < 1e-5 && fabs(probability - (0.75 + 0.25 / 3)) < 0.01, "the last light is preferred", NULL);
    check(wend_lights_sample(lights, &receiver, first, 0.9f, &light, &again, &error) == WEND_OK && light == 2 &&
              again == probability,
          "and chosen", &error);
    wend_lights_destroy(lights);
}

/* Flights towards the lamp above the cube: in the mean their weights are the light that scatters on to them. */
static void check_flights(const wend_field* surface) {
    enum { count = 3000, flights = 20000 };
    const wend_medium fog = {{0.2f, 0.2f, 0.2f}, {1, 1, 1}, {{1, 0.3f}}, 1};
    const wend_flight_settings settings = {0.3f, WEND_GUIDE_SCATTERING_AND_DISTANCE};
    wend_flight_start start = {{0.5f, 0.5f, 0}, {0, 0, 1}, 1,
                               {1, 1, 1},       1,         {WEND_END_SURFACE, {0.5f, 0.5f, 1}, {0, 0, -1}, 0}};
    wend_scatter_record records[count];
    wend_ray_cell cells[64];
    wend_field *fitted = train(1), *volume = NULL;
    wend_flight flight;
    wend_error error;
    uint64_t seed = 11;
    size_t cell_count = 0;
    double guided = 0, classical = 0, distance;
    float radiance = -1, passed[3];
    int i, looks = 0;
    for (i = 0; i < count; ++i) {
        wend_scatter_record* r = &records[i];
        const float x = uniform(&seed), y = uniform(&seed), z = uniform(&seed);
        r->position = vector(x, y, z);
        r->normal = vector(0, 0, 0);
        r->to_light = towards_lamp(r->position, &distance);
        r->light_distance = (float)distance;
        r->connected = (float)(1 / (distance * distance));
        r->leaving = r->connected * 0.1f;
    }
    check(wend_field_fit_scattered(fitted, records, count, 0.8, 2, &volume, &error) == WEND_OK, "scattered light",
          &error);
    wend_field_destroy(fitted);
    check(wend_field_leaving(volume, start.origin, start.direction, &radiance, &error) == WEND_OK && radiance > 0,
          "leaving light", &error);
    check(wend_field_cells_along_ray(volume, start.origin, start.direction, 0, 1, 0, cells, 64, &cell_count, &error) ==
                  WEND_OK &&
              cell_count > 1 && cells[0].t_in == 0 && cells[cell_count - 1].t_out == 1,
          "cells along a ray", &error);
    check(cells[0].walked.fluence > 0 && cells[0].connected.mean.z > 0.5f && cells[0].confidence > 0, "what they tell",
          NULL);
    check(wend_flight_looks_ahead(&fog, &start, &looks, &error) == WEND_OK && looks, "guided flights look ahead",
          &error);
    check(wend_flight_pass_probability(&fog, 1, passed, &error) == WEND_OK && fabs(passed[1] - exp(-1.2)) < 1e-4,
          "the probability of passing", &error);
    for (i = 0; i < flights; ++i) {
        const float u = uniform(&seed);
        check(wend_flight_guided(surface, volume, &settings, &fog, &start, u, &flight, &error) == WEND_OK,
              "a guided flight", &error);
        guided += flight.scatters ? flight.weight[0] * flight.distance : 0;
        check(wend_flight_classical(&fog, &start, u, &flight, &error) == WEND_OK, "a classical flight", &error);
        classical += flight.scatters ? flight.weight[0] * flight.distance : 0;
    }
    check(fabs(guided / classical - 1) < 0.05 && guided != classical, "both have the same mean", NULL);
    wend_field_destroy(volume);
}

/* White wax without absorption, a half-space, in a white sky: whatever enters brings 1. */
static void check_interior(void) {
    enum { walks = 500 };
    const wend_medium wax = {{0, 0, 0}, {10, 10, 10}, {{1, 0.5f}}, 1};
    const float channels[3] = {0.5f, 0.25f, 0.25f};
    const wend_vec3 up = {0, 0, 1}, down = {0, 0, -1};
    wend_interior_guide* guide = NULL;
    wend_error error;
    uint64_t seed = 17;
    double sum = 0;
    int i;
    check(wend_interior_guide_create(&wax, 0.25f, &guide, &error) == WEND_OK, "a guide", &error);
    for (i = 0; i < walks; ++i) {
        wend_interior_walk walk, there;
        wend_vec3 direction = down;
        double height = 0, throughput = 1;
        check(wend_interior_enter(guide, channels, &walk, &error) == WEND_OK &&
                  wend_interior_aim(&walk, up, 1, &error) == WEND_OK &&
                  wend_interior_head(&walk, direction, &error) == WEND_OK,
              "enter, aim, head", &error);
        for (;;) {
            const double exit = direction.z > 0 ? -height / direction.z : 1e30;
            wend_interior_flight flight;
            wend_interior_direction s;
            float drawn, passed, density, survival;
            int turned;
            check(wend_interior_draw_distance(&walk, uniform(&seed), &drawn, &error) == WEND_OK &&
                      wend_interior_fly(&walk, (float)exit, drawn, &flight, &error) == WEND_OK,
                  "fly", &error);
            throughput *= flight.weight[0];
            if (!flight.scatters) {
                check(wend_interior_has_turned(&walk, &turned, &error) == WEND_OK && turned, "a turn", &error);
                sum += throughput;
                break;
            }
            height = fmin(0, height + flight.distance * direction.z);
            check(wend_interior_density(&walk, direction, up, &density, &error) == WEND_OK && density > 0, "density",
                  &error);
            there = walk;
            check(wend_interior_turn(&there, direction, up, &error) == WEND_OK &&
                      wend_interior_pass(&there, (float)-height, &passed, &error) == WEND_OK && passed > 0 &&
                      passed <= 1,
                  "a connection", &error);
            check(wend_interior_sample(&walk, direction, uniform(&seed), uniform(&seed), uniform(&seed),
                                       (uint64_t)(uniform(&seed) * 0x1p24f), &s, &error) == WEND_OK &&
                      s.density > 0,
                  "a direction", &error);
            check(wend_interior_turn(&walk, direction, s.direction, &error) == WEND_OK, "turn", &error);
            throughput *= s.weight;
            direction = s.direction;
            check(wend_interior_survival(&walk, (float)throughput, &survival, &error) == WEND_OK, "survive", &error);
            if (uniform(&seed) >= survival) {
                break;
            }
            throughput /= survival;
        }
    }
    check(fabs(sum / walks - 1) < 0.05, "all light comes back", NULL);
    wend_interior_guide_destroy(guide);
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
    check_survival();
    check_pixels();
    check_lights();
    check_flights(field);
    check_interior();
    wend_field_destroy(field);
    printf("%s\n", failures ? "FAILED" : "passed");
    return failures ? 1 : 0;
}
