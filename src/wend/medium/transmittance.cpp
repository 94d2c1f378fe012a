#include <wend/medium/transmittance.h>

#include <wend/medium/dense_cells.h>
#include <wend/medium/tentative_collisions.h>

namespace wend {
namespace {

// Estimates below this are brought back to it, or ended, by roulette.
constexpr float roulette_threshold = 0.05f;

/// At density 1.
double depth_of(const GridMedium& medium, const GridMedium::IndexRay& ray, float t_in, float t_out) {
    double depth = 0;
    walk_voxels(medium.density(), ray.origin, ray.direction, t_in, t_out, [&depth](const VoxelPassage& passage) {
        depth += passage.depth();
        return true;
    });
    return depth;
}

/// Ratio tracking against the bound of a medium whose voxels have coefficients of their own.
Rgb estimate_by_voxels(const GridMedium& medium, const Ray& ray, float distance, Pcg32& random) {
    const VoxelCoefficients& voxels = *medium.voxels();
    const auto index_ray = medium.to_index(ray);
    Rgb estimate(1.0f);
    TentativeCollisions collisions(random);
    const auto cross = [&](const MajorantGrid::Cell& cell, float t_in, float t_out) {
        for (double t = t_in; collisions.next(t, t_out, cell.maximum);) {
            const Vec3 p = index_ray.at(static_cast<float>(t));
            const Vec3 corner(random.uniform(), random.uniform(), random.uniform());
            const Rgb extinction =
                voxels.absorption.sample_nearest(p, corner) + voxels.scattering.sample_nearest(p, corner);
            estimate *= Rgb(1.0f) - extinction / cell.maximum;
            const float size = max_value(estimate);
            if (size < roulette_threshold) {
                if (!(random.uniform() * roulette_threshold < size)) {
                    estimate = Rgb(0.0f);
                    return false;
                }
                estimate *= roulette_threshold / size;
            }
        }
        return true;
    };
    medium.majorants().walk(index_ray.origin, index_ray.direction, 0, distance, cross);
    return estimate;
}

}  // namespace

Rgb estimate_transmittance(const GridMedium& medium, const Ray& ray, float distance, Pcg32& random) {
    if (medium.voxels()) {
        return estimate_by_voxels(medium, ray, distance, random);
    }
    const auto index_ray = medium.to_index(ray);
    const Rgb& extinction = medium.extinction();
    const float largest = max_value(extinction);
    if (!(largest > 0)) {
        return Rgb(1.0f);
    }
    const Rgb relative = extinction / largest;
    const bool grey = extinction.r == extinction.g && extinction.g == extinction.b;
    const bool exact = is_black(medium.scattering());

    Rgb estimate(1.0f);
    // Ends a small estimate or makes it larger; false where it has ended.
    const auto survives = [&] {
        const float size = max_value(estimate);
        if (size >= roulette_threshold || (exact && size > 0)) {
            return true;
        }
        if (!(random.uniform() * roulette_threshold < size)) {
            estimate = Rgb(0.0f);
            return false;
        }
        estimate *= roulette_threshold / size;
        return true;
    };
    TentativeCollisions collisions(random);
    constexpr double countable = 1e30;
    const auto cross = [&](const MajorantGrid::Cell& cell, float t_in, float t_out) {
        const double most = double{largest} * (t_out - t_in);
        const double tentative_collisions = most * (cell.maximum - cell.minimum);
        if ((exact && tentative_collisions > 0) || tentative_collisions > most_tentative_collisions ||
            most * cell.maximum > countable) {
            estimate *= transmitted(extinction, depth_of(medium, index_ray, t_in, t_out));
            return survives();
        }
        if (cell.minimum > 0) {
            const float control = -largest * cell.minimum * (t_out - t_in);
            estimate *= grey ? Rgb(std::exp(control)) : exp(relative * control);
            if (!survives()) {
                return false;
            }
        }
        const float range = cell.maximum - cell.minimum;
        const float rate = largest * range;
        for (double t = t_in; collisions.next(t, t_out, rate);) {
            const Vec3 u(random.uniform(), random.uniform(), random.uniform());
            const float excess =
                (medium.density().sample_nearest(index_ray.at(static_cast<float>(t)), u) - cell.minimum) / range;
            estimate *= grey ? Rgb(1 - excess) : Rgb(1.0f) - relative * excess;
            if (!survives()) {
                return false;
            }
        }
        return true;
    };
    medium.majorants().walk(index_ray.origin, index_ray.direction, 0, distance, cross);
    return estimate;
}

}  // namespace wend
