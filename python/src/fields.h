// The learned fields as Python holds them: shared, since they never change.
#pragma once

#include <wend/guide/fit.h>

namespace wend::python {

using FieldPointer = std::shared_ptr<const guide::Field>;

}  // namespace wend::python
