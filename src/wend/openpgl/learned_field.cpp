#include <wend/openpgl/learned_field.h>

#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/guide/field.h>
#include <wend/guide/sealed_bytes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <utility>

namespace wend::openpgl {
namespace {

constexpr guide::SealedKind kind_of_field{"a guiding field", "a field", "WENDPGF\x1a", 1};

/// What Open PGL's default of samples per leaf is for, in Wend's own.
constexpr double leaf_scale = PGL_TREE_MAX_SAMPLE_PER_LEAF;

bool is_box(const Box3& box) {
    return is_finite(box.min) && is_finite(box.max) && !box.isEmpty();
}

/// Around all records that teach, and a tenth further, so that what later samples find beside is still inside.
Box3 box_around(const guide::Records& records, Box3 box) {
    for (const guide::Record& record : records) {
        if (guide::is_usable(record)) {
            box.extendBy(record.position);
        }
    }
    return box;
}

Box3 widened(const Box3& box) {
    constexpr float margin = 0.1f;
    const float size = length(box.max - box.min);
    const Vec3 by(margin * (size > 0 ? size : 1.0f));
    return {box.min - by, box.max + by};
}

/// The figures and their names, in the order of the columns.
struct Figure {
    const char* name;
    double value;
};
std::array<Figure, 9> figures(const FieldStatistics& s) {
    return {{{"iteration", static_cast<double>(s.iteration)},
             {"cells", static_cast<double>(s.cells)},
             {"lobes", static_cast<double>(s.lobes)},
             {"bytes", static_cast<double>(s.bytes)},
             {"samples known", s.records},
             {"samples of the last update", static_cast<double>(s.report.records)},
             {"of these ignored", static_cast<double>(s.report.ignored)},
             {"of these of value zero", static_cast<double>(s.report.dark)},
             {"memory limited", s.report.memory_limited ? 1.0 : 0.0}}};
}

}  // namespace

guide::FitSettings settings_of(const PGLFieldArguments& arguments) {
    guide::FitSettings settings;
    if (const auto* tree = static_cast<const PGLKDTreeArguments*>(arguments.spatialSturctureArguments)) {
        settings.leaf_samples =
            std::max(1.0, settings.leaf_samples * static_cast<double>(tree->maxSamples) / leaf_scale);
        settings.max_depth =
            static_cast<int>(std::min(tree->maxDepth, static_cast<std::size_t>(guide::Field::max_depth)));
    }
    return settings;
}

void LearnedField::set_bounds(const Box3& bounds) {
    if (is_box(bounds)) {
        given_ = bounds;
    }
}

Box3 LearnedField::bounds() const {
    return given_ ? *given_ : fields_ ? fields_->surface.bounds() : Box3();
}

void LearnedField::update(const SampleStore& store, bool surface, bool volume) {
    const guide::Records on_surfaces = surface ? store.records(Half::surface) : guide::Records();
    const guide::Records in_volumes = volume ? store.records(Half::volume) : guide::Records();
    if (std::max(on_surfaces.size(), in_volumes.size()) >= std::numeric_limits<std::uint32_t>::max()) {
        throw InputError("an update has 2^32 - 1 samples or more");
    }
    if (!fields_) {
        const Box3 found = given_ ? *given_ : box_around(in_volumes, box_around(on_surfaces, Box3()));
        if (!found.isEmpty()) {
            const Box3 box = given_ ? found : widened(found);
            fields_ = guide::Fields{guide::Field::empty(box), guide::Field::empty(box)};
        }
    }
    // A half without samples neither learns nor forgets.
    if (!on_surfaces.empty() && fields_) {
        guide::FitResult result = guide::fit(fields_->surface, on_surfaces, settings_, threads_);
        fields_->surface = std::move(result.field);
        surface_ = result.report;
    }
    if (!in_volumes.empty() && fields_) {
        guide::FitResult result = guide::fit(fields_->volume, in_volumes, settings_, threads_);
        fields_->volume = std::move(result.field);
        volume_ = result.report;
    }
    ++iteration_;
}

void LearnedField::reset() {
    fields_.reset();
    surface_ = volume_ = {};
    iteration_ = 0;
}

const guide::Field* LearnedField::field(Half half) const {
    return !fields_ ? nullptr : half == Half::volume ? &fields_->volume : &fields_->surface;
}

bool LearnedField::operator==(const LearnedField& other) const {
    if (!fields_ || !other.fields_) {
        return !fields_ && !other.fields_;
    }
    return guide::to_bytes(fields_->surface) == guide::to_bytes(other.fields_->surface) &&
           guide::to_bytes(fields_->volume) == guide::to_bytes(other.fields_->volume);
}

std::string LearnedField::to_bytes() const {
    ArchiveWriter bytes;
    const Box3 box = given_.value_or(Box3());
    bytes(settings_.leaf_samples, static_cast<std::int32_t>(settings_.max_depth),
          static_cast<std::uint64_t>(iteration_), box.min, box.max, static_cast<std::uint8_t>(fields_ ? 1 : 0));
    if (fields_) {
        bytes(guide::to_bytes(fields_->surface), guide::to_bytes(fields_->volume));
    }
    return guide::seal(kind_of_field, bytes.bytes());
}

LearnedField LearnedField::from_bytes(std::string_view bytes, int threads) {
    ArchiveReader body(guide::unseal(kind_of_field, bytes));
    guide::FitSettings settings;
    std::int32_t max_depth;
    std::uint64_t iteration;
    Box3 box;
    std::uint8_t has_fields;
    body(settings.leaf_samples, max_depth, iteration, box.min, box.max, has_fields);
    ArchiveReader::require(settings.leaf_samples >= 1 && std::isfinite(settings.leaf_samples) && max_depth >= 0 &&
                           max_depth <= guide::Field::max_depth && has_fields <= 1);
    settings.max_depth = max_depth;
    LearnedField field(settings, threads);
    field.iteration_ = iteration;
    field.set_bounds(box);
    if (has_fields) {
        std::string surface, volume;
        body(surface, volume);
        field.fields_ = guide::Fields{guide::field_from_bytes(surface), guide::field_from_bytes(volume)};
    }
    ArchiveReader::require(body.empty());
    return field;
}

FieldStatistics statistics_of(const LearnedField& field, Half half) {
    FieldStatistics s;
    s.iteration = field.iteration();
    s.report = field.report(half);
    if (const guide::Field* learned = field.field(half)) {
        s.cells = learned->size();
        s.bytes = learned->bytes();
        learned->for_each_cell([&](const Box3&, const guide::Region& region, double records) {
            s.lobes += static_cast<std::size_t>(region.mixture().size());
            s.records += records;
        });
    }
    return s;
}

std::string to_text(const FieldStatistics& statistics) {
    std::ostringstream text;
    text.precision(12);
    for (const Figure& figure : figures(statistics)) {
        text << figure.name << ": " << figure.value << '\n';
    }
    return text.str();
}

std::string csv_header() {
    std::string line;
    for (const Figure& figure : figures({})) {
        line += (line.empty() ? "" : ",") + std::string(figure.name);
    }
    return line;
}

std::string to_csv(const FieldStatistics& statistics) {
    std::ostringstream line;
    line.precision(12);
    const char* separator = "";
    for (const Figure& figure : figures(statistics)) {
        line << separator << figure.value;
        separator = ",";
    }
    return line.str();
}

}  // namespace wend::openpgl
