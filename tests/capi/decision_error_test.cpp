// Bad input to the decisions of the interface for C.
#include <tests/capi/support.h>

#include <array>
#include <memory>
#include <utility>

namespace wend::capi {
namespace {

/// The value after a change.
template <class Value, class Change>
Value changed(Value value, const Change& change) {
    change(value);
    return value;
}

TEST(CDecisionErrors, SurvivalNeedsNumbersInRange) {
    using S = wend_survival_settings;
    using C = wend_expected_contribution;
    using W = wend_walk_state;
    const S settings{1, 1, 1};
    const C contribution{1, 1, 1};
    const W state{{1, 1, 1}, 1, 1, 1, 0, 0};
    wend_continuations out;
    float p;
    const auto before = [&](const S* s, const C* c, double u, wend_error* e) {
        return wend_survival_before_direction(s, c, u, &out, e);
    };
    const auto with = [&](auto change, wend_error* e) {
        const C c = changed(contribution, change);
        return before(&settings, &c, 0, e);
    };
    const auto after = [&](auto change, wend_error* e) {
        const W w = changed(state, change);
        return wend_survival_after_direction(&settings, &w, &p, e);
    };
    const S noise{1, 1, static_cast<double>(nan)}, negative{1, 1, -1};
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", before(nullptr, &contribution, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", before(&settings, nullptr, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_survival_before_direction(&settings, &contribution, 0, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "variance", before(&noise, &contribution, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "variance", before(&negative, &contribution, 0, e));
    for (const double u : {1.0, -0.1, static_cast<double>(nan)}) {
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)", before(&settings, &contribution, u, e));
    }
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "ratio", with([](C& c) { c.ratio = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", with([](C& c) { c.weight = inf; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", with([](C& c) { c.weight = -1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "capacity", with([](C& c) { c.split_capacity = 0; }, e));
    EXPECT_EQ(with([](C& c) { c.ratio = inf; }, nullptr), WEND_OK);
    EXPECT_EQ(out.copies, 1);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "throughput", after([](W& w) { w.throughput[1] = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "density ratio", after([](W& w) { w.density_ratio = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "index scale", after([](W& w) { w.index_scale = -1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_survival_after_direction(&settings, nullptr, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_survival_after_direction(nullptr, &state, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_survival_after_direction(&settings, &state, nullptr, e));
    const wend_roulette never{0, 0}, roulette = wend_roulette_guided();
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "(0,1]", wend_roulette_survival(&never, &state, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_roulette_survival(nullptr, &state, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_roulette_survival(&roulette, nullptr, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_roulette_survival(&roulette, &state, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", wend_least_classical_share(nan, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_least_classical_share(1, nullptr, e));
}

TEST(CDecisionErrors, PicturesMustBeFinite) {
    std::vector<float> rgb(12, 1), estimates(4, -1);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_pixel_estimates(nullptr, 2, 2, 1, estimates.data(), e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_pixel_estimates(rgb.data(), 2, 2, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "pixels", wend_pixel_estimates(rgb.data(), 0, 2, 1, estimates.data(), e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "pixels", wend_pixel_estimates(rgb.data(), 2, -2, 1, estimates.data(), e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "pixels",
                   wend_pixel_estimates(rgb.data(), 1 << 30, 1 << 30, 1, estimates.data(), e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "sample", wend_pixel_estimates(rgb.data(), 2, 2, 0, estimates.data(), e));
    rgb[7] = nan;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "finite", wend_pixel_estimates(rgb.data(), 2, 2, 1, estimates.data(), e));
    EXPECT_EQ(estimates, std::vector<float>(4, -1));
}

TEST(CDecisionErrors, LightsMustBeThere) {
    wend_lights* made = nullptr;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "1 to 256", wend_lights_create(unit_cube, 0, &made, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "1 to 256", wend_lights_create(unit_cube, 257, &made, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "bounds.max", wend_lights_create({{0, 0, 0}, {1, nan, 1}}, 2, &made, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_create(unit_cube, 2, nullptr, e));
    EXPECT_EQ(made, nullptr);
    wend_lights_destroy(nullptr);
    ASSERT_EQ(wend_lights_create(unit_cube, 2, &made, nullptr), WEND_OK);
    const LightsPointer owner(made);
    const wend_light_receiver here{inside, up}, nowhere{{nan, 0, 0}, up}, skewed{inside, {0, 0, 2}};
    const float first[] = {0.5f, 0.5f}, more[] = {0.5f, 0.6f}, negative[] = {-0.5f, 1.5f}, not_numbers[] = {nan, 0};
    int light;
    float p;
    const auto sample = [&](const wend_light_receiver* r, const float* choice, float u, wend_error* e) {
        return wend_lights_sample(made, r, choice, u, &light, &p, e);
    };
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_sample(nullptr, &here, first, 0, &light, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_sample(made, &here, first, 0, nullptr, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_sample(made, &here, first, 0, &light, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", sample(nullptr, first, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", sample(&here, nullptr, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "position", sample(&nowhere, first, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "normal", sample(&skewed, first, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)", sample(&here, first, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "sum 1", sample(&here, more, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1]", sample(&here, negative, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1]", sample(&here, not_numbers, 0, e));
    for (const int absent : {-1, 2}) {
        wend_light_record record;
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "no light", wend_lights_probability(made, &here, absent, 0.5f, &p, e));
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "no light", wend_lights_record(made, &here, absent, 1, &record, e));
    }
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1]", wend_lights_probability(made, &here, 0, nan, &p, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_probability(made, &here, 0, 0.5f, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_probability(nullptr, &here, 0, 0.5f, &p, e));
}

TEST(CDecisionErrors, LightsLearnFromTheirOwnRecords) {
    wend_lights* made = nullptr;
    ASSERT_EQ(wend_lights_create(unit_cube, 2, &made, nullptr), WEND_OK);
    const LightsPointer owner(made);
    const wend_light_receiver here{inside, up};
    wend_light_record record;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "negative", wend_lights_record(made, &here, 0, -1, &record, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_record(made, &here, 0, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_record(made, nullptr, 0, 1, &record, e));
    ASSERT_EQ(wend_lights_record(made, &here, 0, 1, &record, nullptr), WEND_OK);
    std::vector<wend_light_record> records(20, record);
    const auto add = [&](auto change, wend_error* e) {
        std::vector<wend_light_record> some = records;
        change(some[9]);
        return wend_lights_add(made, some.data(), some.size(), e);
    };
    using R = wend_light_record;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "not made", add([](R& r) { r.cell = 65535; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "not made", add([](R& r) { r.light = 2; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "not made", add([](R& r) { r.brought = -1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_add(made, nullptr, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_add(nullptr, records.data(), 1, e));
    EXPECT_EQ(wend_lights_add(made, nullptr, 0, nullptr), WEND_OK);

    const auto half = [](void*, const wend_light_receiver*, int) { return 0.5f; };
    const auto wrong = [](void*, const wend_light_receiver*, int) { return 1.5f; };
    const auto probability = [&] {
        float p = 0;
        EXPECT_EQ(wend_lights_probability(made, &here, 0, 0.5f, &p, nullptr), WEND_OK);
        return p;
    };
    ASSERT_EQ(wend_lights_learn(made, half, nullptr, 1, nullptr), WEND_OK);
    EXPECT_EQ(probability(), 0.5f);  // none of the records above were added
    ASSERT_EQ(wend_lights_add(made, records.data(), records.size(), nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "answers", wend_lights_learn(made, wrong, nullptr, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_learn(made, nullptr, nullptr, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lights_learn(nullptr, half, nullptr, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "threads", wend_lights_learn(made, half, nullptr, -1, e));
    EXPECT_EQ(probability(), 0.5f);
    ASSERT_EQ(wend_lights_learn(made, half, nullptr, 1, nullptr), WEND_OK);
    EXPECT_GT(probability(), 0.6f);
}

TEST(CDecisionErrors, FlightsNeedMediaAndSegments) {
    using M = wend_medium;
    using S = wend_flight_start;
    using G = wend_flight_settings;
    const FieldPointer field = trained_field();
    const M fog{{1, 1, 1}, {1, 1, 1}, {{1, 0.5f}}, 1};
    const S ahead{inside, up, 1, {1, 1, 1}, 1, {WEND_END_SURFACE, inside, up, 0}};
    const G guiding{0.3f, WEND_GUIDE_SCATTERING};
    wend_flight flight;
    float passed[3];
    int looks;
    const auto fly = [&](const M* m, const S* s, wend_error* e) {
        const wend_status status = wend_flight_classical(m, s, 0, &flight, nullptr);
        EXPECT_EQ(wend_flight_looks_ahead(m, s, &looks, nullptr), status);
        EXPECT_EQ(wend_flight_guided(field.get(), field.get(), &guiding, m, s, 0, &flight, nullptr), status);
        return wend_flight_classical(m, s, 0, &flight, e);
    };
    const auto through = [&](auto change, wend_error* e) {
        const M medium = changed(fog, change);
        return fly(&medium, &ahead, e);
    };
    const auto from = [&](auto change, wend_error* e) {
        const S start = changed(ahead, change);
        return fly(&fog, &start, e);
    };
    const auto guided_by = [&](G settings, wend_error* e) {
        return wend_flight_guided(field.get(), field.get(), &settings, &fog, &ahead, 0, &flight, e);
    };
    EXPECT_EQ(fly(&fog, &ahead, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", fly(nullptr, &ahead, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", fly(&fog, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_flight_classical(&fog, &ahead, 0, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)", wend_flight_classical(&fog, &ahead, 1, &flight, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "absorption", through([](M& m) { m.absorption[0] = -1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "scattering", through([](M& m) { m.scattering[2] = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "sums", through([](M& m) { m.absorption[1] = m.scattering[1] = 3e38f; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "parts", through([](M& m) { m.phase_parts = 5; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "parts", through([](M& m) { m.phase_parts = -1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "mean cosine", through([](M& m) { m.phase[0].g = 1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", through([](M& m) { m.phase[0].weight = 0; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "origin", from([](S& s) { s.origin.x = inf; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction", from([](S& s) { s.direction.x = 1; }, e));
    for (const float length : {-1.0f, inf, nan}) {
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "length", from([=](S& s) { s.length = length; }, e));
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "length", wend_flight_pass_probability(&fog, length, passed, e));
    }
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "throughput", from([](S& s) { s.throughput[0] = -1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", from([](S& s) { s.weight = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "end", from([](S& s) { s.end.kind = 3; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "end", from([](S& s) { s.end.emitted = inf; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "end", from([](S& s) { s.end.position.y = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "end", from([](S& s) { s.end.normal.y = 1; }, e));
    // What does not matter is not looked at.
    EXPECT_EQ(from([](S& s) { s.end = {WEND_END_NOTHING, {nan, 0, 0}, {0, 0, 0}, 0}; }, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "share", guided_by({0, WEND_GUIDE_SCATTERING}, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "share", guided_by({nan, WEND_GUIDE_SCATTERING}, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "guiding", guided_by({0.5f, 2}, e));
    const auto guided = [&](const wend_field* surface, const wend_field* volume, const G* settings, wend_error* e) {
        return wend_flight_guided(surface, volume, settings, &fog, &ahead, 0, &flight, e);
    };
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", guided(nullptr, field.get(), &guiding, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", guided(field.get(), nullptr, &guiding, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", guided(field.get(), field.get(), nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_flight_looks_ahead(&fog, &ahead, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_flight_pass_probability(&fog, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_flight_pass_probability(nullptr, 1, passed, e));
}

TEST(CDecisionErrors, RaysNeedFieldsThatHaveLearned) {
    const FieldPointer field = trained_field(), empty = empty_field();
    std::size_t count = 7;
    float radiance = -1;
    const auto cells = [&](const wend_field* f, wend_vec3 origin, float t0, float t1, float finest, wend_error* e) {
        return wend_field_cells_along_ray(f, origin, up, t0, t1, finest, nullptr, 0, &count, e);
    };
    EXPECT_REFUSED(WEND_NOTHING_LEARNED, "nothing", cells(empty.get(), inside, 0, 1, 0, e));
    EXPECT_REFUSED(WEND_NOTHING_LEARNED, "nothing", wend_field_leaving(empty.get(), inside, up, &radiance, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", cells(nullptr, inside, 0, 1, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "origin", cells(field.get(), {nan, 0, 0}, 0, 1, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "distances", cells(field.get(), inside, 1, 1, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "distances", cells(field.get(), inside, -1, 1, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "distances", cells(field.get(), inside, 0, inf, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "finest", cells(field.get(), inside, 0, 1, nan, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null",
                   wend_field_cells_along_ray(field.get(), inside, up, 0, 1, 0, nullptr, 0, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction",
                   wend_field_cells_along_ray(field.get(), inside, {0, 0, 0}, 0, 1, 0, nullptr, 0, &count, e));
    EXPECT_EQ(count, 7u);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_leaving(nullptr, inside, up, &radiance, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_leaving(field.get(), inside, up, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "position", wend_field_leaving(field.get(), {nan, 0, 0}, up, &radiance, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "normal", wend_field_leaving(field.get(), inside, {0, 0, 0}, &radiance, e));
    EXPECT_EQ(radiance, -1);

    wend_field* next = nullptr;
    const wend_scatter_record record{inside, up, 1, 0, up, 1};
    const auto fit = [&](const wend_field* f, const wend_scatter_record* r, std::size_t n, double decay, int threads,
                         wend_error* e) { return wend_field_fit_scattered(f, r, n, decay, threads, &next, e); };
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", fit(nullptr, &record, 1, 0.5, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", fit(field.get(), nullptr, 1, 0.5, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "2^32", fit(field.get(), &record, 0xffffffffu, 0.5, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "threads", fit(field.get(), &record, 1, 0.5, 1025, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "", fit(field.get(), &record, 1, 1.5, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "", fit(field.get(), &record, 1, static_cast<double>(nan), 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_fit_scattered(field.get(), &record, 1, 0.5, 1, nullptr, e));
    EXPECT_EQ(next, nullptr);
    // A field that knows nothing stays one.
    ASSERT_EQ(fit(empty.get(), &record, 1, 0.5, 1, nullptr), WEND_OK);
    const FieldPointer owner(next);
    EXPECT_EQ(cells(next, inside, 0, 1, 0, nullptr), WEND_NOTHING_LEARNED);
}

TEST(CDecisionErrors, GuidesNeedMediaThatScatter) {
    using M = wend_medium;
    const M wax{{1, 1, 1}, {9, 9, 9}, {{1, 0.5f}}, 1};
    wend_interior_guide* guide = nullptr;
    const auto make = [&](auto change, float share, wend_error* e) {
        const M medium = changed(wax, change);
        return wend_interior_guide_create(&medium, share, &guide, e);
    };
    const auto as_it_is = [](M&) {};
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_guide_create(nullptr, 0.25f, &guide, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_guide_create(&wax, 0.25f, nullptr, e));
    for (const float share : {0.0f, 1.1f, nan}) {
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "(0, 1]", make(as_it_is, share, e));
    }
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "scatter", make([](M& m) { m = {}; }, 0.25f, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "scattering", make([](M& m) { m.scattering[0] = inf; }, 0.25f, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "0.96", make([](M& m) { m.phase[0].g = 0.97f; }, 0.25f, e));
    EXPECT_EQ(guide, nullptr);
    wend_interior_guide_destroy(nullptr);
    // As peaked as may be, and media that do not absorb at all or hardly scatter.
    for (const auto& [absorption, scattering] : {std::pair(0.0f, 1.0f), {1.0f, 1e-6f}, {1e20f, 1e10f}}) {
        for (const float g : {-0.96f, 0.96f}) {
            const M medium{{absorption, 0, 0}, {scattering, 0, scattering}, {{1, g}}, 1};
            ASSERT_EQ(wend_interior_guide_create(&medium, 0.25f, &guide, nullptr), WEND_OK);
            wend_interior_guide_destroy(guide);
        }
    }
}

TEST(CDecisionErrors, LampsAreNumbersOfLamps) {
    const wend_interior_lamp lamp{up, 100, 0.5f, 1};
    wend_interior_lamps* lamps = nullptr;
    const auto make = [&](auto change, wend_error* e) {
        const wend_interior_lamp wrong = changed(lamp, change);
        return wend_interior_lamps_create(&wrong, 1, &lamps, e);
    };
    using L = wend_interior_lamp;
    const std::array<L, 5> many{lamp, lamp, lamp, lamp, lamp};
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "at most 4", wend_interior_lamps_create(many.data(), 5, &lamps, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_lamps_create(nullptr, 1, &lamps, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_lamps_create(&lamp, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction", make([](L& l) { l.direction = {}; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "concentration", make([](L& l) { l.concentration = 2e5f; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "cosine", make([](L& l) { l.cosine = 0; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "fluence", make([](L& l) { l.fluence = nan; }, e));
    EXPECT_EQ(lamps, nullptr);
    wend_interior_lamps_destroy(nullptr);

    const wend_medium wax{{1, 1, 1}, {9, 9, 9}, {{1, 0.5f}}, 1};
    wend_interior_guide* guide = nullptr;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "connects", wend_interior_guide_create_for_lamps(&wax, 0.25f, 2, &guide, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_guide_create_for_lamps(&wax, 0.25f, 1, nullptr, e));
    ASSERT_EQ(wend_interior_guide_create_for_lamps(&wax, 0.25f, 1, &guide, nullptr), WEND_OK);
    const GuidePointer owner(guide);
    ASSERT_EQ(wend_interior_lamps_create(&lamp, 1, &lamps, nullptr), WEND_OK);
    const std::unique_ptr<wend_interior_lamps, Destroy<wend_interior_lamps_destroy>> lamps_owner(lamps);
    const float channels[] = {0.5f, 0.25f, 0.25f}, diffuse[] = {1, 1, 1}, negative[] = {1, -1, 1};
    wend_interior_walk walk;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "share", wend_interior_enter_with(guide, channels, 0, &walk, e));
    ASSERT_EQ(wend_interior_enter_with(guide, channels, 0.5f, &walk, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "aim", wend_interior_aim_lamps(&walk, lamps, 1, diffuse, e));
    ASSERT_EQ(wend_interior_aim(&walk, up, 1, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_aim_lamps(&walk, nullptr, 1, diffuse, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_aim_lamps(&walk, lamps, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "diffuse", wend_interior_aim_lamps(&walk, lamps, 1, negative, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "length", wend_interior_aim_lamps(&walk, lamps, -1, diffuse, e));
    wend_vec3 direction;
    int found;
    float x, relative[2];
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_sample_lamps(&walk, up, 1, &direction, &found, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_relative_densities(&walk, relative, e));
    ASSERT_EQ(wend_interior_head(&walk, up, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_sample_lamps(&walk, up, 1, nullptr, &found, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_sample_lamps(&walk, up, 1, &direction, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_lamps_density(&walk, up, up, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction", wend_interior_lamps_density(&walk, up, {}, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_relative_densities(&walk, nullptr, e));
}

TEST(CDecisionErrors, MixesLearnFromRecordsOfNumbers) {
    wend_technique_mixes* mixes = nullptr;
    const wend_bounds unit{{0, 0, 0}, {1, 1, 1}};
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "share", wend_technique_mixes_create(unit, 0, &mixes, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_technique_mixes_create(unit, 0.25f, nullptr, e));
    ASSERT_EQ(wend_technique_mixes_create(unit, 0.25f, &mixes, nullptr), WEND_OK);
    const std::unique_ptr<wend_technique_mixes, Destroy<wend_technique_mixes_destroy>> owner(mixes);
    wend_technique_mixes_destroy(nullptr);
    wend_technique_mix mix;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "entry", wend_technique_mixes_at(mixes, {nan, 0, 0}, &mix, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_technique_mixes_at(mixes, {0, 0, 0}, nullptr, e));
    wend_technique_record record;
    const float one[] = {1, 1}, wrong[] = {1, nan};
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "guided", wend_technique_record_begin({0, 0, 0}, 2, &record, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "entry", wend_technique_record_begin({inf, 0, 0}, 1, &record, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_technique_record_begin({0, 0, 0}, 1, nullptr, e));
    ASSERT_EQ(wend_technique_record_begin({0, 0, 0}, 1, &record, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "light", wend_technique_record_hit(&record, inf, one, one, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "connections", wend_technique_record_hit(&record, 1, one, one, 2, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "density", wend_technique_record_hit(&record, 1, one, wrong, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_technique_record_connection(&record, 1, one, nullptr, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_technique_record_connection(nullptr, 1, one, one, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_technique_mixes_learn(mixes, nullptr, 1, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "is_last", wend_technique_mixes_learn(mixes, &record, 1, 2, e));
    record.flights = -1;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "flights", wend_technique_mixes_learn(mixes, &record, 1, 0, e));
    EXPECT_EQ(wend_technique_mixes_learn(mixes, nullptr, 0, 0, nullptr), WEND_OK);
}

TEST(CDecisionErrors, InteriorWalksGoStepByStep) {
    const wend_medium wax{{1, 1, 1}, {9, 9, 9}, {{1, 0.5f}}, 1};
    wend_interior_guide* guide = nullptr;
    ASSERT_EQ(wend_interior_guide_create(&wax, 0.25f, &guide, nullptr), WEND_OK);
    const GuidePointer owner(guide);
    const float channels[] = {0.5f, 0.25f, 0.25f}, too_much[] = {1, 1, 0}, negative[] = {-1, 1, 1},
                not_numbers[] = {nan, 0.5f, 0.5f};
    wend_interior_walk walk;
    std::memset(&walk, 0, sizeof walk);
    wend_interior_flight flight;
    wend_interior_direction direction;
    float x;
    int turned;
    const auto sample = [&](wend_vec3 before, float choice, float u, float v, wend_error* e) {
        return wend_interior_sample(&walk, before, choice, u, v, 1, &direction, e);
    };
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "enter", wend_interior_aim(&walk, up, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "enter", wend_interior_has_turned(&walk, &turned, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_enter(nullptr, channels, &walk, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_enter(guide, nullptr, &walk, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_enter(guide, channels, nullptr, e));
    for (const float* wrong : {too_much, negative, not_numbers}) {
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "sum 1", wend_interior_enter(guide, wrong, &walk, e));
    }
    ASSERT_EQ(wend_interior_enter(guide, channels, &walk, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "aim", wend_interior_head(&walk, up, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "normal", wend_interior_aim(&walk, {0, 0, 0}, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "steepness", wend_interior_aim(&walk, up, nan, e));
    ASSERT_EQ(wend_interior_aim(&walk, up, 1, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_draw_distance(&walk, 0, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_fly(&walk, 1, 1, &flight, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_pass(&walk, 1, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", sample(up, 0, 0, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_density(&walk, up, up, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_turn(&walk, up, up, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "head", wend_interior_survival(&walk, 1, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction", wend_interior_head(&walk, {1, 1, 1}, e));
    ASSERT_EQ(wend_interior_head(&walk, up, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)", wend_interior_draw_distance(&walk, 1, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_draw_distance(&walk, 0, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "length", wend_interior_fly(&walk, inf, 1, &flight, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "drawn", wend_interior_fly(&walk, 1, nan, &flight, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_fly(&walk, 1, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "length", wend_interior_pass(&walk, -1, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_pass(&walk, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "before", sample({0, 0, 0}, 0, 0, 0, e));
    for (int i = 0; i < 3; ++i) {
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)",
                       sample(up, i == 0 ? 1.0f : 0, i == 1 ? 1.0f : 0, i == 2 ? nan : 0, e));
    }
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_sample(&walk, up, 0, 0, 0, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction", wend_interior_density(&walk, up, {0, nan, 0}, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_density(&walk, up, up, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "direction", wend_interior_turn(&walk, up, {2, 0, 0}, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "throughput", wend_interior_survival(&walk, nan, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_survival(&walk, 1, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_has_turned(&walk, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_interior_turn(nullptr, up, up, e));
    std::vector<unsigned char> memory(2 * sizeof walk + 1);
    auto* odd = memory.data() + (reinterpret_cast<std::uintptr_t>(memory.data()) % 2 == 0 ? 1 : 0);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "aligned",
                   wend_interior_enter(guide, channels, reinterpret_cast<wend_interior_walk*>(odd), e));
}

}  // namespace
}  // namespace wend::capi
