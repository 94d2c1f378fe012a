// What all bytes that the guide writes have around them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace wend::guide {

/// A kind of bytes: how messages begin that are about them and what they call one of it, the bytes' first characters,
/// and the version of what is in them.
struct SealedKind {
    std::string_view title;
    std::string_view noun;
    std::string_view signature;
    std::uint32_t version;
};

/// Signature and version, the body, and a checksum of all.
std::string seal(const SealedKind& kind, std::string_view body);

/// The body of sealed bytes, which it refers to. Throws InputError for another kind or version, and where the checksum
/// does not fit.
std::string_view unseal(const SealedKind& kind, std::string_view bytes);

}  // namespace wend::guide
