// Mitsuba's BSDFs that hold no others, as materials of pbrt's kinds.
#pragma once

#include <wend/io/mitsuba/textures.h>

#include <string>
#include <string_view>

namespace wend::mitsuba {

/// A material that is not yet in the scene.
struct Model {
    std::string type;  ///< as scene files have it
    Parameters parameters;
    bool is_one_sided = true;  ///< whether it is black from behind
};

/// Makes models of what BSDFs say.
class Models {
public:
    /// Both must outlive this.
    Models(Context& context, Textures& textures) : context_(context), textures_(textures) {}

    /// Of a BSDF. Throws InputError for one that there is not; what Wend lacks is diffuse, with a warning.
    Model of(const Object& bsdf);

private:
    Model diffuse(const Object& bsdf);
    Model dielectric(const Object& bsdf);
    Model conductor(const Object& bsdf);
    Model plastic(const Object& bsdf);
    Model principled(const Object& bsdf);
    Model hair(const Object& bsdf);
    Model thin(const Object& bsdf);
    Model measured(const Object& bsdf);
    Model replaced(const Object& bsdf);
    void set_roughness(const Object& bsdf, const std::string& prefix, Parameters& p);
    void require_one(const Object& bsdf, std::string_view name);

    Context& context_;
    Textures& textures_;
};

}  // namespace wend::mitsuba
