// A field's inside as bytes, whole or cell by cell.
#pragma once

#include <wend/guide/field.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wend::guide {

class FieldBytesReader;

/// Sees a field's inside.
class FieldBytes {
public:
    static std::string body(const Field& field);
    static Field field(FieldBytesReader& in);

    /// Which of the size() cells a position belongs to, whether or not the field has learned anything.
    static std::size_t cell_at(const Field& field, const Vec3& position) {
        return field.nodes_[field.leaf_of(position)].child;
    }
    /// What has become of some cells of a field in the next one, in that order: how they were split, and all that is
    /// known of the parts, bit by bit, for graft() on a machine of the same kind.
    static std::string branches(const Field& next, const Field& before, std::span<const std::uint32_t> cells);
    /// The next field of all, numbered as if one fit had made it: `next` in those cells that nobody tells of. Each
    /// cell may be told of once. Throws InputError for other bytes than those of branches().
    static Field graft(Field next, const Field& before, std::span<const std::string> told);

private:
    struct Leaf;
    struct Branch;

    static void require_tree(const Field& field);
};

}  // namespace wend::guide
