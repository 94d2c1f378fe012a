#include <wend/io/mitsuba/phase_functions.h>

#include <wend/core/error.h>
#include <wend/core/vector.h>
#include <wend/io/mitsuba/spectra.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace wend::mitsuba {
namespace {

/// A phase function that is not blended, with its share of the whole.
struct Part {
    enum class Kind { henyey_greenstein, rayleigh, table };

    Kind kind = Kind::henyey_greenstein;
    double share = 1;
    double g = 0;
    std::vector<double> values{};  ///< at even steps of the cosine from -1, of integral 1 over the cosine

    double evaluate(double cosine) const {
        switch (kind) {
            case Kind::rayleigh:
                return 0.375 * (1 + cosine * cosine);
            case Kind::table: {
                const double x = 0.5 * (cosine + 1) * static_cast<double>(values.size() - 1);
                const auto i = std::min(static_cast<std::size_t>(std::max(x, 0.0)), values.size() - 2);
                return std::lerp(values[i], values[i + 1], x - static_cast<double>(i));
            }
            default:
                return 0.5 * (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
        }
    }
};

double mean_cosine(const Object& phase) {
    const double g = phase.number("g", 0.8);
    if (!(std::abs(g) < 1)) {
        throw InputError(phase.place_of("g"), fmt::format("\"g\" must lie between -1 and 1, not {}", g));
    }
    return g;
}

std::vector<double> table_of(const Object& phase) {
    std::vector<double> values = numbers_of(phase.text("values", ""), phase.place_of("values"));
    double integral = 0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        integral += (values[i] + values[i + 1]) / static_cast<double>(values.size() - 1);
    }
    if (values.size() < 2 || *std::min_element(values.begin(), values.end()) < 0 || !(integral > 0) ||
        !std::isfinite(integral)) {
        throw InputError(phase.place_of("values"),
                         "a \"tabphase\" has two or more \"values\", not negative and not all 0");
    }
    for (double& value : values) {
        value /= integral;
    }
    return values;
}

/// Appends what a phase function consists of.
void collect(Context& context, const Element& element, double share, int depth, std::vector<Part>& parts) {
    constexpr int deepest = 16;
    constexpr std::size_t most = 64;
    const Object phase(context, element);
    if (depth > deepest || parts.size() > most) {
        throw InputError(phase.place(), fmt::format("phase functions are blended more than {} deep, or of more than {}",
                                                    deepest, most));
    }
    if (phase.type() == "isotropic") {
        parts.push_back({Part::Kind::henyey_greenstein, share, 0});
    } else if (phase.type() == "hg") {
        parts.push_back({Part::Kind::henyey_greenstein, share, mean_cosine(phase)});
    } else if (phase.type() == "rayleigh") {
        parts.push_back({Part::Kind::rayleigh, share});
    } else if (phase.type() == "tabphase") {
        parts.push_back({Part::Kind::table, share, 0, table_of(phase)});
    } else if (phase.type() == "blendphase") {
        const std::vector<const Element*> blended = phase.nested("phase");
        const double weight = phase.number("weight", 0.5);
        if (blended.size() != 2 || !(weight >= 0 && weight <= 1)) {
            throw InputError(phase.place_of("weight"),
                             "a \"blendphase\" has two phase functions, and a \"weight\" between 0 and 1");
        }
        collect(context, *blended[0], share * (1 - weight), depth + 1, parts);
        collect(context, *blended[1], share * weight, depth + 1, parts);
    } else {
        refuse_type(phase, "blendphase, hg, isotropic, rayleigh, tabphase");
    }
    phase.warn_of_unused();
}

using Floats = std::vector<float>;

void set_mixture(std::span<const Part> parts, Parameters& medium) {
    // Mixtures end before single functions do.
    constexpr double sharpest = 0.99;
    Floats g, weights;
    for (const Part& part : parts) {
        g.push_back(static_cast<float>(std::clamp(part.g, -sharpest, sharpest)));
        weights.push_back(static_cast<float>(part.share));
    }
    medium.text("phase", "henyeygreensteinmixture")
        .add(pbrt::ParameterType::real, "g", std::move(g))
        .add(pbrt::ParameterType::real, "weights", std::move(weights));
}

/// Angles in degrees: the nodes of the tables, and such that other functions are smooth between them.
Floats nodes_of(std::span<const Part> parts) {
    constexpr double fine = 0.02, coarse = 0.25, end_of_fine = 5;
    const auto is_table = [](const Part& part) { return part.kind == Part::Kind::table; };
    Floats angles{0, 180};
    if (!std::all_of(parts.begin(), parts.end(), is_table)) {
        for (double angle = fine; angle < 180;
             angle += angle < end_of_fine || angle > 180 - end_of_fine ? fine : coarse) {
            angles.push_back(static_cast<float>(angle));
        }
    }
    for (const Part& part : parts) {
        for (std::size_t i = 1; i + 1 < part.values.size(); ++i) {
            const double cosine = 2 * static_cast<double>(i) / static_cast<double>(part.values.size() - 1) - 1;
            angles.push_back(static_cast<float>(std::acos(cosine) * 180 / double{pi}));
        }
    }
    std::sort(angles.begin(), angles.end());
    // What is closer together has one cosine in single precision.
    constexpr float closest = 1e-3f;
    Floats apart{0};
    for (const float angle : angles) {
        if (angle > apart.back() + closest && (angle == 180 || angle < 180 - closest)) {
            apart.push_back(angle);
        }
    }
    return apart;
}

void set_table(std::span<const Part> parts, Parameters& medium) {
    Floats angles = nodes_of(parts), values;
    for (const float angle : angles) {
        double value = 0;
        for (const Part& part : parts) {
            value += part.share * part.evaluate(std::cos(double{angle} * double{pi} / 180));
        }
        values.push_back(static_cast<float>(value));
    }
    medium.text("phase", "tabulated")
        .add(pbrt::ParameterType::real, "angles", std::move(angles))
        .add(pbrt::ParameterType::real, "values", std::move(values));
}

}  // namespace

void set_phase(Context& context, const Element* phase, Parameters& medium) {
    std::vector<Part> parts;
    if (phase) {
        collect(context, *phase, 1, 0, parts);
    } else {
        parts.push_back({});
    }
    std::erase_if(parts, [](const Part& part) { return !(part.share > 0); });
    const bool are_lobes = std::all_of(parts.begin(), parts.end(),
                                       [](const Part& part) { return part.kind == Part::Kind::henyey_greenstein; });
    constexpr std::size_t most_lobes = 4;
    if (parts.size() == 1 && parts.front().kind == Part::Kind::rayleigh) {
        medium.text("phase", "rayleigh");
    } else if (parts.size() == 1 && are_lobes) {
        medium.real("g", parts.front().g);
    } else if (are_lobes && parts.size() <= most_lobes) {
        set_mixture(parts, medium);
    } else {
        set_table(parts, medium);
    }
}

}  // namespace wend::mitsuba
