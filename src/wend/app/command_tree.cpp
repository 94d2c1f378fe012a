#include <wend/app/command_tree.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>
#include <set>

namespace wend {
namespace {

/// The values in "TEXT:{bar,json,none}" or "normal|diffuse", the two ways in which options say which they take.
std::vector<std::string> choices_in(const std::string& type) {
    const std::size_t open = type.find('{'), close = type.find('}');
    if (open != std::string::npos && close != std::string::npos && open < close) {
        return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
    }
    if (type.find('|') != std::string::npos) {
        return CLI::detail::split(type, '|');
    }
    return {};
}

/// In the order of their names: the sets are ordered by address.
std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    for (const CLI::Option* option : options) {
        names.push_back(option->get_name());
    }
    std::sort(names.begin(), names.end());
    return names;
}

OptionShape shape_of(const CLI::Option& option) {
    OptionShape shape;
    for (const std::string& name : option.get_snames()) {
        shape.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        shape.names.push_back("--" + name);
    }
    if (option.get_positional()) {
        shape.names = {option.get_name(true)};
    }
    if (option.get_items_expected_max() > 0) {
        const std::string type = option.get_type_name();
        shape.choices = choices_in(type);
        const std::size_t colon = type.find(':');
        shape.value = type.substr(0, colon);
        if (colon != std::string::npos && shape.choices.empty()) {
            shape.range = type.substr(colon + 1);
        }
    }
    shape.group = option.get_group();
    shape.needs = names_of(option.get_needs());
    shape.excludes = names_of(option.get_excludes());
    shape.description = option.get_description();
    shape.default_value = option.get_default_str();
    shape.is_required = option.get_required();
    shape.is_repeated = option.get_items_expected_max() > 1;
    return shape;
}

CommandShape shape_of(const CLI::App& app) {
    CommandShape shape;
    shape.name = app.get_parent() ? app.get_name() : "";
    shape.description = app.get_description();
    shape.footer = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_group().empty()) {
            (option->get_positional() ? shape.arguments : shape.options).push_back(shape_of(*option));
        }
    }
    return shape;
}

using Json = nlohmann::ordered_json;

Json json_of(const OptionShape& option) {
    return {{"names", option.names},
            {"value", option.value},
            {"choices", option.choices},
            {"range", option.range},
            {"group", option.group},
            {"needs", option.needs},
            {"excludes", option.excludes},
            {"description", option.description},
            {"default_value", option.default_value},
            {"is_required", option.is_required},
            {"is_repeated", option.is_repeated}};
}

Json json_of(const std::vector<OptionShape>& options) {
    Json all = Json::array();
    for (const OptionShape& option : options) {
        all.push_back(json_of(option));
    }
    return all;
}

}  // namespace

std::vector<CommandShape> command_tree(const CLI::App& program) {
    std::vector<CommandShape> all = {shape_of(program)};
    for (const CLI::App* command : program.get_subcommands({})) {
        if (!command->get_group().empty()) {
            all.push_back(shape_of(*command));
        }
    }
    return all;
}

void write_json(std::ostream& out, const std::vector<CommandShape>& tree) {
    Json all = Json::array();
    for (const CommandShape& command : tree) {
        all.push_back({{"name", command.name},
                       {"description", command.description},
                       {"footer", command.footer},
                       {"arguments", json_of(command.arguments)},
                       {"options", json_of(command.options)}});
    }
    out << all.dump(2) << '\n';
}

}  // namespace wend
