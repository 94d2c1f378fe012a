#include <wend/film/chess_board.h>

#include <utility>

namespace wend {

Image filled_from_half(Image image, std::size_t half) {
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (static_cast<std::size_t>((x + y) % 2) == half) {
                continue;
            }
            Rgb sum;
            int neighbours = 0;
            for (const auto& [nx, ny] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
                if (nx >= 0 && ny >= 0 && nx < image.width && ny < image.height) {
                    sum += image.at(nx, ny);
                    ++neighbours;
                }
            }
            image.at(x, y) = neighbours > 0 ? sum / static_cast<float>(neighbours) : sum;
        }
    }
    return image;
}

}  // namespace wend
