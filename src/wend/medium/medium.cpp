#include <wend/medium/medium.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

// A coarse cell of four voxels: finer costs more steps of the walk, coarser more null collisions (measured by
// bench_render).
constexpr float majorant_cell_voxels = 4;

}  // namespace

Rgb GridEmission::at(const Vec3& p) const {
    const Rgb full = strength ? radiance * strength->interpolate(strength_from_world.point(p)) : radiance;
    if (colours) {
        return full * colours->interpolate(field_from_world.point(p));
    }
    if (!field) {
        return full;
    }
    const float value = field->interpolate(field_from_world.point(p));
    if (black_body.empty()) {
        return full * value;
    }
    const float kelvin = (value - temperature_offset) * temperature_scale;
    // Cooler than 100 K nothing is visible.
    if (!(kelvin > 100)) {
        return is_apart ? full * black_body.front() : Rgb(0.0f);
    }
    const float position = std::min(kelvin / black_body_step, static_cast<float>(black_body.size()) - 1.001f);
    const auto i = static_cast<std::size_t>(position);
    const float f = position - static_cast<float>(i);
    return full * (black_body[i] * (1 - f) + black_body[i + 1] * f);
}

GridMedium::GridMedium(std::shared_ptr<const Grid> density, const Transform& index_from_world, const Box3& box,
                       const Rgb& absorption, const Rgb& scattering, const PhaseFunction& phase,
                       std::shared_ptr<const GridEmission> emission)
    : density_(std::move(density)),
      index_from_world_(index_from_world),
      majorants_(*density_, box, majorant_cell_voxels),
      absorption_(absorption),
      scattering_(scattering),
      extinction_(absorption + scattering),
      phase_(phase),
      emission_(std::move(emission)) {
    WEND_EXPECT(min_value(absorption) >= 0 && min_value(scattering) >= 0);
    find_glow(box, index_from_world);
}

GridMedium::GridMedium(std::shared_ptr<const Grid> density, const Transform& index_from_world, const Box3& box,
                       std::shared_ptr<const VoxelCoefficients> voxels, const Rgb& absorption, const Rgb& scattering,
                       const PhaseFunction& phase, std::shared_ptr<const GridEmission> emission)
    : density_(std::move(density)),
      voxels_(std::move(voxels)),
      index_from_world_(index_from_world),
      majorants_(*density_, box, majorant_cell_voxels),
      absorption_(absorption),
      scattering_(scattering),
      extinction_(1.0f),
      phase_(phase),
      emission_(std::move(emission)) {
    WEND_EXPECT(voxels_ && min_value(absorption) >= 0 && min_value(scattering) >= 0);
    find_glow(box, index_from_world);
}

void GridMedium::find_glow(const Box3& box, const Transform& index_from_world) {
    if (emission_) {
        const auto glow = std::make_shared<const EmissionSampler>(
            box, index_from_world.inverse(), [this](const Vec3& p) { return mean_value(emitted_at(p)); });
        if (glow->power() > 0) {
            glow_ = glow;
        }
    }
}

float GridMedium::looks(const IndexRay& ray, float length) const {
    constexpr float several = 8;
    float begin = 0, end = length;
    const bool passes = emission_ && clip_to_box(majorants_.box(), ray.origin, ray.direction, begin, end);
    return passes ? several / (end - begin) : 0.0f;
}

Rgb extinction_at(const Medium& medium, const Vec3& position) {
    if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
        return homogeneous->extinction();
    }
    const auto& grid = std::get<GridMedium>(medium);
    if (const VoxelCoefficients* voxels = grid.voxels()) {
        const Vec3 p = grid.to_index({position, Vec3(0, 0, 0)}).origin;
        return voxels->absorption.interpolate(p) + voxels->scattering.interpolate(p);
    }
    return grid.extinction() * grid.density().interpolate(grid.to_index({position, Vec3(0, 0, 0)}).origin);
}

bool scatters(const Medium& medium) {
    if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
        return !is_black(homogeneous->scattering);
    }
    return !is_black(std::get<GridMedium>(medium).scattering());
}

Rgb albedo(const Medium& medium) {
    const auto ratio = [](const Rgb& scattering, const Rgb& absorption) {
        Rgb result;
        for (int c = 0; c < 3; ++c) {
            const float extinction = scattering[c] + absorption[c];
            result[c] = extinction > 0 ? scattering[c] / extinction : 0.0f;
        }
        return result;
    };
    if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
        return ratio(homogeneous->scattering, homogeneous->absorption);
    }
    const auto& grid = std::get<GridMedium>(medium);
    return ratio(grid.scattering(), grid.absorption());
}

}  // namespace wend
