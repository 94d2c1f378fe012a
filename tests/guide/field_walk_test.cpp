// Walks through the cells of a field: those that a look-up finds on the way, in order and without gaps.
#include <wend/core/random.h>
#include <wend/guide/fit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wend::guide {
namespace {

const Box3 box(Vec3(-1, 0, 0), Vec3(2, 1, 1));

/// Cut in many places by a lamp that is seen differently from everywhere.
const Field& field() {
    static const Field result = [] {
        Pcg32 random(1);
        Records records;
        for (int i = 0; i < 40000; ++i) {
            const Vec2 u = random.uniform2();
            const Vec3 position(3 * u.x - 1, u.y * u.y, random.uniform());
            const Vmf lamp{normalize(Vec3(0.5f, 0.5f, 0.6f) - position), 40};
            const Vec3 w = lamp.sample(random.uniform2());
            records.push_back({position, w, lamp.density(w), lamp.density(w), 1.5f});
        }
        FitSettings settings;
        settings.leaf_samples = 100;
        return fit(Field::empty(box), records, settings, 1).field;
    }();
    return result;
}

std::vector<Box3> cells() {
    std::vector<Box3> result;
    field().for_each_cell([&](const Box3& cell, const Region&, double) { result.push_back(cell); });
    return result;
}

struct Step {
    const ScatteredLight* light;
    float t_in, t_out;
};

std::vector<Step> steps_of(const Ray& ray, float t0, float t1, float finest = 0) {
    std::vector<Step> steps;
    field().walk(
        ray, t0, t1,
        [&](const ScatteredLight& light, float t_in, float t_out) {
            steps.push_back({&light, t_in, t_out});
            return true;
        },
        finest);
    return steps;
}

/// Steps that are too short for a point inside to be told from one beside.
bool is_tiny(const Step& s) {
    return s.t_out - s.t_in < 1e-4f * (1 + std::abs(s.t_in));
}

void expect_honest(const Ray& ray, float t0, float t1) {
    SCOPED_TRACE(testing::Message() << "from " << ray.origin << " towards " << ray.direction);
    const std::vector<Step> steps = steps_of(ray, t0, t1);
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps.front().t_in, t0);
    EXPECT_EQ(steps.back().t_out, t1);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Step& s = steps[i];
        ASSERT_LT(s.t_in, s.t_out);
        if (i > 0) {
            ASSERT_EQ(s.t_in, steps[i - 1].t_out);
            ASSERT_NE(s.light, steps[i - 1].light);
        }
        if (is_tiny(s)) {
            continue;
        }
        for (const float share : {0.01f, 0.5f, 0.99f}) {
            const float t = s.t_out == infinity ? s.t_in + 100 * share : s.t_in + share * (s.t_out - s.t_in);
            ASSERT_EQ(field().scattered_light(ray.at(t)), s.light) << "step " << i << ", distance " << t;
        }
    }
}

Vec3 position_around(Pcg32& random, float margin) {
    const Vec2 u = random.uniform2();
    const Vec3 low = box.min - Vec3(margin), size = box.max - box.min + Vec3(2 * margin);
    return low + size * Vec3(u.x, u.y, random.uniform());
}

Vec3 along_axis(int i) {
    Vec3 d(0, 0, 0);
    d[i / 2] = i % 2 == 0 ? 1.0f : -1.0f;
    return d;
}

TEST(FieldWalk, TheFieldHasManyCells) {
    EXPECT_GT(field().size(), 100u);
    // A walk meets more than a few.
    EXPECT_GT(steps_of({{-1, 0.05f, 0.1f}, normalize(Vec3(3, 0.4f, 0.8f))}, 0, 3).size(), 8u);
}

TEST(FieldWalk, AnyRay) {
    Pcg32 random(2);
    for (int i = 0; i < 5000; ++i) {
        const Ray ray{position_around(random, i % 2 == 0 ? 0.0f : 3.0f), Vmf{}.sample(random.uniform2())};
        const float t0 = i % 3 == 0 ? random.uniform() : 0.0f;
        expect_honest(ray, t0, i % 5 == 0 ? infinity : t0 + 0.1f + 6 * random.uniform());
    }
}

TEST(FieldWalk, AlongTheAxes) {
    Pcg32 random(3);
    for (int i = 0; i < 600; ++i) {
        expect_honest({position_around(random, 0.5f), along_axis(i % 6)}, 0, i % 2 == 0 ? 2.0f : infinity);
    }
}

TEST(FieldWalk, FromPlanesAndCorners) {
    Pcg32 random(4);
    for (const Box3& cell : cells()) {
        const Vec3 inside = (cell.min + cell.max) * 0.5f;
        for (int i = 0; i < 16; ++i) {
            // On one, two or three planes of the tree.
            Vec3 origin = inside;
            for (int axis = 0; axis < 3; ++axis) {
                if (i % 8 & (1 << axis)) {
                    origin[axis] = i < 8 ? cell.min[axis] : cell.max[axis];
                }
            }
            expect_honest({origin, Vmf{}.sample(random.uniform2())}, 0, 4);
        }
    }
}

TEST(FieldWalk, InPlanesAndEdges) {
    for (const Box3& cell : cells()) {
        const Vec3 inside = (cell.min + cell.max) * 0.5f;
        for (int i = 0; i < 6; ++i) {
            for (int plane = 0; plane < 8; ++plane) {
                Vec3 origin = inside;
                for (int axis = 0; axis < 3; ++axis) {
                    if (plane & (1 << axis)) {
                        origin[axis] = cell.min[axis];
                    }
                }
                expect_honest({origin, along_axis(i)}, 0, 4);
                expect_honest({origin - along_axis(i), along_axis(i)}, 0, infinity);
            }
        }
    }
}

TEST(FieldWalk, ThroughCorners) {
    Pcg32 random(5);
    for (const Box3& cell : cells()) {
        const Vec3 d = Vmf{}.sample(random.uniform2());
        expect_honest({cell.min - d, d}, 0, 3);
    }
}

TEST(FieldWalk, DividesNoFurtherThanAsked) {
    Pcg32 random(6);
    std::size_t all = 0, told = 0;
    for (int i = 0; i < 1000; ++i) {
        const Ray ray{position_around(random, 0), Vmf{}.sample(random.uniform2())};
        const float end = 0.5f + random.uniform();
        const std::vector<Step> steps = steps_of(ray, 0, end, 0.5f);
        ASSERT_EQ(steps.front().t_in, 0);
        ASSERT_EQ(steps.back().t_out, end);
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const Step& s = steps[k];
            ASSERT_TRUE(k == 0 || s.t_in == steps[k - 1].t_out);
            ASSERT_TRUE(is_tiny(s) || s.light == field().scattered_light(ray.at(0.5f * (s.t_in + s.t_out))));
        }
        ASSERT_EQ(steps_of(ray, 0, end, end).size(), 1u);
        all += steps_of(ray, 0, end).size();
        told += steps.size();
    }
    EXPECT_LT(told, all);
}

TEST(FieldWalk, StopsWhenTold) {
    const Ray ray{{-1, 0.05f, 0.1f}, normalize(Vec3(3, 0.4f, 0.8f))};
    const std::size_t all = steps_of(ray, 0, 3).size();
    for (std::size_t most = 1; most <= all; ++most) {
        std::size_t visited = 0;
        field().walk(ray, 0, 3, [&](const ScatteredLight&, float, float) { return ++visited < most; });
        EXPECT_EQ(visited, most);
    }
}

TEST(FieldWalk, AnEmptyIntervalHasNoCells) {
    EXPECT_TRUE(steps_of({{0, 0.5f, 0.5f}, {1, 0, 0}}, 1, 1).empty());
}

}  // namespace
}  // namespace wend::guide
