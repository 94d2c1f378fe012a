// The tiles of a picture, shared out among the processes that render it.
#pragma once

#include <wend/core/archive.h>
#include <wend/core/team.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace wend {

/// Which rank walks which tile. A process that is alone walks all.
class TileShares {
public:
    /// `ranks` may be null, and must outlive this.
    explicit TileShares(Ranks* ranks) : team_(ranks) {}

    Team& team() { return team_; }
    const Team& team() const { return team_; }

    /// Anew, by the work that each tile has been so far.
    void share_out(const std::vector<std::uint64_t>& work) {
        if (!team_.is_alone()) {
            owners_ = shares_of_ranks(work, team_.size());
        }
    }
    /// Whether this process walks a tile.
    bool owns(std::size_t tile) const { return team_.is_alone() || owners_[tile] == team_.rank(); }

    /// Tells all others something of the tiles that this process walks, and takes the same of theirs:
    /// `archive(bytes, tile)` hands it over, both ways.
    template <class ArchiveTile>
    void gather(const ArchiveTile& archive) {
        if (team_.is_alone()) {
            return;
        }
        ArchiveWriter mine;
        for (std::size_t tile = 0; tile < owners_.size(); ++tile) {
            if (owns(tile)) {
                archive(mine, tile);
            }
        }
        const std::vector<std::string> all = team_.gather(mine.take());
        for (std::size_t rank = 0; rank < all.size(); ++rank) {
            if (static_cast<int>(rank) == team_.rank()) {
                continue;
            }
            ArchiveReader bytes(all[rank]);
            for (std::size_t tile = 0; tile < owners_.size(); ++tile) {
                if (owners_[tile] == static_cast<int>(rank)) {
                    archive(bytes, tile);
                }
            }
            bytes.require(bytes.empty());
        }
    }

private:
    Team team_;
    std::vector<int> owners_;  ///< by tile: ranks; none where there is one
};

}  // namespace wend
