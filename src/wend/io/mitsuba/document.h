// Reads the XML of a Mitsuba scene.
#pragma once

#include <wend/io/mitsuba/element.h>

#include <filesystem>
#include <string>

namespace wend::mitsuba {

/// Reads a scene file and what it includes. Names of version 0.x are those of version 3 then. Throws InputError with
/// the place for a missing or broken file, an element or attribute that there is not, an undefined parameter or id, and
/// where files include each other in a circle. Bounded: files of 256 MiB together, ten million elements and attributes,
/// 64 levels, 1000 includes; an entity is never more than its name.
Document read_document(const std::filesystem::path& file);

/// The same for a text; `name` stands for the file in messages. `allow_includes`: whether it may open files.
Document read_document(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                       bool allow_includes);

/// Where a file is that an element names: beside the file that names it, in a folder of `<path>`, or beside the main
/// file. It need not exist.
std::filesystem::path find_file(const Document& document, std::string_view name, const pbrt::Location& place);

}  // namespace wend::mitsuba
