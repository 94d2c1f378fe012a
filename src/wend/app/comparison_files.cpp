#include <wend/app/comparison_files.h>

#include <wend/app/comparison_data.h>
#include <wend/app/comparison_page.h>
#include <wend/io/atomic_file.h>
#include <wend/io/image_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace wend {
namespace {

std::string file_name(const WayOfSampling& way) {
    std::string name = to_string(way);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '+' || c == '/'; }, '-');
    return name;
}

}  // namespace

Picture error_picture(const ComparisonRow& row) {
    Picture picture;
    picture.image = Image(row.image.width, row.image.height);
    picture.full_size = {row.image.width, row.image.height};
    const std::vector<float> squared = to_floats(row.errors.squared);
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        picture.image.pixels[i] = Rgb(squared[3 * i], squared[3 * i + 1], squared[3 * i + 2]);
    }
    picture.layers = {{"relative_squared", {"Y"}, to_floats(row.errors.relative_squared)},
                      {"relative", {"Y"}, to_floats(row.errors.relative)},
                      {"bias", {"R", "G", "B"}, to_floats(row.errors.difference)}};
    picture.metadata = {{"wend:content", "squared errors, means over renders"},
                        {"wend:sampling", to_string(row.way)},
                        {"wend:renders", std::to_string(row.runs.size())}};
    return picture;
}

void write_tables(const std::filesystem::path& folder, std::span<const Comparison> comparisons) {
    write_atomically(folder / "rows.csv", rows_csv(comparisons));
    write_atomically(folder / "runs.csv", runs_csv(comparisons));
    write_atomically(folder / "curves.csv", curves_csv(comparisons));
}

void write_comparison(const std::filesystem::path& folder, const Comparison& comparison) {
    for (const ComparisonRow& row : comparison.rows) {
        const std::string name = file_name(row.way);
        const Vec2i size(row.image.width, row.image.height);
        write_picture(folder / (name + ".png"), {row.image, {}, {}, {0, 0}, size});
        write_picture(folder / (name + ".exr"), {row.image, row.walks, {}, {0, 0}, size});
        write_picture(folder / (name + "-error.png"),
                      {error_map(row, comparison.reference.halves), {}, {}, {0, 0}, size});
        write_picture(folder / (name + "-error.exr"), error_picture(row));
    }
    write_tables(folder, {&comparison, 1});
    write_atomically(folder / "comparison.json", json_text(results_json(comparison), 2) + "\n");
    write_atomically(folder / "index.html", comparison_page(comparison));
}

}  // namespace wend
