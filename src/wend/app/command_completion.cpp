#include <wend/app/commands.h>
#include <wend/app/completion.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>
#include <string>

namespace wend {

Action add_completion_command(CLI::App& program) {
    const auto shell = std::make_shared<std::string>();
    CLI::App& command = *program.add_subcommand("completion", "print a script that completes wend's command line");
    command.add_option("shell", *shell, "bash, zsh or fish: source what is printed")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    return [shell, &program](const Streams& streams) {
        const auto script = *shell == "bash" ? bash_completion : *shell == "zsh" ? zsh_completion : fish_completion;
        streams.out << script(command_tree(program));
    };
}

}  // namespace wend
