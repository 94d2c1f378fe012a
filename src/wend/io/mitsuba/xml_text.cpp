#include <wend/io/mitsuba/xml_text.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace wend::mitsuba {

XmlText::XmlText(const std::string& text, const std::string& name) : lines_{0} {
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 1)) {
        lines_.push_back(end + 1);
    }
    // Entities of a file's own are left as they are, so that they do not multiply.
    const pugi::xml_parse_result result =
        document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
        const auto [line, column] = line_and_column(result.offset);
        throw InputError(Place{name, line, column}, fmt::format("this is no XML: {}", result.description()));
    }
    if (!root()) {
        throw InputError(Place{name, 0, 0}, "this is no XML: there is no element");
    }
}

std::pair<int, int> XmlText::line_and_column(std::ptrdiff_t offset) const {
    const auto byte = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    const auto after = std::upper_bound(lines_.begin(), lines_.end(), byte);
    return {static_cast<int>(after - lines_.begin()), static_cast<int>(byte - *(after - 1)) + 1};
}

}  // namespace wend::mitsuba
