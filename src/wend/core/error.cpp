#include <wend/core/error.h>

namespace wend {

std::string to_string(const Place& place) {
    std::string text = place.file.empty() ? "input" : place.file;
    if (place.line > 0) {
        text += ':';
        text += std::to_string(place.line);
    }
    if (place.line > 0 && place.column > 0) {
        text += ':';
        text += std::to_string(place.column);
    }
    return text;
}

}  // namespace wend
