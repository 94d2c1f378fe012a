// The subcommands, one file each: a function that adds it to the program and returns what it does.
#pragma once

#include <wend/app/options.h>

namespace wend {

Action add_render_command(CLI::App& program);
Action add_view_command(CLI::App& program);
Action add_compare_command(CLI::App& program);
Action add_metric_command(CLI::App& program);
Action add_merge_command(CLI::App& program);
Action add_denoise_command(CLI::App& program);
Action add_demo_command(CLI::App& program);
Action add_field_command(CLI::App& program);
Action add_halfspace_command(CLI::App& program);
Action add_slab_command(CLI::App& program);
Action add_completion_command(CLI::App& program);
/// Not in --help: for who packs the program.
Action add_man_page_command(CLI::App& program);

/// The names that --sampling takes, for help texts.
std::string guidable_decisions_text();

}  // namespace wend
