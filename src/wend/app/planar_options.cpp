#include <wend/app/planar_options.h>

#include <wend/core/error.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <utility>

namespace wend {
namespace {

template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

// Sums are kept for blocks of walks, which need some memory.
constexpr double most_walks = 1e10;

const Choices<Tally> tallies = {{"reflectance", Tally::reflectance}, {"transmittance", Tally::transmittance}};
const Choices<std::optional<double>> incidences = {{"normal", 1.0}, {"diffuse", std::nullopt}};
const Choices<FirstFlight> first_flights = {{"stretched", FirstFlight::stretched},
                                            {"classical", FirstFlight::classical}};
const Choices<int> exponentials = {{"1", 1}, {"2", 2}};
const Choices<MatchedMoments> moments = {{"01", MatchedMoments::zeroth_first}, {"12", MatchedMoments::first_second}};
const Choices<PlanarWindow> windows = {
    {"none", PlanarWindow::none}, {"adjoint", PlanarWindow::adjoint}, {"weight", PlanarWindow::weight}};

Choices<std::string> samplers() {
    Choices<std::string> result;
    for (const std::string& name : planar_samplers()) {
        result.emplace_back(name, name);
    }
    return result;
}

template <class T>
std::string names(const Choices<T>& choices, const char* separator) {
    std::string text;
    for (const auto& [name, value] : choices) {
        text += (text.empty() ? "" : separator) + name;
    }
    return text;
}

/// The name of a value; empty for one that has none.
template <class T>
std::string name_of(const Choices<T>& choices, const T& value) {
    for (const auto& [name, other] : choices) {
        if (other == value) {
            return name;
        }
    }
    return {};
}

/// An option that takes one of a few names.
template <class T>
CLI::Option* add_choice(CLI::App& command, const std::string& option, const Choices<T>& choices, T& value,
                        const std::string& help) {
    const auto choose = [&value, choices, option](const std::string& given) {
        for (const auto& [name, choice] : choices) {
            if (name == given) {
                value = choice;
                return;
            }
        }
        throw InputError(fmt::format("{} '{}': expected one of {}", option, given, names(choices, ", ")));
    };
    return command.add_option_function<std::string>(option, choose, help)
        ->type_name(names(choices, "|"))
        ->default_str(name_of(choices, value));
}

/// A number from text. Throws InputError for anything that is not finite.
double finite_number(const std::string& option, const std::string& text) {
    double value = 0;
    if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value)) {
        throw InputError(fmt::format("{} '{}': expected a number", option, text));
    }
    return value;
}

/// An option that takes a finite number; `value` is a double or an optional one.
template <class T>
CLI::Option* add_number(CLI::App& command, const std::string& option, T& value, const std::string& help) {
    const auto set = [&value, option](const std::string& text) { value = finite_number(option, text); };
    return command.add_option_function<std::string>(option, set, help)->type_name("NUMBER");
}

/// An option that takes one number, or three for three channels.
CLI::Option* add_channels(CLI::App& command, const std::string& option, std::vector<double>& values,
                          const std::string& help) {
    const auto set = [&values, option](const std::string& text) {
        std::vector<double> numbers;
        for (const std::string& part : split_list(text)) {
            numbers.push_back(finite_number(option, part));
        }
        if (numbers.size() != 1 && numbers.size() != 3) {
            throw InputError(fmt::format("{} '{}': expected one number, or three separated by commas", option, text));
        }
        values = std::move(numbers);
    };
    return command.add_option_function<std::string>(option, set, help)->type_name("NUMBER[,NUMBER,NUMBER]");
}

/// Lines of numbers with commas between them; empty ones and those that begin with # are left out.
std::vector<std::vector<double>> read_rows(const std::string& file) {
    std::ifstream lines(file);
    if (!lines) {
        throw InputError({file}, "cannot be read");
    }
    constexpr std::size_t most_rows = 1000;
    std::vector<std::vector<double>> rows;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.empty() || line[0] == '#') {
            continue;
        }
        const Place place{file, number};
        if (rows.size() == most_rows) {
            throw InputError(place, fmt::format("more than {} rows", most_rows));
        }
        rows.emplace_back();
        for (const std::string& part : split_list(line)) {
            double value = 0;
            if (!CLI::detail::lexical_cast(part, value)) {
                throw InputError(place, fmt::format("'{}' is no number", part));
            }
            rows.back().push_back(value);
        }
    }
    return rows;
}

void add_medium(CLI::App& command, PlanarExperiment& e) {
    const char* group = "Medium";
    add_channels(command, "--albedo", e.albedo,
                 "fraction of collisions that scatter, 0 to 1; three for a chromatic medium")
        ->default_str("0.8")
        ->group(group);
    add_channels(command, "--extinction", e.extinction, "collisions per length of each channel, relative to the first")
        ->default_str("1")
        ->group(group);
    add_number(command, "--g", e.g, "mean cosine of the scattering angle (Henyey-Greenstein), -0.95 to 0.95")
        ->default_str("0")
        ->group(group);
    add_number(command, "--ior", e.ior, "refractive index, inside over outside, 1 to 3")
        ->default_str("1")
        ->group(group);
    add_number(command, "--roughness", e.roughness, "roughness alpha of the boundary (GGX), with --ior above 1")
        ->default_str("0")
        ->group(group);
}

void add_incidence(CLI::App& command, PlanarExperiment& e) {
    CLI::Option* cosine =
        add_number(command, "--mu0", e.mu0, "cosine to the normal at which walks enter, above 0 and up to 1");
    cosine->group("Walk");
    add_choice(command, "--incidence", incidences, e.mu0, "how walks enter; diffuse is cosine-weighted")
        ->excludes(cosine)
        ->group("Walk");
}

void add_sampler(CLI::App& command, PlanarExperiment& e) {
    const char* group = "Sampler";
    add_choice(command, "--sampler", samplers(), e.sampler, "how walks are sampled")->group(group);
    add_number(command, "--stretch", e.stretch,
               "of 'stretched': how much paths stretch toward the target, below 1 (default: by the medium)")
        ->group(group);
    add_choice(command, "--first-flight", first_flights, e.first_flight, "of 'dwivedi': the flight after entry")
        ->group(group);
    add_choice(command, "--exponentials", exponentials, e.exponentials, "of 'boundary': how many it keeps")
        ->group(group);
    add_choice(command, "--moments", moments, e.moments,
               "of 'boundary' with one exponential: which moments of the true fluence it has")
        ->group(group);
    command.add_option("--modes", e.modes, "of 'modes': transients beside the discrete mode (2 to 32 are usual)")
        ->capture_default_str()
        ->group(group);
    add_number(command, "--guide-albedo", e.guide_albedo, "guide as if the albedo were this one (grey media)")
        ->group(group);
    const auto set_adjoint = [&e](const std::string& file) { e.adjoint = planar_adjoint(read_rows(file)); };
    command
        .add_option_function<std::string>(
            "--adjoint", set_adjoint,
            "of 'modes': an adjoint of your own, a line each mode, longest first: its length, amplitudes at the near "
            "and the far side, and Legendre coefficients of its shape")
        ->type_name("FILE")
        ->group(group);
    add_choice(command, "--window", windows, e.window,
               "roulette and splitting by weight times adjoint, or by the weight alone")
        ->group(group);
}

}  // namespace

void PlanarOptions::add_to(CLI::App& command) {
    add_medium(command, experiment);
    add_incidence(command, experiment);
    add_sampler(command, experiment);
    const auto set_walks = [this](const std::string& text) {
        const double number = finite_number("--walks", text);
        if (!(number >= 1 && number <= most_walks) || number != std::floor(number)) {
            throw InputError(fmt::format("--walks '{}': expected a whole number from 1 to {:g}", text, most_walks));
        }
        walks = static_cast<std::uint64_t>(number);
    };
    command.add_option_function<std::string>("--walks", set_walks, "how many walks to take")
        ->type_name("COUNT")
        ->default_str(std::to_string(walks));
    common.add_to(command);
}

void PlanarOptions::add_slab_to(CLI::App& command) {
    add_number(command, "--thickness", experiment.thickness, "thickness in mean free paths")
        ->required()
        ->group("Medium");
    add_choice(command, "--tally", tallies, experiment.tally, "what comes back, or what gets through")->group("Walk");
}

PlanarRun PlanarOptions::run() const {
    return {walks, common.seed.value_or(0), common.threads};
}

PlanarModes planar_adjoint(const std::vector<std::vector<double>>& rows) {
    constexpr std::size_t before_shape = 3;
    PlanarModes modes;
    for (const std::vector<double>& row : rows) {
        if (row.size() <= before_shape) {
            throw InputError(fmt::format(
                "mode {} of the adjoint: {} numbers, expected length, two amplitudes, and a shape of one or more",
                modes.modes.size() + 1, row.size()));
        }
        modes.modes.push_back({row[0], row[1], row[2], {row.begin() + before_shape, row.end()}});
    }
    return modes;
}

nlohmann::json planar_settings(const PlanarExperiment& e, const PlanarRun& run) {
    const std::string incidence = name_of(incidences, e.mu0);
    nlohmann::json adjoint(nullptr);
    if (e.adjoint) {
        for (const PlanarModes::Mode& mode : e.adjoint->modes) {
            adjoint.push_back({json_number(mode.length), mode.near, mode.far});
            for (const double coefficient : mode.shape) {
                adjoint.back().push_back(coefficient);
            }
        }
    }
    return {{"albedo", e.albedo},
            {"extinction", e.extinction},
            {"g", e.g},
            {"ior", e.ior},
            {"roughness", e.roughness},
            {"thickness", json_number(e.thickness)},
            {"tally", name_of(tallies, e.tally)},
            {"incidence", incidence.empty() ? "oblique" : incidence},
            {"mu0", e.mu0 ? nlohmann::json(*e.mu0) : nlohmann::json(nullptr)},
            {"sampler", e.sampler},
            {"stretch", e.stretch ? nlohmann::json(*e.stretch) : nlohmann::json(nullptr)},
            {"first_flight", name_of(first_flights, e.first_flight)},
            {"exponentials", e.exponentials},
            {"moments", name_of(moments, e.moments)},
            {"modes", e.modes},
            {"adjoint", adjoint},
            {"guide_albedo", e.guide_albedo ? nlohmann::json(*e.guide_albedo) : nlohmann::json(nullptr)},
            {"window", name_of(windows, e.window)},
            {"seed", run.seed},
            {"threads", run.threads}};
}

std::string sampler_text(const PlanarExperiment& e) {
    if (e.sampler == "stretched" && e.stretch) {
        return fmt::format("stretched by {:g}", *e.stretch);
    }
    if (e.sampler == "dwivedi" && e.first_flight == FirstFlight::classical) {
        return "dwivedi, first flight classical";
    }
    if (e.sampler == "boundary") {
        return e.exponentials == 2                         ? "boundary, 2 exponentials"
               : e.moments == MatchedMoments::zeroth_first ? "boundary, moments 0 and 1"
                                                           : "boundary, moments 1 and 2";
    }
    if (e.adjoint) {
        return fmt::format("modes, {} of one's own", e.adjoint->modes.size());
    }
    return e.sampler == "modes" ? fmt::format("modes, {} transients", e.modes) : e.sampler;
}

}  // namespace wend
