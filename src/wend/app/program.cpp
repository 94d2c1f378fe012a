#include <wend/app/program.h>

#include <wend/app/commands.h>
#include <wend/app/config_file.h>
#include <wend/app/interrupt.h>
#include <wend/core/error.h>
#include <wend/render/preset.h>
#include <wend/version.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace wend {

std::string guidable_decisions_text() {
    std::string text;
    for (const std::string& name : guidable_decisions()) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

namespace {

/// What to say where no subcommand was recognized.
InputError unknown_subcommand(const CLI::App& program) {
    const std::vector<std::string> given = program.remaining();
    std::string names;
    for (const CLI::App* command : program.get_subcommands({})) {
        if (!command->get_group().empty()) {
            names += (names.empty() ? "" : ", ") + command->get_name();
        }
    }
    return InputError((given.empty() ? "a subcommand is missing" : "unknown subcommand '" + given.front() + "'") +
                      ": expected one of " + names + " (--help says more)");
}

/// A wrong value may be one that nobody has typed.
void note_config(const CLI::App& program, const CLI::ParseError& error, std::ostream& err) {
    if (dynamic_cast<const CLI::FileError*>(&error)) {
        return;
    }
    for (const std::string& file : program.get_config_ptr()->results()) {
        err << "note: options were also taken from " << file << '\n';
    }
}

void require_written(std::ostream& out) {
    if (!out.flush()) {
        throw std::runtime_error("cannot write to the standard output");
    }
}

}  // namespace

int run_program(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
    const Streams streams{out, err};
    try {
        CLI::App program("Wend renders participating media by zero-variance-based path sampling.", "wend");
        program.set_version_flag("--version", std::string("wend ") + WEND_VERSION);
        program.require_subcommand(1);
        // The program's own options may come last.
        program.fallthrough();
        std::vector<std::pair<CLI::App*, Action>> actions;
        for (const auto add : {add_render_command, add_view_command, add_compare_command, add_metric_command,
                               add_merge_command, add_denoise_command, add_demo_command, add_field_command,
                               add_halfspace_command, add_slab_command, add_completion_command, add_man_page_command}) {
            Action action = add(program);
            actions.emplace_back(program.get_subcommands({}).back(), std::move(action));
        }
        add_config_option(program);
        try {
            program.parse(argc, argv);
        } catch (const CLI::ParseError& e) {
            if (e.get_exit_code() != 0 && program.get_subcommands().empty()) {
                throw unknown_subcommand(program);
            }
            if (program.exit(e, out, err) != 0) {
                note_config(program, e, err);
                return 2;
            }
            require_written(out);
            return 0;
        }
        for (const auto& [command, action] : actions) {
            if (command->parsed()) {
                action(streams);
            }
        }
        require_written(out);
        return 0;
    } catch (const EndedBySignal& signal) {
        return 128 + signal.number;
    } catch (const std::exception& e) {
        err << failure_text(e) << '\n';
        return dynamic_cast<const InputError*>(&e) ? 2 : 1;
    }
}

}  // namespace wend
