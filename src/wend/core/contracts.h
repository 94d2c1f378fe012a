// Contracts between parts of the program. A violated contract is a mistake of ours, never of the user's input
// (which throws InputError, see core/error.h). They are checked in debug builds and vanish in release builds.
#pragma once

#include <wend/core/export.h>

#ifdef NDEBUG
#define WEND_CONTRACT_(kind, condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#else
#define WEND_CONTRACT_(kind, condition) \
    ((condition) ? static_cast<void>(0) : ::wend::contract_violated(kind, #condition, __FILE__, __LINE__))
#endif

/// What a caller must provide.
#define WEND_EXPECT(condition) WEND_CONTRACT_("expected", condition)
/// What must hold in the middle of a computation.
#define WEND_ASSERT(condition) WEND_CONTRACT_("asserted", condition)
/// What a function promises on return.
#define WEND_ENSURE(condition) WEND_CONTRACT_("ensured", condition)

namespace wend {

/// Prints the broken contract with its place and aborts.
[[noreturn]] WEND_API void contract_violated(const char* kind, const char* condition, const char* file, int line);

}  // namespace wend
