// Bytes whose checksum fits, so that what is behind it is reached.
#pragma once

#include <wend/core/error.h>
#include <wend/guide/sealed_bytes.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace wend::fuzz {

/// Signature, version and body as the input has them, with their checksum. An input is what guide::seal() makes,
/// without the last four bytes.
inline std::string sealed(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t signature_bytes = 8;
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    std::uint32_t version = 0;
    if (size < signature_bytes + sizeof version) {
        return std::string(input);
    }
    std::memcpy(&version, data + signature_bytes, sizeof version);
    return guide::seal({"", "", input.substr(0, signature_bytes), version},
                       input.substr(signature_bytes + sizeof version));
}

}  // namespace wend::fuzz
