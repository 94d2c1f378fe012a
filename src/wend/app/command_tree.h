// What the command line looks like, for what describes it elsewhere than in --help.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace wend {

struct OptionShape {
    std::vector<std::string> names;     ///< "-o", "--output"; of what has a place instead its name: "scene"
    std::string value;                  ///< what stands for the value, such as "TEXT"; empty: a flag
    std::vector<std::string> choices;   ///< all values, where they are known
    std::string range;                  ///< of numbers, as --help has it: "INT in [1 - 1000]"; empty: any
    std::string group;                  ///< the heading that it has in --help
    std::vector<std::string> needs;     ///< options without which it may not be given
    std::vector<std::string> excludes;  ///< options beside which it may not be given
    std::string description;
    std::string default_value;  ///< empty: none
    bool is_required = false;
    bool is_repeated = false;  ///< takes any number of values
};

struct CommandShape {
    std::string name;  ///< empty: the program itself
    std::string description;
    std::string footer;
    std::vector<OptionShape> arguments;  ///< that are known by their places
    std::vector<OptionShape> options;
};

/// The program, and then its subcommands. What --help hides is left out.
std::vector<CommandShape> command_tree(const CLI::App& program);

/// The tree as JSON: a list of commands, keys as the members above.
void write_json(std::ostream& out, const std::vector<CommandShape>& tree);

}  // namespace wend
