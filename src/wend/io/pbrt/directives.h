// The directives of the format: where each may stand, what follows its name, and what it does.
#pragma once

#include <wend/io/pbrt/description_builder.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace wend::pbrt {

/// "type" and parameters: `Camera "perspective" ...`. What it does is a member of DescriptionBuilder, as for the
/// others.
struct TypedDirective {
    void (DescriptionBuilder::*act)(std::string, ParameterSet, const Location&);
};
/// "name": `NamedMaterial "wax"`.
struct NamedDirective {
    void (DescriptionBuilder::*act)(const std::string&, const Location&);
};
/// So many numbers, in brackets or not: `Translate 0 1 0`.
struct NumericDirective {
    std::size_t count;
    bool has_brackets;
    void (DescriptionBuilder::*act)(std::span<const double>, const Location&);

    static constexpr std::size_t most = 16;
};
/// Nothing: `WorldBegin`.
struct PlainDirective {
    void (DescriptionBuilder::*act)(const Location&);
};
/// Those that are like no other.
enum class SpecialDirective { active_transform, attribute, import, include, medium_interface, option, texture };

struct Directive {
    /// Where it may stand, relative to WorldBegin.
    enum class Where { before_world, in_world, anywhere };

    std::string_view name;
    Where where;
    std::variant<TypedDirective, NamedDirective, NumericDirective, PlainDirective, SpecialDirective> syntax;
};

/// Null for a name that is none.
const Directive* find_directive(std::string_view name);

/// Throws InputError unless the directive may stand there.
void require_place(const Directive& directive, bool in_world, const Location& place);

}  // namespace wend::pbrt
