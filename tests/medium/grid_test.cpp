#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/medium/grid.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace wend {
namespace {

/// Random values in random blobs, zero elsewhere, with the plain definition of everything that Grid computes cleverly.
class SparseField {
public:
    SparseField(const Vec3i& first, const Vec3i& size, std::uint64_t seed)
        : first_(first), size_(size), values_(static_cast<std::size_t>(size.x) * size.y * size.z) {
        Pcg32 rng(seed);
        for (int blob = 0; blob < 4; ++blob) {
            const Vec3 centre(rng.uniform() * size.x, rng.uniform() * size.y, rng.uniform() * size.z);
            for (int z = 0; z < size.z; ++z) {
                for (int y = 0; y < size.y; ++y) {
                    for (int x = 0; x < size.x; ++x) {
                        if (length(Vec3(x, y, z) - centre) < 5) {
                            values_[index(x, y, z)] = rng.uniform();
                        }
                    }
                }
            }
        }
    }

    float voxel(int x, int y, int z) const {
        x -= first_.x, y -= first_.y, z -= first_.z;
        const bool inside = x >= 0 && y >= 0 && z >= 0 && x < size_.x && y < size_.y && z < size_.z;
        return inside ? values_[index(x, y, z)] : 0.0f;
    }

    double interpolate(const Vec3& p) const {
        const int x = static_cast<int>(std::floor(p.x)), y = static_cast<int>(std::floor(p.y)),
                  z = static_cast<int>(std::floor(p.z));
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
            sum += (1 - std::abs(p.x - (x + dx))) * (1 - std::abs(p.y - (y + dy))) * (1 - std::abs(p.z - (z + dz))) *
                   voxel(x + dx, y + dy, z + dz);
        }
        return sum;
    }

    bool occupied(const Vec3i& first, const Vec3i& last) const {
        for (int z = first.z; z <= last.z; ++z) {
            for (int y = first.y; y <= last.y; ++y) {
                for (int x = first.x; x <= last.x; ++x) {
                    if (voxel(x, y, z) != 0) {
                        return true;
                    }
                }
            }
        }
        return false;
    }

    Grid grid() const {
        return Grid(
            first_, size_, [this](const Vec3i& a, const Vec3i& b) { return occupied(a, b); },
            [this](int x, int y, int z) { return voxel(x, y, z); });
    }

private:
    std::size_t index(int x, int y, int z) const { return (static_cast<std::size_t>(z) * size_.y + y) * size_.x + x; }

    Vec3i first_, size_;
    std::vector<float> values_;
};

const Vec3i field_first(-5, 3, 100);
const Vec3i field_size(37, 24, 41);

Vec3 random_point(Pcg32& rng, const Box3& box, float margin) {
    const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
    const Vec3 extent = box.size() + Vec3(2 * margin);
    return box.min - Vec3(margin) + Vec3(u.x * extent.x, u.y * extent.y, u.z * extent.z);
}

Grid constant_grid(const Vec3i& size, float value) {
    return Grid(
        {0, 0, 0}, size, [](const Vec3i&, const Vec3i&) { return true; }, [=](int, int, int) { return value; });
}

TEST(Grid, InterpolatesAsTheDefinitionSays) {
    const SparseField field(field_first, field_size, 1);
    const Grid grid = field.grid();
    Pcg32 rng(2);
    int positive = 0;
    for (int i = 0; i < 50000; ++i) {
        const Vec3 p = random_point(rng, grid.bounds(), 2);
        const double expected = field.interpolate(p);
        ASSERT_NEAR(grid.interpolate(p), expected, 2e-5) << p;
        positive += expected > 0;
    }
    EXPECT_GT(positive, 1000);
}

TEST(Grid, ReturnsTheVoxelsThemselves) {
    const SparseField field(field_first, field_size, 3);
    const Grid grid = field.grid();
    for (int z = 98; z < 143; ++z) {
        for (int y = 1; y < 29; ++y) {
            for (int x = -7; x < 34; ++x) {
                ASSERT_EQ(grid.interpolate(Vec3(x, y, z)), field.voxel(x, y, z));
            }
        }
    }
}

TEST(Grid, FallsToZeroAtItsBounds) {
    const Grid grid = constant_grid({7, 8, 9}, 2.0f);
    EXPECT_EQ(grid.bounds(), Box3(Vec3(-1, -1, -1), Vec3(7, 8, 9)));
    EXPECT_NEAR(grid.interpolate({6.5f, 3, 3}), 1.0f, 1e-6);
    EXPECT_NEAR(grid.interpolate({3, 7.75f, 3}), 0.5f, 1e-6);
    EXPECT_NEAR(grid.interpolate({3, 3, -0.75f}), 0.5f, 1e-6);
    EXPECT_EQ(grid.interpolate({7, 3, 3}), 0.0f);
    EXPECT_EQ(grid.interpolate({-5, 3, 3}), 0.0f);
    EXPECT_EQ(grid.interpolate({std::nanf(""), 3, 3}), 0.0f);
    EXPECT_EQ(Grid().interpolate({0, 0, 0}), 0.0f);
}

TEST(Grid, SampleOfOneVoxelHasTheInterpolatedMean) {
    const SparseField field(field_first, field_size, 4);
    const Grid grid = field.grid();
    Pcg32 rng(5);
    double worst_z = 0, worst_wrong_z = 0;
    for (int i = 0; i < 200; ++i) {
        Vec3 p = random_point(rng, grid.bounds(), 0);
        while (grid.interpolate(p) == 0) {
            p = random_point(rng, grid.bounds(), 0);
        }
        constexpr int n = 4000;
        double sum = 0, squares = 0, wrong = 0;
        for (int k = 0; k < n; ++k) {
            const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
            const double v = grid.sample_nearest(p, u);
            sum += v;
            squares += v * v;
            wrong += grid.sample_nearest(p, Vec3(1) - u);
        }
        const double mean = sum / n;
        const double error = std::sqrt(std::max(squares / n - mean * mean, 0.0) / n) + 1e-7;
        worst_z = std::max(worst_z, std::abs(mean - grid.interpolate(p)) / error);
        // The twin: weights of a point half a cell away.
        worst_wrong_z = std::max(worst_wrong_z, std::abs(wrong / n - grid.interpolate(p + Vec3(0.5f))) / error);
    }
    EXPECT_LT(worst_z, 4.5);
    EXPECT_GT(worst_wrong_z, 10);
}

TEST(Grid, RangeHoldsEveryValueAndIsReached) {
    const SparseField field(field_first, field_size, 6);
    const Grid grid = field.grid();
    Pcg32 rng(7);
    for (int i = 0; i < 300; ++i) {
        Box3 box;
        box.extendBy(random_point(rng, grid.bounds(), 1));
        box.extendBy(box.min + Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * (i % 2 ? 3.0f : 30.0f));
        const Grid::Range range = grid.range(box);
        // On a mesh of the box's ends and the integers between, the field takes its extremes.
        Grid::Range expected{std::numeric_limits<float>::max(), 0};
        const auto mesh = [&](int axis) {
            std::vector<float> at{box.min[axis], box.max[axis]};
            for (float x = std::ceil(box.min[axis]); x < box.max[axis]; ++x) {
                at.push_back(x);
            }
            return at;
        };
        for (const float x : mesh(0)) {
            for (const float y : mesh(1)) {
                for (const float z : mesh(2)) {
                    const float v = grid.interpolate({x, y, z});
                    expected.min = std::min(expected.min, v);
                    expected.max = std::max(expected.max, v);
                }
            }
        }
        ASSERT_NEAR(range.min, expected.min, 2e-6);
        ASSERT_NEAR(range.max, expected.max, 2e-6);
        for (int k = 0; k < 200; ++k) {
            const float v = grid.interpolate(random_point(rng, box, 0));
            ASSERT_GE(v, range.min - 2e-6f);
            ASSERT_LE(v, range.max + 2e-6f);
        }
    }
}

TEST(Grid, RangeOfABoxOfVoxelsIsExact) {
    const SparseField field(field_first, field_size, 8);
    const Grid grid = field.grid();
    for (const int size : {0, 1, 5, 16}) {
        const Vec3i low(3, 8, 110), high = low + Vec3i(size);
        Grid::Range expected{std::numeric_limits<float>::max(), 0};
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int x = low.x; x <= high.x; ++x) {
                    expected.min = std::min(expected.min, field.voxel(x, y, z));
                    expected.max = std::max(expected.max, field.voxel(x, y, z));
                }
            }
        }
        const Grid::Range range = grid.range({Vec3(low), Vec3(high)});
        EXPECT_EQ(range.min, expected.min);
        EXPECT_EQ(range.max, expected.max);
    }
    EXPECT_EQ(grid.range(grid.bounds()).max, grid.max_value());
    EXPECT_EQ(grid.range({Vec3(-1e9f), Vec3(1e9f)}).max, grid.max_value());
    EXPECT_EQ(grid.range({Vec3(1000), Vec3(2000)}).max, 0.0f);
    EXPECT_EQ(grid.range(Box3()).max, 0.0f);
}

TEST(Grid, StoresOccupiedBricksOnly) {
    const Grid grid(
        {0, 0, 0}, {1000, 1000, 1000},
        [](const Vec3i& a, const Vec3i& b) {
            return a.x <= 500 && a.y <= 500 && a.z <= 500 && b.x >= 500 && b.y >= 500 && b.z >= 500;
        },
        [](int x, int y, int z) { return x == 500 && y == 500 && z == 500 ? 1.0f : 0.0f; });
    EXPECT_LT(grid.bytes(), std::size_t{10} << 20);
    EXPECT_EQ(grid.interpolate({500, 500, 500}), 1.0f);
    EXPECT_NEAR(grid.interpolate({499.5f, 500.5f, 500}), 0.25f, 1e-6);
}

TEST(Grid, BricksMayLieInMemoryAlready) {
    // Two bricks of three are there; the third is asked for. A place in memory of which a copy is no part.
    std::vector<float> there(3 * Grid::brick_voxels, 0.0f);
    const auto value = [](int x, int y, int z) { return 1.0f + 0.01f * static_cast<float>(x * 64 + y * 8 + z); };
    for (int i = 0; i < Grid::brick_voxels; ++i) {
        there[static_cast<std::size_t>(Grid::brick_voxels + i)] = value(8 + i / 64, i / 8 % 8, i % 8);
        there[static_cast<std::size_t>(2 * Grid::brick_voxels + i)] = value(16 + i / 64, i / 8 % 8, i % 8);
    }
    const std::shared_ptr<const float> memory(std::shared_ptr<void>(), there.data());
    const auto in_place = [&](const Vec3i& first) -> const float* {
        return first.x == 8 || first.x == 16 ? there.data() + first.x / 8 * Grid::brick_voxels : nullptr;
    };
    const VoxelBox all{{0, 0, 0}, {23, 7, 7}};
    int asked = 0;
    const Grid mixed(
        {0, 0, 0}, {24, 8, 8}, std::span(&all, 1),
        [&](int x, int y, int z) {
            ++asked;
            return value(x, y, z);
        },
        Grid::default_max_bytes, in_place, memory);
    const Grid copied({0, 0, 0}, {24, 8, 8}, std::span(&all, 1), value);
    EXPECT_EQ(asked, Grid::brick_voxels);
    EXPECT_EQ(mixed.max_value(), copied.max_value());
    EXPECT_EQ(mixed.stored_voxels(), copied.stored_voxels());
    EXPECT_LT(mixed.bytes(), copied.bytes());
    Pcg32 rng(9);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p = random_point(rng, copied.bounds(), 1);
        ASSERT_EQ(mixed.interpolate(p), copied.interpolate(p));
        const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
        ASSERT_EQ(mixed.sample_nearest(p, u), copied.sample_nearest(p, u));
        const Box3 box(p, p + Vec3(5));
        ASSERT_EQ(mixed.range(box).max, copied.range(box).max);
    }
}

TEST(Grid, RefusesAbsurdSizesBeforeAllocating) {
    const auto full = [](const Vec3i&, const Vec3i&) { return true; };
    const auto one = [](int, int, int) -> float {
        ADD_FAILURE() << "a value was asked for";
        return 1.0f;
    };
    EXPECT_THROW(Grid({0, 0, 0}, {1 << 19, 1 << 19, 1 << 19}, full, one), InputError);
    EXPECT_THROW(Grid({0, 0, 0}, {20000, 10000, 5000}, full, one), InputError);
    EXPECT_THROW(Grid({0, 0, 0}, {100, 100, 100}, full, one, 1 << 20), InputError);
    EXPECT_THROW(Grid({0, 0, 0}, {0, 5, 5}, full, one), InputError);
    EXPECT_THROW(Grid({0, 0, 0}, {5, -5, 5}, full, one), InputError);
    EXPECT_THROW(Grid({std::numeric_limits<int>::max() - 2, 0, 0}, {5, 5, 5}, full, one), InputError);
}

TEST(Grid, NamesTheVoxelThatHoldsNonsense) {
    const auto full = [](const Vec3i&, const Vec3i&) { return true; };
    for (const float bad : {-1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
        try {
            Grid({0, 0, 0}, {5, 5, 5}, full,
                 [=](int x, int y, int z) { return x == 1 && y == 2 && z == 3 ? bad : 1.0f; });
            ADD_FAILURE() << bad;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("(1, 2, 3)"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace wend
