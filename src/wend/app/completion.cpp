#include <wend/app/completion.h>

#include <wend/app/markup.h>

#include <fmt/format.h>

namespace wend {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between = " ") {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : between) + word;
    }
    return text;
}

std::vector<std::string> names_of(const std::vector<OptionShape>& options) {
    std::vector<std::string> names;
    for (const OptionShape& option : options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return names;
}

std::vector<std::string> subcommands_of(const std::vector<CommandShape>& tree) {
    std::vector<std::string> names;
    for (const CommandShape& command : tree) {
        if (!command.name.empty()) {
            names.push_back(command.name);
        }
    }
    return names;
}

/// The text with a backslash before each of the characters.
std::string escaped(const std::string& text, std::string_view characters) {
    std::string result;
    for (const char c : text) {
        result += characters.find(c) == std::string_view::npos ? "" : "\\";
        result += c;
    }
    return result;
}

/// For shells that know no escape inside of single quotes.
std::string in_quotes(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return result + "'";
}

// bash

/// What is known of the values of options; for the others bash offers files.
std::string bash_values(const CommandShape& command) {
    std::string text;
    std::vector<std::string> others;
    for (const OptionShape& option : command.options) {
        for (const std::string& name : option.names) {
            const std::string pattern = command.name + ":" + name;
            if (!option.choices.empty()) {
                text += "    " + pattern + ") words=" + in_quotes(joined(option.choices)) + " ;;\n";
            } else if (!option.value.empty()) {
                others.push_back(pattern);
            }
        }
    }
    return text + (others.empty() ? "" : "    " + joined(others, " | ") + ") return ;;\n");
}

std::string bash_words(const std::vector<CommandShape>& tree) {
    std::string text;
    for (const CommandShape& command : tree) {
        std::vector<std::string> words;
        for (const OptionShape& argument : command.arguments) {
            words.insert(words.end(), argument.choices.begin(), argument.choices.end());
        }
        if (command.name.empty()) {
            words = subcommands_of(tree);
        }
        text += fmt::format("    {}:option) words={} ;;\n", command.name, in_quotes(joined(names_of(command.options))));
        text += fmt::format("    {}:word) words={} ;;\n", command.name, in_quotes(joined(words)));
    }
    return text;
}

// zsh

std::string zsh_action(const OptionShape& option) {
    return escaped(option.names.back(), "\\:") + ":" +
           (option.choices.empty() ? "_files" : "(" + joined(option.choices) + ")");
}

std::string zsh_option(const OptionShape& option) {
    const std::string rest =
        "[" + escaped(option.description, "\\[]:") + "]" + (option.value.empty() ? "" : ":" + zsh_action(option));
    std::vector<std::string> names;
    for (const std::string& name : option.names) {
        names.push_back(name + (option.value.empty() ? "" : name.starts_with("--") ? "=" : "+"));
    }
    if (names.size() == 1) {
        return in_quotes(names.front() + rest);
    }
    return in_quotes("(" + joined(option.names) + ")") + "{" + joined(names, ",") + "}" + in_quotes(rest);
}

std::vector<std::string> zsh_specs(const CommandShape& command) {
    std::vector<std::string> specs;
    for (const OptionShape& option : command.options) {
        specs.push_back(zsh_option(option));
    }
    for (const OptionShape& argument : command.arguments) {
        specs.push_back(in_quotes((argument.is_repeated ? "*:" : ":") + zsh_action(argument)));
    }
    return specs;
}

// fish

std::string fish_quoted(const std::string& text) {
    return "'" + escaped(text, "\\'") + "'";
}

std::string fish_option(const std::string& condition, const OptionShape& option) {
    std::string line = "complete -c wend -n " + fish_quoted(condition);
    for (const std::string& name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.choices.empty()) {
        line += " -x -a " + fish_quoted(joined(option.choices));
    } else if (!option.value.empty()) {
        line += " -r";
    }
    return line + " -d " + fish_quoted(option.description) + "\n";
}

}  // namespace

std::string bash_completion(const std::vector<CommandShape>& tree) {
    std::string values;
    for (const CommandShape& command : tree) {
        values += bash_values(command);
    }
    const std::string_view script = R"(# Completion of wend for bash, made by 'wend completion bash'.
_wend() {
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command= words= kind=word i
    # Bash takes --name=value apart.
    if [[ $current == = ]]; then
        current=
    elif [[ $before == = && COMP_CWORD -gt 1 ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    COMPREPLY=()
    for ((i = 1; i < COMP_CWORD; i++)); do
        case ${COMP_WORDS[i]} in
        --config) i=$((i + 1)) ;;
        {{subcommands}})
            command=${COMP_WORDS[i]}
            break
            ;;
        esac
    done
    case $command:$before in
{{values}}    esac
    [[ $current == -* ]] && kind=option
    [[ -n $words ]] || case $command:$kind in
{{words}}    esac
    COMPREPLY=($(compgen -W "$words" -- "$current"))
}
complete -o default -F _wend wend
)";
    return fill_template(
        script,
        {{"subcommands", joined(subcommands_of(tree), " | ")}, {"values", values}, {"words", bash_words(tree)}});
}

std::string zsh_completion(const std::vector<CommandShape>& tree) {
    std::string commands, cases, general;
    for (const CommandShape& command : tree) {
        std::string specs;
        for (const std::string& spec : zsh_specs(command)) {
            specs += " \\\n            " + spec;
        }
        if (command.name.empty()) {
            general = specs;
            continue;
        }
        commands += "            " + in_quotes(command.name + ":" + command.description) + "\n";
        cases += "        " + command.name + ")\n            _arguments -s" + specs + "\n            ;;\n";
    }
    const std::string_view script = R"(#compdef wend
# Completion of wend for zsh, made by 'wend completion zsh'.
_wend() {
    local context state state_descr line
    typeset -A opt_args
    _arguments -C{{general}} \
            '1:command:->command' \
            '*::argument:->argument'
    case $state in
    command)
        local -a commands=(
{{commands}}        )
        _describe -t commands command commands
        ;;
    argument)
        case $line[1] in
{{cases}}        esac
        ;;
    esac
}
if [[ $funcstack[1] == _wend ]]; then
    _wend "$@"
else
    compdef _wend wend
fi
)";
    return fill_template(script, {{"general", general}, {"commands", commands}, {"cases", cases}});
}

std::string fish_completion(const std::vector<CommandShape>& tree) {
    const std::string nothing_yet = "not __fish_seen_subcommand_from " + joined(subcommands_of(tree));
    std::string script = "# Completion of wend for fish, made by 'wend completion fish'.\n";
    script += "complete -c wend -n " + fish_quoted(nothing_yet) + " -f\n";
    for (const CommandShape& command : tree) {
        if (!command.name.empty()) {
            script += "complete -c wend -n " + fish_quoted(nothing_yet) + " -a " + command.name + " -d " +
                      fish_quoted(command.description) + "\n";
        }
    }
    for (const CommandShape& command : tree) {
        const std::string condition =
            command.name.empty() ? nothing_yet : "__fish_seen_subcommand_from " + command.name;
        for (const OptionShape& option : command.options) {
            script += fish_option(condition, option);
        }
        for (const OptionShape& argument : command.arguments) {
            if (!argument.choices.empty()) {
                script += "complete -c wend -n " + fish_quoted(condition) + " -f -a " +
                          fish_quoted(joined(argument.choices)) + "\n";
            }
        }
    }
    return script;
}

}  // namespace wend
