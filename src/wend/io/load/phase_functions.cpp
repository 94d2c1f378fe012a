#include <wend/io/load/phase_functions.h>

#include <wend/io/load/media.h>
#include <wend/io/pbrt/text_file.h>
#include <wend/io/pbrt/token_stream.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace wend {
namespace {

/// What `make` returns, with the place of a parameter where it throws.
template <class Make>
PhaseFunction made(const pbrt::Location& place, const Make& make) {
    try {
        return PhaseFunction(make());
    } catch (const InputError& error) {
        throw InputError(place, error.what());
    }
}

PhaseFunction load_draine(LoadContext& context, const pbrt::ParameterSet& p) {
    const float g = load_mean_cosine(context, p), alpha = p.get_float("alpha", 1);
    if (!(alpha >= 0 && alpha <= Draine::largest_alpha)) {
        throw InputError(p.place_of("alpha"),
                         fmt::format("\"alpha\" must lie between 0 and {}, not {}", Draine::largest_alpha, alpha));
    }
    return PhaseFunction(Draine(g, alpha));
}

PhaseFunction load_cornette_shanks(LoadContext& context, const pbrt::ParameterSet& p) {
    return PhaseFunction(Draine(load_mean_cosine(context, p), 1));
}

PhaseFunction load_rayleigh(LoadContext&, const pbrt::ParameterSet&) {
    return PhaseFunction(Draine(0, 1));
}

PhaseFunction load_henyey_greenstein(LoadContext& context, const pbrt::ParameterSet& p) {
    return PhaseFunction(HenyeyGreenstein{load_mean_cosine(context, p)});
}

PhaseFunction load_mixture(LoadContext&, const pbrt::ParameterSet& p) {
    const std::vector<float> g = p.get_floats("g"), weights = p.get_floats("weights");
    constexpr std::size_t most = HenyeyGreensteinMixture::max_lobes;
    if (g.empty() || g.size() > most || g.size() != weights.size()) {
        throw InputError(p.place_of("g"),
                         fmt::format("a mixture needs as many numbers \"g\" as \"weights\", 1 to {}, not {} and {}",
                                     most, g.size(), weights.size()));
    }
    HenyeyGreensteinMixture mixture;
    for (std::size_t i = 0; i < g.size(); ++i) {
        constexpr float sharpest = 0.99f;
        if (!(std::abs(g[i]) <= sharpest)) {
            throw InputError(p.place_of("g"), fmt::format("\"g\" must lie within {}, not {}", sharpest, g[i]));
        }
        if (!(weights[i] > 0) || !std::isfinite(weights[i])) {
            throw InputError(p.place_of("weights"), "\"weights\" must be finite and above 0");
        }
        mixture.add(weights[i], g[i]);
    }
    return PhaseFunction(mixture);
}

PhaseFunction load_fog(LoadContext&, const pbrt::ParameterSet& p) {
    return made(p.place_of("diameter"), [&] { return fog_droplets(static_cast<double>(p.get_float("diameter", 20))); });
}

PhaseFunction load_fournier_forand(LoadContext&, const pbrt::ParameterSet& p) {
    return made(p.place_of("index"), [&] {
        return fournier_forand(static_cast<double>(p.get_float("index", 1.1f)),
                               static_cast<double>(p.get_float("slope", 3.5835f)));
    });
}

/// Angles and values in turn, separated by space; the rest of a line after # is a comment.
void read_pairs(const std::filesystem::path& file, const pbrt::Location& place, std::vector<float>& angles,
                std::vector<float>& values) {
    std::istringstream lines(pbrt::read_text_file(file, place));
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line.substr(0, line.find('#')));
        float angle = 0, value = 0;
        if (words >> angle) {
            std::string more;
            if (!(words >> value) || words >> more) {
                throw InputError(Place{file.string(), number, 1}, "expected an angle and a value");
            }
            angles.push_back(angle);
            values.push_back(value);
        } else if (!words.eof()) {
            throw InputError(Place{file.string(), number, 1}, "expected an angle and a value");
        }
    }
}

PhaseFunction load_tabulated(LoadContext& context, const pbrt::ParameterSet& p) {
    std::vector<float> angles = p.get_floats("angles"), values = p.get_floats("values");
    const std::string name = p.get_string("file", "");
    const pbrt::Location place = p.place_of(name.empty() ? "angles" : "file");
    if (!name.empty()) {
        const std::filesystem::path file = pbrt::find_file(name, place, context.base_directory);
        context.files->insert(file);
        read_pairs(file, place, angles, values);
    }
    if (angles.size() != values.size()) {
        throw InputError(place,
                         fmt::format("there are {} \"angles\", but {} \"values\"", angles.size(), values.size()));
    }
    std::vector<double> cosines, by_cosine;
    for (std::size_t i = angles.size(); i-- > 0;) {
        cosines.push_back(std::cos(static_cast<double>(angles[i]) * (static_cast<double>(pi) / 180)));
        by_cosine.push_back(static_cast<double>(values[i]));
    }
    return made(place, [&] { return TabulatedPhase(cosines, by_cosine); });
}

/// What "phase" may name.
struct PhaseLoader {
    std::string_view name;
    PhaseFunction (*load)(LoadContext&, const pbrt::ParameterSet&);
};
constexpr std::array phase_loaders{PhaseLoader{"cornetteshanks", load_cornette_shanks},
                                   PhaseLoader{"draine", load_draine},
                                   PhaseLoader{"fog", load_fog},
                                   PhaseLoader{"fournierforand", load_fournier_forand},
                                   PhaseLoader{"henyeygreenstein", load_henyey_greenstein},
                                   PhaseLoader{"henyeygreensteinmixture", load_mixture},
                                   PhaseLoader{"rayleigh", load_rayleigh},
                                   PhaseLoader{"tabulated", load_tabulated}};

}  // namespace

PhaseFunction load_phase(LoadContext& context, const pbrt::ParameterSet& p) {
    const std::string name = p.get_string("phase", "henyeygreenstein");
    std::string known;
    for (const PhaseLoader& loader : phase_loaders) {
        if (name == loader.name) {
            return loader.load(context, p);
        }
        known += fmt::format("{}{}", known.empty() ? "" : ", ", loader.name);
    }
    throw InputError(p.place_of("phase"),
                     fmt::format("the phase function \"{}\" is unknown; known are {}", name, known));
}

}  // namespace wend
