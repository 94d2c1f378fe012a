#include <wend/app/checkpoint.h>
#include <wend/app/commands.h>
#include <wend/app/comparison_data.h>
#include <wend/app/denoiser.h>
#include <wend/app/extra_layers.h>
#include <wend/app/frames.h>
#include <wend/app/interrupt.h>
#include <wend/app/mpi_ranks.h>
#include <wend/app/render_series.h>
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
#include <optional>
#include <utility>

namespace wend {
namespace {

using FieldsPointer = std::shared_ptr<const guide::Fields>;

/// What the texts of the options mean.
struct RenderPlan {
    Preset preset;
    SubsurfacePreset subsurface;
    std::vector<int> passes;
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
    if (total > RenderSettings::most_samples) {
        throw InputError(
            fmt::format("--passes {}: more than {} samples per pixel", text, RenderSettings::most_samples));
    }
    return passes;
}

std::vector<std::string> asked_layers(const RenderOptions& options) {
    return options.layers.empty() ? std::vector<std::string>() : split_list(options.layers);
}

/// Those that are asked for, and what the picture is denoised best with. A render that goes on has the latter if it
/// began with it.
std::vector<std::string> layers_of(const RenderOptions& options, const Scene& scene) {
    std::vector<std::string> names = asked_layers(options);
    if (!options.denoise || scene.media().empty()) {
        return names;
    }
    if (!options.watch.resume.empty()) {
        const std::vector<std::string> before = layers_in_checkpoint(options.watch.resume);
        if (std::find(before.begin(), before.end(), layer_of_media) == before.end()) {
            return names;
        }
    }
    if (std::find(names.begin(), names.end(), layer_of_media) == names.end()) {
        names.emplace_back(layer_of_media);
    }
    return names;
}

/// Throws InputError for what is wrong whatever the scene.
RenderPlan plan_of(const RenderOptions& options) {
    options.scene.check();
    Preset preset = parse_preset(options.sampling);
    preset.adaptive = options.adaptive.empty() ? preset.adaptive : options.adaptive == "on";
    return {preset, parse_subsurface(options.subsurface),
            options.passes ? parse_passes(*options.passes) : std::vector<int>()};
}

/// What is wrong with --noise; empty: nothing. CLI::PositiveNumber would let NaN pass, which asks for nothing.
std::string noise_problem(const std::string& text) {
    double noise = 0;
    const bool fits = CLI::detail::lexical_cast(text, noise) && noise > 0 && noise <= 1e9;
    return fits ? "" : "'" + text + "' is not a relative noise, such as 0.02";
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
    if (preset.is_classical() && (options.carry_field || !(options.load_field.empty() && options.save_field.empty() &&
                                                           options.save_records.empty()))) {
        throw InputError(
            "--load-field, --save-field, --save-records and --carry-field: classical sampling has no field; give "
            "--sampling, such as direction");
    }
    for (const std::string& file : {options.save_field, options.save_records}) {
        if (!file.empty()) {
            require_writable(file);
        }
    }
    check_extra_layers(asked_layers(options));
    options.watch.check();
}

/// Says which options do nothing, since the picture has colours of eight bits alone.
void note_options_of_no_use(const RenderOptions& options, const std::filesystem::path& output, const Streams& streams) {
    std::string names;
    for (const auto& [name, is_given] :
         {std::pair("--layers", !options.layers.empty()), std::pair("--alpha", options.picture.alpha),
          std::pair("--exr half", options.picture.format().half)}) {
        names += is_given ? (names.empty() ? "" : ", ") + std::string(name) : "";
    }
    if (!names.empty() && !is_exr_name(output)) {
        options.common.note(streams,
                            fmt::format("{}: note: only an .exr has what {} asks for", output.string(), names));
    }
}

void check_paths(const RenderOptions& options, const std::string& output) {
    RenderPaths paths;
    paths.add(options, output);
    paths.check();
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
                      const std::filesystem::path& output, std::uint64_t memory_of_rank) {
    nlohmann::json described = session.describe(settings);
    described["passes"] = statistics.passes;
    described["output"] = output.string();
    nlohmann::json results = {{"spp", statistics.samples},
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
        results["ranks"] = statistics.ranks;
        results["waiting_seconds"] = statistics.waiting_seconds;
        results["bytes_per_rank"] = memory_of_rank;
        results["bytes_per_pass"] = statistics.bytes_sent / std::max<std::size_t>(1, statistics.passes.size());
    }
    return results;
}

/// What a file of fields has for a scene. Fields of another one steer walks all the same; what is noted of its pixels
/// and lights would mislead.
FieldsPointer fields_for(const Session& session, SavedFields saved, const RenderOptions& options,
                         const Streams& streams) {
    const bool is_of_scene = saved.scene.empty() || saved.scene == digest_of(session.files());
    if (!is_of_scene && !saved.fields.notes.empty()) {
        options.common.note(streams, options.load_field +
                                         ": was learned in another scene, or before this one changed: the fields are "
                                         "taken, but not what is noted of pixels, lights and techniques");
        saved.fields.notes.clear();
    }
    return std::make_shared<const guide::Fields>(std::move(saved.fields));
}

/// Whether this process is the one that tells and writes.
bool is_first_of(const Ranks* ranks) {
    return !ranks || ranks->rank() == 0;
}

/// What there is to say of a render that ended before its last pass did. Whoever gave a time and did not stop it need
/// not think of an interruption.
const char* early_end(const RenderSettings& settings, const RenderStatistics& statistics, int signal) {
    if (!statistics.interrupted) {
        return "";
    }
    return settings.seconds > 0 && signal == 0 ? " (time was up within a pass)" : " (interrupted)";
}

/// Renders one picture; what was learned comes back. `fields` is what is known before, if not null; `ranks` are the
/// processes that render it together, null for one alone.
FieldsPointer render_scene(const RenderOptions& options, const Streams& streams, Ranks* ranks,
                           FieldsPointer fields = nullptr) {
    const RenderPlan plan = plan_of(options);
    check(options, plan.preset);
    check_paths(options, options.output);
    std::optional<SavedFields> saved;
    // A checkpoint has what its render began with, and what it has learned since.
    if (!fields && !options.load_field.empty() && options.watch.resume.empty()) {
        saved = read_saved_fields(options.load_field);
    }
    const Session session(options.scene, options.common, streams);
    if (saved) {
        fields = fields_for(session, std::move(*saved), options, streams);
    }
    const std::filesystem::path output =
        options.output.empty() ? default_output(session) : std::filesystem::path(options.output);
    check_paths(options, output.string());
    note_options_of_no_use(options, output, streams);

    RenderSettings settings = session.settings();
    settings.preset = plan.preset;
    settings.subsurface = plan.subsurface;
    ask_for_layers(layers_of(options, session.scene()), session.scene(), settings);
    settings.fields = std::move(fields);
    if (options.samples > 0) {
        settings.samples = options.samples;
    } else if (options.noise > 0) {
        settings.samples = RenderSettings::most_samples;
    }
    settings.noise = options.noise;
    settings.ranks = ranks;
    settings.seconds = options.seconds;
    settings.passes = plan.passes;
    RecordSamples records;
    settings.keeps_fields = options.carry_field || !options.save_field.empty() || !options.save_records.empty();
    if (!options.save_records.empty()) {
        settings.on_records = [&](std::span<const guide::PathRecords> told) { records.add(told); };
    }

    Film film = session.new_film(settings);
    const InterruptGuard interrupt;
    settings.stop = &interrupt.flag();
    const auto denoiser = options.denoise && is_first_of(ranks)
                              ? std::make_unique<Denoiser>(options.denoiser, options.common.threads)
                              : nullptr;
    const auto write = [&](const RenderStatistics& statistics) {
        Picture picture = session.picture(film, settings, statistics);
        if (options.record_time) {
            picture.metadata["wend:seconds"] = fmt::format("{:.3f}", statistics.seconds);
        }
        if (denoiser) {
            picture = denoised(picture, *denoiser);
        }
        if (options.half) {
            write_colours(output, picture);
        } else {
            write_picture(output, picture, options.picture.format());
        }
    };
    const RenderStatistics statistics =
        watched_render(session, film, settings, options.watch, options.common, streams, write);
    const std::uint64_t memory_of_rank = ranks ? most_memory_of(*ranks) : 0;
    if (!is_first_of(ranks)) {
        return statistics.fields;
    }
    if (!options.save_field.empty()) {
        write_fields(options.save_field, *statistics.fields, digest_of(session.files()));
    }
    if (!options.save_records.empty()) {
        write_records(options.save_records, records);
    }
    options.common.note(streams, fmt::format("{}: {} spp in {:.2f} s{}", output.string(), statistics.samples,
                                             statistics.seconds, early_end(settings, statistics, interrupt.signal())));
    warn_of_lacks(statistics, streams.err);
    options.common.write_json(streams, report(session, settings, statistics, output, memory_of_rank));
    if (interrupt.signal() != 0) {
        throw EndedBySignal{interrupt.signal()};
    }
    return statistics.fields;
}

/// Renders several pictures in turn. What is wrong with one of them is an InputError before the first is rendered.
void render_series(const RenderSeries& series, const Streams& streams, Ranks* ranks) {
    series.check_files();
    for (const RenderOptions& one : series.renders) {
        check(one, plan_of(one).preset);
    }
    FieldsPointer carried;
    const auto render = [&](std::size_t i) {
        const RenderOptions& one = series.renders[i];
        FieldsPointer learned = render_scene(one, streams, ranks, carried);
        if (one.carry_field) {
            carried = std::move(learned);
        }
    };
    if (ranks) {
        // After an error the others do not know which is next: it ends all.
        for (std::size_t i = 0; i < series.renders.size(); ++i) {
            render(i);
        }
    } else {
        for_each_in_turn(series.kind, series.names, streams, render);
    }
}

void render(RenderOptions options, const Streams& streams, bool has_frames) {
    const std::unique_ptr<Ranks> ranks = ranks_of_job();
    options.common.quiet = options.common.quiet || !is_first_of(ranks.get());
    if (has_frames) {
        render_series(frames_of(options), streams, ranks.get());
    } else if (options.scenes.size() > 1) {
        render_series(scenes_of(options), streams, ranks.get());
    } else {
        render_scene(one_scene_of(options), streams, ranks.get());
    }
}

/// What is rendered, and what is written of it.
void add_output_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option("scene", options.scenes, "scene file, or several to render in turn: pbrt-v4, or Mitsuba 3 (.xml)")
        ->required();
    options.scene.add_choices_to(command);
    CLI::Option* output = command.add_option(
        "-o,--output", options.output,
        "picture to write: .exr with layers and metadata, .png or .jpg (default: the scene's file name); of several "
        "scenes a folder, where the pictures have the scenes' names");
    command
        .add_flag("--half", options.half,
                  "write the colours alone, in half floats, as references are kept (to an .exr file)")
        ->needs(output);
    options.picture.add_to(command);
    command.add_option("--layers", options.layers,
                       "more layers of the picture, separated by commas: " + extra_layer_names());
    for (const char* name : {"--layer-names", "--exr", "--alpha", "--layers"}) {
        command.get_option("--half")->excludes(command.get_option(name));
    }
    command.add_flag("--record-time", options.record_time,
                     "write into an .exr how many seconds the render took: the same picture is then another file");
    CLI::Option* denoise = command.add_flag(
        "--denoise", options.denoise,
        "take the noise out by Open Image Denoise; an .exr keeps what was as the layer 'noisy', and of scenes "
        "with media it has the layer 'volume', which helps");
    command
        .add_option("--oidn", options.denoiser,
                    "the library's file or folder (default: what WEND_OIDN names, the system's, or that of the Python "
                    "package pyoidn)")
        ->needs(denoise);
}

/// How many samples there are, and how they are drawn.
void add_sampling_options(CLI::App& command, RenderOptions& options) {
    CLI::Option* samples = command.add_option("--spp", options.samples, "samples per pixel (default: the scene's)");
    CLI::Option* seconds = command.add_option("--time", options.seconds, "seconds to spend, training included");
    command
        .add_option("--noise", options.noise,
                    "render until the relative noise is estimated to be no more than this in every square of 16x16 "
                    "pixels, such as 0.02 for 2 %: the standard error over the brightness, of dark pixels over a tenth "
                    "of the picture's, as a root mean square; --spp and --time end it earlier")
        ->check(noise_problem);
    CLI::Option* passes = command.add_option("--passes", options.passes,
                                             "repeat these passes of an earlier run (settings.passes of its --json)");
    samples->check(CLI::Range(1, RenderSettings::most_samples))->excludes(seconds)->excludes(passes);
    seconds->check(seconds_problem)->excludes(passes);
    command.add_option(
        "--sampling", options.sampling,
        "classical; full: whatever pays, where it pays; or decisions, guided everywhere, joined by '+': " +
            guidable_decisions_text() + " (default: full)");
    command
        .add_option("--adaptive", options.adaptive,
                    "on: pixels get samples by their noise; off: all get as many (default: as --sampling says, on with "
                    "full)")
        ->check(CLI::IsMember({"on", "off"}));
    command
        .add_option("--subsurface", options.subsurface,
                    "walks inside dense homogeneous media: " + subsurface_names() + "; default: auto")
        ->capture_default_str();
}

}  // namespace

Action add_render_command(CLI::App& program) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App& command = *program.add_subcommand("render", "render a scene");
    add_output_options(command, *options);
    add_sampling_options(command, *options);
    command.add_option("--save-field", options->save_field, "write what was learned to this file (see 'wend field')");
    CLI::Option* save_records =
        command.add_option("--save-records", options->save_records,
                           "write a sample of what the field learned from to this file (for 'wend field --records')");
    command.add_option(
        "--load-field", options->load_field,
        "go on with what an earlier render of the scene learned; with --resume it is the checkpoint that has it");
    CLI::Option* frames = command.add_option(
        "--frames", options->frames,
        "render these frames one after another, such as 1-48, 1-48x2 or 7: the number goes where names have ####");
    CLI::Option* carry_field =
        command
            .add_flag("--carry-field", options->carry_field,
                      "a frame begins with what the one before has learned: good where little changes")
            ->needs(frames);
    options->watch.add_to(command);
    command.get_option("--resume")->excludes(save_records)->excludes(carry_field);
    options->common.add_to(command);
    return [options, frames](const Streams& streams) { render(*options, streams, frames->count() > 0); };
}

}  // namespace wend
