#include <wend/app/planar_options.h>
#include <wend/app/planar_report.h>
#include <wend/core/error.h>

#include "bindings.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace wend::python {
namespace {

/// Runs one experiment, described by the options of `wend halfspace`, or of `wend slab`; the result is its JSON. An
/// adjoint of one's own comes as the rows of planar_adjoint().
std::string run_experiment(std::vector<std::string> options, bool slab,
                           const std::optional<std::vector<std::vector<double>>>& adjoint) {
    const nb::gil_scoped_release release;
    CLI::App command;
    PlanarOptions planar;
    planar.add_to(command);
    if (slab) {
        planar.add_slab_to(command);
    }
    try {
        std::reverse(options.begin(), options.end());
        command.parse(options);
    } catch (const CLI::ParseError& error) {
        throw InputError(error.what());
    }
    if (adjoint) {
        planar.experiment.adjoint = planar_adjoint(*adjoint);
    }
    PlanarRun run = planar.run();
    run.watch = let_signals_arrive();
    return planar_json(planar.experiment, run, run_planar(planar.experiment, run)).dump();
}

}  // namespace

void bind_laboratory(nb::module_& module) {
    module.def("run_experiment", &run_experiment, nb::arg("options"), nb::arg("slab"), nb::arg("adjoint").none());
    module.def("planar_samplers", &planar_samplers);
}

}  // namespace wend::python
