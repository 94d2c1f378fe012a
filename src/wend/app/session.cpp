#include <wend/app/session.h>

#include <wend/app/extra_layers.h>
#include <wend/app/manifest.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/gzip.h>
#include <wend/io/image_file.h>
#include <wend/io/load/parse_scene.h>
#include <wend/io/spectrum/colour_space.h>
#include <wend/version.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace wend {
namespace {

/// Of a walk without a limit.
constexpr int most_depth = 1 << 30;

LoadedScene load(const SceneOptions& options, pbrt::Description description, LoadedParts* parts = nullptr) {
    LoadOverrides overrides;
    if (!options.resolution.empty()) {
        const auto [width, height] = parse_resolution(options.resolution);
        overrides.resolution = Vec2i(width, height);
    }
    return load_scene(std::move(description), overrides, parts);
}

/// Of the scene's files; those that were not read again keep what the earlier session knows of them.
std::vector<FileStamp> stamps_of(const LoadedScene& loaded, const std::filesystem::path& folder,
                                 const Session* earlier) {
    std::vector<FileStamp> stamps;
    for (const std::filesystem::path& file : loaded.files) {
        const std::string name = stamp_name(file, folder);
        const std::span<const FileStamp> kept =
            earlier && loaded.kept_files.contains(file) ? std::span(earlier->files()) : std::span<const FileStamp>();
        const auto known = std::ranges::find(kept, name, &FileStamp::name);
        stamps.push_back(known != kept.end() ? *known : stamp_of_file(file, name));
    }
    return stamps;
}

SamplerKind parse_sampler(const std::string& name) {
    static const std::map<std::string, SamplerKind> kinds = {{"sobol", SamplerKind::sobol},
                                                             {"independent", SamplerKind::independent}};
    const auto found = kinds.find(name);
    if (found == kinds.end()) {
        throw InputError("unknown sampler '" + name + "': expected sobol or independent");
    }
    return found->second;
}

/// "x0,x1,y0,y1" as fractions of the picture.
PixelRect parse_crop(const std::string& text, const Vec2i& size) {
    double v[4];
    int used = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf,%lf,%lf%n", &v[0], &v[1], &v[2], &v[3], &used) != 4 ||
        used != static_cast<int>(text.size()) ||
        !(v[0] >= 0 && v[0] < v[1] && v[1] <= 1 && v[2] >= 0 && v[2] < v[3] && v[3] <= 1)) {
        throw InputError("--crop " + text +
                         ": expected X0,X1,Y0,Y1 as fractions of the picture, such as 0.25,0.75,0,0.5");
    }
    const auto pixel = [](double fraction, int n) { return static_cast<int>(std::ceil(fraction * n)); };
    return {{pixel(v[0], size.x), pixel(v[2], size.y)}, {pixel(v[1], size.x), pixel(v[3], size.y)}};
}

}  // namespace

void SceneOptions::add_to(CLI::App& command) {
    command.add_option("scene", file, "scene file: pbrt-v4, or Mitsuba 3 (.xml)")->required();
    add_choices_to(command);
}

void SceneOptions::add_choices_to(CLI::App& command) {
    command.add_option("--resolution", resolution, "size of the picture, WIDTHxHEIGHT (default: the scene's)");
    command.add_option("--crop", crop, "part of the picture to render: X0,X1,Y0,Y1 as fractions");
    command
        .add_option("--max-depth", max_depth,
                    "largest number of scattering events of a walk, a stay inside a \"subsurface\" material being "
                    "one; 0: no limit (default: the scene's)")
        ->check(CLI::Range(0, most_depth));
    command.add_option("--sampler", sampler, "random numbers: sobol or independent (default: the scene's)");
}

void SceneOptions::check() const {
    if (!resolution.empty()) {
        parse_resolution(resolution);
    }
    if (!crop.empty()) {
        parse_crop(crop, {1, 1});
    }
    if (!sampler.empty()) {
        parse_sampler(sampler);
    }
    if (max_depth && (*max_depth < 0 || *max_depth > most_depth)) {
        throw InputError(fmt::format("--max-depth {}: expected 0, for no limit, to {}", *max_depth, most_depth));
    }
}

ReadScene read_scene(const SceneOptions& options) {
    // A redirected file is none of those in that folder, either.
    const bool is_told =
        is_device(options.file) || options.file == "/dev/stdin" || options.file.starts_with("/dev/fd/");
    return is_told ? read_scene(read_file(options.file), {}, options) : ReadScene{parse_scene(options.file), {}};
}

ReadScene read_scene(const std::string& text, const std::filesystem::path& folder, const SceneOptions& options) {
    // It has to be kept with all that are made of the scene: not a long text.
    const FileStamp stamp = stamp_of(text, "text");
    return {parse_scene(text, folder, options.file),
            fmt::format("{} {} {:08x}\n", stamp.name, stamp.bytes, stamp.checksum)};
}

Session::Session(const SceneOptions& options, const CommonOptions& common, ReadScene read)
    : Session(options, common, load(options, std::move(read.description))) {
    stamp(read.changes);
}

Session::Session(const SceneOptions& options, const CommonOptions& common, const Streams& streams)
    : Session(options, common, read_scene(options)) {
    for (const std::string& warning : warnings_) {
        common.note(streams, warning);
    }
}

Session::Session(const SceneOptions& options, const CommonOptions& common, pbrt::Description description,
                 const std::string& changes, LoadedParts& parts, const Session* earlier)
    : Session(options, common, load(options, std::move(description), &parts), earlier) {
    stamp(changes);
}

void Session::stamp(const std::string& changes) {
    if (!changes.empty()) {
        files_.push_back(stamp_of(changes, stamp_of_changes));
    }
}

Session::Session(const SceneOptions& options, const CommonOptions& common, LoadedScene loaded, const Session* earlier)
    : scene_file_(options.file),
      film_file_(loaded.film_file),
      colour_space_(loaded.colour_space),
      resolution_(loaded.resolution),
      crop_(options.crop.empty() ? loaded.crop : parse_crop(options.crop, loaded.resolution)),
      files_(stamps_of(loaded, std::filesystem::path(options.file).parent_path(), earlier)),
      warnings_(std::move(loaded.warnings)),
      scene_(std::move(loaded.scene), earlier ? &earlier->scene_ : nullptr) {
    settings_.samples = loaded.samples;
    settings_.sampler = options.sampler.empty() ? loaded.sampler : parse_sampler(options.sampler);
    settings_.seed = common.seed.value_or(loaded.seed);
    settings_.threads = common.threads;
    settings_.max_depth =
        options.max_depth ? (*options.max_depth == 0 ? most_depth : *options.max_depth) : loaded.max_depth;
    settings_.filter = loaded.filter;
    settings_.exposure = loaded.exposure;
    settings_.balance = loaded.balance;
}

Film Session::new_film(const RenderSettings& settings) const {
    return {resolution_, crop_, film_layers(settings.layers, scene_)};
}

nlohmann::json Session::describe(const RenderSettings& settings) const {
    nlohmann::json described = {{"scene", scene_file_},
                                {"sampling", to_string(settings.preset)},
                                {"subsurface", to_string(settings.subsurface)},
                                {"resolution", {resolution_.x, resolution_.y}},
                                {"crop", {crop_.min.x, crop_.max.x, crop_.min.y, crop_.max.y}},
                                {"sampler", settings.sampler == SamplerKind::sobol ? "sobol" : "independent"},
                                {"seed", settings.seed},
                                {"threads", settings.threads},
                                {"max_depth", settings.max_depth},
                                {"version", WEND_VERSION}};
    if (!settings.layers.empty()) {
        described["layers"] = settings.layers;
    }
    return described;
}

Picture Session::picture(const Film& film, const RenderSettings& settings, const RenderStatistics& statistics) const {
    // Only what the picture follows from: the same picture is the same file.
    nlohmann::json described = describe(settings);
    described.erase("threads");
    Picture picture = film.picture();
    picture.view = scene_.camera().view_matrices();
    picture.metadata = {{"wend:scene", scene_file_},
                        {"wend:scene_digest", digest_of(files_)},
                        {"wend:settings", json_text(described)},
                        {"wend:seed", std::to_string(settings.seed)},
                        {"wend:version", WEND_VERSION},
                        {"wend:spp", std::to_string(statistics.samples)}};
    if (colour_space_ != pbrt::ColourSpace::srgb) {
        picture.metadata.emplace(colour_space_text, pbrt::to_string(colour_space_));
    }
    add_manifest(scene_, settings.objects, picture);
    return picture;
}

void require_writable_picture(const std::filesystem::path& file) {
    require_known_picture_extension(file);
    require_writable(file);
}

}  // namespace wend
