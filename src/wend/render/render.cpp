#include <wend/render/render.h>

#include <wend/core/parallel.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/noise_target.h>
#include <wend/render/pass.h>
#include <wend/render/pass_planning.h>
#include <wend/render/schedule.h>
#include <wend/render/spent_time.h>
#include <wend/render/taught.h>
#include <wend/render/tiles_at_work.h>
#include <wend/render/walks.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace wend {

namespace {

void check_rejected(const WalkCounts& counts) {
    if (counts.rejected > 10 && counts.rejected * 10000 > counts.paths) {
        throw std::runtime_error(std::to_string(counts.rejected) + " of " + std::to_string(counts.paths) +
                                 " samples were not finite numbers, more than rounding can explain");
    }
}

}  // namespace

/// What a render is made of.
class Render::Work {
public:
    Work(const Scene& scene, Film& film, RenderSettings settings)
        : scene_(scene),
          film_(film),
          settings_(std::move(settings)),
          schedule_(settings_),
          context_{scene, settings_, static_cast<double>(film.crop().width()) * film.crop().height()},
          tiles_(film.crop(), settings_.ranks),
          records_(tiles_.size()),
          learners_(context_),
          choice_(settings_.preset, {has_fog(scene), learners_.get<InteriorLearner>().can_guide()},
                  settings_.fields != nullptr, tiles_.size(), context_.pixels),
          walks_(scene_, film_, settings_, choice_, learners_) {
        if (settings_.fields) {
            if (auto picture = take_notes(settings_.fields->notes, context_, film_, learners_, choice_)) {
                taught_.push_back(std::move(*picture));
            }
        }
    }

    bool step(double seconds) {
        if (!is_within_pass_) {
            // What a pass begins with takes time, too.
            constexpr int stopped = -1;
            const int count = tiles_.shares().team().agreed(settings_.stop && *settings_.stop ? stopped : next_count());
            is_stopped_ = count == stopped;
            if (count <= 0) {
                return is_stopped_;
            }
            begin_pass(count);
        }
        const Rest rest(std::min(SpentTime().when_spent(seconds), end_of_time()), settings_.stop);
        for (bool is_over = false; all_have_walked(rest, is_over);) {
            share_film();
            if (kinds_of_stage_ == choice_.kinds().size()) {
                end_pass();
                return tiles_.shares().team().agreed(next_count()) > 0;
            }
            film_.begin_stage();
            ++kinds_of_stage_;
            if (is_over) {
                share();
                break;
            }
        }
        return !is_time_over_;
    }

    bool is_within_pass() const { return is_within_pass_; }
    bool is_stopped() const { return is_stopped_; }

    void share() {
        if (is_within_pass_) {
            tiles_.shares().gather([&](auto& bytes, std::size_t tile) {
                archive_work(bytes, *this, tile);
                Film::archive_part(bytes, film_, tiles_[tile].pixels);
            });
        }
    }

    RenderProgress progress() const {
        RenderProgress progress;
        progress.seconds = time_.seconds();
        progress.samples = statistics_.samples;
        progress.relative_noise = ends_by_noise() ? noise_left_.worst : noise_;
        progress.learns = is_within_pass_ && plan_.learns;
        progress.fraction = fraction();
        const double pace = (progress.fraction - mark_.fraction) / (progress.seconds - mark_.seconds);
        progress.seconds_left = pace > 0 ? (1 - progress.fraction) / pace : 0.0;
        if (settings_.seconds > 0) {
            progress.seconds_left =
                std::min(progress.seconds_left, std::max(0.0, settings_.seconds - progress.seconds));
        }
        return progress;
    }

    RenderStatistics statistics() const {
        RenderStatistics statistics = statistics_;
        statistics.seconds = time_.seconds();
        statistics.counts = tiles_.counts();
        const auto means = choice_.means();
        for (std::size_t kind = 0; kind < choice_.kinds().size(); ++kind) {
            const double all = static_cast<double>(std::max<std::uint64_t>(statistics.counts.paths, 1));
            statistics.kinds.push_back(
                {choice_.kinds()[kind], tiles_.walks(kind) / all, means[kind].square, means[kind].work});
        }
        statistics.interrupted = is_within_pass_ || next_count() > 0;
        statistics.ranks = tiles_.shares().team().size();
        statistics.bytes_sent = tiles_.shares().team().bytes_sent();
        statistics.waiting_seconds = tiles_.shares().team().waiting_seconds();
        return statistics;
    }

    std::shared_ptr<const guide::Fields> fields() const {
        return settings_.preset.is_classical()
                   ? nullptr
                   : std::make_shared<const guide::Fields>(learners_.get<FieldLearner>().fields());
    }

    RenderStatistics result() const {
        RenderStatistics result = statistics();
        if (settings_.preset.is_classical()) {
            check_rejected(result.counts);
            return result;
        }
        guide::Fields learned = learners_.get<FieldLearner>().fields();
        if (settings_.keeps_fields) {
            learned.notes = notes_of(context_, film_, learners_, choice_, seen_picture());
        }
        result.fields = std::make_shared<const guide::Fields>(std::move(learned));
        result.field_bytes = result.fields->bytes();
        check_rejected(result.counts);
        return result;
    }

    void save(ArchiveWriter& bytes) const {
        archive(bytes, *this);
        bytes(time_.seconds());
    }
    void restore(ArchiveReader& bytes) {
        archive(bytes, *this);
        double seconds_before = 0;
        bytes(seconds_before);
        bytes.require(bytes.empty() && seconds_before >= 0);
        schedule_.require(statistics_.passes, is_within_pass_ ? plan_.count : 0);
        // It may be the first to be asked for an end by noise, or for this one.
        if (ends_by_noise() && !is_within_pass_) {
            noise_left_ = noise_left(film_, settings_, statistics_.samples);
        }
        time_ = SpentTime(seconds_before);
        tiles_.share_out(plan_);
    }

private:
    /// How far it was, and when.
    struct Mark {
        double fraction = 0, seconds = 0;
    };

    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& work) {
        bytes.same(work.tiles_.size());
        bytes(work.film_, work.learners_, work.choice_, work.is_within_pass_, work.plan_, work.kinds_of_stage_,
              work.noise_, work.noise_left_, work.recorded_samples_, work.mark_, work.last_mark_, work.taught_);
        bytes.require(work.taught_.size() <= 1);
        bytes(work.statistics_.samples, work.statistics_.training_seconds, work.statistics_.passes);
        for (std::size_t i = 0; i < work.tiles_.size(); ++i) {
            archive_work(bytes, work, i);
            bytes.require(work.tiles_[i].kinds_done <= work.kinds_of_stage_);
        }
        const auto is_of_pixels = [&](const auto& list) {
            return list.empty() || list.size() == static_cast<std::size_t>(work.context_.pixels);
        };
        bytes.require(is_of_pixels(work.plan_.estimates) && is_of_pixels(work.plan_.firsts) &&
                      is_of_pixels(work.plan_.counts) &&
                      (work.taught_.empty() || is_of_pixels(work.taught_.front().means)));
        const std::size_t kinds = work.choice_.kinds().size();
        bytes.require(work.kinds_of_stage_ >= 1 && work.kinds_of_stage_ <= kinds && work.plan_.count >= 0 &&
                      work.plan_.first >= 0 && work.statistics_.samples >= 0);
    }

    /// What was done in a tile, but for the film.
    template <class Archive, class Self>
    static void archive_work(Archive& bytes, Self& work, std::size_t tile) {
        bytes(work.tiles_[tile]);
        work.learners_.archive_records(bytes, work.records_[tile]);
    }
    /// Gives all ranks what each has added to the film. Records are exchanged when they are learned from.
    void share_film() {
        tiles_.shares().gather([&](auto& bytes, std::size_t tile) {
            bytes(tiles_[tile]);
            Film::archive_part(bytes, film_, tiles_[tile].pixels);
        });
    }
    /// Goes on with walks of the stage at hand. Whether all ranks have walked theirs; where one is stopped, or time is
    /// over, all know what each has done.
    bool all_have_walked(const Rest& rest, bool& is_over) {
        struct Said {
            bool has_walked, is_stopped, is_time_over;
        };
        const std::vector<Said> all =
            tiles_.shares().team().all(Said{walk(rest), rest.drops_walks(), SpentTime::Clock::now() >= end_of_time()});
        const auto any = [&](bool Said::*what) {
            return std::any_of(all.begin(), all.end(), [what](const Said& said) { return said.*what; });
        };
        const bool have_all = std::all_of(all.begin(), all.end(), [](const Said& said) { return said.has_walked; });
        is_stopped_ = any(&Said::is_stopped);
        is_time_over_ = any(&Said::is_time_over);
        is_over = is_stopped_ || is_time_over_;
        if (is_over && !have_all) {
            share();
        }
        return have_all;
    }

    /// Samples of each pixel in the next pass; 0 at the end.
    int next_count() const {
        if (ends_by_noise() && statistics_.samples >= known_noise && noise_left_.worst <= settings_.noise) {
            return 0;
        }
        return schedule_.next(static_cast<int>(statistics_.passes.size()), statistics_.samples, time_.seconds());
    }

    double fraction() const {
        // Of other ranks it is not known how far they are in the pass at hand. Pixels that get samples by their noise
        // do so in the mean.
        const double own = is_within_pass_ ? tiles_.own_mean_samples() : 0.0;
        const double samples = own > 0 ? own : static_cast<double>(statistics_.samples);
        const double by_noise = ends_by_noise() && noise_left_.samples > 0 ? samples / noise_left_.samples : 0.0;
        return std::min(1.0, std::max(schedule_.fraction(samples, time_.seconds()), by_noise));
    }

    /// Of the time to spend.
    SpentTime::Clock::time_point end_of_time() const {
        return time_.when_spent(schedule_.is_timed() ? settings_.seconds : endless);
    }

    void begin_pass(int count) {
        const bool is_last =
            schedule_.is_last(static_cast<int>(statistics_.passes.size()), statistics_.samples + count);
        plan_ = plan_pass({context_, film_, learners_, choice_, taught()},
                          {statistics_.samples, recorded_samples_, noise_}, count, is_last);
        if (ends_by_noise() && !plan_.counts.empty() && plan_.first >= known_noise) {
            plan_.counts = counts_to_noise(film_, settings_, count);
        }
        learners_.begin(plan_);
        tiles_.begin_pass(choice_, plan_);
        // By one sample a stage would not know its variance.
        const std::size_t kinds = choice_.kinds().size();
        kinds_of_stage_ = choice_.is_trial() && plan_.count >= 2 * static_cast<int>(kinds) ? 1 : kinds;
        is_within_pass_ = true;
    }

    bool ends_by_noise() const { return settings_.noise > 0; }

    void end_pass() {
        is_within_pass_ = false;
        tiles_.end_pass();
        // Where a pass leaves out what has no more noise than wanted, it has fewer samples than planned.
        statistics_.samples = ends_by_noise() && !plan_.counts.empty() ? static_cast<int>(tiles_.mean_samples())
                                                                       : statistics_.samples + plan_.count;
        statistics_.passes.push_back(plan_.count);
        const SpentTime training;
        learners_.learn(records_, plan_, tiles_.shares());
        statistics_.training_seconds += training.seconds();
        // The next pass will sample in another way: what it learned from has changed, or survival begins to follow it.
        const bool warms_up = !settings_.preset.is_classical() && plan_.first < warm_up_samples;
        if (plan_.learns) {
            recorded_samples_ += plan_.count * choice_.recorded_share(plan_.count);
        }
        const bool chooses_anew = choose(statistics_.samples);
        if ((statistics_.samples >= warm_up_samples || choice_.is_trial()) &&
            (learners_.changes_walks() || warms_up || chooses_anew)) {
            film_.begin_stage();
        }
        noise_ = film_.relative_noise();
        if (ends_by_noise()) {
            noise_left_ = noise_left(film_, settings_, statistics_.samples);
        }
        mark_ = std::exchange(last_mark_, {fraction(), time_.seconds()});
    }

    const TaughtPicture* taught() const { return taught_.empty() ? nullptr : &taught_.front(); }
    /// What later renders may know of the picture.
    TaughtPicture seen_picture() const {
        return is_within_pass_ ? TaughtPicture() : picture_seen(context_, film_, statistics_.samples);
    }

    /// By what the pass has shown, the kinds of walks to come; whether that changes anything.
    bool choose(int samples) {
        return choice_.learn(tiles_.tallies(), samples, learners_.get<FieldLearner>().records());
    }

    /// Walks of the stage at hand; whether all have been walked.
    bool walk(const Rest& rest) {
        std::atomic<bool> have_all = true;
        parallel_for(tiles_.size(), settings_.threads, [&](std::size_t i) {
            while (tiles_.shares().owns(i) && tiles_[i].kinds_done < kinds_of_stage_) {
                if (!walks_.walk(plan_, rest, tiles_[i], records_[i])) {
                    have_all = false;
                    break;
                }
            }
        });
        return have_all;
    }

    const Scene& scene_;
    Film& film_;
    const RenderSettings settings_;
    Schedule schedule_;
    LearningContext context_;
    TilesAtWork tiles_;
    std::vector<Learners::Records> records_;  ///< by tile
    Learners learners_;
    GuidingChoice choice_;
    const Walks walks_;
    std::vector<TaughtPicture> taught_;  ///< by an earlier render: one, or none

    bool is_stopped_ = false, is_time_over_ = false;
    bool is_within_pass_ = false;
    double recorded_samples_ = 0;  ///< of each pixel: those that the fields have learned from
    PassPlan plan_;                ///< of the pass at hand
    /// Those whose walks are drawn before the film begins another stage, with those of the stages before in this pass.
    std::size_t kinds_of_stage_ = 1;
    double noise_ = 0;             ///< after the last pass
    NoiseLeft noise_left_;         ///< likewise, where noise ends the render
    Mark mark_, last_mark_;        ///< at the ends of the last two passes
    RenderStatistics statistics_;  ///< samples, passes and time to train
    SpentTime time_;
};

Render::Render(const Scene& scene, Film& film, RenderSettings settings)
    : work_(std::make_unique<Work>(scene, film, std::move(settings))) {
}

Render::~Render() = default;

bool Render::step(double seconds) {
    return work_->step(seconds);
}

bool Render::is_within_pass() const {
    return work_->is_within_pass();
}

bool Render::is_stopped() const {
    return work_->is_stopped();
}

void Render::share() {
    work_->share();
}

RenderProgress Render::progress() const {
    return work_->progress();
}

RenderStatistics Render::statistics() const {
    return work_->statistics();
}

std::shared_ptr<const guide::Fields> Render::fields() const {
    return work_->fields();
}

RenderStatistics Render::result() const {
    return work_->result();
}

void Render::save(ArchiveWriter& bytes) const {
    work_->save(bytes);
}

void Render::restore(ArchiveReader& bytes) {
    work_->restore(bytes);
}

RenderStatistics render(const Scene& scene, Film& film, const RenderSettings& settings,
                        const std::function<bool(const RenderProgress&)>& keep_going) {
    Render render(scene, film, settings);
    for (bool goes_on = true; goes_on;) {
        goes_on = render.step() && !render.is_stopped();
        if (!render.is_within_pass() && keep_going && !keep_going(render.progress())) {
            break;
        }
    }
    return render.result();
}

}  // namespace wend
