// Means that are kept: what takes longest in many tests is to know well what they compare with.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace wend::test {

/// What is known beforehand.
struct KnownMean {
    double mean = 0, standard_error = 0;
};

/// What tests/references/means.csv has under that name: means by unguided walks, with their standard errors. What it
/// does not have is measured, written there, and fails the test, since nobody knows yet whether it is right. Delete the
/// line of a scene that is changed.
std::vector<KnownMean> kept_means(const std::string& name, const std::function<std::vector<KnownMean>()>& measure);

}  // namespace wend::test
