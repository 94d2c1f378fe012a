// A film as bytes, to compare.
#pragma once

#include <wend/core/archive.h>
#include <wend/film/film.h>

#include <string>

namespace wend::test {

/// The whole film, as it would be saved.
inline std::string bytes_of(const Film& film) {
    ArchiveWriter bytes;
    bytes(film);
    return bytes.take();
}

}  // namespace wend::test
