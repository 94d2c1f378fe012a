#pragma once

#include <wend/guide/field.h>

#include <span>
#include <string>

namespace wend {

/// A part of a file of guiding fields, by name.
struct FieldPart {
    const char* name;
    const guide::Field* field;
};

/// All cells as boxes in VTK's legacy text format, with what each knows.
std::string vtk_text(std::span<const FieldPart> parts);

}  // namespace wend
