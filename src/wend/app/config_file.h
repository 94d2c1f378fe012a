// Options from a file.
#pragma once

namespace CLI {
class App;
}

namespace wend {

/// Adds --config FILE to the program, whose subcommands must be there. The file has a section for each subcommand,
/// with lines NAME = VALUE:
///
///     [render]
///     spp = 64
///     sampling = "full"
///
/// The command line counts before it. What is wrong in the file throws InputError with its place; a value that an
/// option does not take throws CLI::ParseError.
void add_config_option(CLI::App& program);

}  // namespace wend
