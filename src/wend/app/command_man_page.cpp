#include <wend/app/commands.h>
#include <wend/app/man_page.h>

#include <CLI/CLI.hpp>

#include <ostream>

namespace wend {

Action add_man_page_command(CLI::App& program) {
    // An empty group is what hides a subcommand.
    program.add_subcommand("man-page", "print the manual page")->group("");
    return [&program](const Streams& streams) { streams.out << man_page(command_tree(program), program.version()); };
}

}  // namespace wend
