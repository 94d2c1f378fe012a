#include <wend/core/archive.h>
#include <wend/guide/field_bytes.h>
#include <wend/guide/field_memory.h>

#include <algorithm>
#include <utility>

namespace wend::guide {

/// All that is known of a cell.
struct FieldBytes::Leaf {
    Region region;
    Field::Memory memory;
    ScatteredLight scattered;
};

/// What has become of a cell: a tree whose leaves count from 0.
struct FieldBytes::Branch {
    std::uint32_t cell = 0;
    std::vector<Field::Node> nodes;
    std::vector<Leaf> leaves;

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& branch) {
        bytes(branch.cell, branch.nodes, branch.leaves);
        const std::size_t nodes = branch.nodes.size();
        bytes.require(nodes > 0 && nodes + 1 == 2 * branch.leaves.size());
        for (std::size_t i = 0; i < nodes; ++i) {
            const Field::Node& node = branch.nodes[i];
            bytes.require(node.axis == Field::Node::leaf ? node.child < branch.leaves.size()
                                                         : node.child > i && node.child + 1u < nodes);
        }
    }
};

std::string FieldBytes::branches(const Field& next, const Field& before, std::span<const std::uint32_t> cells) {
    std::vector<std::uint32_t> roots(before.size());
    for (std::uint32_t node = 0; node < before.nodes_.size(); ++node) {
        if (before.nodes_[node].axis == Field::Node::leaf) {
            roots[before.nodes_[node].child] = node;
        }
    }
    std::vector<Branch> branches;
    branches.reserve(cells.size());
    for (const std::uint32_t cell : cells) {
        Branch& branch = branches.emplace_back();
        branch.cell = cell;
        branch.nodes.push_back(next.nodes_[roots[cell]]);
        for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
            const Field::Node node = branch.nodes[i];
            std::size_t child = branch.leaves.size();
            if (node.axis == Field::Node::leaf) {
                branch.leaves.push_back(
                    {next.regions_[node.child], next.memories_[node.child], next.scattered_[node.child]});
            } else {
                child = branch.nodes.size();
                branch.nodes.push_back(next.nodes_[node.child]);
                branch.nodes.push_back(next.nodes_[node.child + 1]);
            }
            branch.nodes[i].child = static_cast<std::uint32_t>(child) & Field::largest_child;
        }
    }
    ArchiveWriter bytes;
    bytes(next.trained_, branches);
    return bytes.take();
}

Field FieldBytes::graft(Field next, const Field& before, std::span<const std::string> told) {
    std::vector<Branch> branches(before.size());
    for (const std::string& one : told) {
        ArchiveReader bytes(one);
        bool is_trained = false;
        std::vector<Branch> some;
        bytes(is_trained, some);
        bytes.require(bytes.empty());
        next.trained_ = next.trained_ || is_trained;
        for (Branch& branch : some) {
            bytes.require(branch.cell < branches.size() && branches[branch.cell].nodes.empty());
            branches[branch.cell] = std::move(branch);
        }
    }
    next.nodes_ = before.nodes_;
    next.regions_.resize(before.size());
    next.memories_.resize(before.size());
    next.scattered_.resize(before.size());
    // Level by level over all cells, as Fitting splits them.
    struct Open {
        std::uint32_t node;
        const Branch* branch;
        std::uint32_t in_branch;
    };
    std::vector<Open> open, children;
    for (std::uint32_t node = 0; node < before.nodes_.size(); ++node) {
        if (before.nodes_[node].axis == Field::Node::leaf && !branches[before.nodes_[node].child].nodes.empty()) {
            open.push_back({node, &branches[before.nodes_[node].child], 0});
        }
    }
    for (; !open.empty(); open = std::exchange(children, {})) {
        for (const auto& [node, branch, in_branch] : open) {
            const Field::Node& of_branch = branch->nodes[in_branch];
            const std::uint32_t region = next.nodes_[node].child;
            if (of_branch.axis == Field::Node::leaf) {
                const Leaf& leaf = branch->leaves[of_branch.child];
                next.regions_[region] = leaf.region;
                next.memories_[region] = leaf.memory;
                next.scattered_[region] = leaf.scattered;
                continue;
            }
            const auto first = static_cast<std::uint32_t>(next.nodes_.size());
            const auto other_region = static_cast<std::uint32_t>(next.regions_.size());
            next.nodes_[node] = of_branch;
            next.nodes_[node].child = first & Field::largest_child;
            Field::Node child;
            child.child = region & Field::largest_child;
            next.nodes_.push_back(child);
            child.child = other_region & Field::largest_child;
            next.nodes_.push_back(child);
            next.regions_.emplace_back();
            next.memories_.emplace_back();
            next.scattered_.emplace_back();
            children.push_back({first, branch, of_branch.child});
            children.push_back({first + 1, branch, of_branch.child + 1u});
        }
    }
    return next;
}

}  // namespace wend::guide
