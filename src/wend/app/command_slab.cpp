#include <wend/app/commands.h>
#include <wend/app/planar_options.h>
#include <wend/app/planar_report.h>

#include <CLI/CLI.hpp>

#include <memory>

namespace wend {

Action add_slab_command(CLI::App& program) {
    const auto options = std::make_shared<PlanarOptions>();
    CLI::App& command = *program.add_subcommand(
        "slab", "walks through a layer lit by a uniform sky from one side, against the exact answer");
    options->add_to(command);
    options->add_slab_to(command);
    command.footer(
        "Example: how much light gets through ten mean free paths?\n"
        "  wend slab --albedo 0.8 --thickness 10 --tally transmittance --sampler modes --walks 1e6\n"
        "The same with --sampler analog shows what that costs without guiding.");
    return [options](const Streams& streams) {
        report_planar(options->experiment, options->run(), options->common, streams);
    };
}

}  // namespace wend
