#include <wend/app/config_file.h>

#include <wend/core/error.h>

#include <CLI/CLI.hpp>

#include <istream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace wend {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20;

/// Up to so many bytes, and one more where there are more.
std::string read_some(std::istream& input, std::size_t most) {
    std::string text(most + 1, '\0');
    input.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(input.gcount()));
    return text;
}

/// One line of the file, read from the left.
class Line {
public:
    /// `place` has the file and the line's number.
    Line(std::string_view text, const Place& place) : text_(text), rest_(text), place_(place) { skip_blanks(); }

    /// Whether nothing is left, but for a comment.
    bool is_at_end() const { return rest_.empty() || rest_[0] == '#' || rest_[0] == ';'; }
    bool take(char c) {
        if (!rest_.starts_with(c)) {
            return false;
        }
        rest_.remove_prefix(1);
        skip_blanks();
        return true;
    }
    void expect(char c) {
        if (!take(c)) {
            fail(std::string("expected '") + c + "'");
        }
    }
    void expect_end() const {
        if (!is_at_end()) {
            fail("did not expect '" + std::string(rest_) + "'");
        }
    }
    /// A name of letters, digits, '-' and '_'.
    std::string name() {
        const std::size_t end = std::min(rest_.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                                 "0123456789-_"),
                                         rest_.size());
        if (end == 0) {
            fail("expected [SECTION] or NAME = VALUE");
        }
        return taken(end);
    }
    /// All values of an option: several stand in brackets.
    std::vector<std::string> values() {
        if (!take('[')) {
            return {value("#;")};
        }
        std::vector<std::string> all;
        while (!take(']')) {
            all.push_back(value("#;,]"));
            if (!take(',')) {
                expect(']');
                break;
            }
        }
        return all;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError({place_.file, place_.line, static_cast<int>(text_.size() - rest_.size()) + 1}, what);
    }

private:
    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size())); }
    std::string taken(std::size_t length) {
        const std::string text(rest_.substr(0, length));
        rest_.remove_prefix(length);
        skip_blanks();
        return text;
    }
    /// In quotes, or a bare one up to one of `ends`.
    std::string value(std::string_view ends) {
        if (rest_.starts_with('"') || rest_.starts_with('\'')) {
            return quoted();
        }
        std::size_t end = 0;
        // A name may have a '#' in it, which begins a comment only after a blank.
        const auto is_comment = [&](char c) { return c == '#' || c == ';'; };
        while (end < rest_.size() && (ends.find(rest_[end]) == std::string_view::npos ||
                                      (is_comment(rest_[end]) && end > 0 && !is_blank(rest_[end - 1])))) {
            ++end;
        }
        std::string text = taken(end);
        text.resize(text.find_last_not_of(" \t\r") + 1);
        if (text.empty()) {
            fail("a value is missing");
        }
        return text;
    }
    /// "..." with \" and \\ in it, or '...' as it is.
    std::string quoted() {
        const char quote = rest_[0];
        std::string text;
        for (std::size_t i = 1; i < rest_.size(); ++i) {
            if (rest_[i] == quote) {
                taken(i + 1);
                return text;
            }
            if (quote == '"' && rest_[i] == '\\' && i + 1 < rest_.size()) {
                ++i;
            }
            text += rest_[i];
        }
        fail("a quotation mark is missing");
    }
    static bool is_blank(char c) { return c == ' ' || c == '\t'; }

    std::string_view text_, rest_;
    const Place& place_;
};

/// CLI11's own reader ends values at any '#' and passes over what it does not know.
class ConfigReader : public CLI::ConfigTOML {
public:
    ConfigReader(CLI::App& program, const CLI::Option& file) : program_(program), file_(file) {}

    std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
        Place place{file_.results().front()};
        std::string text = read_some(input, most_bytes);
        if (text.size() > most_bytes || text.find('\0') != std::string::npos) {
            throw InputError(place, "is no file of options");
        }
        // Some editors mark UTF-8 so.
        if (text.starts_with("\xef\xbb\xbf")) {
            text.erase(0, 3);
        }
        std::vector<CLI::ConfigItem> all;
        CLI::App* section = &program_;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            ++place.line;
            Line rest(line, place);
            if (rest.is_at_end()) {
                continue;
            }
            if (rest.take('[')) {
                section = find_section(rest);
            } else {
                add_item(all, *section, rest);
            }
        }
        return all;
    }

private:
    CLI::App* find_section(Line& line) const {
        const std::string name = line.name();
        line.expect(']');
        line.expect_end();
        const auto found =
            program_.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
        if (found.empty()) {
            line.fail("there is no subcommand '" + name + "'");
        }
        return found.front();
    }

    void add_item(std::vector<CLI::ConfigItem>& all, CLI::App& section, Line& line) const {
        CLI::ConfigItem item;
        item.name = line.name();
        line.expect('=');
        item.inputs = line.values();
        line.expect_end();
        if (&section == &program_) {
            line.fail("expected a section, such as [render], before options");
        }
        item.parents = {section.get_name()};
        const CLI::Option* option = section.get_option_no_throw("--" + item.name);
        option = option ? option : section.get_option_no_throw(item.name);
        if (!option || !option->get_configurable()) {
            line.fail("'wend " + section.get_name() + "' has no option '" + item.name + "'");
        }
        for (const CLI::ConfigItem& other : all) {
            if (other.parents == item.parents && other.name == item.name) {
                line.fail("'" + item.name + "' is given twice");
            }
        }
        // As long as the file is read, what counts is what the command line has.
        for (const CLI::Option* other : option->get_excludes()) {
            if (other->count() > 0) {
                return;
            }
        }
        all.push_back(std::move(item));
    }

    CLI::App& program_;
    const CLI::Option& file_;
};

}  // namespace

void add_config_option(CLI::App& program) {
    CLI::Option* file = program.set_config(
        "--config", "", "take options from this file: sections such as [render], lines NAME = VALUE");
    file->type_name("FILE");
    program.config_formatter(std::make_shared<ConfigReader>(program, *file));
}

}  // namespace wend
