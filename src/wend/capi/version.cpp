#include <wend/capi/field.h>

const char* wend_version() noexcept {
    return WEND_VERSION;
}
