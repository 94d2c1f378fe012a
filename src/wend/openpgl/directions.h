// What a field knows of a place: directions to draw, and the radiance that comes from them.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/guide/field.h>
#include <wend/guide/mixture.h>
#include <wend/guide/region.h>
#include <wend/sampling/axial_lobes.h>

#include <cstdint>
#include <optional>

namespace wend::openpgl {

/// Refers to nothing, the field included. Before it is initialized, directions are uniform and nothing is bright.
class Directions {
public:
    /// Takes over what a field knows of a position. False, and cleared, where that is nothing.
    bool init(const guide::Field* field, const Vec3& position);
    void clear();
    bool is_initialized() const { return initialized_; }

    /// Directions from now on are in proportion to the radiance times the lobes, in place of those before.
    void multiply(const AxialLobes& lobes);

    /// A direction that belongs to a point of the unit square, which what is outside is moved into.
    Vec3 sample(const Vec2& u) const;
    /// Density of a unit direction, in 1/sr.
    float density(const Vec3& direction) const;
    /// The same in proportion to the radiance alone.
    float incident_density(const Vec3& direction) const { return incident_.density(direction); }

    /// The radiance that arrives from a unit direction.
    Rgb radiance(const Vec3& direction) const { return here().radiance(position_, direction); }
    /// The integral of the radiance.
    Rgb fluence() const { return here().in_scattered(incident_.product(AxialLobes())) * (4 * pi); }
    /// The integral of the radiance times the lobes.
    Rgb scattered(const AxialLobes& lobes) const { return here().in_scattered(incident_.product(lobes)); }
    /// The field's cell.
    std::uint32_t cell() const { return cell_; }

private:
    /// The field's region as seen from the position.
    guide::Region here() const { return {position_, incident_, guide::Lanes{}, fluence_, colours_}; }

    Vec3 position_{0, 0, 0};
    guide::VmfMixture incident_;
    float fluence_ = 0;
    guide::LobeColours colours_;
    std::optional<guide::MixtureProduct> product_;
    std::uint32_t cell_ = 0;
    bool initialized_ = false;
};

/// The cosine to a normal, which is scaled to unit length; nothing if it has none.
std::optional<AxialLobes> cosine_lobes(const Vec3& normal);
/// Henyey and Greenstein's phase function as lobes. It keeps the last, since media seldom change their mean cosine.
class PhaseLobes {
public:
    /// Around the direction of flight before the collision, which is scaled to unit length; nothing if it has none or
    /// the mean cosine is no number.
    std::optional<AxialLobes> around(const Vec3& before, float mean_cosine);

private:
    float mean_cosine_ = 0;
    AxialLobes lobes_;
};

}  // namespace wend::openpgl
