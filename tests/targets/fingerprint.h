// What the guide computes, as one number.
#pragma once

#include <cstdint>

namespace wend::test {

/// A hash of a field fitted in passes and of products, samples and densities asked of it: any bit that differs shows.
std::uint64_t fingerprint();

}  // namespace wend::test
