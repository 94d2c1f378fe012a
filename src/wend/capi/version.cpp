#include <wend/capi/guide.h>

const char* wend_version(void) WEND_NOEXCEPT {
    return WEND_VERSION;
}
