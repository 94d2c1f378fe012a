// BSDFs of Mitsuba scenes as materials.
#pragma once

#include <wend/io/mitsuba/models.h>

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace wend::mitsuba {

/// What a surface is made of.
struct SurfaceLook {
    std::string material;                  ///< name of a material
    std::optional<NumberOrTexture> alpha;  ///< the probability that the surface is there at all; none: 1
};

/// Adds materials to the scene when they are first asked for.
class Materials {
public:
    /// Both must outlive this.
    Materials(Context& context, Textures& textures)
        : context_(context), textures_(textures), models_(context, textures) {}

    /// Who asks: an integrator of surfaces alone, in a scene that has lights without size or has not. What it sees
    /// otherwise than Wend through surfaces that let light pass straight on is told, once.
    void set_integrator(bool is_of_surfaces, bool has_points) {
        is_of_surfaces_ = is_of_surfaces;
        has_points_ = has_points;
    }

    /// Of a BSDF; null: the one that shapes have without any, which is black where they shine. Throws InputError for a
    /// BSDF that there is not; what Mitsuba has and Wend lacks is replaced by a diffuse one, with a warning.
    /// `mesh` is the shape's, for what its textures take of it; null: it is no mesh.
    SurfaceLook look_of(const Element* bsdf, const pbrt::Location& shape, bool shines, const TriangleMeshData* mesh);

private:
    /// What is around a BSDF.
    struct Setting {
        bool is_two_sided = false;
        const Element* detail = nullptr;  ///< a bumpmap or normalmap
    };

    std::string name_of(const Element& bsdf, const Setting& setting);
    std::string make(const Object& bsdf, const Setting& setting);
    std::string add(const Object& bsdf, const std::string& type, Parameters& p);
    std::string add_model(const Object& bsdf, Model model, const Setting& setting);
    std::string mix(const Object& bsdf, const std::string& first, const std::string& second,
                    const NumberOrTexture& amount);
    std::string black();

    std::string two_sided(const Object& bsdf, Setting setting);
    std::string detailed(const Object& bsdf, Setting setting);
    std::string blended(const Object& bsdf, const Setting& setting);
    std::optional<SurfaceLook> masked(const Object& bsdf);
    std::optional<SurfaceLook> filter(const Object& bsdf);
    void set_detail(const Element& detail, Parameters& p);
    void warn_of_holes(const Object& bsdf);
    void warn_of_panes(const Object& bsdf);

    Context& context_;
    Textures& textures_;
    Models models_;
    std::map<std::tuple<const Element*, bool, const Element*, int>, std::string> names_;
    std::string black_, default_;
    int depth_ = 0;
    bool is_of_surfaces_ = false, has_points_ = false;
    bool is_told_of_holes_ = false, is_told_of_panes_ = false;
};

}  // namespace wend::mitsuba
