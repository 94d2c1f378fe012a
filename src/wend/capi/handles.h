// What is behind the handles of the interface for C.
#pragma once

#include <wend/capi/field.h>
#include <wend/guide/field.h>

struct wend_field {
    wend::guide::Field value;
};
