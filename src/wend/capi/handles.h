// What is behind the handles of capi/guide.h.
#pragma once

#include <wend/capi/guide.h>
#include <wend/guide/field.h>

struct wend_field {
    wend::guide::Field value;
};
