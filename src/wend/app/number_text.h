#pragma once

#include <string>

namespace wend {

/// A number to read: three significant digits, without an exponent where that is short; a dash for what is not finite.
std::string number_text(double value);

}  // namespace wend
