#pragma once

#include <wend/io/pbrt/location.h>

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace wend::pbrt {

/// Indices for names that may be used before they are defined.
class NameTable {
public:
    /// `kind` is what messages call a name: "material".
    explicit NameTable(std::string kind) : kind_(std::move(kind)) {}

    /// The index of a name, defined or not.
    std::size_t use(const std::string& name, const Location& place);
    /// The index of a name that is defined here. Throws InputError if it is defined already.
    std::size_t define(const std::string& name, const Location& place);
    /// An index without a name.
    std::size_t define_anonymous(const Location& place);

    /// Throws InputError at the first use of a name that was never defined.
    void require_all_defined() const;

private:
    struct Slot {
        std::string name;
        Location place;  // of the definition, or else of the first use
        bool defined = false;
    };

    std::string kind_;
    std::vector<Slot> slots_;
    std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace wend::pbrt
