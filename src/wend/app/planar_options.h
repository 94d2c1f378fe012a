// What `wend halfspace` and `wend slab` share on the command line.
#pragma once

#include <wend/app/options.h>
#include <wend/lab/lab.h>

#include <string>

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

/// The experiment and the run as the "settings" key of results has them.
nlohmann::json planar_settings(const PlanarExperiment& experiment, const PlanarRun& run);

/// The sampler with the options that matter to it, such as "modes, 8 transients".
std::string sampler_text(const PlanarExperiment& experiment);

}  // namespace wend
