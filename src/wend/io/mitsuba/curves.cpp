#include <wend/io/mitsuba/curves.h>

#include <wend/core/error.h>
#include <wend/io/gzip.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend::mitsuba {
namespace {

/// Points of a curve, with the radius at each.
struct Strand {
    std::vector<Vec3> points;
    std::vector<double> radii;
};

/// Lines of four numbers; empty ones are between curves.
std::vector<Strand> read_strands(const std::filesystem::path& file, std::size_t fewest, const Transform& to_world) {
    const std::string content = read_file(file);
    std::vector<Strand> strands(1);
    pbrt::Location place{std::make_shared<const pbrt::SourceFile>(pbrt::SourceFile{file.string(), {}}), 0, 0};
    const auto end_strand = [&] {
        const std::size_t count = strands.back().points.size();
        if (count > 0 && count < fewest) {
            throw InputError(place, fmt::format("a curve of {} points: there must be {} or more", count, fewest));
        }
        if (count > 0) {
            strands.emplace_back();
        }
    };
    for (std::string_view rest = content; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++place.line;
        if (line.find_first_not_of(" \t\r") == std::string_view::npos) {
            end_strand();
            continue;
        }
        const std::vector<double> numbers = numbers_of(line.substr(0, line.find_last_not_of('\r') + 1), place);
        if (numbers.size() != 4 || !(numbers[3] >= 0)) {
            throw InputError(place, "a line is a point and a radius, not below 0: four numbers");
        }
        strands.back().points.push_back(to_world.point(
            Vec3(static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2]))));
        strands.back().radii.push_back(numbers[3]);
    }
    end_strand();
    strands.pop_back();
    return strands;
}

/// The radius where a piece of a uniform spline begins.
double radius_of_spline(const std::vector<double>& r, std::size_t i) {
    return (r[i] + 4 * r[i + 1] + r[i + 2]) / 6;
}

/// Points that a curve in one piece has, and its width at both ends.
struct Piece {
    std::vector<Vec3> points;
    double first, last;
};

bool are_alike(const std::vector<double>& radii) {
    return std::all_of(radii.begin(), radii.end(), [&](double r) { return r == radii.front(); });
}

std::vector<Piece> pieces_of_spline(const Strand& strand) {
    if (are_alike(strand.radii)) {
        return {{strand.points, strand.radii.front(), strand.radii.front()}};
    }
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i + 3 < strand.points.size(); ++i) {
        const auto from = strand.points.begin() + static_cast<std::ptrdiff_t>(i);
        pieces.push_back({{from, from + 4}, radius_of_spline(strand.radii, i), radius_of_spline(strand.radii, i + 1)});
    }
    return pieces;
}

/// As Bezier curves whose points are on the lines.
std::vector<Piece> pieces_of_lines(const Strand& strand) {
    std::vector<Piece> pieces;
    const auto lead_to = [](std::vector<Vec3>& points, const Vec3& end) {
        const Vec3 start = points.back();
        points.push_back(start + (end - start) * (1.0f / 3));
        points.push_back(start + (end - start) * (2.0f / 3));
        points.push_back(end);
    };
    const bool is_one = are_alike(strand.radii);
    for (std::size_t i = 0; i + 1 < strand.points.size(); ++i) {
        if (pieces.empty() || !is_one) {
            pieces.push_back({{strand.points[i]}, strand.radii[i], strand.radii[i + 1]});
        }
        lead_to(pieces.back().points, strand.points[i + 1]);
    }
    return pieces;
}

}  // namespace

std::vector<pbrt::ParameterSet> curves_of(const Object& shape, const pbrt::ParameterSet& common) {
    const bool is_spline = shape.type() == "bsplinecurve";
    const std::vector<Strand> strands =
        read_strands(shape.file("filename"), is_spline ? 4 : 2, shape.transform("to_world"));
    std::vector<pbrt::ParameterSet> result;
    for (const Strand& strand : strands) {
        for (const Piece& piece : is_spline ? pieces_of_spline(strand) : pieces_of_lines(strand)) {
            std::vector<float> numbers;
            for (const Vec3& point : piece.points) {
                numbers.insert(numbers.end(), {point.x, point.y, point.z});
            }
            Parameters p(shape.place());
            p.add(common)
                .text("type", "round")
                .text("basis", is_spline ? "bspline" : "bezier")
                .real("width0", 2 * piece.first)
                .real("width1", 2 * piece.last)
                .add(pbrt::ParameterType::point3, "P", std::move(numbers));
            result.push_back(p.take());
        }
    }
    return result;
}

}  // namespace wend::mitsuba
