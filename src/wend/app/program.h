// The wend program: its command line and its exit status.
#pragma once

#include <iosfwd>

namespace wend {

/// Runs the program. Results go to `out`, progress and errors to `err`. Returns the exit status: 0, 1 for a failure, 2
/// for bad input.
int run_program(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace wend
