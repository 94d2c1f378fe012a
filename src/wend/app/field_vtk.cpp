#include <wend/app/field_vtk.h>

#include <fmt/format.h>

#include <vector>

namespace wend {
namespace {

struct Cell {
    Box3 box;
    float fluence;
    float defensive_fraction;
    double samples;
    int lobes;
    int part;
};

std::vector<Cell> cells_of(std::span<const FieldPart> parts) {
    std::vector<Cell> cells;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        parts[p].field->for_each_cell([&](const Box3& box, const guide::Region& region, double samples) {
            cells.push_back({box, region.fluence(), region.defensive_fraction(), samples, region.mixture().size(),
                             static_cast<int>(p)});
        });
    }
    return cells;
}

}  // namespace

std::string vtk_text(std::span<const FieldPart> parts) {
    const std::vector<Cell> cells = cells_of(parts);
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

}  // namespace wend
