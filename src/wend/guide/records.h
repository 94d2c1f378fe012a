// What walks report to the guide: one record for each direction drawn and what came back along it.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/vector.h>

#include <limits>
#include <vector>

namespace wend::guide {

/// An estimate of the radiance arriving at a point from one direction. Estimates of zero are as informative as others:
/// they tell where walks go (the cells of the field follow that) and lower the mean.
struct Record {
    /// Where it arrives, in scene units.
    Vec3 position;
    /// Unit vector towards where the radiance comes from.
    Vec3 direction;
    /// Estimate of the incident radiance as a scalar, for instance its luminance; not negative.
    float radiance;
    /// Density the direction was drawn with, in 1/sr; positive.
    float density;
    /// Distance to the next vertex along the direction; positive, and infinite where there is none.
    float distance;
    /// The density that classical sampling had for the direction. This and the two that follow tell how classical and
    /// guided directions are best mixed; all 0 where there was no choice.
    float classical_density = 0;
    /// The density that the guide had for the direction.
    float guided_density = 0;
    /// The scattering function with its cosine times the radiance, a scalar too.
    float scattered = 0;
    /// The radiance by colour channel in any scale, of which only ratios count; not negative. Black stands for grey.
    Rgb colour{1.0f};
};

/// What a vertex of a walk says about the light that is scattered there: decisions about flights ask how much of it
/// there is ahead.
struct ScatterRecord {
    /// Of the vertex, in scene units.
    Vec3 position;
    /// Of the surface, on the side that the walk came from; zero in a volume.
    Vec3 normal;
    /// Estimate of the radiance that leaves to where the walk came from, as a scalar.
    float leaving;
    /// What a connection to a light found there: an estimate of the fluence of the light that connections account for,
    /// in radiance times sr.
    float connected;
    /// Towards the light, unit length; means nothing where `connected` is 0.
    Vec3 to_light;
    /// To the light; infinite for one that is far.
    float light_distance = std::numeric_limits<float>::infinity();
};

/// Records in an order that does not depend on threads, since sums of floating-point numbers depend on it: by pixel,
/// sample and vertex.
using Records = std::vector<Record>;

/// In the same order as Records.
using ScatterRecords = std::vector<ScatterRecord>;

/// Whether the field can learn from a record: finite numbers in their ranges (the distance may be infinite),
/// coordinates up to 1e15 and a weight up to 1e30.
WEND_API bool is_usable(const Record& record);
/// The same for what a vertex says about scattered light.
WEND_API bool is_usable(const ScatterRecord& record);

/// The record's share in ∫ L dω: radiance / density, in radiance times sr.
inline double weight_of(const Record& record) {
    return static_cast<double>(record.radiance) / record.density;
}

}  // namespace wend::guide
