#include <wend/io/json_text.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace wend {

nlohmann::json json_number(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json json_vector(const Vec3& v) {
    return {json_number(v.x), json_number(v.y), json_number(v.z)};
}

std::string json_text(const nlohmann::json& value, int indent) {
    return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace wend
