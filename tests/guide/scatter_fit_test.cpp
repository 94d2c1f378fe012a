// What rays are told: the means of the records, per cell and side.
#include <tests/guide/sphere_integral.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/guide/field.h>
#include <wend/guide/fit.h>
#include <wend/guide/scatter_fit.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wend::guide {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const Box3 box(Vec3(0, 0, 0), Vec3(2, 1, 1));
const Vec3 anywhere(0.5f, 0.5f, 0.5f);
/// Of records without a surface.
const Vec3 no_normal(0, 0, 0);

Vec3 position_in(const Box3& b, Pcg32& random) {
    const Vec2 u = random.uniform2();
    return b.min + (b.max - b.min) * Vec3(u.x, u.y, random.uniform());
}

/// Directions towards a lamp from everywhere in the box.
Records lamp_records(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    Records records;
    for (int i = 0; i < count; ++i) {
        const Vec3 position = position_in(box, random);
        const Vmf lamp{normalize(Vec3(0.5f, 0.5f, 2) - position), 40};
        const Vec3 w = lamp.sample(random.uniform2());
        records.push_back({position, w, lamp.density(w), lamp.density(w), 1.5f});
    }
    return records;
}

Field many_cells() {
    FitSettings settings;
    settings.leaf_samples = 100;
    return fit(Field::empty(box), lamp_records(10000, 1), settings, 1).field;
}

Field one_cell() {
    FitSettings settings;
    settings.leaf_samples = 1e9;
    return fit(Field::empty(box), lamp_records(500, 1), settings, 1).field;
}

std::vector<Box3> cells_of(const Field& field) {
    std::vector<Box3> cells;
    field.for_each_cell([&](const Box3& cell, const Region&, double) { cells.push_back(cell); });
    return cells;
}

ScatterRecord record(const Vec3& position, float leaving, float connected = 0, const Vec3& to_light = {0, 0, 1}) {
    return {position, Vec3(0, 0, 0), leaving, connected, to_light};
}

ScatterRecords equal_records(int count, float leaving, float connected = 0) {
    return ScatterRecords(static_cast<std::size_t>(count), record(anywhere, leaving, connected));
}

/// Numbers of all kinds from everywhere.
ScatterRecords random_records(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    ScatterRecords records;
    for (int i = 0; i < count; ++i) {
        const Vec3 position = position_in(box, random);
        const float leaving = random.uniform(), connected = random.uniform();
        records.push_back(
            record(position, 1 / (0.01f + leaving), connected < 0.5f ? 0 : connected, Vmf{}.sample(random.uniform2())));
        records.back().light_distance = i % 4 == 0 ? infinity : 0.2f + random.uniform();
        records.back().normal = i % 3 == 0 ? Vec3(0, 0, 0) : Vmf{}.sample(random.uniform2());
    }
    return records;
}

void expect_same(const ScatteredLight& a, const ScatteredLight& b) {
    EXPECT_EQ(a.walked.fluence, b.walked.fluence);
    EXPECT_EQ(a.walked.mean, b.walked.mean);
    EXPECT_EQ(a.connected.fluence, b.connected.fluence);
    EXPECT_EQ(a.connected.mean, b.connected.mean);
    EXPECT_EQ(a.near.position, b.near.position);
    EXPECT_EQ(a.near.extent_squared, b.near.extent_squared);
    EXPECT_EQ(a.near.intensity, b.near.intensity);
    EXPECT_EQ(a.near.share, b.near.share);
}

TEST(FitScattered, ToldAreTheMeansOfEachCellAndSide) {
    const Vec3 up(0, 1, 0), back(0.1f, 0, -0.99f), light1(0, 0, 1), light2(0.6f, 0, 0.8f);
    Field field = many_cells();
    const std::vector<Box3> cells = cells_of(field);
    ASSERT_GT(cells.size(), 10u);
    ScatterRecords records;
    Pcg32 random(2);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const auto level = static_cast<float>(k + 1);
        for (int i = 0; i < 600; ++i) {
            ScatterRecord r = record(position_in(cells[k], random), 0);
            r.normal = i < 400 ? up : back;
            r.leaving = i < 400 ? level * (i % 2 == 0 ? 0.5f : 1.5f) : 5 * level;
            r.connected = i % 3 == 0 ? 0.0f : level * static_cast<float>(i % 3);
            r.to_light = i % 3 == 1 ? light1 : light2;
            records.push_back(r);
        }
    }
    field = fit_scattered(std::move(field), records, 1, 2);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        SCOPED_TRACE(k);
        const Vec3 middle = (cells[k].min + cells[k].max) * 0.5f;
        const ScatteredLight& light = *field.scattered_light(middle);
        const double level = static_cast<double>(k + 1), mean = (400 * 1 + 200 * 5) / 600.0 * level;
        // Sides that few saw, or nobody, are drawn to the mean by four records.
        EXPECT_NEAR(field.leaving(middle, up), (400 * level + 4 * mean) / 404, 1e-4 * level);
        EXPECT_NEAR(field.leaving(middle, back), (1000 * level + 4 * mean) / 204, 1e-4 * level);
        EXPECT_NEAR(field.leaving(middle, -up), mean, 1e-4 * level);
        EXPECT_NEAR(light.connected.fluence, level, 1e-4 * level);
        const Vec3 towards = (light1 + light2 * 2.0f) / 3.0f;
        EXPECT_LT(length(light.connected.mean - towards), 1e-4f);
    }
}

TEST(FitScattered, WhatWalksFoundIsTheFieldsOwn) {
    const Field field = fit_scattered(many_cells(), {}, 1, 1);
    for (const Box3& cell : cells_of(field)) {
        const Vec3 middle = (cell.min + cell.max) * 0.5f;
        const ScatteredLight& light = *field.scattered_light(middle);
        const VmfMixture& mixture = field.find(middle)->mixture();
        EXPECT_EQ(light.walked.fluence, field.find(middle)->fluence());
        for (int axis = 0; axis < 3; ++axis) {
            const double mean = test::integrate_sphere(
                [&](const Vec3& w) { return static_cast<double>(w[axis] * mixture.density(w)); }, 600);
            EXPECT_NEAR(light.walked.mean[axis], mean, 1e-3);
        }
        EXPECT_EQ(light.connected.fluence, 0);
        EXPECT_EQ(field.leaving(middle, {1, 0, 0}), 0);
    }
}

TEST(FitScattered, LightOfBothKindsIsScattered) {
    ScatteredLight light;
    light.walked = {2, {0.3f, 0.2f, -0.4f}};
    light.connected = {3, {0, 0.7f, 0}};
    const Vec3 before = normalize(Vec3(1, -1, 2));
    const PhaseFunction phase(HenyeyGreenstein{0.6f});
    const auto radiance = [&](const ArrivingLight& l, const Vec3& w) {
        return l.fluence * HenyeyGreenstein{length(l.mean)}.evaluate(dot(normalize(l.mean), w));
    };
    const double expected = test::integrate_sphere([&](const Vec3& w) {
        return static_cast<double>(phase.evaluate(dot(before, w)) *
                                   (radiance(light.walked, w) + radiance(light.connected, w)));
    });
    EXPECT_NEAR(light.in_scattered(before, phase), expected, 1e-4 * expected);
}

/// Connections from all of the box to a lamp of this radius, and as much light from afar.
ScatterRecords records_around(const Vec3& lamp, float radius, float intensity) {
    Pcg32 random(8);
    ScatterRecords records;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 position = position_in(box, random);
        const Vec3 from = lamp + Vmf{}.sample(random.uniform2()) * radius - position;
        ScatterRecord r = record(position, 0, intensity / length_squared(from), normalize(from));
        r.light_distance = length(from);
        records.push_back(r);
        records.push_back(record(position, 0, r.connected));
    }
    return records;
}

TEST(FitScattered, ALampInTheCellIsFound) {
    const Vec3 lamp(0.9f, 0.4f, 0.6f);
    const NearLight near =
        fit_scattered(one_cell(), records_around(lamp, 0.05f, 3), 1, 1).scattered_light(anywhere)->near;
    EXPECT_LT(length(near.position - lamp), 2e-3f);
    EXPECT_NEAR(near.extent_squared, 0.0025f, 1e-4f);
    // Half of the records are of light from afar, and a few of the others from beyond the cell's radius.
    EXPECT_NEAR(near.intensity, 1.5f, 0.03f);
    EXPECT_NEAR(near.share, 0.5f, 2e-3f);
}

TEST(FitScattered, ALampFarFromTheCellIsNotNear) {
    const ScatteredLight light =
        *fit_scattered(one_cell(), records_around({9, 0.4f, 0.6f}, 0.05f, 3), 1, 1).scattered_light(anywhere);
    EXPECT_GT(light.connected.fluence, 0);
    EXPECT_EQ(light.near.intensity, 0);
    EXPECT_EQ(light.near.share, 0);
}

TEST(FitScattered, LightFromAfarIsTheRest) {
    const ScatteredLight light =
        *fit_scattered(one_cell(), records_around({0.9f, 0.4f, 0.6f}, 0.05f, 3), 1, 1).scattered_light(anywhere);
    const PhaseFunction phase(HenyeyGreenstein{0.3f});
    const Vec3 before(0, 0, 1);
    ScatteredLight near = light;
    near.walked.fluence = 0;
    EXPECT_NEAR(light.in_scattered(before, phase) - light.in_scattered_from_afar(before, phase),
                light.near.share * near.in_scattered(before, phase), 1e-4f * light.in_scattered(before, phase));
}

TEST(FitScattered, OlderRecordsCountLess) {
    const Field field = fit_scattered(one_cell(), equal_records(100, 1, 2), 0.5, 1);
    EXPECT_NEAR(field.leaving(anywhere, no_normal), 1, 1e-6);
    const auto later = [&](double decay) {
        return fit_scattered(field, equal_records(100, 4, 8), decay, 1).leaving(anywhere, no_normal);
    };
    EXPECT_NEAR(later(0), 4, 1e-5);
    EXPECT_NEAR(later(0.5), 3, 1e-5);
    EXPECT_NEAR(later(1), 2.5, 1e-5);
    const Field half = fit_scattered(field, equal_records(100, 4, 8), 0.5, 1);
    EXPECT_NEAR(half.scattered_light(anywhere)->connected.fluence, 6, 1e-5);
}

TEST(FitScattered, OneFreakTeachesLittle) {
    ScatterRecords records = equal_records(9999, 1, 1);
    records.push_back(record(anywhere, 1e9f, 1e9f));
    const Field field = fit_scattered(one_cell(), records, 1, 1);
    EXPECT_NEAR(field.leaving(anywhere, no_normal), 1.01f, 2e-3f);
    EXPECT_NEAR(field.scattered_light(anywhere)->connected.fluence, 1.01f, 2e-3f);
}

TEST(FitScattered, AnyNumberOfThreadsGivesTheSameBits) {
    const ScatterRecords records = random_records(20000, 3);
    const std::string one = to_bytes(fit_scattered(many_cells(), records, 0.8, 1));
    for (const int threads : {2, 5}) {
        EXPECT_EQ(to_bytes(fit_scattered(many_cells(), records, 0.8, threads)), one) << threads;
    }
    EXPECT_NE(to_bytes(fit_scattered(many_cells(), random_records(20000, 4), 0.8, 2)), one);
}

TEST(FitScattered, UnusableRecordsTeachNothing) {
    const ScatterRecords good = random_records(1000, 5);
    const std::string expected = to_bytes(fit_scattered(many_cells(), good, 1, 1));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ScatterRecords bad(10, record(anywhere, 1, 1));
    bad[0].position.y = nan;
    bad[1].position.z = infinity;
    bad[2].leaving = nan;
    bad[3].leaving = -1;
    bad[4].leaving = infinity;
    bad[5].connected = nan;
    bad[6].connected = -1;
    bad[7].to_light = {0, 0, 0.5f};
    bad[8].to_light.x = nan;
    bad[9].normal.x = nan;
    for (const ScatterRecord& r : bad) {
        EXPECT_FALSE(is_usable(r)) << &r - bad.data();
    }
    ScatterRecords all = bad;
    all.insert(all.end(), good.begin(), good.end());
    all.insert(all.end(), bad.begin(), bad.end());
    EXPECT_EQ(to_bytes(fit_scattered(many_cells(), all, 1, 1)), expected);
}

TEST(FitScattered, WithoutAConnectionTheDirectionMeansNothing) {
    ScatterRecords records = equal_records(10, 1, 2);
    records.push_back(record(anywhere, 1, 0, Vec3(std::numeric_limits<float>::quiet_NaN())));
    const ScatteredLight light = *fit_scattered(one_cell(), records, 1, 1).scattered_light(anywhere);
    EXPECT_EQ(light.connected.mean, Vec3(0, 0, 1));
    EXPECT_NEAR(light.connected.fluence, 20 / 11.0, 1e-6);
}

TEST(FitScattered, ADecayOutOfRangeIsRefused) {
    const Field field = one_cell();
    for (const double decay : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(fit_scattered(field, {}, decay, 1), InputError) << decay;
    }
}

TEST(FitScattered, AFieldThatKnowsNothingTellsNothing) {
    const Field field = fit_scattered(Field::empty(box), random_records(100, 6), 1, 1);
    EXPECT_EQ(field.scattered_light(anywhere), nullptr);
    EXPECT_EQ(field.leaving(anywhere, no_normal), 0);
}

TEST(FitScattered, CellsThatAreSplitHandOnWhatTheyKnew) {
    const Field before = fit_scattered(one_cell(), equal_records(4000, 3, 5), 1, 1);
    FitSettings settings;
    settings.leaf_samples = 100;
    const Field after = fit_scattered(fit(before, lamp_records(10000, 7), settings, 1).field, {}, 1, 1);
    ASSERT_GT(after.size(), 10u);
    for (const Box3& cell : cells_of(after)) {
        const Vec3 middle = (cell.min + cell.max) * 0.5f;
        EXPECT_NEAR(after.leaving(middle, no_normal), 3, 1e-4);
        EXPECT_NEAR(after.scattered_light(middle)->connected.fluence, 5, 1e-4);
    }
}

TEST(FitScattered, AFieldFromBytesTellsTheSame) {
    const Field field = fit_scattered(many_cells(), random_records(20000, 8), 0.7, 2);
    const Field again = field_from_bytes(to_bytes(field));
    Pcg32 random(9);
    for (int i = 0; i < 300; ++i) {
        const Vec3 position = position_in(box, random);
        expect_same(*again.scattered_light(position), *field.scattered_light(position));
        EXPECT_EQ(again.leaving(position, no_normal), field.leaving(position, no_normal));
    }
    const ScatterRecords more = random_records(5000, 10);
    EXPECT_EQ(to_bytes(fit_scattered(again, more, 0.5, 1)), to_bytes(fit_scattered(field, more, 0.5, 1)));
}

TEST(Sides, AreTheNearestAxes) {
    EXPECT_EQ(side_of({1, 0, 0}), 0);
    EXPECT_EQ(side_of({-0.9f, 0.2f, 0.4f}), 1);
    EXPECT_EQ(side_of({0.1f, 0.8f, -0.6f}), 2);
    EXPECT_EQ(side_of({0, -1, 0}), 3);
    EXPECT_EQ(side_of({0.5f, 0.5f, 0.7f}), 4);
    EXPECT_EQ(side_of({0.6f, 0, -0.8f}), 5);
}

}  // namespace
}  // namespace wend::guide
