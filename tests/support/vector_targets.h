// Calling what was compiled for several vector targets, one after the other.
#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace wend::test {

/// Calls body() once for every target that was compiled and that this processor can run, with Highway kept to it.
template <class Body>
void for_each_target(const Body& body) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        body();
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace wend::test
