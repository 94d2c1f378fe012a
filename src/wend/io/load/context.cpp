#include <wend/io/load/context.h>

#include <wend/io/pbrt/token_stream.h>

#include <fmt/format.h>

#include <cmath>

namespace wend {

void Warnings::add(const Place& place, const std::string& text) {
    add(text, to_string(place) + ": warning: " + text);
}

void Warnings::add(const std::string& text, const std::string& message) {
    if (texts_.insert(text).second) {
        all_.push_back(message);
        text_lengths_.push_back(text.size());
    }
}

void Warnings::add_all(const Warnings& others) {
    for (std::size_t i = 0; i < others.all_.size(); ++i) {
        const std::string& message = others.all_[i];
        add(message.substr(message.size() - others.text_lengths_[i]), message);
    }
}

void Warnings::add_unused(std::string_view directive, const pbrt::Entity& entity) {
    add_unused(fmt::format("{} \"{}\"", directive, entity.type), entity.parameters);
}

void Warnings::add_unused(const std::string& owner, const pbrt::ParameterSet& parameters) {
    for (const pbrt::Parameter* parameter : parameters.unused()) {
        add(parameter->place, fmt::format("the parameter \"{}\" of {} is not used", parameter->name, owner));
    }
}

std::filesystem::path required_file(const LoadContext& context, const pbrt::Entity& entity,
                                    std::string_view parameter) {
    const std::string name = entity.parameters.get_string(parameter, "");
    const pbrt::Location& place = entity.parameters.place_of(parameter);
    if (name.empty()) {
        throw InputError(place, fmt::format("\"{}\" needs the parameter \"string {}\"", entity.type, parameter));
    }
    std::filesystem::path file = pbrt::find_file(name, place, context.base_directory);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        throw InputError(place, fmt::format("there is no file \"{}\"", file.string()));
    }
    context.files->insert(file);
    return file;
}

void refuse_type(std::string_view directive, const pbrt::Entity& entity,
                 std::initializer_list<std::string_view> known) {
    throw InputError(entity.place,
                     fmt::format("{} \"{}\" is unknown; known are {}", directive, entity.type, fmt::join(known, ", ")));
}

float positive_float(const pbrt::ParameterSet& parameters, std::string_view name, float fallback) {
    const float value = parameters.get_float(name, fallback);
    if (!(value > 0) || !std::isfinite(value)) {
        throw InputError(parameters.place_of(name), fmt::format("\"{}\" must be above 0, not {}", name, value));
    }
    return value;
}

float non_negative_float(const pbrt::ParameterSet& parameters, std::string_view name, float fallback) {
    const float value = parameters.get_float(name, fallback);
    if (!(value >= 0) || !std::isfinite(value)) {
        throw InputError(parameters.place_of(name), fmt::format("\"{}\" must not be below 0, but is {}", name, value));
    }
    return value;
}

}  // namespace wend
