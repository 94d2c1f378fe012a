/* What examples/embed does, in C99, by one thread. The numbered comments are the steps of docs/embedding.md; the scene
 * and its random numbers are written out, so that pictures can be compared bit for bit. */
#include "rooms.h"

#include <wend/capi/guide.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program unless all went well; a field that has learned nothing is no mistake. */
static int learned(wend_status status, const wend_error* error) {
    if (status != WEND_OK && status != WEND_NOTHING_LEARNED) {
        fprintf(stderr, "%s\n", error->message);
        exit(1);
    }
    return status == WEND_OK;
}

/* ---- Vectors, colours and growing arrays ---- */

typedef wend_vec3 vec3;
typedef struct vec2 {
    float x, y;
} vec2;
typedef struct rgb {
    float c[3];
} rgb;

static vec3 make(float x, float y, float z) {
    vec3 v;
    v.x = x, v.y = y, v.z = z;
    return v;
}
static float along(vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
static vec3 from_axes(int axis, float a, float b, float c) {
    float v[3];
    v[axis] = a, v[(axis + 1) % 3] = b, v[(axis + 2) % 3] = c;
    return make(v[0], v[1], v[2]);
}
static vec3 add(vec3 a, vec3 b) {
    return make(a.x + b.x, a.y + b.y, a.z + b.z);
}
static vec3 subtract(vec3 a, vec3 b) {
    return make(a.x - b.x, a.y - b.y, a.z - b.z);
}
static vec3 scale(vec3 v, float s) {
    return make(v.x * s, v.y * s, v.z * s);
}
static float dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static vec3 cross(vec3 a, vec3 b) {
    return make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static float norm(vec3 v) {
    return sqrtf(dot(v, v));
}
static vec3 normalize(vec3 v) {
    return scale(v, 1.0f / norm(v));
}

static rgb grey(float value) {
    rgb r;
    r.c[0] = r.c[1] = r.c[2] = value;
    return r;
}
static rgb plus(rgb a, rgb b) {
    rgb r;
    int i;
    for (i = 0; i < 3; ++i) {
        r.c[i] = a.c[i] + b.c[i];
    }
    return r;
}
static rgb times(rgb a, rgb b) {
    rgb r;
    int i;
    for (i = 0; i < 3; ++i) {
        r.c[i] = a.c[i] * b.c[i];
    }
    return r;
}
static float mean(rgb r) {
    return (r.c[0] + r.c[1] + r.c[2]) / 3;
}

/* Room for one more of `count` things of a size. */
static void* room(void* things, size_t count, size_t* capacity, size_t size) {
    if (count == *capacity) {
        *capacity = 2 * *capacity + 64;
        things = realloc(things, *capacity * size);
        if (!things) {
            fprintf(stderr, "out of memory\n");
            exit(1);
        }
    }
    return things;
}

/* ---- Random numbers: those of a pixel and a sample, by PCG32 (oneill2014) ---- */

typedef struct generator {
    uint64_t state, increment;
} generator;

static uint64_t mixed(uint64_t x) {
    x ^= x >> 30;
    x *= UINT64_C(0xbf58476d1ce4e5b9);
    x ^= x >> 27;
    x *= UINT64_C(0x94d049bb133111eb);
    x ^= x >> 31;
    return x;
}
static uint32_t next(generator* g) {
    const uint64_t old = g->state;
    const uint32_t shifted = (uint32_t)(((old >> 18) ^ old) >> 27), rotation = (uint32_t)(old >> 59);
    g->state = old * UINT64_C(6364136223846793005) + g->increment;
    return (shifted >> rotation) | (shifted << ((32u - rotation) & 31u));
}
static generator generator_of(uint64_t pixel, uint64_t sample) {
    const uint64_t golden = UINT64_C(0x9e3779b97f4a7c15);
    const uint64_t key = mixed(mixed(golden + golden + pixel) + golden + sample);
    generator g;
    g.state = mixed(key);
    g.increment = mixed(key ^ UINT64_C(0xda3e39cb94b95bdb)) | 1u;
    next(&g);
    return g;
}
static float uniform(generator* g) {
    return (float)(next(g) >> 8) * 0x1p-24f;
}
static double uniform_double(generator* g) {
    const uint64_t high = next(g);
    return (double)((high << 32 | next(g)) >> 11) * 0x1p-53;
}
static vec2 uniform2(generator* g) {
    vec2 u;
    u.x = uniform(g);
    u.y = uniform(g);
    return u;
}

/* ---- The scene: rectangles across an axis, and fog everywhere ---- */

typedef struct wall {
    int axis;
    float at;
    vec2 min, max; /* along the next two axes */
    rgb albedo;
    int lamp;     /* which, if it is one; otherwise -1 */
    float shines; /* along the axis: on this side */
    rgb radiance;
} wall;

#define WHITE                   \
    {                           \
        { 0.75f, 0.75f, 0.75f } \
    }
#define RED                   \
    {                         \
        { 0.6f, 0.2f, 0.15f } \
    }
#define BLACK       \
    {               \
        { 0, 0, 0 } \
    }
enum { wall_count = 11, lamp_count = 2, first_lamp = wall_count - lamp_count };
static const wall walls[wall_count] = {
    {0, 0, {0, 0}, {2.5f, 4}, RED, -1, -1, BLACK},
    {0, 6, {0, 0}, {2.5f, 4}, WHITE, -1, -1, BLACK},
    {1, 0, {0, 0}, {4, 6}, WHITE, -1, -1, BLACK},
    {1, 2.5f, {0, 0}, {4, 6}, WHITE, -1, -1, BLACK},
    {2, 0, {0, 0}, {6, 2.5f}, WHITE, -1, -1, BLACK},
    {2, 4, {0, 0}, {6, 2.5f}, WHITE, -1, -1, BLACK},
    /* The wall between the rooms, around a door. */
    {0, 3, {0, 0}, {2.5f, 0.3f}, WHITE, -1, -1, BLACK},
    {0, 3, {0, 0.7f}, {2.5f, 4}, WHITE, -1, -1, BLACK},
    {0, 3, {2, 0.3f}, {2.5f, 0.7f}, WHITE, -1, -1, BLACK},
    /* One lamp shines towards the door, a stronger one from the wall between the rooms, where nobody sees it. */
    {0, 5.99f, {0.8f, 0.2f}, {1.6f, 0.8f}, BLACK, 0, -1, {{15, 13, 10}}},
    {0, 3.01f, {1, 2}, {2, 3.5f}, BLACK, 1, 1, {{8, 9, 12}}},
};
static const wend_medium fog = {{0.01f, 0.01f, 0.01f}, {0.19f, 0.19f, 0.19f}, {{1, 0.6f}}, 1};
static const float extinction = 0.2f;
static const wend_bounds bounds = {{0, 0, 0}, {6, 2.5f, 4}};

static float area(const wall* w) {
    return (w->max.x - w->min.x) * (w->max.y - w->min.y);
}

typedef struct hit {
    const wall* wall;
    float distance;
    vec3 normal; /* towards where the ray came from */
} hit;

static hit intersect(vec3 origin, vec3 direction) {
    hit nearest = {NULL, INFINITY, {0, 0, 0}};
    int i;
    for (i = 0; i < wall_count; ++i) {
        const wall* w = &walls[i];
        const float distance = (w->at - along(origin, w->axis)) / along(direction, w->axis);
        const vec3 p = add(origin, scale(direction, distance));
        const float x = along(p, (w->axis + 1) % 3), y = along(p, (w->axis + 2) % 3);
        if (distance > 1e-5f && distance < nearest.distance &&
            !(x < w->min.x || x > w->max.x || y < w->min.y || y > w->max.y)) {
            nearest.wall = w;
            nearest.distance = distance;
            nearest.normal = from_axes(w->axis, along(direction, w->axis) > 0 ? -1.0f : 1.0f, 0, 0);
        }
    }
    return nearest;
}

/* The cosine at a lamp on its bright side of a direction towards it; 0 on its back. */
static float cosine_at(const wall* lamp, vec3 direction) {
    return fmaxf(0.0f, -lamp->shines * along(direction, lamp->axis));
}
/* Of choosing a direction by choosing a point of a lamp, per steradian. */
static float emitter_density(const wall* lamp, float distance, float cosine) {
    return distance * distance / (cosine * area(lamp));
}

/* Which lamp is connected to, as long as nothing is learned: by power. (wend_first_choice) */
static float by_power(void* user, const wend_light_receiver* receiver, int light) {
    const wall* lamps = walls + first_lamp;
    const float power[lamp_count] = {mean(lamps[0].radiance) * area(&lamps[0]),
                                     mean(lamps[1].radiance) * area(&lamps[1])};
    (void)user, (void)receiver;
    return power[light] / (power[0] + power[1]);
}

/* ---- 1. How things scatter: a matt surface, or the fog ---- */

typedef struct scatterer {
    int in_volume;
    rgb albedo;
    vec3 axis; /* the normal, or the direction of propagation before the collision */
} scatterer;

static float own_density(const scatterer* f, vec3 w) {
    const float cosine = dot(f->axis, w);
    if (f->in_volume) {
        /* Henyey and Greenstein's phase function. */
        const float g = fog.phase[0].g, d = 1 + g * (g - 2 * cosine);
        return 0.07957747154594766788f * (1 - g * g) / (d * sqrtf(d));
    }
    return fmaxf(0.0f, cosine) * 0.31830988618379067154f;
}
static rgb evaluate(const scatterer* f, vec3 w) {
    return times(f->albedo, grey(own_density(f, w)));
}

/* The direction that has these coordinates around an axis (duff2017, listing 3). */
static vec3 around(vec3 n, vec3 v) {
    const float sign = copysignf(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    const vec3 s = make(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), t = make(b, sign + n.y * n.y * a, -n.y);
    return add(add(scale(s, v.x), scale(t, v.y)), scale(n, v.z));
}
static float safe_sqrt(float x) {
    return x > 0 ? sqrtf(x) : 0.0f;
}
static vec3 draw_own(const scatterer* f, vec2 u) {
    const float pi = 3.14159265358979323846f;
    if (f->in_volume) {
        const float g = fog.phase[0].g, s = (1 - g * g) / (1 + g * (2 * u.x - 1));
        const float cosine = fminf(fmaxf((1 + g * g - s * s) / (2 * g), -1.0f), 1.0f);
        const float sine = safe_sqrt(1 - cosine * cosine), phi = 2 * pi * u.y;
        return around(f->axis, make(sine * cosf(phi), sine * sinf(phi), cosine));
    } else {
        /* A disk by the concentric map (shirley1997), lifted to the hemisphere. */
        const float x = 2 * u.x - 1, y = 2 * u.y - 1;
        const int wide = fabsf(x) > fabsf(y);
        const float r = wide ? x : y;
        const float phi = wide ? (pi / 4) * (y / x) : (pi / 2) - (pi / 4) * (x / y);
        const vec2 d = {x == 0 && y == 0 ? 0 : r * cosf(phi), x == 0 && y == 0 ? 0 : r * sinf(phi)};
        return around(f->axis, make(d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)));
    }
}

/* What walks ask, and the shapes of what scatters, by `in_volume`. */
typedef struct decisions {
    int guided;
    wend_field* fields[2];
    wend_lobes lobes[2];
    wend_survival_settings survival;
    wend_flight_settings flights;
    wend_roulette roulette;
    wend_lights* lights;
} decisions;

/* Directions at one vertex: the scatterer's own, mixed with those of the field where it knows something. */
typedef struct directions {
    const scatterer* f;
    int known;
    float share; /* of the scatterer's own */
    wend_distribution product;
    rgb in_scattered;
} directions;

static void directions_at(const decisions* d, vec3 position, const scatterer* f, float weight, directions* result) {
    const wend_field* field = d->fields[f->in_volume];
    wend_error error;
    float least;
    result->f = f;
    result->share = 1;
    result->known = d->guided && learned(wend_field_incident(field, position, &result->product, &error), &error);
    if (!result->known) {
        return;
    }
    learned(
        wend_distribution_product(&result->product, &d->lobes[f->in_volume], f->axis, &result->product, NULL, &error),
        &error);
    learned(wend_field_in_scattered(field, position, &result->product, result->in_scattered.c, &error), &error);
    learned(wend_field_classical_share(field, position, &result->share, &error), &error);
    learned(wend_least_classical_share(weight, &least, &error), &error);
    result->share = fmaxf(result->share, least);
}

static float guide_density(const directions* d, vec3 w) {
    float density;
    wend_error error;
    learned(wend_distribution_density(&d->product, w, &density, &error), &error);
    return density;
}
static float density_of(const directions* d, vec3 w) {
    const float own = own_density(d->f, w);
    return d->known && d->share < 1 ? d->share * own + (1 - d->share) * guide_density(d, w) : own;
}

typedef struct drawn {
    vec3 direction;
    rgb weight;
    float density, ratio, classical_density, guided_density;
} drawn;

/* 0 where the direction would carry nothing. */
static int draw_direction(const directions* d, float u, vec2 square, drawn* s) {
    const int mixes = d->known && d->share < 1;
    wend_error error;
    rgb value;
    float own;
    if (!mixes || u < d->share) {
        s->direction = draw_own(d->f, square);
    } else {
        learned(wend_distribution_sample(&d->product, square.x, square.y, &s->direction, NULL, &error), &error);
    }
    own = own_density(d->f, s->direction);
    value = evaluate(d->f, s->direction);
    s->density = own;
    s->ratio = 1;
    s->classical_density = s->guided_density = 0;
    if (mixes) {
        s->classical_density = own;
        s->guided_density = guide_density(d, s->direction);
        s->density = d->share * own + (1 - d->share) * s->guided_density;
        s->ratio = own > 0 ? s->density / own : 1.0f;
    }
    if (!(s->density > 0) || (value.c[0] == 0 && value.c[1] == 0 && value.c[2] == 0)) {
        return 0;
    }
    s->weight = times(value, grey(1 / s->density));
    return 1;
}

/* ---- 2. Walk, let decisions choose, and keep the vertices ---- */

/* Where a walk is for its records: what happened since its last vertex. */
typedef struct branch {
    int32_t vertex;
    rgb weight;
    rgb connected;
    vec3 to_light;
    float light_distance, light_fluence;
    vec3 normal;
} branch;

static branch after_vertex(int32_t vertex) {
    branch b;
    b.vertex = vertex;
    b.weight = grey(1);
    b.connected = grey(0);
    b.to_light = b.normal = make(0, 0, 0);
    b.light_distance = INFINITY;
    b.light_fluence = 0;
    return b;
}

/* Where a branch of the walk is. */
typedef struct state {
    vec3 origin, direction;
    rgb throughput;
    wend_light_receiver last; /* where the direction was drawn */
    float density;            /* of the direction */
    float ratio;              /* how much likelier the walk is for being guided */
    float copies;
    int depth;
    branch at;
} state;

/* What walks told: records for the fields, by `in_volume`, and what connections brought. */
typedef struct told {
    wend_record* records[2];
    wend_scatter_record* scattered[2];
    size_t count[2], records_capacity[2], scattered_capacity[2];
    wend_light_record* lights;
    size_t light_count, light_capacity;
} told;

typedef struct walk {
    const decisions* d;
    float expected; /* what the pixel will be, as far as is known; 0: not at all */
    generator* random;
    told* told;
    state now;
    rgb radiance;
    state* pending;
    size_t pending_count, pending_capacity;
    wend_path_vertex* path;
    unsigned char* in_volume;
    size_t count, capacity, in_volume_capacity;
} walk;

/* Every factor and every radiance is for the records as well. */
static void weigh(walk* w, rgb weight) {
    w->now.throughput = times(w->now.throughput, weight);
    w->now.at.weight = times(w->now.at.weight, weight);
}
static void gather(walk* w, rgb radiance) {
    w->radiance = plus(w->radiance, times(w->now.throughput, radiance));
    if (w->now.at.vertex >= 0) {
        const rgb gathered = times(w->now.at.weight, radiance);
        int i;
        for (i = 0; i < 3; ++i) {
            w->path[w->now.at.vertex].gathered[i] += gathered.c[i];
        }
    }
}
static void meet(walk* w, float distance) {
    if (w->now.at.vertex >= 0 && w->path[w->now.at.vertex].distance == INFINITY) {
        w->path[w->now.at.vertex].distance = distance;
    }
}

static void keep_vertex(walk* w, vec3 position, const drawn* s, int in_volume) {
    wend_path_vertex* v;
    const branch* at = &w->now.at;
    w->path = room(w->path, w->count, &w->capacity, sizeof *w->path);
    w->in_volume = room(w->in_volume, w->count, &w->in_volume_capacity, sizeof *w->in_volume);
    w->in_volume[w->count] = (unsigned char)in_volume;
    v = &w->path[w->count];
    memset(v, 0, sizeof *v);
    v->position = position;
    v->direction = s->direction;
    v->density = s->density;
    v->distance = INFINITY;
    memcpy(v->arrival, at->weight.c, sizeof v->arrival);
    memcpy(v->scattering, s->weight.c, sizeof v->scattering);
    v->classical_density = s->classical_density;
    v->guided_density = s->guided_density;
    v->parent = at->vertex;
    memcpy(v->connected, at->connected.c, sizeof v->connected);
    v->light_fluence = at->light_fluence;
    v->to_light = at->to_light;
    v->light_distance = at->light_distance;
    v->normal = at->normal;
    w->now.at = after_vertex((int32_t)w->count++);
}

/* Radiance of a lamp that is met, weighted against connect(), which might have found it (balance heuristic). */
static rgb met(const walk* w, const hit* h) {
    const float cosine = h->wall->lamp < 0 ? 0.0f : cosine_at(h->wall, w->now.direction);
    float own, probability, other;
    wend_error error;
    if (cosine == 0 || w->now.depth == 0) {
        return cosine > 0 ? h->wall->radiance : grey(0);
    }
    own = w->now.density * expf(-extinction * h->distance);
    learned(wend_lights_probability(w->d->lights, &w->now.last, h->wall->lamp, by_power(NULL, NULL, h->wall->lamp),
                                    &probability, &error),
            &error);
    other = probability * emitter_density(h->wall, h->distance, cosine);
    return times(h->wall->radiance, grey(own / (own + other)));
}

/* Next-event estimation. Directions could have found the lamp as well: the balance heuristic asks their density. */
static void connect(walk* w, const directions* ways, const wend_light_receiver* here) {
    const float first[lamp_count] = {by_power(NULL, here, 0), by_power(NULL, here, 1)};
    const wall* lamp;
    int light;
    float chosen, distance, cosine;
    vec2 u;
    vec3 to_lamp, direction;
    rgb brought = grey(0);
    wend_light_record record;
    wend_error error;
    learned(wend_lights_sample(w->d->lights, here, first, uniform(w->random), &light, &chosen, &error), &error);
    lamp = &walls[first_lamp + light];
    u = uniform2(w->random);
    to_lamp = subtract(from_axes(lamp->axis, lamp->at, lamp->min.x + u.x * (lamp->max.x - lamp->min.x),
                                 lamp->min.y + u.y * (lamp->max.y - lamp->min.y)),
                       here->position);
    distance = norm(to_lamp);
    direction = make(to_lamp.x / distance, to_lamp.y / distance, to_lamp.z / distance);
    cosine = cosine_at(lamp, direction);
    if (cosine > 0 && intersect(add(here->position, scale(here->normal, 1e-4f)), direction).wall == lamp) {
        const float transmittance = expf(-extinction * distance);
        const float both =
            chosen * emitter_density(lamp, distance, cosine) + density_of(ways, direction) * transmittance;
        const rgb fluence = times(lamp->radiance, grey(transmittance / both));
        branch* at = &w->now.at;
        brought = times(evaluate(ways->f, direction), fluence);
        if (mean(fluence) >= at->light_fluence) {
            at->to_light = direction;
            at->light_distance = distance;
        }
        at->light_fluence += mean(fluence);
        at->connected = plus(at->connected, brought);
        gather(w, brought);
    }
    learned(wend_lights_record(w->d->lights, here, light, mean(brought) * chosen, &record, &error), &error);
    w->told->lights = room(w->told->lights, w->told->light_count, &w->told->light_capacity, sizeof record);
    w->told->lights[w->told->light_count++] = record;
}

static int draw(walk* w, const directions* ways, const wend_light_receiver* here, vec3 position) {
    const float u = uniform(w->random);
    drawn s;
    if (!draw_direction(ways, u, uniform2(w->random), &s)) {
        return 0;
    }
    /* The weight is the scattering function over the density that was used, so no field can bias the picture. */
    w->now.throughput = times(w->now.throughput, s.weight);
    keep_vertex(w, here->position, &s, ways->f->in_volume);
    w->now.ratio *= s.ratio;
    w->now.origin = position;
    w->now.direction = s.direction;
    w->now.last = *here;
    w->now.density = s.density;
    return 1;
}

static int survives(walk* w, int in_volume) {
    wend_walk_state at;
    float survival;
    wend_error error;
    memcpy(at.throughput, w->now.throughput.c, sizeof at.throughput);
    at.density_ratio = w->now.ratio;
    at.index_scale = 1;
    at.depth = w->now.depth;
    at.is_judged_elsewhere = 0;
    at.in_volume = in_volume;
    learned(w->d->guided ? wend_survival_after_direction(&w->d->survival, &at, &survival, &error)
                         : wend_roulette_survival(&w->d->roulette, &at, &survival, &error),
            &error);
    if (uniform(w->random) >= survival) {
        return 0;
    }
    weigh(w, grey(1 / survival));
    return 1;
}

/* How many directions to draw; judged_by_weight where that is not decided before. */
static wend_continuations continuations_at(walk* w, const directions* ways) {
    wend_expected_contribution contribution;
    wend_continuations c = {1, 1, 1, 0};
    wend_error error;
    if (!w->d->guided) {
        return c;
    }
    contribution.ratio = ways->known && w->expected > 0
                             ? mean(times(times(w->now.throughput, ways->f->albedo), ways->in_scattered)) / w->expected
                             : -1;
    contribution.weight = mean(w->now.throughput);
    contribution.split_capacity = (int)(64 / w->now.copies) + 1;
    learned(wend_survival_before_direction(&w->d->survival, &contribution, 0, &c, &error), &error);
    if (c.uses_number) {
        learned(wend_survival_before_direction(&w->d->survival, &contribution, uniform_double(w->random), &c, &error),
                &error);
    }
    return c;
}

/* Connects to a lamp, decides how many directions to draw, and leaves all but one of them pending. */
static int scatter(walk* w, const scatterer* f, const wend_light_receiver* here, vec3 position) {
    directions ways;
    wend_continuations continuations;
    float expected;
    int i;
    ++w->now.depth;
    directions_at(w->d, position, f, mean(w->now.throughput), &ways);
    connect(w, &ways, here);
    continuations = continuations_at(w, &ways);
    if (continuations.judged_by_weight) {
        return draw(w, &ways, here, position) && survives(w, f->in_volume);
    }
    expected = (float)continuations.expected;
    weigh(w, grey(1 / expected));
    w->now.ratio *= expected;
    w->now.copies *= fmaxf(1.0f, expected);
    for (i = 1; i < continuations.copies; ++i) {
        const state before = w->now;
        if (draw(w, &ways, here, position)) {
            w->pending = room(w->pending, w->pending_count, &w->pending_capacity, sizeof *w->pending);
            w->pending[w->pending_count++] = w->now;
        }
        w->now = before;
    }
    return continuations.copies > 0 && draw(w, &ways, here, position);
}

/* To the next collision or surface; 0 where the branch ends. */
static int fly(walk* w) {
    const hit h = intersect(w->now.origin, w->now.direction);
    wend_flight_start start;
    wend_flight flight;
    wend_light_receiver here;
    scatterer f;
    rgb light, weight;
    float u;
    wend_error error;
    if (!h.wall) {
        return 0; /* out through an edge, where rounding leaves a gap */
    }
    light = met(w, &h);
    start.origin = w->now.origin;
    start.direction = w->now.direction;
    start.length = h.distance;
    memcpy(start.throughput, w->now.throughput.c, sizeof start.throughput);
    start.weight = mean(w->now.throughput);
    start.end.kind = WEND_END_SURFACE;
    start.end.position = add(w->now.origin, scale(w->now.direction, h.distance));
    start.end.normal = h.normal;
    start.end.emitted = mean(light);
    u = uniform(w->random);
    /* These rays are cheap, and a guided flight costs five of them. The first flights are worth it. */
    learned(w->d->guided && w->now.depth < 2
                ? wend_flight_guided(w->d->fields[0], w->d->fields[1], &w->d->flights, &fog, &start, u, &flight, &error)
                : wend_flight_classical(&fog, &start, u, &flight, &error),
            &error);
    memcpy(weight.c, flight.weight, sizeof weight.c);
    weigh(w, weight);
    w->now.ratio *= flight.density_ratio;
    meet(w, flight.scatters ? flight.distance : h.distance);
    if (flight.scatters) {
        here.position = add(w->now.origin, scale(w->now.direction, flight.distance));
        here.normal = make(0, 0, 0);
        f.in_volume = 1;
        f.albedo = grey(1); /* absorption is the flight's matter */
        f.axis = w->now.direction;
        return scatter(w, &f, &here, here.position);
    }
    gather(w, light);
    if (h.wall->lamp >= 0) {
        return 0;
    }
    w->now.at.normal = h.normal;
    here.position = start.end.position;
    here.normal = h.normal;
    f.in_volume = 0;
    f.albedo = h.wall->albedo;
    f.axis = h.normal;
    return scatter(w, &f, &here, add(here.position, scale(h.normal, 1e-4f)));
}

/* One walk from the camera, with all its branches. */
static rgb run(walk* w, vec3 origin, vec3 direction) {
    memset(&w->now, 0, sizeof w->now);
    w->now.origin = origin;
    w->now.direction = direction;
    w->now.throughput = grey(1);
    w->now.ratio = w->now.copies = 1;
    w->now.at = after_vertex(-1);
    w->radiance = grey(0);
    w->count = w->pending_count = 0;
    for (;;) {
        while (fly(w)) {
        }
        if (w->pending_count == 0) {
            return w->radiance;
        }
        w->now = w->pending[--w->pending_count];
    }
}

/* Makes records of a walk's vertices: of 64 at most, evenly. */
static void tell(const walk* w) {
    const size_t stride = w->count <= 64 ? 1 : (w->count - 1) / 64 + 1;
    wend_record* records = malloc((w->count + 1) * sizeof *records);
    wend_scatter_record* scattered = malloc((w->count + 1) * sizeof *scattered);
    wend_error error;
    size_t i;
    if (!records || !scattered) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    learned(wend_records_of_path(w->path, w->count, records, &error), &error);
    learned(wend_scatter_records_of_path(w->path, w->count, scattered, &error), &error);
    for (i = 0; i < w->count; i += stride) {
        told* t = w->told;
        const int v = w->in_volume[i];
        t->records[v] = room(t->records[v], t->count[v], &t->records_capacity[v], sizeof *records);
        t->scattered[v] = room(t->scattered[v], t->count[v], &t->scattered_capacity[v], sizeof *scattered);
        t->records[v][t->count[v]] = records[i];
        t->scattered[v][t->count[v]++] = scattered[i];
    }
    free(records);
    free(scattered);
}

/* ---- 3. Render in passes ---- */

/* Of the pixels, or of their squares. */
static double average(const rooms_picture* picture, int squared) {
    double total = 0;
    int i;
    for (i = 0; i < rooms_pixels; ++i) {
        rgb pixel;
        double value;
        memcpy(pixel.c, picture->mean[i], sizeof pixel.c);
        value = (double)mean(pixel);
        total += squared ? value * value : value;
    }
    return total / rooms_pixels;
}
double rooms_mean(const rooms_picture* picture) {
    return average(picture, 0);
}
double rooms_variance(const rooms_picture* picture) {
    double squares = 0;
    int row;
    for (row = 0; row < rooms_height; ++row) {
        squares += picture->squares[row];
    }
    return squares / (picture->samples * rooms_width * rooms_height) - average(picture, 1);
}

static vec3 camera_direction(float x, float y) {
    const vec3 forward = normalize(make(0.67f, -0.08f, -0.74f)), right = normalize(cross(forward, make(0, 1, 0)));
    return normalize(add(add(forward, scale(right, 1.6f * (x / rooms_width - 0.5f))),
                         scale(cross(forward, right), 0.9f * (y / rooms_height - 0.5f))));
}

/* Adds samples to every pixel. A random number depends on pixel and sample. */
static void render(const decisions* d, const float* expected, int count, rooms_picture* picture, told* t) {
    walk w;
    int i, sample, c;
    memset(&w, 0, sizeof w);
    w.d = d;
    w.told = t;
    for (i = 0; i < rooms_pixels; ++i) {
        for (sample = picture->samples; sample < picture->samples + count; ++sample) {
            generator random = generator_of((uint64_t)i, (uint64_t)(picture->first + sample));
            const float x = (float)(i % rooms_width) + uniform(&random);
            const float y = (float)(i / rooms_width) + uniform(&random);
            rgb radiance;
            double value;
            w.random = &random;
            w.expected = expected[i];
            radiance = run(&w, make(0.4f, 1.3f, 3.6f), camera_direction(x, y));
            for (c = 0; c < 3; ++c) {
                picture->mean[i][c] += (radiance.c[c] - picture->mean[i][c]) * (1 / (float)(sample + 1));
            }
            value = (double)mean(radiance);
            picture->squares[i / rooms_width] += value * value;
            tell(&w);
        }
    }
    picture->samples += count;
    free(w.pending);
    free(w.path);
    free(w.in_volume);
}

/* ---- 4. Learn between passes ---- */

/* Surfaces and volumes have a field each: what they see differs. */
static void learn(decisions* d, told* t) {
    const double decay = wend_fit_settings_default().decay;
    wend_error error;
    int v;
    for (v = 0; v < 2; ++v) {
        wend_field *fitted, *next;
        learned(wend_field_fit(d->fields[v], t->records[v], t->count[v], NULL, 0, &fitted, NULL, &error), &error);
        learned(wend_field_fit_scattered(fitted, t->scattered[v], t->count[v], decay, 0, &next, &error), &error);
        wend_field_destroy(d->fields[v]);
        wend_field_destroy(fitted);
        d->fields[v] = next;
        t->count[v] = 0;
    }
    learned(wend_lights_add(d->lights, t->lights, t->light_count, &error), &error);
    learned(wend_lights_learn(d->lights, by_power, NULL, 0, &error), &error);
    t->light_count = 0;
}

/* What pixels will be is known from the passes, too, and how noisy their samples are. */
static void expect(const rooms_picture* training, float* expected, wend_survival_settings* survival) {
    wend_error error;
    learned(wend_pixel_estimates(training->mean[0], rooms_width, rooms_height, training->samples, expected, &error),
            &error);
    if (training->samples > 1) {
        survival->sample_variance = rooms_variance(training) / (rooms_mean(training) * rooms_mean(training));
    }
}

void rooms_render(int samples, int passes, rooms_picture* classical, rooms_picture* guided) {
    float expected[rooms_pixels] = {0};
    rooms_picture* training = calloc(1, sizeof *training);
    decisions d;
    told t;
    wend_error error;
    int pass, v;
    if (!training) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    memset(&d, 0, sizeof d);
    memset(&t, 0, sizeof t);
    memset(classical, 0, sizeof *classical);
    memset(guided, 0, sizeof *guided);
    for (v = 0; v < 2; ++v) {
        learned(wend_field_create(bounds, &d.fields[v], &error), &error);
    }
    learned(wend_lobes_cosine(&d.lobes[0], &error), &error);
    learned(wend_lobes_phase(fog.phase, 1, &d.lobes[1], &error), &error);
    learned(wend_lights_create(bounds, lamp_count, &d.lights, &error), &error);
    d.roulette = wend_roulette_unguided();
    d.flights.classical_share = 0.3f;
    d.flights.guiding = WEND_GUIDE_SCATTERING_AND_DISTANCE;
    d.survival.roulette = d.survival.splitting = 1;
    d.survival.sample_variance = 1;

    training->first = samples;
    guided->first = samples + (1 << passes);
    render(&d, expected, samples, classical, &t);
    t.count[0] = t.count[1] = t.light_count = 0; /* of a classical picture nothing is learned here */
    d.guided = 1;
    for (pass = 0; pass < passes; ++pass) {
        render(&d, expected, 1 << pass, training, &t);
        learn(&d, &t);
        expect(training, expected, &d.survival);
    }
    render(&d, expected, samples, guided, &t);

    for (v = 0; v < 2; ++v) {
        wend_field_destroy(d.fields[v]);
        free(t.records[v]);
        free(t.scattered[v]);
    }
    wend_lights_destroy(d.lights);
    free(t.lights);
    free(training);
}
