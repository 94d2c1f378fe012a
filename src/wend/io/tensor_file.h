// Files of named arrays of numbers, in which measured reflections come (dupuy2018).
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace wend {

/// An array of 32-bit floats, the last index fastest.
struct Tensor {
    std::vector<std::size_t> shape;
    std::vector<float> values;
};

/// Reads the arrays of 32-bit floats of such a file by their names; arrays of other types are left out. Throws
/// InputError if the file is not one of version 1.0, or is truncated.
std::map<std::string, Tensor> read_tensors(const std::filesystem::path& file);

}  // namespace wend
