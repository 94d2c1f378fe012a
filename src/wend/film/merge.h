// One picture of several independent renders.
#pragma once

#include <wend/film/picture.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace wend {

/// What merge_pictures() makes.
struct MergedPictures {
    Picture picture;                    ///< without metadata
    std::vector<double> shares;         ///< of each picture in all weights; their sum is 1
    std::vector<std::string> left_out;  ///< layers that not all pictures have, so that the merged one has them neither
    std::size_t empty = 0;              ///< pixels without a sample in any picture: they are black
};

/// Joins independent unbiased estimates of one picture, such as renders that differ in their seeds. That they are
/// independent, and of the same picture, is for the caller to know.
///
/// The beauty is Σ w m / Σ w. A pixel's weight is its samples times what a sample of that picture is worth: the inverse
/// of a sample's variance relative to the picture, as the mean over one half of a chess board, for the pixels of the
/// other half. So no sample has a say in its own weight, and the merged mean is the one of its parts. Differences in
/// variance count as far as they are significant: with rare bright samples the noise of a variance is large, and
/// following it would cost more than it brings. Where variances are not known (one sample a pixel), samples alone
/// count.
///
/// The layer `variance` is that of the merged pixel, Σ w² v / (Σ w)². Pictures with one sample in a pixel do not know
/// theirs: others speak for them, or if there are none, the scatter of these samples. `samples` are summed. Parts of
/// the beauty and its halves (counts_as_beauty()) are weighted as it is, so that they still add up to it; all other
/// layers are means over samples. A picture without samples in a pixel counts nothing there.
///
/// `read` is called with 0 to count - 1 in order, three times over, so that only one of the pictures has to be in
/// memory beside the sums. Throws InputError where a picture lacks `variance` (R, G, B) or `samples` (N), has numbers
/// there that cannot be, or a beauty that is not finite, or has another size, or a layer with other channels than the
/// first picture. The message does not name the picture: it is the last one read.
MergedPictures merge_pictures(std::size_t count, const std::function<Picture(std::size_t)>& read);

}  // namespace wend
