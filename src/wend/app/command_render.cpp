#include <wend/app/commands.h>
#include <wend/app/comparison.h>
#include <wend/app/interrupt.h>
#include <wend/app/mpi_ranks.h>
#include <wend/app/session.h>
#include <wend/app/watched_render.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/field_file.h>
#include <wend/io/image_file.h>
#include <wend/io/records_file.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <memory>

namespace wend {
namespace {

constexpr int most_samples = 1 << 30;

struct RenderOptions {
    CommonOptions common;
    SceneOptions scene;
    WatchOptions watch;
    std::string output;
    int samples = 0;
    double seconds = 0;
    double noise = 0;
    std::string sampling = "full";
    std::string subsurface = "auto";
    std::optional<std::string> passes;
    std::string load_field, save_field, save_records;
    bool half = false;
};

std::vector<int> parse_passes(const std::string& text) {
    std::vector<int> passes;
    std::int64_t total = 0;
    for (const std::string& part : split_list(text)) {
        int n = 0;
        const auto result = std::from_chars(part.data(), part.data() + part.size(), n);
        if (result.ec != std::errc() || result.ptr != part.data() + part.size() || n <= 0) {
            throw InputError("--passes " + text +
                             ": expected positive numbers of samples per pixel, separated by commas");
        }
        passes.push_back(n);
        total += n;
    }
    if (total > most_samples) {
        throw InputError(fmt::format("--passes {}: more than {} samples per pixel", text, most_samples));
    }
    return passes;
}

/// Where the picture goes if nobody says: the scene's own file name, in the current folder. Throws InputError where
/// that cannot be written.
std::filesystem::path default_output(const Session& session) {
    std::filesystem::path name = std::filesystem::path(session.film_file()).filename();
    if (name.empty() || !is_known_picture_extension(name)) {
        name = std::filesystem::path(session.scene_file()).stem();
        name += ".exr";
    }
    require_writable_picture(name);
    return name;
}

/// Refuses what cannot be written or does not go together, before anything takes time.
void check(const RenderOptions& options, const Preset& preset) {
    if (!options.output.empty()) {
        require_writable_picture(options.output);
    }
    if (options.half) {
        require_exr_extension(options.output);
    }
    if (preset.is_classical() &&
        !(options.load_field.empty() && options.save_field.empty() && options.save_records.empty())) {
        throw InputError(
            "--load-field, --save-field and --save-records: classical sampling has no field; give --sampling, such as "
            "direction");
    }
    for (const std::string& file : {options.save_field, options.save_records}) {
        if (!file.empty()) {
            require_writable(file);
        }
    }
    options.watch.check();
}

/// The paths that are written differ, and are not read.
void check_paths(const RenderOptions& options, const std::string& output) {
    require_distinct({options.scene.file, options.load_field},
                     {output, options.common.json, options.save_field, options.save_records, options.watch.checkpoint,
                      options.watch.progress_file});
    require_distinct({options.watch.resume}, {output, options.common.json, options.save_field, options.save_records,
                                              options.watch.progress_file});
}

void warn_of_lacks(const RenderStatistics& statistics, std::ostream& err) {
    if (statistics.samples == 0) {
        err << "warning: the render was stopped before all pixels had a sample: the others are black\n";
    }
    if (statistics.counts.rejected > 0) {
        err << "warning: " << statistics.counts.rejected << " samples were not finite numbers and count as black\n";
    }
}

nlohmann::json report(const Session& session, const RenderSettings& settings, const RenderStatistics& statistics,
                      const std::filesystem::path& output) {
    nlohmann::json described = session.describe(settings);
    described["passes"] = statistics.passes;
    described["output"] = output.string();
    nlohmann::json told = {{"spp", statistics.samples},
                           {"seconds", statistics.seconds},
                           {"training_seconds", statistics.training_seconds},
                           {"paths", statistics.counts.paths},
                           {"segments", statistics.counts.segments},
                           {"guiding", kinds_json(statistics.kinds)},
                           {"field_bytes", statistics.field_bytes},
                           {"rejected_samples", statistics.counts.rejected},
                           {"interrupted", statistics.interrupted},
                           {"settings", std::move(described)}};
    if (statistics.ranks > 1) {
        told["ranks"] = statistics.ranks;
        told["waiting_seconds"] = statistics.waiting_seconds;
        told["bytes_per_pass"] = statistics.bytes_sent / std::max<std::size_t>(1, statistics.passes.size());
    }
    return told;
}

void render_scene(RenderOptions options, const Streams& streams) {
    const std::unique_ptr<Ranks> ranks = ranks_of_job();
    const bool is_first = !ranks || ranks->rank() == 0;
    options.common.quiet = options.common.quiet || !is_first;
    const Preset preset = parse_preset(options.sampling);
    const SubsurfacePreset subsurface = parse_subsurface(options.subsurface);
    const std::vector<int> passes = options.passes ? parse_passes(*options.passes) : std::vector<int>();
    check(options, preset);
    check_paths(options, options.output);
    std::shared_ptr<const guide::Fields> fields;
    if (!options.load_field.empty()) {
        fields = std::make_shared<const guide::Fields>(read_fields(options.load_field));
    }
    const Session session(options.scene, options.common, streams);
    const std::filesystem::path output =
        options.output.empty() ? default_output(session) : std::filesystem::path(options.output);
    check_paths(options, output.string());

    RenderSettings settings = session.settings();
    settings.preset = preset;
    settings.subsurface = subsurface;
    settings.fields = std::move(fields);
    if (options.samples > 0) {
        settings.samples = options.samples;
    } else if (options.noise > 0) {
        settings.samples = most_samples;
    }
    settings.noise = options.noise;
    settings.ranks = ranks.get();
    settings.seconds = options.seconds;
    settings.passes = passes;
    RecordSamples records;
    settings.keeps_fields = !options.save_field.empty() || !options.save_records.empty();
    if (!options.save_records.empty()) {
        settings.on_records = [&](std::span<const guide::PathRecords> told) { records.add(told); };
    }

    Film film = session.new_film();
    const InterruptGuard interrupt;
    settings.stop = &interrupt.flag();
    const auto write = [&](const RenderStatistics& statistics) {
        (options.half ? write_colours : write_picture)(output, session.picture(film, settings, statistics));
    };
    const RenderStatistics statistics =
        watched_render(session, film, settings, options.watch, options.common, streams, write);
    if (!is_first) {
        return;
    }
    if (!options.save_field.empty()) {
        write_fields(options.save_field, *statistics.fields);
    }
    if (!options.save_records.empty()) {
        write_records(options.save_records, records);
    }
    options.common.note(streams, fmt::format("{}: {} spp in {:.2f} s{}", output.string(), statistics.samples,
                                             statistics.seconds, statistics.interrupted ? " (interrupted)" : ""));
    warn_of_lacks(statistics, streams.err);
    options.common.write_json(streams, report(session, settings, statistics, output));
    if (interrupt.signal() != 0) {
        throw EndedBySignal{interrupt.signal()};
    }
}

}  // namespace

Action add_render_command(CLI::App& program) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App& command = *program.add_subcommand("render", "render a pbrt-v4 scene");
    options->scene.add_to(command);
    CLI::Option* output = command.add_option(
        "-o,--output", options->output,
        "picture to write: .exr with layers and metadata, .png or .jpg (default: the scene's file name)");
    command
        .add_flag("--half", options->half,
                  "write the colours alone, in half floats, as references are kept (to an .exr file)")
        ->needs(output);
    CLI::Option* samples = command.add_option("--spp", options->samples, "samples per pixel (default: the scene's)");
    CLI::Option* seconds = command.add_option("--time", options->seconds, "seconds to spend, training included");
    command
        .add_option("--noise", options->noise,
                    "render until the estimated relative noise of the picture is this, such as 0.02 for 2 %; --spp and "
                    "--time end it earlier")
        ->check(CLI::PositiveNumber);
    CLI::Option* passes = command.add_option("--passes", options->passes,
                                             "repeat these passes of an earlier run (settings.passes of its --json)");
    samples->check(CLI::Range(1, most_samples))->excludes(seconds)->excludes(passes);
    seconds->check(seconds_problem)->excludes(passes);
    command.add_option(
        "--sampling", options->sampling,
        "classical; full: whatever pays, where it pays; or the decisions to guide everywhere, joined by '+': " +
            guidable_decisions_text() + " (default: full)");
    command
        .add_option("--subsurface", options->subsurface,
                    "walks inside dense homogeneous media: " + subsurface_names() + "; default: auto")
        ->capture_default_str();
    command.add_option("--save-field", options->save_field, "write what was learned to this file (see 'wend field')");
    CLI::Option* save_records =
        command.add_option("--save-records", options->save_records,
                           "write a sample of what the field learned from to this file (for 'wend field --records')");
    CLI::Option* load_field = command.add_option("--load-field", options->load_field,
                                                 "go on with what an earlier render of the scene learned");
    options->watch.add_to(command);
    command.get_option("--resume")->excludes(load_field)->excludes(save_records);
    options->common.add_to(command);
    return [options](const Streams& streams) { render_scene(*options, streams); };
}

}  // namespace wend
