// The lenses of a camera as a maker describes them, and rays through them (kolb1995).
#pragma once

#include <wend/core/image.h>
#include <wend/core/vector.h>

#include <Imath/ImathVec.h>

#include <optional>
#include <vector>

namespace wend {

/// A surface of a lens around the axis of the camera. Lengths are in metres, as are those of the scene.
struct LensSurface {
    double radius = 0;     ///< of curvature: above 0 where it bulges towards the scene; 0: an aperture stop
    double thickness = 0;  ///< the distance to the next surface, behind the last of all to the film
    double index = 1;      ///< of refraction behind it
    double aperture = 0;   ///< radius of the opening
};

/// Lenses before a film. The film is at z = 0 of the camera's space, which looks along +z: the lenses are before it.
class LensSystem {
public:
    /// Surfaces from the scene to the film, of which there must be some. The lenses are moved to where they are
    /// focused on what is at `focus_distance` from the film. The film reaches as far as `film_radius` from the axis.
    /// `stop`, if it is not empty, is what the stops let through in place of a disk, over the square around it; its
    /// colours are averaged. Throws std::domain_error where no ray along the axis gets through, or the distance is too
    /// short.
    LensSystem(std::vector<LensSurface> surfaces, double focus_distance, double film_radius, Image stop = {});

    /// A ray to the scene, and by how much its radiance counts.
    struct Sample {
        Ray ray;
        float weight;
    };
    /// From a point of the film, by a uniform `lens` in [0,1)²; nothing where the lenses hold the ray up. The mean of
    /// the weights, 0 for nothing, is the integral of cos⁴ over the pupil behind the last lens, over the square of the
    /// distance to it (pharr2023, section 5.4): the irradiance of the film where all radiance is 1.
    std::optional<Sample> sample(const Vec2& film, const Vec2& lens) const;

    /// From the film to the last surface.
    double back_focus() const { return surfaces_.back().thickness; }

private:
    struct Line {
        Imath::V3d origin, direction;
    };
    /// A part of the plane of the last surface, seen from film points on the x axis.
    struct Pupil {
        Vec2 min, max;
    };

    /// Through all lenses. `weight` is multiplied with what the stops let through; if it is null, and from the scene,
    /// they are open.
    std::optional<Line> to_scene(Line line, double* weight) const;
    std::optional<Line> to_film(Line line) const;
    /// Goes through one surface at `z`; `index` is the index behind it over that before it, as the line goes.
    bool pass(const LensSurface& surface, double z, double index, Line& line) const;
    double let_through(const LensSurface& stop, const Imath::V3d& at) const;
    double front() const;
    void focus(double distance, double film_radius);
    Pupil find_pupil(double film_min, double film_max) const;

    std::vector<LensSurface> surfaces_;
    Image stop_;
    double film_radius_;
    std::vector<Pupil> pupils_;  ///< by distance from the axis, in equal steps
};

}  // namespace wend
