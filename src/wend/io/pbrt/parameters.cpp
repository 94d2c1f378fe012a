#include <wend/io/pbrt/parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wend::pbrt {
namespace {

// pbrt's longest list has some sixty; a limit keeps hostile files from making every look-up slow.
constexpr std::size_t most_parameters = 256;

constexpr std::initializer_list<ParameterType> colours = {ParameterType::rgb, ParameterType::spectrum,
                                                          ParameterType::blackbody};
constexpr std::initializer_list<ParameterType> colours_and_textures = {
    ParameterType::rgb, ParameterType::spectrum, ParameterType::blackbody, ParameterType::texture};

std::string alternatives(std::initializer_list<ParameterType> types) {
    std::string text;
    std::size_t left = types.size();
    for (const ParameterType type : types) {
        text += to_string(type);
        --left;
        text += left > 1 ? ", " : left == 1 ? " or " : "";
    }
    return text;
}

template <typename Value>
const std::vector<Value>& values_of(const Parameter& parameter) {
    return std::get<std::vector<Value>>(parameter.values);
}

template <typename Vector>
Vector vector_at(const std::vector<float>& numbers, std::size_t element) {
    Vector v;
    constexpr unsigned n = Vector::dimensions();
    for (unsigned i = 0; i < n; ++i) {
        v[static_cast<int>(i)] = numbers[element * n + i];
    }
    return v;
}

Rgb rgb_at(const std::vector<float>& numbers, std::size_t element) {
    return {numbers[3 * element], numbers[3 * element + 1], numbers[3 * element + 2]};
}

ColourValue spectrum_of(const Parameter& parameter) {
    if (const auto* names = std::get_if<std::vector<std::string>>(&parameter.values)) {
        return NamedSpectrum{names->front()};
    }
    SampledSpectrum spectrum;
    const auto& numbers = values_of<float>(parameter);
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
        if (!spectrum.wavelengths.empty() && numbers[i] <= spectrum.wavelengths.back()) {
            throw InputError(parameter.place,
                             fmt::format("\"{}\": the wavelengths must increase, but {} nm follows {} nm",
                                         parameter.name, numbers[i], spectrum.wavelengths.back()));
        }
        spectrum.wavelengths.push_back(numbers[i]);
        spectrum.values.push_back(numbers[i + 1]);
    }
    return spectrum;
}

ColourValue colour_of(const Parameter& parameter) {
    switch (parameter.type) {
        case ParameterType::rgb:
            return RgbColour{rgb_at(values_of<float>(parameter), 0), parameter.colour_space};
        case ParameterType::spectrum:
            return spectrum_of(parameter);
        default:
            break;
    }
    const float temperature = values_of<float>(parameter).front();
    if (!(temperature > 0)) {
        throw InputError(parameter.place, fmt::format("\"{}\": a temperature must be above 0 kelvin", parameter.name));
    }
    return Blackbody{temperature};
}

// A sampled spectrum is one value however many pairs it has.
bool is_single(const Parameter& parameter) {
    const bool sampled =
        parameter.type == ParameterType::spectrum && std::holds_alternative<std::vector<float>>(parameter.values);
    return sampled || parameter.count() == 1;
}

}  // namespace

std::shared_ptr<const Parameter> ParameterSet::add(Parameter parameter) {
    std::shared_ptr<const Parameter> replaced = remove(parameter.name);
    if (own_.size() >= most_parameters) {
        throw InputError(parameter.place, fmt::format("more than {} parameters", most_parameters));
    }
    own_.push_back(std::make_shared<Parameter>(std::move(parameter)));
    return replaced;
}

void ParameterSet::rename(std::string_view from, std::string to) {
    if (const auto old = remove(from)) {
        Parameter renamed = *old;
        renamed.name = std::move(to);
        add(std::move(renamed));
    }
}

std::shared_ptr<const Parameter> ParameterSet::remove(std::string_view name) {
    const auto found = std::find_if(own_.begin(), own_.end(), [&](const auto& mine) { return mine->name == name; });
    if (found == own_.end()) {
        return nullptr;
    }
    std::shared_ptr<const Parameter> removed = *found;
    own_.erase(found);
    return removed;
}

void ParameterSet::override_with(const ParameterSet& others) {
    for (const auto& other : others.own_) {
        std::erase_if(own_, [&](const auto& mine) { return mine->name == other->name; });
        if (own_.size() >= most_parameters) {
            throw InputError(other->place, fmt::format("more than {} default parameters", most_parameters));
        }
        own_.push_back(other);
    }
}

std::shared_ptr<Parameter> ParameterSet::find(std::string_view name) const {
    for (const auto& parameter : own_) {
        if (parameter->name == name) {
            return parameter;
        }
    }
    return defaults_ ? defaults_->find(name) : nullptr;
}

std::optional<ParameterType> ParameterSet::type_of(std::string_view name) const {
    const auto parameter = find(name);
    return parameter ? std::optional(parameter->type) : std::nullopt;
}

const Location& ParameterSet::place_of(std::string_view name) const {
    const auto parameter = find(name);
    return parameter ? parameter->place : directive_;
}

const Parameter* ParameterSet::look_up(std::string_view name, std::initializer_list<ParameterType> allowed) const {
    const auto parameter = find(name);
    if (!parameter) {
        return nullptr;
    }
    parameter->looked_up = true;
    if (std::find(allowed.begin(), allowed.end(), parameter->type) == allowed.end()) {
        throw InputError(parameter->place, fmt::format("\"{}\": expected {}, found {}", name, alternatives(allowed),
                                                       to_string(parameter->type)));
    }
    return parameter.get();
}

const Parameter* ParameterSet::look_up_one(std::string_view name, std::initializer_list<ParameterType> allowed) const {
    const Parameter* parameter = look_up(name, allowed);
    if (parameter && !is_single(*parameter)) {
        throw InputError(parameter->place, fmt::format("\"{}\": expected one {}, found {}", name,
                                                       to_string(parameter->type), parameter->count()));
    }
    return parameter;
}

float ParameterSet::get_float(std::string_view name, float fallback) const {
    const Parameter* parameter = look_up_one(name, {ParameterType::real});
    return parameter ? values_of<float>(*parameter).front() : fallback;
}

int ParameterSet::get_int(std::string_view name, int fallback) const {
    const Parameter* parameter = look_up_one(name, {ParameterType::integer});
    return parameter ? values_of<int>(*parameter).front() : fallback;
}

bool ParameterSet::get_bool(std::string_view name, bool fallback) const {
    const Parameter* parameter = look_up_one(name, {ParameterType::boolean});
    return parameter ? values_of<bool>(*parameter).front() : fallback;
}

std::string ParameterSet::get_string(std::string_view name, const std::string& fallback) const {
    const Parameter* parameter = look_up_one(name, {ParameterType::string});
    return parameter ? values_of<std::string>(*parameter).front() : fallback;
}

template <typename Vector>
Vector ParameterSet::get_vector(std::string_view name, ParameterType type, const Vector& fallback) const {
    const Parameter* parameter = look_up_one(name, {type});
    return parameter ? vector_at<Vector>(values_of<float>(*parameter), 0) : fallback;
}

Vec2 ParameterSet::get_point2(std::string_view name, const Vec2& fallback) const {
    return get_vector(name, ParameterType::point2, fallback);
}

Vec2 ParameterSet::get_vector2(std::string_view name, const Vec2& fallback) const {
    return get_vector(name, ParameterType::vector2, fallback);
}

Vec3 ParameterSet::get_point3(std::string_view name, const Vec3& fallback) const {
    return get_vector(name, ParameterType::point3, fallback);
}

Vec3 ParameterSet::get_vector3(std::string_view name, const Vec3& fallback) const {
    return get_vector(name, ParameterType::vector3, fallback);
}

Vec3 ParameterSet::get_normal3(std::string_view name, const Vec3& fallback) const {
    return get_vector(name, ParameterType::normal3, fallback);
}

std::optional<ColourValue> ParameterSet::get_colour(std::string_view name) const {
    const Parameter* parameter = look_up_one(name, colours);
    return parameter ? std::optional(colour_of(*parameter)) : std::nullopt;
}

std::optional<std::variant<ColourValue, TextureName>> ParameterSet::get_colour_or_texture(std::string_view name) const {
    const Parameter* parameter = look_up_one(name, colours_and_textures);
    if (!parameter) {
        return std::nullopt;
    }
    if (parameter->type == ParameterType::texture) {
        return TextureName{values_of<std::string>(*parameter).front()};
    }
    return colour_of(*parameter);
}

std::variant<float, TextureName> ParameterSet::get_float_or_texture(std::string_view name, float fallback) const {
    const Parameter* parameter = look_up_one(name, {ParameterType::real, ParameterType::texture});
    if (!parameter) {
        return fallback;
    }
    if (parameter->type == ParameterType::texture) {
        return TextureName{values_of<std::string>(*parameter).front()};
    }
    return values_of<float>(*parameter).front();
}

std::optional<TextureName> ParameterSet::get_texture(std::string_view name) const {
    const Parameter* parameter = look_up_one(name, {ParameterType::texture});
    return parameter ? std::optional(TextureName{values_of<std::string>(*parameter).front()}) : std::nullopt;
}

template <typename Value>
std::vector<Value> ParameterSet::get_list(std::string_view name, ParameterType type) const {
    const Parameter* parameter = look_up(name, {type});
    return parameter ? values_of<Value>(*parameter) : std::vector<Value>();
}

std::vector<float> ParameterSet::get_floats(std::string_view name) const {
    return get_list<float>(name, ParameterType::real);
}

std::vector<int> ParameterSet::get_ints(std::string_view name) const {
    return get_list<int>(name, ParameterType::integer);
}

std::vector<bool> ParameterSet::get_bools(std::string_view name) const {
    return get_list<bool>(name, ParameterType::boolean);
}

std::vector<std::string> ParameterSet::get_strings(std::string_view name) const {
    return get_list<std::string>(name, ParameterType::string);
}

template <typename Vector>
std::vector<Vector> ParameterSet::get_vectors(std::string_view name, ParameterType type) const {
    std::vector<Vector> vectors;
    if (const Parameter* parameter = look_up(name, {type})) {
        vectors.reserve(parameter->count());
        for (std::size_t i = 0; i < parameter->count(); ++i) {
            vectors.push_back(vector_at<Vector>(values_of<float>(*parameter), i));
        }
    }
    return vectors;
}

std::vector<Vec2> ParameterSet::get_point2s(std::string_view name) const {
    return get_vectors<Vec2>(name, ParameterType::point2);
}

std::vector<Vec2> ParameterSet::get_vector2s(std::string_view name) const {
    return get_vectors<Vec2>(name, ParameterType::vector2);
}

std::vector<Vec3> ParameterSet::get_point3s(std::string_view name) const {
    return get_vectors<Vec3>(name, ParameterType::point3);
}

std::vector<Vec3> ParameterSet::get_vector3s(std::string_view name) const {
    return get_vectors<Vec3>(name, ParameterType::vector3);
}

std::vector<Vec3> ParameterSet::get_normal3s(std::string_view name) const {
    return get_vectors<Vec3>(name, ParameterType::normal3);
}

std::vector<RgbColour> ParameterSet::get_rgbs(std::string_view name) const {
    std::vector<RgbColour> colours_found;
    if (const Parameter* parameter = look_up(name, {ParameterType::rgb})) {
        colours_found.reserve(parameter->count());
        for (std::size_t i = 0; i < parameter->count(); ++i) {
            colours_found.push_back({rgb_at(values_of<float>(*parameter), i), parameter->colour_space});
        }
    }
    return colours_found;
}

template <typename Value>
std::vector<Value> ParameterSet::take_list(std::string_view name, ParameterType type) {
    for (const auto& parameter : own_) {
        if (parameter->name == name && parameter->type == type && parameter.use_count() == 1) {
            parameter->looked_up = true;
            return std::move(std::get<std::vector<Value>>(parameter->values));
        }
    }
    return get_list<Value>(name, type);
}

std::vector<float> ParameterSet::take_numbers(std::string_view name, ParameterType type) {
    return take_list<float>(name, type);
}

std::vector<int> ParameterSet::take_ints(std::string_view name) {
    return take_list<int>(name, ParameterType::integer);
}

std::vector<const Parameter*> ParameterSet::unused() const {
    std::vector<const Parameter*> found;
    for (const auto& parameter : own_) {
        if (!parameter->looked_up) {
            found.push_back(parameter.get());
        }
    }
    return found;
}

std::vector<const Parameter*> ParameterSet::own() const {
    std::vector<const Parameter*> found;
    for (const auto& parameter : own_) {
        found.push_back(parameter.get());
    }
    return found;
}

std::vector<const Parameter*> ParameterSet::all() const {
    std::vector<const Parameter*> found = own();
    if (defaults_) {
        for (const auto& parameter : defaults_->own_) {
            if (find(parameter->name) == parameter) {
                found.push_back(parameter.get());
            }
        }
    }
    return found;
}

}  // namespace wend::pbrt
