// What `wend halfspace` and `wend slab` share on the command line.
#pragma once

#include <wend/app/options.h>
#include <wend/lab/lab.h>

#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace wend {

/// An experiment of the planar laboratory as the command line describes it. Ranges are the laboratory's to check; here
/// a number need only be finite.
struct PlanarOptions {
    CommonOptions common;
    PlanarExperiment experiment;
    std::uint64_t walks = PlanarRun{}.walks;

    /// Adds all options but those of one command only. The object must outlive the command.
    void add_to(CLI::App& command);
    /// Adds what only a slab has: its thickness and the side that is lit.
    void add_slab_to(CLI::App& command);

    PlanarRun run() const;
};

/// An adjoint of one's own, a row each mode: length, amplitudes at the near and at the far side, and one or more
/// Legendre coefficients of its shape (PlanarModes). Throws InputError for shorter rows; what else is wrong with it is
/// for the experiment to say.
PlanarModes planar_adjoint(const std::vector<std::vector<double>>& rows);

/// The experiment and the run as the "settings" key of results has them.
nlohmann::json planar_settings(const PlanarExperiment& experiment, const PlanarRun& run);

/// The sampler with the options that matter to it, such as "modes, 8 transients".
std::string sampler_text(const PlanarExperiment& experiment);

}  // namespace wend
