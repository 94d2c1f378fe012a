#include <wend/app/commands.h>
#include <wend/app/reference.h>
#include <wend/app/text_table.h>
#include <wend/core/error.h>
#include <wend/film/flip.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

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
    std::vector<std::string> inputs = options.images;
    inputs.push_back(options.reference);
    require_distinct(inputs, {options.common.json});
    const Reference reference = read_reference(options.reference).halves;
    const Image average = reference.average();
    nlohmann::json rows = nlohmann::json::array();
    std::vector<std::vector<std::string>> table = {{"image", "relMSE", "trimmed", "99.99 %", "MSE", "MAPE", "FLIP"}};
    for (const std::string& name : options.images) {
        try {
            const Image image = read_image(name);
            const Metrics m = measure(image, reference);
            const double difference = flip(image, average).mean;
            rows.push_back({{"image", name},
                            {"relmse", json_number(m.relmse)},
                            {"relmse_trimmed", json_number(m.relmse_trimmed)},
                            {"error_p9999", json_number(m.error_p9999)},
                            {"mse", json_number(m.mse)},
                            {"mape", json_number(m.mape)},
                            {"flip", json_number(difference)}});
            table.push_back({name, fmt::format("{:.5g}", m.relmse), fmt::format("{:.5g}", m.relmse_trimmed),
                             fmt::format("{:.5g}", m.error_p9999), fmt::format("{:.5g}", m.mse),
                             fmt::format("{:.5g}", m.mape), fmt::format("{:.4f}", difference)});
        } catch (const InputError& e) {
            const std::string what = e.what();
            throw InputError(what.find(name) != std::string::npos ? what : name + ": error: " + what);
        }
    }
    if (options.common.json != "-") {
        streams.out << text_table(table) << std::flush;
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
