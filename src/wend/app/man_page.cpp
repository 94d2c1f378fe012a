#include <wend/app/man_page.h>

namespace wend {
namespace {

/// Text as it is to be seen: nothing in it is a request or an escape.
std::string plain(const std::string& text) {
    std::string result;
    bool begins_line = true;
    for (const char c : text) {
        if (begins_line && (c == '.' || c == '\'')) {
            result += "\\&";
        }
        switch (c) {
            case '\\':
                result += "\\e";
                break;
            case '-':
                result += "\\-";
                break;
            case '\'':
                result += "\\(aq";
                break;
            default:
                result += c;
        }
        begins_line = c == '\n';
    }
    return result;
}

std::string bold(const std::string& text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
    return "\\fI" + plain(text) + "\\fR";
}

std::string names_of(const OptionShape& option) {
    std::string text;
    for (const std::string& name : option.names) {
        text += (text.empty() ? "" : ", ") + bold(name);
    }
    return text;
}

std::string values_of(const OptionShape& option) {
    std::string text;
    for (const std::string& choice : option.choices) {
        text += (text.empty() ? "" : " | ") + bold(choice);
    }
    return text.empty() ? italic(option.value) : text;
}

std::string meaning_of(const OptionShape& option) {
    std::string text = plain(option.description) + (option.is_required ? " (required)" : "");
    // Some descriptions say it themselves.
    if (!option.default_value.empty() && option.description.find("default") == std::string::npos) {
        text += " (default: " + plain(option.default_value) + ")";
    }
    return text + "\n";
}

std::string entries(const CommandShape& command) {
    std::string text;
    for (const OptionShape& argument : command.arguments) {
        text += ".TP\n" + italic(argument.names.front()) + (argument.is_repeated ? " ..." : "") + "\n" +
                meaning_of(argument);
    }
    for (const OptionShape& option : command.options) {
        text += ".TP\n" + names_of(option) + (option.value.empty() ? "" : " " + values_of(option)) + "\n" +
                meaning_of(option);
    }
    return text;
}

std::string usage(const CommandShape& command) {
    std::string text = bold("wend " + command.name) + " [" + italic("OPTIONS") + "]";
    for (const OptionShape& argument : command.arguments) {
        text += " " + italic(argument.names.front()) + (argument.is_repeated ? "..." : "");
    }
    return text + "\n";
}

std::string section_of(const CommandShape& command) {
    std::string text = ".SS " + plain("wend " + command.name) + "\n" + usage(command) + ".PP\n" +
                       plain(command.description) + "\n" + entries(command);
    if (!command.footer.empty()) {
        text += ".PP\n.nf\n" + plain(command.footer) + "\n.fi\n";
    }
    return text;
}

}  // namespace

std::string man_page(const std::vector<CommandShape>& tree, const std::string& version) {
    const CommandShape& program = tree.front();
    std::string page = ".TH WEND 1 \"\" \"" + version + "\"\n";
    page += ".SH NAME\nwend \\- render participating media with path guiding\n";
    page += ".SH SYNOPSIS\n" + bold("wend") + " [" + italic("OPTIONS") + "] " + italic("COMMAND") + " ...\n";
    page += ".SH DESCRIPTION\n" + plain(program.description) + "\n";
    page += ".SH OPTIONS\n" + entries(program);
    page += ".SH COMMANDS\n";
    for (std::size_t i = 1; i < tree.size(); ++i) {
        page += section_of(tree[i]);
    }
    page += R"(.SH EXIT STATUS
.TP
0
all went well
.TP
1
failure
.TP
2
bad input
.TP
128 + \fIn\fR
ended by the signal of this number; what was rendered is written
.SH FILES
A file of options for \fB\-\-config\fR:
.PP
.nf
.RS
[render]
spp = 64
sampling = "full"
.RE
.fi
)";
    return page;
}

}  // namespace wend
