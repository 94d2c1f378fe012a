#include <wend/render/tile.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(Tile, ExpectsTheWorkOfItsSharesOfEachKind) {
    Tile tile;
    EXPECT_EQ(tile.expected_work(), 0);
    tile.walks = {10, 5};
    tile.work = {20, 50};
    tile.shares = {0.5f, 0.5f};
    EXPECT_DOUBLE_EQ(tile.expected_work(), 0.5 * 2 + 0.5 * 10);
    tile.shares = {0, 1};
    EXPECT_DOUBLE_EQ(tile.expected_work(), 10);
}

TEST(Tile, ExpectsOfAKindThatItHasNotSeenWhatOthersShow) {
    Tile tile;
    tile.walks = {10, 5};
    tile.work = {20, 50};
    tile.shares = {0, 0, 1};
    EXPECT_DOUBLE_EQ(tile.expected_work(), 70.0 / 15);
}

}  // namespace
}  // namespace wend
