#include <wend/io/load/media_parameters.h>

#include <wend/io/load/colours.h>

#include <cmath>
#include <utility>

namespace wend {

Rgb load_coefficient(LoadContext& context, const pbrt::ParameterSet& p, std::string_view name) {
    return get_colour(context, p, name, SpectrumKind::unbounded).value_or(Rgb(1.0f));
}

Rgb load_emitted(LoadContext& context, const pbrt::ParameterSet& p) {
    return get_colour(context, p, "Le", SpectrumKind::illuminant).value_or(Rgb(0.0f));
}

std::string_view emission_scale_name(const pbrt::ParameterSet& p) {
    return p.has("LeScale") ? "LeScale" : "Lescale";
}

Coefficients load_coefficients(LoadContext& context, const pbrt::ParameterSet& p) {
    const float scale = non_negative_float(p, "scale", 1);
    return {load_coefficient(context, p, "sigma_a") * scale, load_coefficient(context, p, "sigma_s") * scale};
}

Box3 load_box(const pbrt::ParameterSet& p) {
    const Vec3 a = p.get_point3("p0", {0, 0, 0});
    const Vec3 b = p.get_point3("p1", {1, 1, 1});
    Box3 box;
    box.extendBy(a);
    box.extendBy(b);
    const Vec3 size = box.size();
    if (!is_finite(a) || !is_finite(b) || !(size.x > 0 && size.y > 0 && size.z > 0)) {
        throw InputError(p.place_of("p1"), "the box from \"p0\" to \"p1\" is empty");
    }
    return box;
}

std::shared_ptr<GridEmission> make_emission_sampler(const pbrt::ParameterSet& p,
                                                    std::shared_ptr<const Grid> temperature,
                                                    const Transform& index_from_world, float scale) {
    auto emission = std::make_shared<GridEmission>();
    emission->radiance = Rgb(scale);
    const float largest = temperature->max_value();
    set_temperature(p, std::move(temperature), index_from_world, *emission);
    emission->black_body_step = 20;
    emission->black_body = glow_by_temperature(emission->black_body_step,
                                               (largest - emission->temperature_offset) * emission->temperature_scale);
    return emission;
}

void set_temperature(const pbrt::ParameterSet& p, std::shared_ptr<const Grid> temperature,
                     const Transform& index_from_world, GridEmission& emission) {
    emission.field_from_world = AffineMap(index_from_world);
    emission.temperature_offset = p.get_float("temperatureoffset", p.get_float("temperaturecutoff", 0));
    emission.temperature_scale = p.get_float("temperaturescale", 1);
    if (!std::isfinite(emission.temperature_offset) || !std::isfinite(emission.temperature_scale)) {
        throw InputError(p.place_of("temperaturescale"), "the temperature's offset and scale must be finite");
    }
    emission.field = std::move(temperature);
}

std::shared_ptr<GridEmission> load_glow(LoadContext& context, const pbrt::ParameterSet& p) {
    auto emission = std::make_shared<GridEmission>();
    emission->is_apart = true;
    std::vector<Rgb> colours;
    for (const pbrt::RgbColour& colour : p.get_rgbs("glow")) {
        colours.push_back(reduce_colour(context, colour, SpectrumKind::unbounded, p.place_of("glow")));
        if (!is_finite(colours.back()) || !(min_value(colours.back()) >= 0)) {
            throw InputError(p.place_of("glow"), "\"glow\" must be finite and not negative");
        }
    }
    if (colours.empty()) {
        throw InputError(p.place_of("glow"), "\"glow\" is one colour, or several by temperature");
    }
    if (colours.size() == 1) {
        emission->radiance = colours.front();
        return emission;
    }
    emission->radiance = Rgb(1.0f);
    emission->black_body = std::move(colours);
    emission->black_body_step = p.get_float("glowstep", 100);
    if (!(emission->black_body_step > 0) || !std::isfinite(emission->black_body_step)) {
        throw InputError(p.place_of("glowstep"), "\"glowstep\" must be above 0 kelvin");
    }
    return emission;
}

}  // namespace wend
