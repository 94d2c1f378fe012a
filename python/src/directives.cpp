#include <wend/app/parsed_scene.h>
#include <wend/core/error.h>
#include <wend/io/file_stamp.h>
#include <wend/io/pbrt/directive_sequence.h>

#include "bindings.h"

#include <nanobind/stl/variant.h>

#include <fmt/format.h>

#include <cstdint>
#include <string_view>
#include <variant>

namespace wend::python {
namespace {

using Integers = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Texts = std::vector<std::string>;
/// "type name", as files declare it, and the values, flat.
using Given = std::tuple<std::string, std::variant<Floats, Integers, Texts>>;

pbrt::ParameterValues values_of(const std::string& declared, pbrt::ParameterType type,
                                const std::variant<Floats, Integers, Texts>& given) {
    using enum pbrt::ParameterType;
    const auto* texts = std::get_if<Texts>(&given);
    const auto* integers = std::get_if<Integers>(&given);
    const bool wants_texts = type == string || type == texture || (type == spectrum && texts);
    const bool wants_integers = type == integer || type == boolean;
    if (wants_texts != (texts != nullptr) || wants_integers != (integers != nullptr)) {
        throw InputError(fmt::format("\"{}\": expected {}", declared,
                                     wants_texts      ? "text"
                                     : wants_integers ? "whole numbers or booleans"
                                                      : "numbers"));
    }
    if (texts) {
        return *texts;
    }
    if (!integers) {
        const auto& floats = std::get<Floats>(given);
        return std::vector<float>(floats.data(), floats.data() + floats.size());
    }
    if (type == boolean) {
        return std::vector<bool>(integers->data(), integers->data() + integers->size());
    }
    return std::vector<int>(integers->data(), integers->data() + integers->size());
}

/// What tells the values from others.
std::string stamp_of_values(const std::variant<Floats, Integers, Texts>& given) {
    if (const auto* texts = std::get_if<Texts>(&given)) {
        return fmt::format("{}", fmt::join(*texts, "\t"));
    }
    const auto stamp = [](const auto& array) {
        const std::string_view bytes(reinterpret_cast<const char*>(array.data()), array.nbytes());
        return fmt::format("{:08x}", wend::stamp_of(bytes, {}).checksum);
    };
    const auto* integers = std::get_if<Integers>(&given);
    return integers ? stamp(*integers) : stamp(std::get<Floats>(given));
}

class PythonDirectives {
public:
    PythonDirectives(const std::string& name, const std::string& folder) : name_(name), scene_(name, folder) {}

    void add(const std::string& directive, std::vector<std::string> texts, const std::vector<double>& numbers,
             const std::vector<Given>& given) {
        content_ += fmt::format("{} {} {}\n", directive, fmt::join(texts, " "), fmt::join(numbers, " "));
        std::vector<pbrt::Parameter> parameters;
        for (const auto& [declared, values] : given) {
            const std::size_t space = declared.find(' ');
            const auto type = pbrt::parameter_type_named(declared.substr(0, space));
            if (space == std::string::npos || space + 1 == declared.size() || !type) {
                throw InputError(fmt::format("\"{}\": expected \"type name\", with a type of {}", declared,
                                             pbrt::parameter_type_names()));
            }
            parameters.emplace_back();
            parameters.back().type = *type;
            parameters.back().name = declared.substr(space + 1);
            parameters.back().values = values_of(declared, *type, values);
            content_ += fmt::format("  {} {}\n", declared, stamp_of_values(values));
        }
        scene_.add(directive, std::move(texts), numbers, std::move(parameters));
    }

    std::shared_ptr<ParsedScene> finish(const std::string& resolution, const std::string& crop,
                                        std::optional<int> max_depth, const std::string& sampler) {
        const nb::gil_scoped_release release;
        const SceneOptions options{name_, resolution, crop, max_depth, sampler};
        options.check();
        return std::make_shared<ParsedScene>(options, scene_.finish(), content_);
    }

private:
    std::string name_;
    pbrt::DirectiveSequence scene_;
    std::string content_;
};

}  // namespace

void bind_directives(nb::module_& module) {
    nb::class_<PythonDirectives>(module, "DirectiveSequence", "A scene, directive by directive.")
        .def(nb::init<const std::string&, const std::string&>(), nb::arg("name"), nb::arg("folder"))
        .def("add", &PythonDirectives::add, nb::arg("directive"), nb::arg("texts"), nb::arg("numbers"),
             nb::arg("parameters"))
        .def("finish", &PythonDirectives::finish, nb::arg("resolution"), nb::arg("crop"), nb::arg("max_depth").none(),
             nb::arg("sampler"));
}

}  // namespace wend::python
