#include <wend/io/ply_header.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace wend::ply {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < line.size();) {
        const auto begin = std::find_if_not(line.begin() + at, line.end(), is_space);
        const auto end = std::find_if(begin, line.end(), is_space);
        if (begin != end) {
            words.emplace_back(begin, end);
        }
        at = static_cast<std::size_t>(end - line.begin());
    }
    return words;
}

class HeaderParser {
public:
    HeaderParser(std::string_view bytes, const std::string& file) : bytes_(bytes), place_{file, 0, 1} {}

    Header parse() {
        if (const auto words = next_line(); words.size() != 1 || words[0] != "ply") {
            fail("not a PLY file: its first line must be `ply`");
        }
        bool has_format = false;
        while (true) {
            const auto words = next_line();
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
                continue;
            }
            if (words[0] == "end_header") {
                break;
            }
            if (words[0] == "format" && words.size() == 3) {
                header_.format = format(words[1]);
                has_format = true;
            } else if (words[0] == "element" && words.size() == 3) {
                header_.elements.push_back({std::string(words[1]), count(words[2]), {}});
            } else if (words[0] == "property" && !header_.elements.empty() && words.size() == 3) {
                header_.elements.back().properties.push_back({std::string(words[2]), type(words[1]), {}});
            } else if (words[0] == "property" && !header_.elements.empty() && words.size() == 5 && words[1] == "list") {
                header_.elements.back().properties.push_back({std::string(words[4]), type(words[3]), type(words[2])});
            } else {
                fail(fmt::format("malformed line in the header, at `{}`", words[0]));
            }
        }
        if (!has_format) {
            fail("the header names no format");
        }
        header_.bytes = at_;
        header_.lines = place_.line;
        return header_;
    }

private:
    std::vector<std::string_view> next_line() {
        ++place_.line;
        const std::size_t end = bytes_.find('\n', at_);
        if (end == std::string_view::npos) {
            fail("the header is truncated");
        }
        const auto words = words_of(bytes_.substr(at_, end - at_));
        at_ = end + 1;
        return words;
    }

    Format format(std::string_view word) const {
        if (word == "ascii") {
            return Format::ascii;
        }
        if (word == "binary_little_endian") {
            return Format::little_endian;
        }
        if (word == "binary_big_endian") {
            return Format::big_endian;
        }
        fail(fmt::format("unknown format `{}`; ascii, binary_little_endian and binary_big_endian are known", word));
    }

    std::uint64_t count(std::string_view word) const {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size()) {
            fail(fmt::format("`{}` is not a number of elements", word));
        }
        return value;
    }

    Type type(std::string_view word) const {
        struct Name {
            std::string_view old_name, new_name;
            Type type;
        };
        static constexpr std::array<Name, 8> names{{{"char", "int8", Type::int8},
                                                    {"uchar", "uint8", Type::uint8},
                                                    {"short", "int16", Type::int16},
                                                    {"ushort", "uint16", Type::uint16},
                                                    {"int", "int32", Type::int32},
                                                    {"uint", "uint32", Type::uint32},
                                                    {"float", "float32", Type::float32},
                                                    {"double", "float64", Type::float64}}};
        for (const Name& name : names) {
            if (word == name.old_name || word == name.new_name) {
                return name.type;
            }
        }
        fail(fmt::format("unknown type `{}`", word));
    }

    [[noreturn]] void fail(const std::string& what) const { throw InputError(place_, what); }

    std::string_view bytes_;
    std::size_t at_ = 0;
    Place place_;
    Header header_;
};

}  // namespace

std::size_t bytes_of(Type type) {
    switch (type) {
        case Type::int8:
        case Type::uint8:
            return 1;
        case Type::int16:
        case Type::uint16:
            return 2;
        case Type::int32:
        case Type::uint32:
        case Type::float32:
            return 4;
        case Type::float64:
            return 8;
    }
    return 0;
}

Header parse_header(std::string_view bytes, const std::string& file) {
    return HeaderParser(bytes, file).parse();
}

}  // namespace wend::ply
