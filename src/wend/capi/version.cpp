#include <wend/capi/base.h>

const char* wend_version() noexcept {
    return WEND_VERSION;
}
