#include <wend/app/commands.h>
#include <wend/app/direction_map.h>
#include <wend/app/session.h>
#include <wend/app/text_table.h>
#include <wend/core/error.h>
#include <wend/guide/lobe_revision.h>
#include <wend/io/atomic_file.h>
#include <wend/io/field_file.h>
#include <wend/io/image_file.h>
#include <wend/io/records_file.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

namespace wend {
namespace {

struct FieldOptions {
    CommonOptions common;
    std::string file;
    std::string at;
    std::string part;
    std::string picture = "field.png";
    std::string vtk;
    std::string records;
};

/// A part of the file by name.
struct Part {
    const char* name;
    const guide::Field* field;
};

std::array<Part, 2> parts_of(const guide::Fields& fields) {
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

nlohmann::json vector_json(const Vec3& v) {
    return {v.x, v.y, v.z};
}

nlohmann::json summary_json(const Summary& s, const Box3& bounds) {
    return {{"cells", s.cells},
            {"lobes", s.lobes},
            {"samples", json_number(s.samples)},
            {"bytes", s.bytes},
            {"bounds", {vector_json(bounds.min), vector_json(bounds.max)}}};
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

/// The part asked for, or the one that more samples taught.
const Part& choose_part(const std::array<Part, 2>& parts, const std::string& name) {
    if (!name.empty()) {
        return name == parts[0].name ? parts[0] : parts[1];
    }
    return summarize(*parts[0].field).samples >= summarize(*parts[1].field).samples ? parts[0] : parts[1];
}

/// The lobes of a region as they are seen from a position: rows of a table, and JSON.
struct Lobes {
    std::vector<std::vector<std::string>> rows;
    nlohmann::json json;
};

Lobes describe_lobes(const guide::Field& field, const guide::Region& region, const Vec3& position) {
    const guide::VmfMixture incident = region.incident(position);
    std::vector<std::vector<std::string>> rows = {
        {"lobe", "share", "towards", "concentration", "distance", "records", "misfit", "colour"}};
    const auto sums = field.lobe_sums(position);
    nlohmann::json lobes = nlohmann::json::array();
    for (int i = 0; i < incident.size(); ++i) {
        const auto [weight, vmf] = incident.lobe(i);
        const double inverse = static_cast<double>(region.inverse_distance()[i]);
        const guide::LobeSums& seen = sums[static_cast<std::size_t>(i)];
        const double records = guide::effective_records(seen);
        const double misfit = guide::misfit(seen, region.mixture().lobe(i).vmf).total();
        const Rgb colour = region.colours()[i];
        rows.push_back({std::to_string(i + 1), fmt::format("{:.4f}", weight),
                        fmt::format("{:.3f} {:.3f} {:.3f}", vmf.mean.x, vmf.mean.y, vmf.mean.z),
                        fmt::format("{:.4g}", vmf.kappa), inverse > 0 ? fmt::format("{:.4g}", 1 / inverse) : "far",
                        fmt::format("{:.1f}", records), fmt::format("{:.3f}", misfit),
                        fmt::format("{:.2f} {:.2f} {:.2f}", colour.r, colour.g, colour.b)});
        lobes.push_back({{"weight", weight},
                         {"mean", vector_json(vmf.mean)},
                         {"kappa", vmf.kappa},
                         {"records", json_number(records)},
                         {"misfit", json_number(misfit)},
                         {"colour", {colour.r, colour.g, colour.b}},
                         {"distance", inverse > 0 ? nlohmann::json(1 / inverse) : nlohmann::json(nullptr)}});
    }
    return {std::move(rows), std::move(lobes)};
}

nlohmann::json show_position(const FieldOptions& options, const std::array<Part, 2>& parts,
                             const std::optional<RecordSamples>& samples, const Streams& streams) {
    const Vec3 position = parse_position(options.at);
    const Part& part = choose_part(parts, options.part);
    const guide::Region* region = part.field->find(position);
    if (!region) {
        throw InputError(fmt::format("{}: the {} field has learned nothing", options.file, part.name));
    }
    const guide::VmfMixture incident = region->incident(position);
    std::optional<guide::Records> told;
    if (samples) {
        told = records_in(part.field == parts[0].field ? samples->surface : samples->volume, *part.field, region);
    }
    const DirectionMaps maps{radiance_map(incident, region->fluence()),
                             told ? record_map(*told) : std::vector<float>()};
    const bool floating_point = std::filesystem::path(options.picture).extension() == ".exr";
    write_picture(options.picture, floating_point ? numbers_picture(maps) : colours_picture(maps, incident));

    const auto [rows, lobes] = describe_lobes(*part.field, *region, position);
    const guide::ScatteredLight& light = *part.field->scattered_light(position);
    if (options.common.json != "-") {
        streams.out
            << fmt::format(
                   "\nat {}, {} field: fluence {:.4g}, classical share {:.2f}, distances from {:.4g} {:.4g} {:.4g}\n",
                   options.at, part.name, region->fluence(), region->defensive_fraction(), region->reference().x,
                   region->reference().y, region->reference().z)
            << fmt::format("light from connections {:.4g}\n", light.connected.fluence) << text_table(rows)
            << "records: how many of equal weight would know as much of the lobe; misfit: by how many nats each of "
               "them spreads otherwise than the lobe\n"
            << "incident radiance by direction: " << options.picture << '\n';
        if (told) {
            streams.out << fmt::format("with that of {} records of the cell {}\n", told->size(),
                                       floating_point ? "as the layer 'records'" : "below");
        }
    }
    return {{"position", vector_json(position)},
            {"part", part.name},
            {"fluence", region->fluence()},
            {"classical_share", region->defensive_fraction()},
            {"connected_fluence", light.connected.fluence},
            {"reference", vector_json(region->reference())},
            {"lobes", lobes},
            {"records", told ? nlohmann::json(told->size()) : nlohmann::json(nullptr)},
            {"picture", options.picture}};
}

/// All cells as boxes in VTK's legacy text format.
std::string vtk_text(const std::array<Part, 2>& parts) {
    struct Cell {
        Box3 box;
        float fluence;
        float defensive_fraction;
        double samples;
        int lobes;
        int part;
    };
    std::vector<Cell> cells;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        parts[p].field->for_each_cell([&](const Box3& box, const guide::Region& region, double samples) {
            cells.push_back({box, region.fluence(), region.defensive_fraction(), samples, region.mixture().size(),
                             static_cast<int>(p)});
        });
    }
    std::string text =
        fmt::format("# vtk DataFile Version 3.0\nguiding field\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} float\n",
                    8 * cells.size());
    for (const Cell& cell : cells) {
        for (int corner = 0; corner < 8; ++corner) {
            const auto along = [&](int axis) {
                return (corner >> axis & 1) != 0 ? cell.box.max[axis] : cell.box.min[axis];
            };
            text += fmt::format("{} {} {}\n", along(0), along(1), along(2));
        }
    }
    text += fmt::format("CELLS {} {}\n", cells.size(), 9 * cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        text += '8';
        for (std::size_t corner = 0; corner < 8; ++corner) {
            text += fmt::format(" {}", 8 * i + corner);
        }
        text += '\n';
    }
    constexpr int voxel = 11;
    text += fmt::format("CELL_TYPES {}\n", cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        text += fmt::format("{}\n", voxel);
    }
    text += fmt::format("CELL_DATA {}\n", cells.size());
    const auto scalars = [&](const char* name, const auto& value) {
        text += fmt::format("SCALARS {} float 1\nLOOKUP_TABLE default\n", name);
        for (const Cell& cell : cells) {
            text += fmt::format("{}\n", static_cast<float>(value(cell)));
        }
    };
    scalars("fluence", [](const Cell& cell) { return cell.fluence; });
    scalars("classical_share", [](const Cell& cell) { return cell.defensive_fraction; });
    scalars("samples", [](const Cell& cell) { return cell.samples; });
    scalars("lobes", [](const Cell& cell) { return cell.lobes; });
    scalars("volume", [](const Cell& cell) { return cell.part; });
    return text;
}

void show_field(const FieldOptions& options, const Streams& streams) {
    if (!options.vtk.empty()) {
        require_writable(options.vtk);
    }
    if (!options.at.empty()) {
        require_writable_picture(options.picture);
    }
    require_distinct({options.file, options.records},
                     {options.vtk, options.at.empty() ? "" : options.picture, options.common.json});
    const guide::Fields fields = read_fields(options.file);
    const std::optional<RecordSamples> samples =
        options.records.empty() ? std::nullopt : std::optional(read_records(options.records));
    const std::array<Part, 2> parts = parts_of(fields);
    Summary all;
    Box3 bounds;
    nlohmann::json by_part;
    std::vector<std::vector<std::string>> rows = {{"field", "cells", "lobes", "samples", "MiB"}};
    for (const Part& part : parts) {
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
    nlohmann::json json = summary_json(all, bounds);
    json["fields"] = std::move(by_part);
    if (!options.at.empty()) {
        json["at"] = show_position(options, parts, samples, streams);
    }
    if (!options.vtk.empty()) {
        write_atomically(options.vtk, vtk_text(parts));
        options.common.note(streams, "cells for ParaView: " + options.vtk);
    }
    options.common.write_json(streams, json);
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
    command.add_option("--part", options->part, "surface or volume (default: the one with more samples)")
        ->check(CLI::IsMember({"surface", "volume"}));
    command.add_option("-o,--output", options->picture,
                       "picture of --at, latitude and longitude: .exr with radiance, .png in false colours over four "
                       "decades (default: field.png)");
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
