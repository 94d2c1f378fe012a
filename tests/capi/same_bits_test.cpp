// Every decision of the interface for C is the C++ library's, bit for bit.
#include <tests/capi/support.h>

#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/decision/guided_distance.h>
#include <wend/decision/learned_lights.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/guide/field.h>
#include <wend/guide/fit.h>
#include <wend/guide/path_log.h>
#include <wend/guide/scatter_fit.h>
#include <wend/sampling/warp.h>
#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/subsurface/technique_mixes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace wend::capi {
namespace {

wend_vec3 from(const Vec3& v) {
    return {v.x, v.y, v.z};
}
Rgb rgb(const float (&c)[3]) {
    return {c[0], c[1], c[2]};
}
void copy(const Rgb& colour, float (&c)[3]) {
    for (int i = 0; i < 3; ++i) {
        c[i] = colour[i];
    }
}

/// From 1e-3 to 1e3, each order of magnitude alike.
float any_size(Pcg32& random) {
    return std::pow(10.0f, 6 * random.uniform() - 3);
}
bool coin(Pcg32& random) {
    return random.uniform() < 0.5f;
}
Vec3 any_direction(Pcg32& random) {
    return to_sphere(random.uniform2());
}
Vec3 any_position(Pcg32& random) {
    const Vec2 xy = random.uniform2();
    return {xy.x, xy.y, random.uniform()};
}
Rgb any_colour(Pcg32& random) {
    const Vec2 rg = random.uniform2();
    return {rg.x, rg.y, random.uniform()};
}

// ---- Survival ----

wend_walk_state any_state(Pcg32& random) {
    wend_walk_state state{};
    copy(any_colour(random) * any_size(random), state.throughput);
    state.density_ratio = coin(random) ? 1.0f : any_size(random);
    state.index_scale = coin(random) ? 1.0f : 2.25f;
    state.depth = static_cast<int>(5 * random.uniform());
    state.is_judged_elsewhere = coin(random) ? 1 : 0;
    state.in_volume = coin(random) ? 1 : 0;
    return state;
}
WalkState state_of(const wend_walk_state& s) {
    return {rgb(s.throughput), s.density_ratio, s.index_scale, s.depth, s.is_judged_elsewhere != 0, s.in_volume != 0};
}

TEST(CSameBits, SurvivalBeforeAndAfterDirections) {
    Pcg32 random(1);
    int split = 0, ended = 0, judged = 0;
    for (int i = 0; i < 20000; ++i) {
        const wend_survival_settings settings{coin(random), coin(random), coin(random) ? any_size(random) : inf};
        const AdjointRouletteSplitting decision(settings.roulette != 0, settings.splitting != 0,
                                                settings.sample_variance);
        const wend_expected_contribution c{coin(random) ? any_size(random) : -1.0f, any_size(random),
                                           1 + static_cast<int>(80 * random.uniform())};
        const ExpectedContribution expected{c.ratio >= 0 ? std::optional(c.ratio) : std::nullopt, c.weight,
                                            c.split_capacity};
        // The same numbers by a generator; a second one tells whether one was drawn.
        const std::uint64_t key = hash_of(i);
        Pcg32 same(key), fresh(key), first(key);
        const auto outcome = decision.before_direction(expected, same);
        const double u = first.uniform_double();
        const bool drawn = same.next() != fresh.next();
        wend_continuations continuations;
        ASSERT_EQ(wend_survival_before_direction(&settings, &c, u, &continuations, nullptr), WEND_OK);
        ASSERT_EQ(continuations.judged_by_weight, outcome ? 0 : 1);
        ASSERT_EQ(continuations.copies, outcome ? outcome->copies : 1);
        ASSERT_EQ(continuations.expected, outcome ? outcome->expected : 1);
        ASSERT_EQ(continuations.uses_number, drawn ? 1 : 0);
        split += continuations.copies > 1 ? 1 : 0;
        ended += continuations.copies == 0 ? 1 : 0;
        judged += continuations.judged_by_weight;
        const wend_walk_state state = any_state(random);
        float probability;
        ASSERT_EQ(wend_survival_after_direction(&settings, &state, &probability, nullptr), WEND_OK);
        ASSERT_EQ(probability, decision.after_direction(state_of(state)));
    }
    EXPECT_GT(split, 1000);
    EXPECT_GT(ended, 500);
    EXPECT_GT(judged, 1000);
}

TEST(CSameBits, ClassicalRouletteAndShares) {
    Pcg32 random(2);
    float probability, share;
    for (int i = 0; i < 2000; ++i) {
        const wend_roulette roulette{random.uniform() + 1e-3f > 1 ? 1.0f : random.uniform() * 0.9f + 0.05f,
                                     coin(random)};
        const wend_walk_state state = any_state(random);
        const WalkState same = state_of(state);
        ASSERT_EQ(wend_roulette_survival(&roulette, &state, &probability, nullptr), WEND_OK);
        ASSERT_EQ(probability,
                  ClassicalRoulette(roulette.ends_below, roulette.media_absorb != 0).after_direction(same));
        const wend_roulette unguided = wend_roulette_unguided(), guided = wend_roulette_guided();
        ASSERT_EQ(wend_roulette_survival(&unguided, &state, &probability, nullptr), WEND_OK);
        ASSERT_EQ(probability, unguided_walks_end.after_direction(same));
        ASSERT_EQ(wend_roulette_survival(&guided, &state, &probability, nullptr), WEND_OK);
        ASSERT_EQ(probability, guided_walks_end.after_direction(same));
        const float weight = any_size(random);
        ASSERT_EQ(wend_least_classical_share(weight, &share, nullptr), WEND_OK);
        ASSERT_EQ(share, least_defensive_fraction(weight));
    }
}

TEST(CSameBits, PixelEstimates) {
    Pcg32 random(3);
    for (const int samples : {1, 10, 1000}) {
        Image picture(23, 17);
        std::vector<float> rgb;
        for (Rgb& pixel : picture.pixels) {
            pixel = any_colour(random) * any_size(random);
            rgb.insert(rgb.end(), {pixel.r, pixel.g, pixel.b});
        }
        std::vector<float> estimates(picture.pixels.size());
        ASSERT_EQ(wend_pixel_estimates(rgb.data(), 23, 17, samples, estimates.data(), nullptr), WEND_OK);
        EXPECT_EQ(estimates, pixel_estimates(picture, samples));
    }
}

// ---- Lights ----

/// By the distance to lights along the x axis, as a first choice that knows where they are.
struct ByDistance {
    std::size_t count;

    std::vector<float> all(const Vec3& position) const {
        std::vector<float> probabilities;
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const float distance = position.x - static_cast<float>(i) / static_cast<float>(count);
            probabilities.push_back(1 / (0.1f + distance * distance));
            sum += probabilities.back();
        }
        for (float& p : probabilities) {
            p /= sum;
        }
        return probabilities;
    }
    float probability(const LightReceiver& receiver, int light) const {
        return all(receiver.position)[static_cast<std::size_t>(light)];
    }
    ChosenLight sample(const LightReceiver& receiver, float u) const {
        const std::vector<float> probabilities = all(receiver.position);
        std::size_t i = 0;
        while (i + 1 < count && u >= probabilities[i]) {
            u -= probabilities[i++];
        }
        return {static_cast<int>(i), probabilities[i]};
    }
};

TEST(CSameBits, LearnedLights) {
    constexpr std::size_t count = 5;
    const ByDistance first{count};
    LearnedLights lights(Box3(Vec3(0, 0, 0), Vec3(1, 1, 1)), count);
    wend_lights* made = nullptr;
    ASSERT_EQ(wend_lights_create(unit_cube, count, &made, nullptr), WEND_OK);
    const LightsPointer owner(made);
    Pcg32 random(4);
    int learned = 0;
    for (int pass = 0; pass < 3; ++pass) {
        std::vector<LightRecord> records;
        std::vector<wend_light_record> c_records;
        for (int i = 0; i < 20000; ++i) {
            const bool in_volume = coin(random);
            const LightReceiver receiver{any_position(random), in_volume ? Vec3(0, 0, 0) : any_direction(random)};
            const wend_light_receiver c_receiver{from(receiver.position), from(receiver.normal)};
            const std::vector<float> probabilities = first.all(receiver.position);
            const float u = random.uniform();
            const ChosenLight chosen = lights.sample(first, receiver, u);
            int light;
            float probability;
            ASSERT_EQ(wend_lights_sample(made, &c_receiver, probabilities.data(), u, &light, &probability, nullptr),
                      WEND_OK);
            ASSERT_EQ(light, chosen.index);
            ASSERT_EQ(probability, chosen.probability);
            learned += probability != probabilities[static_cast<std::size_t>(light)] ? 1 : 0;
            const auto asked = static_cast<int>(count * random.uniform());
            ASSERT_EQ(wend_lights_probability(made, &c_receiver, asked, probabilities[static_cast<std::size_t>(asked)],
                                              &probability, nullptr),
                      WEND_OK);
            ASSERT_EQ(probability, lights.probability(first, receiver, asked));
            // One is always in the dark; some connections are not numbers.
            const float brought = i % 97 == 0 ? nan : (light == 1 ? 0 : random.uniform());
            records.push_back(lights.record(receiver, light, brought));
            c_records.emplace_back();
            ASSERT_EQ(wend_lights_record(made, &c_receiver, light, brought, &c_records.back(), nullptr), WEND_OK);
        }
        lights.add(records);
        ASSERT_EQ(wend_lights_add(made, c_records.data(), c_records.size(), nullptr), WEND_OK);
        lights.learn([&](const LightReceiver& r, int light) { return first.probability(r, light); }, 2);
        const auto ask = [](void* user, const wend_light_receiver* r, int light) {
            const Vec3 position(r->position.x, r->position.y, r->position.z);
            return static_cast<const ByDistance*>(user)->probability({position}, light);
        };
        ByDistance user = first;
        ASSERT_EQ(wend_lights_learn(made, ask, &user, pass, nullptr), WEND_OK);
    }
    EXPECT_GT(learned, 1000);
}

TEST(CSameBits, NoLightReachesSomeReceivers) {
    wend_lights* made = nullptr;
    ASSERT_EQ(wend_lights_create(unit_cube, 2, &made, nullptr), WEND_OK);
    const LightsPointer owner(made);
    const wend_light_receiver receiver{inside, {0, 0, 0}};
    const float none[] = {0, 0}, last[] = {0, 0.9999f};
    int light = 7;
    float probability = 7;
    ASSERT_EQ(wend_lights_sample(made, &receiver, none, 0, &light, &probability, nullptr), WEND_OK);
    EXPECT_EQ(light, -1);
    EXPECT_EQ(probability, 0);
    // What is never chosen first is not chosen by the least of numbers, nor by the last.
    for (const float u : {0.0f, 0x1.fffffep-1f}) {
        ASSERT_EQ(wend_lights_sample(made, &receiver, last, u, &light, &probability, nullptr), WEND_OK);
        EXPECT_EQ(light, 1);
    }
}

// ---- Fields, flights and what rays are told ----

/// The same field for C and for C++.
struct Twins {
    FieldPointer c = empty_field();
    guide::Field cpp = guide::Field::empty(Box3(Vec3(0, 0, 0), Vec3(1, 1, 1)));
};

/// Learned from records of a lamp above the cube; of surfaces that look everywhere, or of fog.
Twins learned(std::uint64_t seed, bool in_volume) {
    constexpr int count = 20000;
    Pcg32 random(seed);
    Twins twins;
    guide::Records records;
    guide::ScatterRecords scattered;
    std::vector<wend_record> c_records;
    std::vector<wend_scatter_record> c_scattered;
    for (int i = 0; i < count; ++i) {
        const Vec3 position = any_position(random), w = any_direction(random), normal = any_direction(random);
        const Vec3 to_lamp = Vec3(0.5f, 0.5f, 1.5f) - position;
        const float distance = length(to_lamp), bright = dot(w, to_lamp) / distance > 0.95f ? 10.0f : 0.1f;
        records.push_back({position, w, bright, inv_4pi, 3, 0, 0, 0, Rgb(1, 0.5f, bright)});
        scattered.push_back({position, in_volume ? Vec3(0, 0, 0) : normal, random.uniform(),
                             random.uniform() / (distance * distance), to_lamp / distance, distance});
        const guide::Record& r = records.back();
        const guide::ScatterRecord& s = scattered.back();
        c_records.push_back({from(position), from(w), r.radiance, r.density, r.distance, 0, 0, 0, {1, 0.5f, bright}});
        c_scattered.push_back(
            {from(position), from(s.normal), s.leaving, s.connected, from(s.to_light), s.light_distance});
    }
    c_scattered.push_back({inside, up, -1, nan, up, 1});  // teaches nothing
    twins.cpp = guide::fit_scattered(guide::fit(twins.cpp, records, {}, 1).field, scattered, 0.8, 1);
    wend_field *fitted = nullptr, *next = nullptr;
    EXPECT_EQ(wend_field_fit(twins.c.get(), c_records.data(), c_records.size(), nullptr, 2, &fitted, nullptr, nullptr),
              WEND_OK);
    const FieldPointer owner(fitted);
    EXPECT_EQ(wend_field_fit_scattered(fitted, c_scattered.data(), c_scattered.size(), 0.8, 2, &next, nullptr),
              WEND_OK);
    twins.c.reset(next);
    return twins;
}

wend_medium any_medium(Pcg32& random) {
    wend_medium medium{};
    const bool grey = coin(random);
    copy(grey ? Rgb(any_size(random)) : any_colour(random) * any_size(random), medium.absorption);
    copy(grey ? Rgb(any_size(random)) : any_colour(random) * any_size(random), medium.scattering);
    medium.phase_parts = static_cast<int>(4 * random.uniform());
    for (int i = 0; i < medium.phase_parts; ++i) {
        medium.phase[i] = {any_size(random), 1.8f * random.uniform() - 0.9f};
    }
    return medium;
}
HomogeneousMedium medium_of(const wend_medium& medium) {
    HenyeyGreensteinMixture mixture;
    for (int i = 0; i < medium.phase_parts; ++i) {
        mixture.add(medium.phase[i].weight, medium.phase[i].g);
    }
    PhaseFunction phase;
    if (medium.phase_parts == 1) {
        phase = PhaseFunction(HenyeyGreenstein{medium.phase[0].g});
    } else if (medium.phase_parts > 1) {
        phase = PhaseFunction(mixture);
    }
    return {.absorption = rgb(medium.absorption), .scattering = rgb(medium.scattering), .emission = {}, .phase = phase};
}

wend_flight_start any_start(Pcg32& random) {
    wend_flight_start start{};
    start.origin = from(any_position(random));
    start.direction = from(any_direction(random));
    start.length = coin(random) ? random.uniform() : (coin(random) ? longest_segment : any_size(random));
    copy(any_colour(random), start.throughput);
    start.weight = coin(random) ? random.uniform() : any_size(random);
    start.end.kind = static_cast<int>(3 * random.uniform());
    start.end.position = from(any_position(random));
    start.end.normal = from(any_direction(random));
    start.end.emitted = coin(random) ? 0 : any_size(random);
    return start;
}
FlightStart start_of(const wend_flight_start& s) {
    const auto vector = [](const wend_vec3& v) { return Vec3(v.x, v.y, v.z); };
    return {{vector(s.origin), vector(s.direction)},
            s.length,
            rgb(s.throughput),
            s.weight,
            {static_cast<FlightEnd::Kind>(s.end.kind), vector(s.end.position), vector(s.end.normal), s.end.emitted}};
}

void expect_same(const wend_flight& c, const Flight& cpp) {
    EXPECT_EQ(c.scatters, cpp.scatters ? 1 : 0);
    EXPECT_EQ(c.distance, cpp.distance);
    EXPECT_EQ(rgb(c.weight), cpp.weight);
    EXPECT_EQ(c.density_ratio, cpp.density_ratio);
}

/// Draws flights by both, and returns how many of them were guided.
int expect_same_flights(const Twins& surface, const Twins& volume, int flights) {
    Pcg32 random(5);
    int guided = 0;
    for (int i = 0; i < flights; ++i) {
        const wend_medium c_medium = any_medium(random);
        const HomogeneousMedium medium = medium_of(c_medium);
        const wend_flight_start start = any_start(random);
        const wend_flight_settings settings{0.05f + 0.9f * random.uniform(), coin(random)};
        const GuidedDistance<guide::Field> decision(&surface.cpp, &volume.cpp, settings.classical_share,
                                                    settings.guiding == WEND_GUIDE_SCATTERING
                                                        ? DistanceGuiding::scatter_alone
                                                        : DistanceGuiding::scatter_and_distance);
        const float u = random.uniform();
        wend_flight flight;
        EXPECT_EQ(
            wend_flight_guided(surface.c.get(), volume.c.get(), &settings, &c_medium, &start, u, &flight, nullptr),
            WEND_OK);
        expect_same(flight, decision.sample(medium, start_of(start), u, random));
        guided += flight.density_ratio != 1 ? 1 : 0;
        EXPECT_EQ(wend_flight_classical(&c_medium, &start, u, &flight, nullptr), WEND_OK);
        expect_same(flight, ClassicalDistance().sample(medium, start_of(start), u, random));
        int looks;
        EXPECT_EQ(wend_flight_looks_ahead(&c_medium, &start, &looks, nullptr), WEND_OK);
        // The interface in C does not say of which fields.
        EXPECT_EQ(looks, decision.can_be_guided(medium, start_of(start)) ? 1 : 0);
        EXPECT_LE(decision.looks_ahead(medium, start_of(start)) ? 1 : 0, looks);
        float passed[3];
        EXPECT_EQ(wend_flight_pass_probability(&c_medium, start.length, passed, nullptr), WEND_OK);
        EXPECT_EQ(rgb(passed), decision.pass_probability(medium, start_of(start).ray, start.length));
    }
    return guided;
}

TEST(CSameBits, Flights) {
    EXPECT_EQ(expect_same_flights(Twins(), Twins(), 1000), 0);
    EXPECT_GT(expect_same_flights(learned(6, false), learned(7, true), 10000), 2000);
}

TEST(CSameBits, FieldsWithScatteredLight) {
    for (const bool in_volume : {false, true}) {
        const Twins twins = learned(8, in_volume);
        const std::vector<char> bytes = bytes_of(twins.c.get());
        EXPECT_EQ(std::string(bytes.begin(), bytes.end()), guide::to_bytes(twins.cpp));
    }
}

TEST(CSameBits, CellsAlongRays) {
    const Twins twins = learned(9, true);
    ASSERT_GT(twins.cpp.size(), 4u);
    Pcg32 random(10);
    std::size_t most = 0;
    for (int i = 0; i < 1000; ++i) {
        const Ray ray{any_position(random), any_direction(random)};
        const float t0 = coin(random) ? 0 : 0.2f * random.uniform(), t1 = t0 + 0.1f + random.uniform();
        const float finest = coin(random) ? 0 : 0.5f * random.uniform();
        std::vector<wend_ray_cell> cells(100);
        std::size_t count = 0, found = 0;
        const auto ask = [&](wend_ray_cell* place, std::size_t capacity) {
            return wend_field_cells_along_ray(twins.c.get(), from(ray.origin), from(ray.direction), t0, t1, finest,
                                              place, capacity, &count, nullptr);
        };
        ASSERT_EQ(ask(nullptr, 0), WEND_OK);
        ASSERT_LE(count, cells.size());
        ASSERT_EQ(ask(cells.data(), count), WEND_OK);
        const auto visit = [&](const guide::ScatteredLight& light, float t_in, float t_out) {
            const wend_ray_cell& cell = cells[found++];
            EXPECT_EQ(cell.t_in, t_in);
            EXPECT_EQ(cell.t_out, t_out);
            EXPECT_EQ(cell.walked.fluence, light.walked.fluence);
            EXPECT_EQ(cell.walked.mean.x, light.walked.mean.x);
            EXPECT_EQ(cell.connected.fluence, light.connected.fluence);
            EXPECT_EQ(cell.connected.mean.z, light.connected.mean.z);
            EXPECT_EQ(cell.near_light.position.y, light.near.position.y);
            EXPECT_EQ(cell.near_light.extent_squared, light.near.extent_squared);
            EXPECT_EQ(cell.near_light.intensity, light.near.intensity);
            EXPECT_EQ(cell.near_light.share, light.near.share);
            EXPECT_EQ(cell.confidence, light.confidence);
            return true;
        };
        twins.cpp.walk(ray, t0, t1, visit, finest);
        ASSERT_EQ(found, count);
        most = std::max(most, count);
        if (count > 1) {
            const wend_ray_cell second = cells[1];
            cells.assign(2, wend_ray_cell{});
            ASSERT_EQ(ask(cells.data(), 1), WEND_BUFFER_TOO_SMALL);
            EXPECT_EQ(count, found);
            EXPECT_EQ(cells[0].t_out, second.t_in);
            EXPECT_EQ(cells[1].t_out, 0);
        }
    }
    EXPECT_GT(most, 3u);
}

TEST(CSameBits, LightThatLeaves) {
    const Twins twins = learned(11, false);
    Pcg32 random(12);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 position = any_position(random), normal = any_direction(random);
        float radiance;
        ASSERT_EQ(wend_field_leaving(twins.c.get(), from(position), from(normal), &radiance, nullptr), WEND_OK);
        ASSERT_EQ(radiance, twins.cpp.leaving(position, normal));
    }
}

TEST(CSameBits, RecordsOfScatteredLight) {
    Pcg32 random(13);
    guide::PathLog log;
    log.start();
    for (int i = 0; i < 50; ++i) {
        const bool on_surface = coin(random);
        log.weigh(any_colour(random));
        log.meet(any_size(random));
        if (coin(random)) {
            log.connect(any_direction(random), any_size(random), any_size(random), any_colour(random));
        }
        if (on_surface) {
            log.face(any_direction(random));
        }
        log.gather(any_colour(random));
        log.scatter(any_position(random), any_direction(random), any_size(random), any_colour(random), !on_surface);
        if (i % 7 == 3) {
            log.resume(log.branch());
        }
    }
    std::vector<wend_path_vertex> path;
    for (const guide::PathVertex& v : log.vertices()) {
        wend_path_vertex c{};
        c.position = from(v.position);
        c.direction = from(v.direction);
        c.density = v.density;
        c.distance = v.distance;
        copy(v.arrival, c.arrival);
        copy(v.scattering, c.scattering);
        copy(v.gathered, c.gathered);
        c.parent = v.parent;
        copy(v.connected, c.connected);
        c.light_fluence = v.light_fluence;
        c.to_light = from(v.to_light);
        c.light_distance = v.light_distance;
        c.normal = from(v.normal);
        path.push_back(c);
    }
    std::vector<wend_scatter_record> records(path.size());
    ASSERT_EQ(wend_scatter_records_of_path(path.data(), path.size(), records.data(), nullptr), WEND_OK);
    guide::PathRecords same;
    same.add(log.vertices());
    std::size_t surface = 0, volume = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const guide::ScatterRecord& r =
            log.vertices()[i].in_volume ? same.volume_scattered()[volume++] : same.surface_scattered()[surface++];
        EXPECT_EQ(records[i].position.x, r.position.x);
        EXPECT_EQ(records[i].normal.y, r.normal.y);
        EXPECT_EQ(records[i].leaving, r.leaving);
        EXPECT_EQ(records[i].connected, r.connected);
        EXPECT_EQ(records[i].to_light.z, r.to_light.z);
        EXPECT_EQ(records[i].light_distance, r.light_distance);
    }
}

// ---- Walks inside dense media ----

/// One walk out of a half-space below z = 0, by both, which must not differ in any number.
/// Lamps of C, and the same for C++.
struct SameLamps {
    std::array<BoundaryEmitter, 2> lamps;
    wend_interior_lamps* made = nullptr;

    SameLamps() {
        const wend_interior_lamp seen[] = {{from(normalize(Vec3(1, 0, 2))), 200, 0.9f, 3},
                                           {from(normalize(Vec3(-1, 1, 1))), 20, 0.5f, 0.5f}};
        for (std::size_t i = 0; i < lamps.size(); ++i) {
            const wend_interior_lamp& lamp = seen[i];
            lamps[i] = {{Vec3(lamp.direction.x, lamp.direction.y, lamp.direction.z), lamp.concentration},
                        lamp.cosine,
                        lamp.fluence,
                        vmf_peak(lamp.concentration)};
        }
        EXPECT_EQ(wend_interior_lamps_create(seen, 2, &made, nullptr), WEND_OK);
    }
    ~SameLamps() { wend_interior_lamps_destroy(made); }
    SameLamps(const SameLamps&) = delete;
    SameLamps& operator=(const SameLamps&) = delete;
};

void expect_same_aim(wend_interior_walk& walk, InteriorWalk& same, const SameLamps& lamps, Pcg32& random) {
    const float depth = random.uniform();
    const Rgb diffuse = any_colour(random);
    float c_diffuse[3];
    copy(diffuse, c_diffuse);
    ASSERT_EQ(wend_interior_aim_lamps(&walk, lamps.made, depth, c_diffuse, nullptr), WEND_OK);
    same.aim(EmitterView{lamps.lamps, depth, diffuse});
}

/// How often it was told where to connect at the boundary.
int expect_same_connections(const wend_interior_walk& walk, const InteriorWalk& same, const Vec3& before,
                            Pcg32& random) {
    const std::uint64_t key = hash_of(static_cast<int>(1e9f * random.uniform()));
    Pcg32 keyed(key);
    const InteriorWalk::Directions directions(same, before, keyed);
    const Vec3 asked = any_direction(random);
    float density, relative[2];
    EXPECT_EQ(wend_interior_lamps_density(&walk, from(before), from(asked), &density, nullptr), WEND_OK);
    EXPECT_EQ(density, directions.emitter_density(asked));
    wend_vec3 direction;
    int found;
    EXPECT_EQ(wend_interior_sample_lamps(&walk, from(before), key, &direction, &found, nullptr), WEND_OK);
    const std::optional<Vec3> w = directions.sample_emitters();
    EXPECT_EQ(found, w ? 1 : 0);
    EXPECT_TRUE(!w || (w->x == direction.x && w->y == direction.y && w->z == direction.z));
    EXPECT_EQ(wend_interior_relative_densities(&walk, relative, nullptr), WEND_OK);
    EXPECT_EQ(relative[0], same.relative_densities()[0]);
    EXPECT_EQ(relative[1], same.relative_densities()[1]);
    return found;
}

void walk_both(const wend_interior_guide* c_guide, const InteriorGuide& guide, const SameLamps& lamps, Pcg32& random,
               int& connected) {
    const Rgb channels = guide.medium.scattering / (3 * mean_value(guide.medium.scattering));
    float c_channels[3];
    copy(channels, c_channels);
    wend_interior_walk walk;
    InteriorWalk same;
    ASSERT_EQ(wend_interior_enter(c_guide, c_channels, &walk, nullptr), WEND_OK);
    same.enter(guide, channels);
    Vec3 before(0, 0, -1), position(0, 0, 0);
    ASSERT_EQ(wend_interior_aim(&walk, up, 1, nullptr), WEND_OK);
    same.aim(Vec3(0, 0, 1));
    expect_same_aim(walk, same, lamps, random);
    ASSERT_EQ(wend_interior_head(&walk, from(before), nullptr), WEND_OK);
    same.head(before);
    Rgb throughput(1);
    for (int i = 0; i < 200; ++i) {
        const float length = before.z > 0 ? position.z / -before.z : longest_segment, u = random.uniform();
        float drawn;
        ASSERT_EQ(wend_interior_draw_distance(&walk, u, &drawn, nullptr), WEND_OK);
        ASSERT_EQ(drawn, same.draw_distance(u));
        wend_interior_flight flight;
        ASSERT_EQ(wend_interior_fly(&walk, std::max(length, 0.0f), drawn, &flight, nullptr), WEND_OK);
        const InteriorFlight flown = same.fly(std::max(length, 0.0f), drawn);
        ASSERT_EQ(flight.scatters, flown.flight.scatters ? 1 : 0);
        ASSERT_EQ(flight.distance, flown.flight.distance);
        ASSERT_EQ(rgb(flight.weight), flown.flight.weight);
        ASSERT_EQ(flight.pass_probability, flown.pass_probability);
        throughput *= flown.flight.weight;
        int turned;
        ASSERT_EQ(wend_interior_has_turned(&walk, &turned, nullptr), WEND_OK);
        ASSERT_EQ(turned, same.has_turned() ? 1 : 0);
        if (!flight.scatters) {
            return;
        }
        position += before * flight.distance;
        if (coin(random)) {
            const Vec3 normal = any_direction(random);
            const float steepness = random.uniform();
            ASSERT_EQ(wend_interior_aim(&walk, from(normal), steepness, nullptr), WEND_OK);
            same.aim(normal, steepness);
            expect_same_aim(walk, same, lamps, random);
        }
        connected += expect_same_connections(walk, same, before, random);
        const std::uint64_t key = hash_of(i);
        Pcg32 keyed(key);
        const InteriorWalk::Directions directions(same, before, keyed);
        // A connection to a light, by copies.
        const Vec3 asked = any_direction(random);
        float density, passed;
        ASSERT_EQ(wend_interior_density(&walk, from(before), from(asked), &density, nullptr), WEND_OK);
        ASSERT_EQ(density, directions.density(asked));
        wend_interior_walk there = walk;
        InteriorWalk same_there = same;
        ASSERT_EQ(wend_interior_turn(&there, from(before), from(asked), nullptr), WEND_OK);
        same_there.turn(directions, asked);
        const float way = random.uniform();
        ASSERT_EQ(wend_interior_pass(&there, way, &passed, nullptr), WEND_OK);
        ASSERT_EQ(passed, same_there.pass(way));
        const float choice = random.uniform();
        const Vec2 square = random.uniform2();
        wend_interior_direction s;
        ASSERT_EQ(wend_interior_sample(&walk, from(before), choice, square.x, square.y, key, &s, nullptr), WEND_OK);
        const auto sampled = directions.sample(choice, square);
        ASSERT_EQ(s.direction.x, sampled->direction.x);
        ASSERT_EQ(s.direction.y, sampled->direction.y);
        ASSERT_EQ(s.direction.z, sampled->direction.z);
        ASSERT_EQ(s.density, sampled->density);
        ASSERT_EQ(Rgb(s.weight), sampled->weight());
        throughput *= sampled->weight();
        ASSERT_EQ(wend_interior_turn(&walk, from(before), s.direction, nullptr), WEND_OK);
        same.turn(directions, sampled->direction);
        before = sampled->direction;
        float survival;
        ASSERT_EQ(wend_interior_survival(&walk, max_value(throughput), &survival, nullptr), WEND_OK);
        ASSERT_EQ(survival, same.survival(max_value(throughput)));
        if (random.uniform() >= survival) {
            return;
        }
        throughput *= 1 / survival;
    }
}

/// Returns how often it was told where to connect at the boundary.
int expect_same_walk(const wend_interior_guide* c_guide, const InteriorGuide& guide, const SameLamps& lamps,
                     Pcg32& random) {
    int connected = 0;
    walk_both(c_guide, guide, lamps, random, connected);
    return connected;
}

TEST(CSameBits, InteriorWalks) {
    const wend_medium media[] = {
        {{2.5f, 5, 10}, {97.5f, 95, 90}, {{1, 0.5f}}, 1},
        {{1, 1, 1}, {9, 9, 9}, {}, 0},
        {{0, 1, 3}, {9, 9, 0}, {{1, 0.9f}, {2, -0.3f}}, 2},
    };
    Pcg32 random(14);
    const SameLamps lamps;
    int connected = 0;
    for (const wend_medium& medium : media) {
        for (const float share : {0.25f, 1.0f}) {
            wend_interior_guide* made = nullptr;
            ASSERT_EQ(wend_interior_guide_create(&medium, share, &made, nullptr), WEND_OK);
            const GuidePointer owner(made);
            const HomogeneousMedium same = medium_of(medium);
            const InteriorGuide guide = interior_guide(same, half_space_modes(same), share);
            wend_interior_guide* lit = nullptr;
            ASSERT_EQ(wend_interior_guide_create_for_lamps(&medium, share, 1, &lit, nullptr), WEND_OK);
            const GuidePointer lit_owner(lit);
            InteriorGuide lit_guide = guide;
            lit_guide.heads_for_emitters = lit_guide.connects_at_boundary = true;
            for (int i = 0; i < 300; ++i) {
                EXPECT_EQ(expect_same_walk(made, guide, lamps, random), 0);
                connected += expect_same_walk(lit, lit_guide, lamps, random);
            }
        }
    }
    EXPECT_GT(connected, 100);
}

/// A walk that found light by a connection and by itself, as C tells it and as C++ does.
struct Found {
    wend_technique_record record;
    InteriorWalkRecord same;
};
Found any_found(Pcg32& random, const wend_technique_mix& mix) {
    Found found;
    const Vec3 entry = any_position(random);
    found.same.entry = entry;
    found.same.guided = !(random.uniform() < mix.unguided_probability);
    EXPECT_EQ(wend_technique_record_begin(from(entry), found.same.guided ? 1 : 0, &found.record, nullptr), WEND_OK);
    found.record.flights = found.same.flights = 1 + static_cast<int>(9 * random.uniform());
    found.record.connected = 1;
    found.same.connected = true;
    // The guide is good where x is small: what it finds varies less.
    const float share = mix.classical_share, light = 1 + (entry.x < 0.5f ? 0.1f : 2.0f) * random.uniform();
    const float classical = 2 * random.uniform(), guided = (1 - share * classical) / std::max(1 - share, 0.01f);
    const float before[] = {classical, std::max(guided, 0.0f)}, now[] = {random.uniform(), before[1]};
    const float part = random.uniform();
    EXPECT_EQ(wend_technique_record_connection(&found.record, light, before, now, part, nullptr), WEND_OK);
    found.same.bring(light, gradient_of_connection({before[0], before[1]}, {now[0], now[1]}, part));
    EXPECT_EQ(wend_technique_record_hit(&found.record, 2 * light, before, now, part, nullptr), WEND_OK);
    found.same.bring(2 * light, gradient_of_hit({before[0], before[1]}, {now[0], now[1]}, part));
    for (std::size_t i = 0; i < 2; ++i) {
        found.record.relative[i] = found.same.relative[i] = now[i];
    }
    return found;
}

TEST(CSameBits, TechniqueMixes) {
    wend_technique_mixes* made = nullptr;
    ASSERT_EQ(wend_technique_mixes_create({{0, 0, 0}, {1, 1, 1}}, 0.25f, &made, nullptr), WEND_OK);
    TechniqueMixes same(Box3(Vec3(0.0f), Vec3(1.0f)), 0.25f);
    Pcg32 random(15);
    float least = 1, most = 0;
    for (int round = 0; round < 5; ++round) {
        std::vector<wend_technique_record> records;
        std::vector<InteriorWalkRecord> walks;
        for (int i = 0; i < 4000; ++i) {
            const Vec3 place = any_position(random);
            wend_technique_mix mix;
            ASSERT_EQ(wend_technique_mixes_at(made, from(place), &mix, nullptr), WEND_OK);
            const TechniqueMix& plan = same.plan(same.cell_at(place));
            ASSERT_EQ(mix.classical_share, plan.defensive_fraction);
            ASSERT_EQ(mix.unguided_probability, plan.unguided_probability);
            ASSERT_EQ(mix.guided.preference, plan.guided.preference);
            ASSERT_EQ(mix.guided.probability, plan.guided.probability);
            ASSERT_EQ(mix.unguided.preference, plan.unguided.preference);
            ASSERT_EQ(mix.unguided.probability, plan.unguided.probability);
            least = std::min(least, mix.classical_share);
            most = std::max(most, mix.classical_share);
            const Found found = any_found(random, mix);
            records.push_back(found.record);
            walks.push_back(found.same);
        }
        ASSERT_EQ(wend_technique_mixes_learn(made, records.data(), records.size(), round == 4 ? 1 : 0, nullptr),
                  WEND_OK);
        same.learn_from(walks, round == 4 ? NextWalks::rendering : NextWalks::beside_classical);
    }
    EXPECT_LT(least, most) << "something was learned";
    wend_technique_mixes_destroy(made);
}

}  // namespace
}  // namespace wend::capi
