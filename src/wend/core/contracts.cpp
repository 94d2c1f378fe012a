#include <wend/core/contracts.h>

#include <cstdio>
#include <cstdlib>

namespace wend {

void contract_violated(const char* kind, const char* condition, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: %s: %s\n", file, line, kind, condition);
    std::abort();
}

}  // namespace wend
