// C++ values in the caller's memory.
#pragma once

#include <wend/capi/boundary.h>

#include <cstdint>
#include <new>
#include <type_traits>

namespace wend::capi {

/// A C++ value inside an opaque object of C. The mark tells it from memory that nobody has filled.
template <class Value, std::uint64_t own_mark>
struct Stored {
    static constexpr std::uint64_t mark = own_mark;

    std::uint64_t found = mark;
    Value value;
};

/// Puts a value into an opaque object. The value is of numbers alone: C copies it byte by byte and forgets it.
template <class Kind, class Object, class Value>
void store(Object& object, const Value& value) {
    static_assert(sizeof(Kind) <= sizeof(Object) && alignof(Kind) <= alignof(Object));
    static_assert(std::is_trivially_destructible_v<Kind>);
    new (static_cast<void*>(object.bytes)) Kind{.value = value};
}

/// The value in an opaque object, or null if there is none of this kind.
template <class Kind, class Object>
const decltype(Kind::value)* stored(const Object& object) {
    const auto& kind = *std::launder(reinterpret_cast<const Kind*>(object.bytes));
    return kind.found == Kind::mark ? &kind.value : nullptr;
}

template <class Object>
void require_object(const Object* object, const char* null_message) {
    require(object, null_message);
    require(reinterpret_cast<std::uintptr_t>(object) % alignof(Object) == 0,
            "an opaque object is not aligned as its type demands");
}

}  // namespace wend::capi
