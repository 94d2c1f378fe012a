#include <wend/app/commands.h>
#include <wend/app/reference.h>
#include <wend/core/error.h>
#include <wend/film/flip.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <ostream>

namespace wend {
namespace {

struct MetricOptions {
    CommonOptions common;
    std::string reference;
    std::vector<std::string> images;
};

void print_metrics(const MetricOptions& options, const Streams& streams) {
    const Reference reference = read_reference(options.reference);
    const Image average = reference.average();
    nlohmann::json rows = nlohmann::json::array();
    std::size_t width = 5;
    for (const std::string& name : options.images) {
        width = std::max(width, name.size());
    }
    std::string table = fmt::format("{:<{}}  {:>11}  {:>11}  {:>11}  {:>11}  {:>7}\n", "image", width, "relMSE",
                                    "trimmed", "MSE", "MAPE", "FLIP");
    for (const std::string& name : options.images) {
        try {
            const Image image = read_image(name);
            const Metrics m = measure(image, reference);
            const double difference = flip(image, average).mean;
            rows.push_back({{"image", name},
                            {"relmse", json_number(m.relmse)},
                            {"relmse_trimmed", json_number(m.relmse_trimmed)},
                            {"mse", json_number(m.mse)},
                            {"mape", json_number(m.mape)},
                            {"flip", json_number(difference)}});
            table += fmt::format("{:<{}}  {:>11.5g}  {:>11.5g}  {:>11.5g}  {:>11.5g}  {:>7.4f}\n", name, width,
                                 m.relmse, m.relmse_trimmed, m.mse, m.mape, difference);
        } catch (const InputError& e) {
            const std::string what = e.what();
            throw InputError(what.find(name) != std::string::npos ? what : name + ": error: " + what);
        }
    }
    if (options.common.json != "-") {
        streams.out << table << std::flush;
    }
    options.common.write_json(streams, {{"reference", options.reference}, {"rows", std::move(rows)}});
}

}  // namespace

Action add_metric_command(CLI::App& program) {
    const auto options = std::make_shared<MetricOptions>();
    CLI::App& command =
        *program.add_subcommand("metric", "measure pictures against a reference: relMSE, MSE, MAPE, FLIP");
    command
        .add_option("reference", options->reference,
                    "reference: a picture, or NAME of the pair NAME.ref-a.exr, NAME.ref-b.exr")
        ->required();
    command.add_option("images", options->images, "pictures to measure")->required();
    options->common.add_to(command);
    return [options](const Streams& streams) { print_metrics(*options, streams); };
}

}  // namespace wend
