#include <wend/io/mitsuba/spectra.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/document.h>
#include <wend/io/pbrt/text_file.h>
#include <wend/io/spectrum/colorimetry.h>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace wend::mitsuba {
namespace {

SpectrumSample sample(double wavelength, double value) {
    return {static_cast<float>(wavelength), static_cast<float>(value)};
}

/// "400:.1, 700:.5".
std::vector<SpectrumSample> read_pairs(const Element& element) {
    std::string text(element.attribute("value"));
    if (std::count(text.begin(), text.end(), ':') == 0) {
        throw InputError(element.place, "a spectrum is one number, or pairs such as \"400:.1, 700:.5\"");
    }
    std::replace(text.begin(), text.end(), ':', ' ');
    const std::vector<double> numbers = numbers_of(text, element.place);
    if (numbers.size() % 2 != 0) {
        throw InputError(element.place, "a spectrum has as many values as wavelengths");
    }
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        samples.push_back(sample(numbers[i], numbers[i + 1]));
    }
    return samples;
}

/// A line each; # begins a comment.
std::vector<SpectrumSample> read_spectrum_file(Context& context, const Element& element) {
    const std::filesystem::path file = find_file(context.document, element.attribute("filename"), element.place);
    std::istringstream lines(pbrt::read_text_file(file, element.place));
    context.files.insert(file);
    std::vector<SpectrumSample> samples;
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const pbrt::Location place{
            std::make_shared<pbrt::SourceFile>(pbrt::SourceFile{file.string(), file.parent_path()}), number, 1};
        const std::vector<double> numbers = numbers_of(line.substr(0, line.find('#')), place);
        if (!numbers.empty() && numbers.size() != 2) {
            throw InputError(place, "expected a wavelength and a value");
        }
        if (!numbers.empty()) {
            samples.push_back(sample(numbers[0], numbers[1]));
        }
    }
    return samples;
}

Rgb integrate(const std::vector<SpectrumSample>& samples, SpectrumUse use, const pbrt::Location& place) {
    try {
        if (use != SpectrumUse::light) {
            return rgb_from_pairs(
                samples, use == SpectrumUse::reflectance ? SpectrumKind::reflectance : SpectrumKind::unbounded);
        }
        // A spectrum of 1 has luminance 1.
        constexpr double luminance_of_one = 106.856895;
        const Xyz xyz = xyz_from_spectrum(spectrum_from_pairs(samples));
        const Rgb rgb = rgb_from_xyz({xyz.x / luminance_of_one, xyz.y / luminance_of_one, xyz.z / luminance_of_one});
        return {std::max(rgb.r, 0.0f), std::max(rgb.g, 0.0f), std::max(rgb.b, 0.0f)};
    } catch (const InputError& error) {
        throw InputError(place, error.what());
    }
}

Rgb rgb_of(const Element& element) {
    if (element.attribute("value").starts_with('#')) {
        throw InputError(element.place, "<rgb> is one or three linear numbers; Mitsuba 3 has no \"#rrggbb\"");
    }
    const std::vector<double> numbers = numbers_of(element.attribute("value"), element.place);
    if (numbers.size() != 1 && numbers.size() != 3) {
        throw InputError(element.place, fmt::format("<rgb> is one or three numbers, not {}", numbers.size()));
    }
    const auto channel = [&](std::size_t i) { return static_cast<float>(numbers[numbers.size() == 1 ? 0 : i]); };
    return {channel(0), channel(1), channel(2)};
}

Rgb spectrum_of(Context& context, const Element& element, SpectrumUse use) {
    if (element.has("filename")) {
        return integrate(read_spectrum_file(context, element), use, element.place);
    }
    const std::string_view value = element.attribute("value");
    if (value.find(':') == std::string_view::npos) {
        const std::vector<double> numbers = numbers_of(value, element.place);
        if (numbers.size() == 1) {
            const auto number = static_cast<float>(numbers.front());
            return use == SpectrumUse::light ? rgb_from_xyz({1, 1, 1}) * number : Rgb(number);
        }
    }
    return integrate(read_pairs(element), use, element.place);
}

/// `<spectrum type="...">`: what of it the RGB variants have.
Rgb object_colour(Context& context, const Element& element) {
    const Object object(context, element);
    Rgb colour;
    if (object.type() == "uniform") {
        colour = Rgb(static_cast<float>(object.number("value", 1)));
    } else if (object.type() == "d65") {
        colour = colour_of(object, "color", SpectrumUse::unbounded, Rgb(1.0f)) *
                 static_cast<float>(object.number("scale", 1));
    } else if (object.type() == "srgb") {
        colour = colour_of(object, "color", SpectrumUse::unbounded, Rgb(1.0f));
        object.ignore("unbounded");
    } else if (object.type() == "rawconstant") {
        const Element* value = object.find("value");
        const std::optional<Vec3> vector = value && value->tag != "float" ? object.vector("value") : std::nullopt;
        colour = vector ? Rgb(vector->x, vector->y, vector->z) : Rgb(static_cast<float>(object.number("value", 1)));
    } else if (object.type() == "blackbody" || object.type() == "regular" || object.type() == "irregular") {
        throw InputError(object.place(),
                         fmt::format("{} is for Mitsuba's spectral variants: <rgb>, or <spectrum value=\"400:.1, "
                                     "700:.5\">, are colours",
                                     object.title()));
    } else {
        refuse_type(object, "bitmap, checkerboard, d65, rawconstant, srgb, uniform");
    }
    object.warn_of_unused();
    return colour;
}

void require_in_range(const Element& element, const Rgb& colour, SpectrumUse use) {
    const bool is_reflectance = use == SpectrumUse::reflectance;
    if (!(min_value(colour) >= 0) || !is_finite(colour) || (is_reflectance && max_value(colour) > 1)) {
        throw InputError(element.place,
                         fmt::format("a {} must {}, but is ({}, {}, {})", is_reflectance ? "reflectance" : "colour",
                                     is_reflectance ? "lie between 0 and 1" : "be finite and not negative", colour.r,
                                     colour.g, colour.b));
    }
}

}  // namespace

bool is_texture(const Element& element) {
    constexpr std::string_view spectra[] = {"blackbody", "d65",  "irregular", "rawconstant",
                                            "regular",   "srgb", "uniform"};
    return (element.tag == "texture" || element.tag == "spectrum") && element.has("type") &&
           std::find(std::begin(spectra), std::end(spectra), element.attribute("type")) == std::end(spectra);
}

Rgb colour_of(Context& context, const Element& element, SpectrumUse use) {
    Rgb colour;
    if (element.tag == "float" || element.tag == "integer") {
        const std::vector<double> numbers = numbers_of(element.attribute("value"), element.place);
        if (numbers.size() != 1) {
            throw InputError(element.place, fmt::format("<{}> is one number, not {}", element.tag, numbers.size()));
        }
        colour = Rgb(static_cast<float>(numbers.front()));
    } else if (element.tag == "rgb") {
        colour = rgb_of(element);
    } else if ((element.tag == "spectrum" || element.tag == "texture") && element.has("type")) {
        colour = object_colour(context, element);
    } else if (element.tag == "spectrum") {
        colour = spectrum_of(context, element, use);
    } else {
        throw InputError(element.place, fmt::format("<{}> is no colour", element.tag));
    }
    require_in_range(element, colour, use);
    return colour;
}

Rgb colour_of(const Object& object, std::string_view name, SpectrumUse use, const Rgb& fallback) {
    const Element* found = object.find(name);
    if (!found) {
        return fallback;
    }
    if (is_texture(*found)) {
        throw InputError(found->place,
                         fmt::format("\"{}\" of {} is a colour here: it cannot vary", name, object.title()));
    }
    return colour_of(object.context(), *found, use);
}

}  // namespace wend::mitsuba
