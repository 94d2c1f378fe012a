#include "xml_support.h"

#include <regex>
#include <vector>

namespace wend::test {

std::string xml_problem(std::string_view text) {
    static const std::regex tag(R"(</?[A-Za-z][\w:-]*((\s+[\w:-]+="[^"<]*")*)\s*/?>)");
    static const std::regex reference(R"(&(?!(amp|lt|gt|quot|apos|#[0-9]+);))");
    const std::string document(text);
    if (std::regex_search(document, reference)) {
        return "a stray '&'";
    }
    std::vector<std::string> open;
    std::size_t roots = 0;
    for (std::size_t at = document.find('<'); at != std::string::npos; at = document.find('<', at)) {
        const std::string piece = document.substr(at, document.find('>', at) - at + 1);
        if (!std::regex_match(piece, tag)) {
            return "no tag: " + piece.substr(0, 80);
        }
        const bool closes = piece[1] == '/';
        const std::size_t begin = closes ? 2 : 1;
        const std::string name = piece.substr(begin, piece.find_first_of(" \n/>", begin) - begin);
        if (closes) {
            if (open.empty() || open.back() != name) {
                return "</" + name + "> closes nothing";
            }
            open.pop_back();
        } else {
            roots += open.empty() ? 1 : 0;
            if (piece[piece.size() - 2] != '/') {
                open.push_back(name);
            }
        }
        at += piece.size();
    }
    return !open.empty() ? "<" + open.back() + "> stays open" : roots == 1 ? "" : "there is not one root";
}

}  // namespace wend::test
