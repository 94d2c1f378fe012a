#include <tests/support/peak_memory.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace wend::test {
namespace {

double peak() {
    std::ifstream status("/proc/self/status");
    for (std::string name; status >> name; std::getline(status, name)) {
        if (double kilobytes = 0; name == "VmHWM:" && status >> kilobytes) {
            return 1024 * kilobytes;
        }
    }
    throw std::runtime_error("/proc/self/status has no VmHWM");
}

}  // namespace

PeakMemory::PeakMemory() {
    // The peak is what is held now (man 5 proc).
    std::ofstream("/proc/self/clear_refs") << 5;
    before_ = peak();
}

double PeakMemory::growth() const {
    return peak() - before_;
}

}  // namespace wend::test
