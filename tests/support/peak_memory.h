// How much memory a piece of work takes.
#pragma once

namespace wend::test {

/// From its construction on; one at a time. Memory that was held and given back before does not hide what is taken.
class PeakMemory {
public:
    PeakMemory();
    /// By how much more than at first the process has held at most, in bytes.
    double growth() const;

private:
    double before_;
};

}  // namespace wend::test
