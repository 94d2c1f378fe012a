#include <wend/capi/guide.h>

const char* wend_version() noexcept {
    return WEND_VERSION;
}
