// Where a render ends that is to have no more than so much noise anywhere: square by square of the picture.
#pragma once

#include <wend/film/film.h>
#include <wend/render/render.h>

#include <array>
#include <cstdint>
#include <vector>

namespace wend {

/// What is known of the noise of squares of 16x16 pixels, once a pass has ended. The noise of a square is the relative
/// standard error of its pixels (PixelNoise), as a root mean square.
///
/// What the pixels of one colour of the chess board show (film/chess_board.h) says how many samples those of the other
/// need, so that no sample has a say in how many follow in its pixel. A square counts as no quieter than half of the
/// variance of the nine squares around it, and a twentieth of that of the picture: where few rare values are to be
/// expected, none of them may have been seen yet.
class SquaresNoise {
public:
    /// Of a picture of that width, row by row.
    SquaresNoise(const std::vector<PixelNoise>& pixels, int width);

    /// The noise of the noisiest square, its two colours apart; 0 where nothing is known.
    double worst() const;
    /// More samples of a pixel, as a mean over the picture, until no square has more noise than that (positive): given
    /// to those that need them, or to all alike.
    double missing(double target, bool to_those_in_need) const;
    /// Of each pixel, how many samples the next pass may give it: none where its square has no more noise than that;
    /// else about as many as it lacks, and no more than it has had, since what is known of it may change.
    std::vector<double> most_samples(double target) const;

private:
    static constexpr int side = 16;

    /// One colour of a square: its pixels, their samples, and the variance of a sample that is reckoned with.
    struct Half {
        double pixels = 0, samples = 0, variance = 0;

        /// Samples that it needs, over those that it has had.
        double needed(double target) const;
    };
    using Square = std::array<Half, 2>;

    std::size_t square_of(std::size_t pixel) const;
    /// The variance that the pixels of one colour show, in each square, where those around it have their say.
    std::vector<double> variances_shown(const std::vector<Square>& seen, std::size_t half) const;

    const std::vector<PixelNoise>& pixels_;
    int width_, columns_, rows_;
    std::vector<Square> squares_;
};

/// By fewer samples of each pixel noise is not known.
inline constexpr int known_noise = 15;

/// How far a render is from the noise that it is to end at.
struct NoiseLeft {
    double worst = 0;    ///< SquaresNoise::worst(), after the last pass
    double samples = 0;  ///< of a pixel, as a mean, that it is expected to end with; 0: not known

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& left) {
        bytes(left.worst, left.samples);
        bytes.require(left.worst >= 0 && left.samples >= 0);
    }
};

/// Of a render that ends at `settings.noise`, with so many samples of a pixel, as a mean.
NoiseLeft noise_left(const Film& film, const RenderSettings& settings, int samples);

/// As sample_counts(), but for no more samples than SquaresNoise::most_samples() of `settings.noise`.
std::vector<std::uint32_t> counts_to_noise(const Film& film, const RenderSettings& settings, int count);

}  // namespace wend
