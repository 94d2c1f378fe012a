// What the guide knows along a pixel's first flight, for whoever points at the pixel.
#pragma once

#include <wend/guide/fit.h>
#include <wend/guide/path_records.h>
#include <wend/io/records_file.h>
#include <wend/scene/scene.h>

#include <nlohmann/json_fwd.hpp>

#include <mutex>
#include <optional>
#include <span>

namespace wend {

/// A sample of what a render's walks told the field; safe to be used from any thread.
class SharedRecords {
public:
    /// For RenderSettings::on_records.
    void add(std::span<const guide::PathRecords> records);
    /// Those of a cell of the surfaces' field, or of the volumes'.
    guide::Records in(const guide::Field& field, const guide::Region* region, bool is_surface) const;

private:
    mutable std::mutex mutex_;
    RecordSamples samples_;
};

/// What there is to know about a render where a pixel looks.
struct PixelQuestion {
    Vec2i pixel;                             ///< of the full picture
    std::optional<float> distance;           ///< along the first flight; none: where it most likely ends
    const guide::Fields* fields = nullptr;   ///< null: nothing is guided
    const SharedRecords* records = nullptr;  ///< null: none are kept
};

/// The first segment of the ray through the pixel's middle; in a medium, where guided and classical flights end; at a
/// point of the segment the lobes of the field, its share of classical sampling, what the records saw by direction, and
/// the cells around. Keys: `segment`, `flight`, `at`, `guide`, `cells`; those that there is nothing to say of are null.
/// Null where the camera lets no light through to the pixel.
nlohmann::json pixel_report(const Scene& scene, const PixelQuestion& question);

}  // namespace wend
