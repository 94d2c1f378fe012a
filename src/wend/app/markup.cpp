#include <wend/app/markup.h>

#include <cstdint>
#include <stdexcept>

namespace wend {

std::string escape_markup(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string encode_base64(std::string_view bytes) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::string_view group = bytes.substr(i, 3);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (k < group.size() ? static_cast<unsigned char>(group[k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            result += k <= group.size() ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return result;
}

std::string fill_template(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
    std::string result;
    for (;;) {
        const std::size_t open = text.find("{{");
        const std::size_t close = text.find("}}", open);
        if (close == std::string_view::npos) {
            return result.append(text);
        }
        const std::string_view name = text.substr(open + 2, close - open - 2);
        const auto value = values.find(name);
        if (value == values.end()) {
            throw std::out_of_range("the template wants {{" + std::string(name) + "}}");
        }
        result.append(text.substr(0, open)).append(value->second);
        text.remove_prefix(close + 2);
    }
}

}  // namespace wend
