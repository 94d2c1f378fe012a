#include <wend/app/commands.h>
#include <wend/app/man_page.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <ostream>
#include <string>

namespace wend {

Action add_man_page_command(CLI::App& program) {
    const auto format = std::make_shared<std::string>("man");
    // An empty group is what hides a subcommand.
    CLI::App& command = *program.add_subcommand("man-page", "print the manual page")->group("");
    command.add_option("--format", *format, "man: for man(1); json: commands and options, for the site's pages")
        ->check(CLI::IsMember({"man", "json"}))
        ->capture_default_str();
    return [format, &program](const Streams& streams) {
        const auto tree = command_tree(program);
        if (*format == "json") {
            write_json(streams.out, tree);
        } else {
            streams.out << man_page(tree, program.version());
        }
    };
}

}  // namespace wend
