#include <wend/io/load/colours.h>

#include <wend/io/pbrt/text_file.h>
#include <wend/io/pbrt/token_stream.h>
#include <wend/io/spectrum/blackbody.h>
#include <wend/io/spectrum/colour_space.h>
#include <wend/io/spectrum/named_spectra.h>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace wend {
namespace {

/// The spectrum that samples stand for, with the place of those that stand for none. Measured ones may fall below 0
/// where there is next to nothing.
std::function<double(double)> spectrum_of(std::vector<SpectrumSample> samples, const Place& place) {
    for (SpectrumSample& sample : samples) {
        sample.value = std::max(sample.value, 0.0f);
    }
    try {
        return spectrum_from_pairs(std::move(samples));
    } catch (const InputError& error) {
        throw InputError(place, error.what());
    }
}

/// Wavelengths and values, separated by space; the rest of a line after # is a comment.
std::vector<SpectrumSample> read_spectrum(const std::filesystem::path& file, const Place& place) {
    std::istringstream lines(pbrt::read_text_file(file, place));
    std::vector<float> numbers;
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line.substr(0, line.find('#')));
        float value = 0;
        while (words >> value) {
            numbers.push_back(value);
        }
        if (!words.eof()) {
            throw InputError(Place{file.string(), number, 1}, "expected a number");
        }
    }
    if (numbers.empty() || numbers.size() % 2 != 0) {
        throw InputError(Place{file.string(), 0, 0}, "a spectrum file holds pairs of a wavelength and a value");
    }
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        samples.push_back({numbers[i], numbers[i + 1]});
    }
    return samples;
}

std::function<double(double)> spectrum_file(const LoadContext& context, const std::string& name,
                                            const pbrt::Location& place) {
    const std::filesystem::path file = pbrt::find_file(name, place, context.base_directory);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        throw InputError(place, fmt::format("\"{}\" is neither a known spectrum ({}) nor a file", name,
                                            fmt::join(spectrum_names(), ", ")));
    }
    context.files->insert(file);
    return spectrum_of(read_spectrum(file, place), place);
}

std::vector<SpectrumSample> pairs_of(const pbrt::SampledSpectrum& sampled) {
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < sampled.values.size(); ++i) {
        samples.push_back({sampled.wavelengths[i], sampled.values[i]});
    }
    return samples;
}

}  // namespace

Rgb rec709_of(const pbrt::RgbColour& colour, SpectrumKind kind) {
    if (colour.space == pbrt::ColourSpace::srgb) {
        return colour.value;
    }
    const Rgb c = rec709_from(colour.space, kind != SpectrumKind::illuminant) * colour.value;
    return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
}

Rgb reduce_colour(const LoadContext& context, const pbrt::ColourValue& value, SpectrumKind kind,
                  const pbrt::Location& place) {
    Rgb colour;
    if (const auto* rgb = std::get_if<pbrt::RgbColour>(&value)) {
        colour = rec709_of(*rgb, kind);
    } else if (const auto* sampled = std::get_if<pbrt::SampledSpectrum>(&value)) {
        colour = rgb_from_spectrum(spectrum_of(pairs_of(*sampled), place), kind);
    } else if (const auto* named = std::get_if<pbrt::NamedSpectrum>(&value)) {
        const auto known = find_named_spectrum(named->name);
        colour = known ? *known : rgb_from_spectrum(spectrum_file(context, named->name, place), kind);
    } else if (kind == SpectrumKind::illuminant) {
        colour = blackbody_rgb(std::get<pbrt::Blackbody>(value).temperature);
    } else {
        colour = blackbody_reflectance(std::get<pbrt::Blackbody>(value).temperature, kind);
    }
    if (!is_finite(colour) || min_value(colour) < 0) {
        throw InputError(place, fmt::format("a colour must be finite and not negative, but is ({}, {}, {})", colour.r,
                                            colour.g, colour.b));
    }
    return colour;
}

Rgb default_light(const pbrt::ParameterSet& parameters) {
    return rec709_of({Rgb(1.0f), parameters.colour_space()}, SpectrumKind::illuminant);
}

std::optional<Rgb> get_colour(const LoadContext& context, const pbrt::ParameterSet& parameters, std::string_view name,
                              SpectrumKind kind) {
    const auto value = parameters.get_colour(name);
    return value ? std::optional(reduce_colour(context, *value, kind, parameters.place_of(name))) : std::nullopt;
}

std::function<double(double)> find_spectrum(const LoadContext& context, const pbrt::ParameterSet& parameters,
                                            std::string_view name) {
    const pbrt::Location place = parameters.place_of(name);
    const auto value = parameters.get_colour(name);
    const auto* named = value ? std::get_if<pbrt::NamedSpectrum>(&*value) : nullptr;
    if (named) {
        const auto metal = find_metal_constant(named->name);
        return metal || find_named_spectrum(named->name) ? metal : spectrum_file(context, named->name, place);
    }
    const auto* sampled = value ? std::get_if<pbrt::SampledSpectrum>(&*value) : nullptr;
    return sampled ? spectrum_of(pairs_of(*sampled), place) : nullptr;
}

std::vector<Rgb> glow_by_temperature(float step, float hottest) {
    constexpr float highest = 40000;
    const auto steps = static_cast<std::size_t>(std::clamp(hottest, 0.0f, highest) / step) + 2;
    std::vector<Rgb> glow;
    glow.reserve(steps);
    for (std::size_t i = 0; i < steps; ++i) {
        glow.push_back(blackbody_emission(static_cast<double>(i) * static_cast<double>(step)));
    }
    return glow;
}

}  // namespace wend
