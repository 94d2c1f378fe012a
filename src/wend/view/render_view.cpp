#include <wend/view/render_view.h>

#include <utility>

namespace wend {
namespace {

// Of the time, what pictures take at most.
constexpr int part_of_time = 50;
// What an eye follows.
constexpr std::chrono::milliseconds shortest{200};

/// The beauty alone takes a tenth of the time that all layers take.
Picture picture_of(const Film& film, bool with_layers) {
    if (with_layers) {
        return film.picture();
    }
    Picture picture;
    picture.image = film.beauty();
    picture.offset = film.crop().min;
    picture.full_size = film.full_size();
    return picture;
}

}  // namespace

RenderView::RenderView(Board& board, std::size_t index, std::string name) : board_(board), index_(index) {
    shown_.name = std::move(name);
    shown_.phase = "learning";
    shown_.layers = layer_names(Film({1, 1}, {{0, 0}, {1, 1}}).picture());
    board_.show(index_, shown_);
}

bool RenderView::is_due() const {
    const bool lacks_layers = board_.wants_layers(index_) && !has_layers_;
    return Clock::now() >= next_ && (board_.is_wanted(index_, shown_.version) || lacks_layers);
}

void RenderView::update(const Render& render, const Film& film, const RenderProgress& progress,
                        const std::string& phase) {
    const bool stands_still = phase == "paused" || phase == "done";
    shown_.size = {film.crop().width(), film.crop().height()};
    shown_.offset = film.crop().min;
    shown_.phase = phase;
    shown_.progress = progress;
    if (progress.samples != samples_) {
        samples_ = progress.samples;
        shown_.kinds = render.statistics().kinds;
        shown_.fields = render.fields();
        shown_.records = shown_.fields ? records_ : nullptr;
        shown_.curve.push_back({shown_.progress.seconds, shown_.progress.samples, shown_.progress.relative_noise});
    }
    // What stands still is drawn once more, with all that is known.
    const bool is_last = stands_still && !std::exchange(is_last_, stands_still);
    is_last_ = stands_still;
    if (is_last || (!stands_still && is_due())) {
        const Clock::time_point start = Clock::now();
        has_layers_ = stands_still || board_.wants_layers(index_);
        shown_.picture = std::make_shared<const Picture>(picture_of(film, has_layers_));
        ++shown_.version;
        const Clock::time_point end = Clock::now();
        next_ = end + std::max<Clock::duration>(part_of_time * (end - start), shortest);
    }
    board_.show(index_, shown_);
}

const char* phase_of(const RenderProgress& progress) {
    return progress.learns ? "learning" : "rendering";
}

}  // namespace wend
