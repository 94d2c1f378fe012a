#include <wend/io/load/measured.h>

#include <wend/core/error.h>
#include <wend/io/spectrum/colorimetry.h>
#include <wend/io/tensor_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

class MeasuredReader {
public:
    explicit MeasuredReader(const std::filesystem::path& file)
        : place_{file.string(), 0, 0}, tensors_(read_tensors(file)) {}

    std::shared_ptr<const MeasuredTables> read() {
        MeasuredData data;
        data.azimuths = take_nodes("phi_i");
        data.angles = take_nodes("theta_i");
        require_whole_turn(data.azimuths);
        const std::size_t slices = data.azimuths.size() * data.angles.size();
        data.facets = take_table("ndf", {});
        data.projected = take_table("sigma", {});
        const std::vector<std::size_t> directions = {data.azimuths.size(), data.angles.size()};
        data.visible = take_table("vndf", directions);
        data.luminance = take_table("luminance", directions);
        data.colours = tensors_.contains("rgb") ? take_rgb(directions) : take_colours(directions, slices);
        if (data.colours.width != data.luminance.width || data.colours.height != data.luminance.height) {
            throw InputError(place_, "the measured reflection's colours and its \"luminance\" differ in size");
        }
        return std::make_shared<const MeasuredTables>(std::move(data));
    }

private:
    /// With the number of dimensions that it must have, and values that are finite; what is below 0 counts as 0.
    Tensor take(const std::string& name, std::size_t dimensions) {
        const auto found = tensors_.find(name);
        if (found == tensors_.end()) {
            throw InputError(place_, fmt::format("the measured reflection has no array \"{}\" of floats", name));
        }
        Tensor tensor = std::move(found->second);
        if (tensor.shape.size() != dimensions) {
            throw InputError(place_, fmt::format("the array \"{}\" has {} dimensions, not {}", name,
                                                 tensor.shape.size(), dimensions));
        }
        if (!std::all_of(tensor.values.begin(), tensor.values.end(), [](float v) { return std::isfinite(v); })) {
            throw InputError(place_, fmt::format("the array \"{}\" has a value that is not finite", name));
        }
        return tensor;
    }

    std::vector<float> take_nodes(const std::string& name) {
        std::vector<float> nodes = take(name, 1).values;
        if (nodes.empty() || std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) != nodes.end()) {
            throw InputError(place_, fmt::format("the values of the array \"{}\" do not increase", name));
        }
        return nodes;
    }

    /// Of symmetric materials a part of the turn may be measured.
    void require_whole_turn(const std::vector<float>& azimuths) const {
        constexpr double turn = 6.283185307179586, tolerance = 0.5;
        const double covered = double{azimuths.back()} - double{azimuths.front()};
        if (azimuths.size() > MeasuredData::most_azimuths_if_isotropic && !(turn / covered < 1 + tolerance)) {
            throw InputError(place_, "only measured reflections with azimuths of a whole turn can be read");
        }
    }

    /// `before`: the sizes of the dimensions before the last two.
    void require_shape(const Tensor& tensor, const std::string& name, const std::vector<std::size_t>& before) const {
        const std::size_t height = tensor.shape[before.size()], width = tensor.shape[before.size() + 1];
        if (!std::equal(before.begin(), before.end(), tensor.shape.begin()) || width < 2 || height < 2) {
            throw InputError(place_, fmt::format("the array \"{}\" has the sizes [{}] where [{}] and two of at least 2 "
                                                 "are expected",
                                                 name, fmt::join(tensor.shape, ", "), fmt::join(before, ", ")));
        }
    }

    BilinearTable<float> take_table(const std::string& name, const std::vector<std::size_t>& before) {
        Tensor tensor = take(name, before.size() + 2);
        require_shape(tensor, name, before);
        for (float& value : tensor.values) {
            value = std::max(value, 0.0f);
        }
        return {tensor.shape.back(), tensor.shape[before.size()], std::move(tensor.values)};
    }

    /// Of files that their authors have made colours of. Planes of a channel become triples.
    BilinearTable<Rgb> take_rgb(const std::vector<std::size_t>& directions) {
        constexpr std::size_t channels = 3;
        const Tensor planes = take("rgb", 5);
        require_shape(planes, "rgb", {directions[0], directions[1], channels});
        BilinearTable<Rgb> colours{planes.shape[4], planes.shape[3], {}};
        const std::size_t size = colours.width * colours.height;
        colours.values.resize(planes.values.size() / channels);
        for (std::size_t i = 0; i < colours.values.size(); ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                const float value = planes.values[(i / size * channels + c) * size + i % size];
                colours.values[i][static_cast<int>(c)] = std::max(value, 0.0f);
            }
        }
        return colours;
    }

    /// Spectra become colours in daylight. Beyond the wavelengths they are as at the outermost.
    BilinearTable<Rgb> take_colours(const std::vector<std::size_t>& directions, std::size_t slices) {
        const std::vector<float> wavelengths = take_nodes("wavelengths");
        const Tensor spectra = take("spectra", 5);
        require_shape(spectra, "spectra", {directions[0], directions[1], wavelengths.size()});
        const std::vector<Rgb> weights = weights_of(wavelengths);
        BilinearTable<Rgb> colours{spectra.shape[4], spectra.shape[3], {}};
        const std::size_t size = colours.width * colours.height;
        colours.values.resize(slices * size);
        for (std::size_t slice = 0; slice < slices; ++slice) {
            for (std::size_t w = 0; w < wavelengths.size(); ++w) {
                for (std::size_t i = 0; i < size; ++i) {
                    const float value = spectra.values[(slice * wavelengths.size() + w) * size + i];
                    colours.values[slice * size + i] += weights[w] * std::max(value, 0.0f);
                }
            }
        }
        for (Rgb& c : colours.values) {
            c = {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
        }
        return colours;
    }

    /// The colour of each spectrum that is 1 at one of the wavelengths and 0 at the others.
    static std::vector<Rgb> weights_of(const std::vector<float>& wavelengths) {
        std::vector<Rgb> weights;
        for (std::size_t i = 0; i < wavelengths.size(); ++i) {
            const double here = double{wavelengths[i]};
            weights.push_back(rgb_of_reflectance([&](double w) {
                if ((i == 0 && w <= here) || (i + 1 == wavelengths.size() && w >= here)) {
                    return 1.0;
                }
                const double next = double{wavelengths[w < here ? i - 1 : i + 1]};
                return std::max(0.0, 1 - std::abs((w - here) / (next - here)));
            }));
        }
        return weights;
    }

    Place place_;
    std::map<std::string, Tensor> tensors_;
};

}  // namespace

std::shared_ptr<const MeasuredTables> read_measured(const std::filesystem::path& file) {
    return MeasuredReader(file).read();
}

}  // namespace wend
