#include <wend/io/pbrt/directive_sequence.h>

#include <wend/core/error.h>
#include <wend/io/pbrt/directives.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace wend::pbrt {
namespace {

/// What stands behind the name of a directive.
class Arguments {
public:
    Arguments(std::string_view directive, const Location& place, std::vector<std::string> texts,
              std::span<const double> numbers, std::vector<Parameter> parameters)
        : directive_(directive),
          place_(place),
          texts_(std::move(texts)),
          numbers_(numbers),
          parameters_(std::move(parameters)) {}

    /// Throws InputError for another number of them.
    void require(std::size_t least_texts, std::size_t most_texts, std::size_t numbers, bool has_parameters) const {
        if (texts_.size() < least_texts || texts_.size() > most_texts || numbers_.size() != numbers ||
            (!has_parameters && !parameters_.empty())) {
            throw InputError(place_, fmt::format("{} wants {} texts, {} numbers and {} parameters", directive_,
                                                 least_texts, numbers, has_parameters ? "any" : "no"));
        }
    }
    std::string text(std::size_t index) const { return texts_[index]; }
    std::size_t texts() const { return texts_.size(); }
    std::span<const double> numbers() const { return numbers_; }

    std::vector<Parameter> take_parameters(ColourSpace colour_space) {
        for (Parameter& parameter : parameters_) {
            parameter.place = place_;
            parameter.colour_space = colour_space;
            const std::size_t values = std::visit([](const auto& list) { return list.size(); }, parameter.values);
            if (values == 0 || values % static_cast<std::size_t>(components_of(parameter.type)) != 0) {
                throw InputError(place_, fmt::format("\"{} {}\": {} values make no whole ones",
                                                     to_string(parameter.type), parameter.name, values));
            }
        }
        return std::move(parameters_);
    }
    ParameterSet take_set(DescriptionBuilder& builder) {
        ParameterSet set(place_, builder.colour_space());
        for (Parameter& parameter : take_parameters(builder.colour_space())) {
            const Parameter last = {parameter.type, parameter.name, place_, parameter.colour_space, {}};
            if (const auto earlier = set.add(std::move(parameter))) {
                builder.warn_of_repeated(last, *earlier);
            }
        }
        return set;
    }

private:
    std::string_view directive_;
    Location place_;
    std::vector<std::string> texts_;
    std::span<const double> numbers_;
    std::vector<Parameter> parameters_;
};

struct Adder {
    DescriptionBuilder& builder;
    const Location& place;
    Arguments& given;

    void operator()(const TypedDirective& syntax) const {
        given.require(1, 1, 0, true);
        (builder.*syntax.act)(given.text(0), given.take_set(builder), place);
    }
    void operator()(const NamedDirective& syntax) const {
        given.require(1, 1, 0, false);
        (builder.*syntax.act)(given.text(0), place);
    }
    void operator()(const NumericDirective& syntax) const {
        given.require(0, 0, syntax.count, false);
        (builder.*syntax.act)(given.numbers(), place);
    }
    void operator()(const PlainDirective& syntax) const {
        given.require(0, 0, 0, false);
        (builder.*syntax.act)(place);
    }
    void operator()(SpecialDirective syntax) const {
        switch (syntax) {
            case SpecialDirective::active_transform:
                given.require(1, 1, 0, false);
                return builder.active_transform(active_transform(given.text(0)));
            case SpecialDirective::attribute:
                given.require(1, 1, 0, true);
                return builder.attribute(given.text(0), given.take_set(builder), place);
            case SpecialDirective::medium_interface:
                given.require(1, 2, 0, false);
                return builder.medium_interface(given.text(0), given.text(given.texts() - 1), place);
            case SpecialDirective::option:
                given.require(0, 0, 0, true);
                for (Parameter& parameter : given.take_parameters(builder.colour_space())) {
                    builder.option(std::move(parameter));
                }
                return;
            case SpecialDirective::texture:
                given.require(3, 3, 0, true);
                return builder.texture(given.text(0), given.text(1), given.text(2), given.take_set(builder), place);
            case SpecialDirective::import:
            case SpecialDirective::include:
                break;
        }
        throw InputError(place, "Include and Import are for files");
    }

    ActiveTransform active_transform(const std::string& name) const {
        if (name != "StartTime" && name != "EndTime" && name != "All") {
            throw InputError(place, fmt::format("expected StartTime, EndTime or All, found '{}'", name));
        }
        return name == "StartTime" ? ActiveTransform::start
               : name == "EndTime" ? ActiveTransform::end
                                   : ActiveTransform::all;
    }
};

}  // namespace

DirectiveSequence::DirectiveSequence(std::string name, const std::filesystem::path& folder)
    : file_(std::make_shared<const SourceFile>(SourceFile{std::move(name), folder})), builder_(folder) {
}

void DirectiveSequence::add(std::string_view directive, std::vector<std::string> texts, std::span<const double> numbers,
                            std::vector<Parameter> parameters) {
    const Location place{file_, ++directives_, 0};
    const Directive* known = find_directive(directive);
    if (!known) {
        throw InputError(place, fmt::format("'{}' is no directive", directive));
    }
    require_place(*known, builder_.in_world(), place);
    Arguments given(directive, place, std::move(texts), numbers, std::move(parameters));
    std::visit(Adder{builder_, place, given}, known->syntax);
}

Description DirectiveSequence::finish() {
    return builder_.finish({file_, directives_ + 1, 0});
}

}  // namespace wend::pbrt
