// XML as pugixml reads it, with lines and columns.
#pragma once

#include <pugixml.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace wend::mitsuba {

/// A parsed text, in UTF-8.
class XmlText {
public:
    /// Throws InputError with the place, in a file called `name`, for what is no XML.
    XmlText(const std::string& text, const std::string& name);

    pugi::xml_node root() const { return document_.document_element(); }
    /// Of a byte, both from 1.
    std::pair<int, int> line_and_column(std::ptrdiff_t offset) const;

private:
    pugi::xml_document document_;
    std::vector<std::size_t> lines_;  ///< where each begins
};

}  // namespace wend::mitsuba
