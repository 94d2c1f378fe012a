#include <wend/app/progress.h>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace wend {

ProgressBar::ProgressBar(std::ostream& stream, bool enabled, std::string label)
    : stream_(stream),
      enabled_(enabled),
      terminal_(&stream == &std::cerr && isatty(STDERR_FILENO) != 0),
      label_(std::move(label)),
      last_(std::chrono::steady_clock::now()) {
}

ProgressBar::~ProgressBar() {
    if (drawn_ && terminal_) {
        stream_ << '\n' << std::flush;
    }
}

void ProgressBar::update(const RenderProgress& p) {
    const std::string noise =
        p.relative_noise > 0 ? fmt::format("  noise {:.1f} %", 100 * p.relative_noise) : std::string();
    update(p.fraction, p.seconds, fmt::format("{} spp{}", p.samples, noise));
}

void ProgressBar::update(double fraction, double seconds, const std::string& detail) {
    const auto now = std::chrono::steady_clock::now();
    const auto interval = std::chrono::milliseconds(terminal_ ? 100 : 10000);
    if (!enabled_ || (now - last_ < interval && fraction < 1)) {
        return;
    }
    last_ = now;
    const double left = fraction > 0 ? seconds * (1 - fraction) / fraction : 0;
    const std::string state = fmt::format("{:3.0f} %  {} left  {}", 100 * fraction, format_duration(left), detail);
    if (terminal_) {
        constexpr int width = 30;
        const int full = std::clamp(static_cast<int>(std::lround(width * fraction)), 0, width);
        stream_ << fmt::format("\r{} [{}{}] {}\x1b[K", label_, std::string(static_cast<std::size_t>(full), '='),
                               std::string(static_cast<std::size_t>(width - full), ' '), state);
        drawn_ = true;
    } else {
        stream_ << label_ << ": " << state << '\n';
    }
    stream_ << std::flush;
}

std::string format_duration(double seconds) {
    const auto total = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, 1e9)));
    if (total >= 3600) {
        return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
    }
    return fmt::format("{}:{:02}", total / 60, total % 60);
}

}  // namespace wend
