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

/// What tests/support/means.csv has under that name: means by unguided walks, with their standard errors. Where it
/// has nothing it throws, or with WEND_MEANS=record measures them and writes them there. Delete the line of a scene
/// that is changed.
std::vector<KnownMean> kept_means(const std::string& name, const std::function<std::vector<KnownMean>()>& measure);

}  // namespace wend::test
