#include <wend/guide/sealed_bytes.h>

#include <wend/core/error.h>

#include <boost/crc.hpp>

#include <bit>
#include <cstring>

namespace wend::guide {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the bytes of big-endian machines need a signature of their own");

std::uint32_t checksum(std::string_view bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
}

std::uint32_t number_at(std::string_view bytes, std::size_t place) {
    std::uint32_t number;
    std::memcpy(&number, bytes.data() + place, sizeof number);
    return number;
}

void put(std::string& out, std::uint32_t number) {
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

std::string seal(const SealedKind& kind, std::string_view body) {
    std::string out(kind.signature);
    put(out, kind.version);
    out += body;
    put(out, checksum(out));
    return out;
}

std::string_view unseal(const SealedKind& kind, std::string_view bytes) {
    const auto refuse = [&](const std::string& reason) { throw InputError(std::string(kind.title) + ": " + reason); };
    if (!bytes.starts_with(kind.signature)) {
        refuse("these are no bytes of " + std::string(kind.noun));
    }
    const std::size_t head = kind.signature.size() + sizeof(std::uint32_t);
    if (bytes.size() < head + sizeof(std::uint32_t)) {
        refuse("the bytes are truncated");
    }
    if (const std::uint32_t found = number_at(bytes, kind.signature.size()); found != kind.version) {
        refuse("version " + std::to_string(found) + " is not known; this is version " + std::to_string(kind.version));
    }
    const std::size_t end = bytes.size() - sizeof(std::uint32_t);
    if (number_at(bytes, end) != checksum(bytes.substr(0, end))) {
        refuse("the checksum does not fit: the bytes are truncated or were changed");
    }
    return bytes.substr(head, end - head);
}

}  // namespace wend::guide
