// The elements that a Mitsuba scene may have.
#pragma once

#include <wend/io/mitsuba/element.h>

namespace wend::mitsuba {

/// What an element is for.
enum class TagKind {
    object,     ///< has a type, and children
    property,   ///< a value, without children
    transform,  ///< has steps as children
    step,       ///< of a transform
    reference,
    include,
    alias,
    parameter,  ///< `<default>`
    folder      ///< `<path>`
};

/// The kind of an element. Throws InputError for one that there is not, for an attribute that it does not take, and
/// where one is missing that it needs.
TagKind check_tag(const Element& element);

}  // namespace wend::mitsuba
