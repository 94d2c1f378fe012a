#include <tests/medium/smooth_medium.h>
#include <wend/core/random.h>
#include <wend/medium/majorant_grid.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <vector>

namespace wend {
namespace {

constexpr int voxels = 24;

/// Cells of unequal sizes, in a box whose corners are on no voxel.
const Box3 box(Vec3(-0.7f, 1.3f, 0.2f), Vec3(22.1f, 20.9f, 19.4f));

Vec3 point_in(const Box3& b, Pcg32& random) {
    const Vec3 size = b.size();
    return b.min + Vec3(random.uniform() * size.x, random.uniform() * size.y, random.uniform() * size.z);
}

TEST(MajorantGrid, CellsBoundWhatLookUpsReturn) {
    const auto grid = test::smooth_grid(voxels);
    const MajorantGrid majorants(*grid, box, 4);
    Pcg32 random(1);
    for (int i = 0; i < 200000; ++i) {
        const Vec3 p = point_in(box, random);
        const Vec3 relative = (p - box.min) / box.size();
        const auto cell_index = [&](int axis) {
            return std::min(static_cast<int>(relative[axis] * majorants.resolution()[axis]),
                            majorants.resolution()[axis] - 1);
        };
        const auto& cell = majorants.cell(cell_index(0), cell_index(1), cell_index(2));
        const float drawn = grid->sample_nearest(p, {random.uniform(), random.uniform(), random.uniform()});
        ASSERT_GE(drawn, cell.minimum);
        ASSERT_LE(drawn, cell.maximum);
    }
}

TEST(MajorantGrid, BoundsAreTightEnoughToBeOfUse) {
    const auto grid = test::smooth_grid(voxels);
    const MajorantGrid majorants(*grid, box, 4);
    double sum = 0;
    int empty = 0, count = 0;
    for (int z = 0; z < majorants.resolution().z; ++z) {
        for (int y = 0; y < majorants.resolution().y; ++y) {
            for (int x = 0; x < majorants.resolution().x; ++x, ++count) {
                sum += majorants.cell(x, y, z).maximum;
                empty += majorants.cell(x, y, z).maximum == 0;
            }
        }
    }
    EXPECT_LT(sum / count, 0.7 * grid->max_value());
    EXPECT_GT(empty, 0);
}

struct Segment {
    const MajorantGrid::Cell* cell;
    float t_in, t_out;
};

std::vector<Segment> walk(const MajorantGrid& majorants, const Vec3& origin, const Vec3& direction, float t1) {
    std::vector<Segment> segments;
    majorants.walk(origin, direction, 0, t1, [&](const MajorantGrid::Cell& cell, float t_in, float t_out) {
        segments.push_back({&cell, t_in, t_out});
        return true;
    });
    return segments;
}

/// Segments are contiguous, cover the ray's part inside the box, and each belongs to the cell that holds its middle.
void expect_exact_cover(const MajorantGrid& majorants, const Vec3& origin, const Vec3& direction, float t1) {
    const std::vector<Segment> segments = walk(majorants, origin, direction, t1);
    float low = 0, high = t1;
    if (!clip_to_box(majorants.box(), origin, direction, low, high)) {
        EXPECT_TRUE(segments.empty());
        return;
    }
    const float tolerance = 1e-5f * (1 + high);
    if (high - low > tolerance) {
        ASSERT_FALSE(segments.empty());
        EXPECT_EQ(segments.front().t_in, low);
        EXPECT_NEAR(segments.back().t_out, high, tolerance);
    }
    const Vec3 cell_size = majorants.box().size() / Vec3(majorants.resolution());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment& s = segments[i];
        EXPECT_LT(s.t_in, s.t_out);
        if (i > 0) {
            EXPECT_EQ(s.t_in, segments[i - 1].t_out);
        }
        if (s.t_out - s.t_in > 10 * tolerance) {
            const Vec3 c = (origin + direction * (0.5f * (s.t_in + s.t_out)) - majorants.box().min) / cell_size;
            const Vec3i& r = majorants.resolution();
            const auto at = [&](int axis) { return std::clamp(static_cast<int>(c[axis]), 0, r[axis] - 1); };
            EXPECT_EQ(s.cell, &majorants.cell(at(0), at(1), at(2)));
        }
    }
}

TEST(MajorantWalk, CoversRandomRaysExactly) {
    const MajorantGrid majorants(*test::smooth_grid(voxels), box, 4);
    const Box3 around(box.min - Vec3(8), box.max + Vec3(8));
    Pcg32 random(2);
    for (int i = 0; i < 5000; ++i) {
        // From inside or outside, with directions of any length, to an end inside or beyond.
        const Vec3 origin = point_in(i % 2 ? box : around, random);
        const Vec3 direction = to_sphere(random.uniform2()) * (0.1f + 3 * random.uniform());
        expect_exact_cover(majorants, origin, direction, 60 * random.uniform());
    }
}

TEST(MajorantWalk, CoversRaysAlongTheAxesAndInPlanesOfCells) {
    const MajorantGrid majorants(*test::smooth_grid(voxels), Box3(Vec3(0), Vec3(20)), 4);
    Pcg32 random(3);
    for (int i = 0; i < 3000; ++i) {
        const int axis = i % 3;
        Vec3 origin = point_in(majorants.box(), random);
        Vec3 direction = to_sphere(random.uniform2());
        direction[axis] = i % 2 ? 0.0f : -0.0f;
        if (i % 5 == 0) {
            direction = Vec3(0);
            direction[axis] = i % 2 ? 1.0f : -1.0f;
        }
        origin[(axis + 1) % 3] = i % 7 == 0 ? 4.0f * static_cast<float>(i % 6) : origin[(axis + 1) % 3];
        const std::vector<Segment> segments = walk(majorants, origin, direction, 100);
        float low = 0, high = 100;
        clip_to_box(majorants.box(), origin, direction, low, high);
        double sum = 0;
        for (const Segment& s : segments) {
            sum += s.t_out - s.t_in;
        }
        EXPECT_NEAR(sum, std::max(0.0f, high - low), 1e-4) << i;
    }
}

TEST(MajorantWalk, ARayBesideTheBoxMeetsNothing) {
    const MajorantGrid majorants(*test::smooth_grid(voxels), Box3(Vec3(0), Vec3(20)), 4);
    EXPECT_TRUE(walk(majorants, {-5, 10, 25}, {1, 0, 0}, 100).empty());
    EXPECT_TRUE(walk(majorants, {-5, 10, 10}, {-1, 0, 0}, 100).empty());
    EXPECT_TRUE(walk(majorants, {-5, 10, 10}, {1, 0, 0}, 4).empty());
    EXPECT_TRUE(walk(majorants, {10, 10, 20.1f}, {1, 0.3f, 0}, 100).empty());
}

TEST(MajorantWalk, StopsWhenTold) {
    const MajorantGrid majorants(*test::smooth_grid(voxels), Box3(Vec3(0), Vec3(20)), 4);
    int visits = 0;
    majorants.walk({-5, 10, 10}, {1, 0.1f, 0.1f}, 0, 100,
                   [&](const MajorantGrid::Cell&, float, float) { return ++visits < 2; });
    EXPECT_EQ(visits, 2);
}

}  // namespace
}  // namespace wend
