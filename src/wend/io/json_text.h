// JSON as this program writes it.
#pragma once

#include <wend/core/vector.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace wend {

/// Numbers as JSON has them: null where not finite.
nlohmann::json json_number(double value);

/// Its three numbers.
nlohmann::json json_vector(const Vec3& v);

/// JSON as text; what is not UTF-8 in it (file names may be anything) is replaced. No line breaks if `indent` is
/// negative.
std::string json_text(const nlohmann::json& value, int indent = -1);

}  // namespace wend
