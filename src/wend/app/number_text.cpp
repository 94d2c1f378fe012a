#include <wend/app/number_text.h>

#include <fmt/format.h>

#include <cmath>

namespace wend {

std::string number_text(double value) {
    if (!std::isfinite(value)) {
        return "–";
    }
    const double size = std::abs(value);
    if (size >= 1000 && size < 1e7) {
        return fmt::format("{:.0f}", value);
    }
    return size == 0 || (size >= 1e-3 && size < 1000) ? fmt::format("{:.3g}", value) : fmt::format("{:.2e}", value);
}

}  // namespace wend
