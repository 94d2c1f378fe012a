// Cells that rays take for one: what they are told is the mean, and no cell is far from it.
#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/join_alike.h>
#include <wend/guide/scatter_fit.h>
#include <wend/guide/serialization.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wend::guide {
namespace {

const Box3 box(Vec3(0, 0, 0), Vec3(2, 1, 1));
const Vec3 up(0, 0, 1);

struct Told {
    Box3 box;
    ScatteredLight light;
};

/// Directions from everywhere, of a radiance that is `step` times as large where x > 1.
Field field_with(float step, const ScatterRecords& scattered = {}) {
    Pcg32 random(1);
    Records records;
    for (int i = 0; i < 40000; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(2 * u.x, u.y, random.uniform());
        const float radiance = position.x > 1 ? step : 1.0f;
        records.push_back({position, Vmf{}.sample(random.uniform2()), radiance, Vmf{}.density(up), 1.5f});
    }
    FitSettings settings;
    settings.leaf_samples = 200;
    settings.uniform_factor = 1;
    return fit_scattered(fit(Field::empty(box), records, settings, 1).field, scattered, 1, 1);
}

std::vector<Told> told_by(const Field& field) {
    std::vector<Told> cells;
    field.for_each_cell([&](const Box3& cell, const Region&, double) {
        cells.push_back({cell, *field.scattered_light((cell.min + cell.max) * 0.5f)});
    });
    return cells;
}

double sum_over_volume(const std::vector<Told>& cells, float (*value)(const ScatteredLight&)) {
    double sum = 0;
    for (const Told& cell : cells) {
        const Vec3 size = cell.box.max - cell.box.min;
        sum += static_cast<double>(size.x * size.y * size.z * value(cell.light));
    }
    return sum;
}
double light_in(const std::vector<Told>& cells) {
    return sum_over_volume(cells, [](const ScatteredLight& light) { return light.walked.fluence; });
}
double trust_in(const std::vector<Told>& cells) {
    return sum_over_volume(cells, [](const ScatteredLight& light) { return light.confidence; });
}

std::vector<float> fluences_along(const Field& field, const Ray& ray, float length) {
    std::vector<float> fluences;
    float end = 0;
    field.walk(ray, 0, length, [&](const ScatteredLight& light, float t_in, float t_out) {
        EXPECT_EQ(t_in, end);
        end = t_out;
        EXPECT_EQ(light.walked.fluence, field.scattered_light(ray.at((t_in + t_out) / 2))->walked.fluence);
        fluences.push_back(light.walked.fluence);
        return true;
    });
    EXPECT_EQ(end, length);
    return fluences;
}

TEST(JoinAlike, WhereTheLightIsTheSameEverywhereThereIsOneCell) {
    const Field apart = field_with(1), joined = join_alike(apart);
    const Ray ray{{0.01f, 0.3f, 0.2f}, normalize(Vec3(1, 0.2f, 0.3f))};
    ASSERT_GT(fluences_along(apart, ray, 2).size(), 3u);
    EXPECT_EQ(fluences_along(joined, ray, 2).size(), 1u);
    EXPECT_NEAR(light_in(told_by(joined)), light_in(told_by(apart)), 1e-4 * light_in(told_by(apart)));
}

TEST(JoinAlike, CellsThatDifferStayApart) {
    const Field apart = field_with(8), joined = join_alike(apart);
    const std::vector<Told> before = told_by(apart), after = told_by(joined);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LE(std::abs(before[i].light.walked.fluence - after[i].light.walked.fluence),
                  0.5f * after[i].light.walked.fluence);
        EXPECT_GT(after[i].light.confidence, 0);
    }
    EXPECT_NEAR(light_in(after), light_in(before), 1e-4 * light_in(before));
    EXPECT_NEAR(trust_in(after), trust_in(before), 1e-4 * trust_in(before));
    const std::vector<float> along = fluences_along(joined, {{0.01f, 0.3f, 0.2f}, Vec3(1, 0, 0)}, 1.9f);
    EXPECT_LT(along.size(), fluences_along(apart, {{0.01f, 0.3f, 0.2f}, Vec3(1, 0, 0)}, 1.9f).size());
    EXPECT_GT(along.back(), 4 * along.front());
}

TEST(JoinAlike, CellsWithLightsCloseByStayApart) {
    const Vec3 lamp(0.5f, 0.5f, 0.5f);
    Pcg32 random(2);
    ScatterRecords scattered;
    for (int i = 0; i < 20000; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(2 * u.x, u.y, random.uniform());
        const Vec3 from = lamp - position;
        scattered.push_back({position, Vec3(0, 0, 0), 0, 1e-3f / length_squared(from), normalize(from)});
        scattered.back().light_distance = length(from);
    }
    const Field apart = field_with(1, scattered), joined = join_alike(apart);
    const std::vector<Told> before = told_by(apart), after = told_by(joined);
    int near = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].light.near.intensity, after[i].light.near.intensity);
        if (before[i].light.near.intensity > 0) {
            ++near;
            EXPECT_EQ(before[i].light.walked.fluence, after[i].light.walked.fluence);
            EXPECT_EQ(before[i].light.connected.fluence, after[i].light.connected.fluence);
        }
    }
    EXPECT_GT(near, 0);
    EXPECT_LT(near, static_cast<int>(before.size()));
}

TEST(JoinAlike, OutlivesAFileAndNotTheNextFit) {
    const Field apart = field_with(1), joined = join_alike(apart);
    const Ray ray{{0.01f, 0.3f, 0.2f}, normalize(Vec3(1, 0.2f, 0.3f))};
    EXPECT_EQ(fluences_along(field_from_bytes(to_bytes(joined)), ray, 2), fluences_along(joined, ray, 2));
    EXPECT_EQ(fluences_along(field_from_bytes(to_bytes(apart)), ray, 2), fluences_along(apart, ray, 2));
    EXPECT_EQ(fluences_along(fit_scattered(joined, {}, 1, 1), ray, 2), fluences_along(apart, ray, 2));
    EXPECT_EQ(join_alike(Field::empty(box)).size(), 1u);
}

}  // namespace
}  // namespace wend::guide
