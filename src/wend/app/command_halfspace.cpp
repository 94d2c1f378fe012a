#include <wend/app/commands.h>
#include <wend/app/halfspace_report.h>
#include <wend/app/planar_options.h>
#include <wend/app/planar_report.h>
#include <wend/core/error.h>

#include <CLI/CLI.hpp>

#include <memory>

namespace wend {
namespace {

struct HalfspaceOptions {
    PlanarOptions planar;
    bool table = false;
    std::string folder = "halfspace";
};

void refuse_what_the_table_varies(const CLI::App& command) {
    for (const char* varied : {"--albedo", "--extinction", "--sampler", "--stretch", "--first-flight", "--exponentials",
                               "--moments", "--modes", "--adjoint", "--guide-albedo"}) {
        if (command.count(varied) > 0) {
            throw InputError(std::string("--table runs all samplers at albedos of its own: leave out ") + varied);
        }
    }
}

}  // namespace

Action add_halfspace_command(CLI::App& program) {
    const auto options = std::make_shared<HalfspaceOptions>();
    CLI::App& command = *program.add_subcommand(
        "halfspace", "walks in an endlessly deep medium under a uniform sky, against the exact answer");
    options->planar.add_to(command);
    CLI::Option* table =
        command.add_flag("--table", options->table, "compare all samplers at five albedos, with plots and a page");
    command.add_option("--out", options->folder, "folder for the plots and index.html of --table")
        ->needs(table)
        ->capture_default_str();
    command.footer(
        "Examples: how bright is a medium that scatters 80 % of what it meets, and how noisy is the estimate?\n"
        "  wend halfspace --albedo 0.8 --sampler classical --walks 1e6\n"
        "  wend halfspace --albedo 0.8 --sampler modes --walks 1e6\n"
        "  wend halfspace --table --out halfspace");
    return [options, &command](const Streams& streams) {
        const PlanarOptions& planar = options->planar;
        if (options->table) {
            refuse_what_the_table_varies(command);
            report_halfspace_table(planar.experiment, planar.run(), options->folder, planar.common, streams);
        } else {
            report_planar(planar.experiment, planar.run(), planar.common, streams);
        }
    };
}

}  // namespace wend
