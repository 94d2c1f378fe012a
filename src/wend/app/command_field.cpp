#include <wend/app/commands.h>
#include <wend/app/direction_picture.h>
#include <wend/app/field_place.h>
#include <wend/app/flight_report.h>
#include <wend/app/lobe_page.h>
#include <wend/app/session.h>
#include <wend/app/text_table.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/field_file.h>
#include <wend/io/image_file.h>
#include <wend/io/records_file.h>
#include <wend/view/pixel_flight.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

namespace wend {
namespace {

constexpr const char* default_picture = "field.png";

struct FieldOptions {
    CommonOptions common;
    std::string file;
    std::string at;
    std::string pixel;
    SceneOptions scene;  ///< that the pixel is of
    std::string part;
    std::string picture;
    std::string page;
    std::string vtk;
    std::string records;
    bool force = false;

    bool has_places() const { return !at.empty() || !pixel.empty(); }
    /// Where the picture goes; empty: nowhere.
    std::string picture_file() const {
        const bool by_default = picture.empty() && page.empty() && has_places();
        return by_default ? default_picture : picture;
    }
};

using Parts = std::array<FieldPart, 2>;

Parts parts_of(const guide::Fields& fields) {
    return {{{"surface", &fields.surface}, {"volume", &fields.volume}}};
}

struct Summary {
    std::size_t cells = 0, lobes = 0, bytes = 0;
    double samples = 0;
};

Summary summarize(const guide::Field& field) {
    Summary summary;
    summary.cells = field.size();
    summary.bytes = field.bytes();
    field.for_each_cell([&](const Box3&, const guide::Region& region, double samples) {
        summary.lobes += static_cast<std::size_t>(region.mixture().size());
        summary.samples += samples;
    });
    return summary;
}

nlohmann::json summary_json(const Summary& s, const Box3& bounds) {
    return {{"cells", s.cells},
            {"lobes", s.lobes},
            {"samples", json_number(s.samples)},
            {"bytes", s.bytes},
            {"bounds", {json_vector(bounds.min), json_vector(bounds.max)}}};
}

Vec3 parse_position(const std::string& text) {
    Vec3 position(0, 0, 0);
    const std::vector<std::string> parts = split_list(text);
    bool good = parts.size() == 3;
    for (int i = 0; good && i < 3; ++i) {
        const std::string& part = parts[static_cast<std::size_t>(i)];
        const auto result = std::from_chars(part.data(), part.data() + part.size(), position[i]);
        good = result.ec == std::errc() && result.ptr == part.data() + part.size() && std::isfinite(position[i]);
    }
    if (!good) {
        throw InputError("--at " + text + ": expected three numbers separated by commas, such as 0.5,1,-2");
    }
    return position;
}

/// A whole number and nothing else.
bool read_number(const std::string& text, int& number) {
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && read == end;
}

Vec2i parse_pixel(const std::string& text, const Vec2i& resolution) {
    Vec2i pixel(0, 0);
    const std::vector<std::string> parts = split_list(text);
    if (parts.size() != 2 || !read_number(parts[0], pixel.x) || !read_number(parts[1], pixel.y)) {
        throw InputError("--pixel " + text + ": expected two whole numbers, such as 100,40: column and row, from 0");
    }
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= resolution.x || pixel.y >= resolution.y) {
        throw InputError(fmt::format("--pixel {}: the picture has {} columns and {} rows, from 0 on", text,
                                     resolution.x, resolution.y));
    }
    return pixel;
}

/// The part asked for, or the one that more samples taught.
const FieldPart& choose_part(const std::array<FieldPart, 2>& parts, const std::string& name) {
    if (!name.empty()) {
        return name == parts[0].name ? parts[0] : parts[1];
    }
    return summarize(*parts[0].field).samples >= summarize(*parts[1].field).samples ? parts[0] : parts[1];
}

/// What is shown of a file: the places, and how they came about.
struct Look {
    LobePage page;
    nlohmann::json json;  ///< of "at" or "pixel"
    std::string text;
};

/// The lobes of a place as text.
std::string place_text(const LobePagePlace& one) {
    const FieldPlace& p = one.place;
    const std::string outside = outside_text(p);
    return fmt::format(
        "\n{}, {} field: fluence {:.4g}, classical share {:.2f}, distances from {:.4g} {:.4g} {:.4g}\n{}light from "
        "connections {:.4g}\n{}",
        one.name, p.part.name, p.region->fluence(), p.region->defensive_fraction(), p.region->reference().x,
        p.region->reference().y, p.region->reference().z, outside.empty() ? "" : outside + "\n", p.connected_fluence,
        lobe_table(p));
}

constexpr const char* table_note =
    "records: how many of equal weight would know as much of the lobe; misfit: by how many nats each of them spreads "
    "otherwise than the lobe\n";

LobePagePlace page_place(std::string name, FieldPlace place) {
    std::vector<Vec3> means;
    for (const LobeFacts& lobe : lobe_facts(place)) {
        means.push_back(lobe.mean);
    }
    DirectionPanel panel{fmt::format("{}, {} field", name, place.part.name),
                         radiance_map(place.incident, place.region->fluence()), std::move(means)};
    return {std::move(name), std::move(place), {std::move(panel)}};
}

Look look_at_position(const FieldOptions& options, const Parts& parts, const std::optional<RecordSamples>& samples) {
    const Vec3 position = parse_position(options.at);
    const FieldPart& part = choose_part(parts, options.part);
    LobePagePlace one = page_place("at " + options.at, field_place(part, position, options.file));
    Look look;
    look.json = place_json(one.place);
    look.json["records"] = nullptr;
    look.text = place_text(one) + table_note;
    if (samples) {
        const bool surface = part.field == parts[0].field;
        const guide::Records told =
            records_in(surface ? samples->surface : samples->volume, *part.field, one.place.region);
        one.panels.push_back({fmt::format("what {} records of the cell saw", told.size()), record_map(told), {}});
        look.json["records"] = told.size();
        look.text +=
            fmt::format("with that of {} records of the cell, below it or as the layer 'records'\n", told.size());
    }
    look.page = {"Lobes at " + options.at, options.file, {std::move(one)}, {}};
    return look;
}

Look look_along_pixel(const FieldOptions& options, const Parts& parts, const guide::Fields& fields,
                      const Streams& streams) {
    constexpr int most_stops = 5;
    const Session session(options.scene, options.common, streams);
    const Vec2i pixel = parse_pixel(options.pixel, session.resolution());
    Pcg32 random(session.settings().seed);
    std::optional<PixelFlight> found = pixel_flight(session.scene(), pixel, &fields, random);
    if (!found) {
        throw InputError(fmt::format("--pixel {}: the camera lets no light through to its middle", options.pixel));
    }
    PixelFlight& flight = *found;
    Look look;
    look.json = flight_json(flight);
    look.json["pixel"] = {pixel.x, pixel.y};
    look.json["stops"] = nlohmann::json::array();
    look.text = flight_text(flight, options.pixel);
    look.page = {fmt::format("Lobes along pixel {}", options.pixel), options.file, {}, {}};
    for (const FlightStop& stop : stops_of(flight, most_stops)) {
        const FieldPart& part = stop.on_surface ? parts[0] : parts[1];
        if (!part.field->is_trained()) {
            continue;
        }
        const Vec3 position =
            stop.on_surface ? flight.surface->position : flight.ray.at(static_cast<float>(stop.distance));
        LobePagePlace one =
            page_place(fmt::format("{}{:.4g} from the camera", stop.on_surface ? "surface, " : "", stop.distance),
                       field_place(part, position, options.file));
        look.text += place_text(one);
        nlohmann::json& entry = look.json["stops"].emplace_back(place_json(one.place));
        entry["distance"] = stop.distance;
        look.page.places.push_back(std::move(one));
    }
    if (look.page.places.empty()) {
        throw InputError(options.file + ": nothing was learned of what the flight of pixel " + options.pixel +
                         " meets");
    }
    look.text += table_note;
    look.page.flight = std::move(flight);
    return look;
}

void write_look(const FieldOptions& options, const Look& look) {
    const std::string picture = options.picture_file();
    if (!picture.empty()) {
        std::vector<DirectionPanel> panels;
        for (const LobePagePlace& one : look.page.places) {
            panels.insert(panels.end(), one.panels.begin(), one.panels.end());
        }
        if (std::filesystem::path(picture).extension() == ".exr") {
            std::vector<DirectionMap> maps;
            for (DirectionPanel& panel : panels) {
                // The second of one place is of its records.
                const bool records = options.pixel.empty() && maps.size() == 1;
                maps.push_back({records ? "records" : fmt::format("stop{}", maps.size() + 1), std::move(panel.values)});
            }
            write_picture(picture, numbers_picture(maps));
        } else {
            write_picture(picture, labelled_picture(panels, scale_of(look.page)));
        }
    }
    if (!options.page.empty()) {
        write_atomically(options.page, lobe_page(look.page));
    }
}

/// Throws InputError for what is wrong with names, before anything is read.
void check(const FieldOptions& options) {
    const std::string picture = options.picture_file();
    if (!options.has_places() && !(picture.empty() && options.page.empty())) {
        throw InputError("-o and --page show a place: --at or --pixel says which");
    }
    if (!picture.empty()) {
        require_writable_picture(picture);
    }
    if (options.picture.empty() && !picture.empty() && !options.force && std::filesystem::exists(picture)) {
        throw InputError(Place{picture}, "is there already: -o names another picture, --force replaces this one");
    }
    for (const std::string& file : {options.page, options.vtk}) {
        if (!file.empty()) {
            require_writable(file);
        }
    }
    require_distinct({options.file, options.records, options.scene.file},
                     {options.vtk, picture, options.page, options.common.json});
    options.scene.check();
}

/// The table of both parts, and JSON.
nlohmann::json show_summary(const FieldOptions& options, const Parts& parts, const Streams& streams) {
    Summary all;
    Box3 bounds;
    nlohmann::json by_part;
    std::vector<std::vector<std::string>> rows = {{"field", "cells", "lobes", "samples", "MiB"}};
    for (const FieldPart& part : parts) {
        const Summary s = summarize(*part.field);
        all.cells += s.cells;
        all.lobes += s.lobes;
        all.samples += s.samples;
        all.bytes += s.bytes;
        bounds.extendBy(part.field->bounds());
        by_part[part.name] = summary_json(s, part.field->bounds());
        rows.push_back({part.name, std::to_string(s.cells), std::to_string(s.lobes), fmt::format("{:.0f}", s.samples),
                        fmt::format("{:.2f}", static_cast<double>(s.bytes) / (1 << 20))});
    }
    if (options.common.json != "-") {
        streams.out
            << text_table(rows)
            << fmt::format(
                   "bounds {:.4g} {:.4g} {:.4g} to {:.4g} {:.4g} {:.4g}; samples of earlier passes count less\n",
                   bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y, bounds.max.z);
    }
    nlohmann::json report = summary_json(all, bounds);
    report["fields"] = std::move(by_part);
    return report;
}

void show_field(const FieldOptions& options, const Streams& streams) {
    check(options);
    const guide::Fields fields = read_fields(options.file);
    const std::optional<RecordSamples> samples =
        options.records.empty() ? std::nullopt : std::optional(read_records(options.records));
    const Parts parts = parts_of(fields);
    nlohmann::json report = show_summary(options, parts, streams);
    if (options.has_places()) {
        Look look = options.pixel.empty() ? look_at_position(options, parts, samples)
                                          : look_along_pixel(options, parts, fields, streams);
        write_look(options, look);
        const std::string picture = options.picture_file();
        look.json["picture"] = picture.empty() ? nlohmann::json(nullptr) : nlohmann::json(picture);
        look.json["page"] = options.page.empty() ? nlohmann::json(nullptr) : nlohmann::json(options.page);
        if (options.common.json != "-") {
            streams.out << look.text << (picture.empty() ? "" : "incident radiance by direction: " + picture + "\n")
                        << (options.page.empty() ? "" : "a page to turn it: " + options.page + "\n");
        }
        report[options.pixel.empty() ? "at" : "pixel"] = std::move(look.json);
    }
    if (!options.vtk.empty()) {
        write_atomically(options.vtk, vtk_text(parts));
        options.common.note(streams, "cells for ParaView: " + options.vtk);
    }
    options.common.write_json(streams, report);
}

}  // namespace

Action add_field_command(CLI::App& program) {
    const auto options = std::make_shared<FieldOptions>();
    CLI::App& command =
        *program.add_subcommand("field", "show what a guiding field holds (a file of 'wend render --save-field')");
    command.add_option("file", options->file, "file of guiding fields")->required();
    CLI::Option* at = command.add_option(
        "--at", options->at,
        "x,y,z: the lobes of incident radiance there, and a picture of them; of each lobe how many records taught it "
        "(those of equal weight that would know as much) and by how many nats their directions spread otherwise than "
        "it does");
    CLI::Option* part =
        command.add_option("--part", options->part, "surface or volume (default: the one with more samples)")
            ->check(CLI::IsMember({"surface", "volume"}));
    CLI::Option* scene = command.add_option("--scene", options->scene.file, "pbrt-v4 scene of --pixel");
    command
        .add_option(
            "--pixel", options->pixel,
            "X,Y, from 0 at the upper left: where the first flight of that pixel of --scene goes, how likely it "
            "scatters in media, and the lobes at places that stand for the light that it brings, and at its "
            "surface")
        ->needs(scene)
        ->excludes(at)
        ->excludes(part);
    command
        .add_option("--resolution", options->scene.resolution,
                    "size of the picture that --pixel is of, WIDTHxHEIGHT (default: the scene's)")
        ->needs(scene);
    command.add_option("-o,--output", options->picture,
                       "picture of --at or --pixel, latitude and longitude: .exr with radiance, .png in false colours "
                       "over four decades, with axes (default: field.png, which must not be there yet, or none with "
                       "--page)");
    command.add_option("--page", options->page, "page of --at or --pixel (HTML): the lobes on a sphere to turn");
    command.add_flag("--force", options->force, "replace field.png where no picture is named");
    command
        .add_option("--records", options->records,
                    "records of the same render (--save-records): what those of the cell saw goes below the picture of "
                    "--at, in .exr into the layer 'records'")
        ->needs(at);
    command.add_option("--vtk", options->vtk, "write the cells to this file, for ParaView");
    options->common.add_to(command);
    return [options](const Streams& streams) { show_field(*options, streams); };
}

}  // namespace wend
