#include <wend/capi/field.h>

#include <wend/capi/boundary.h>
#include <wend/capi/handles.h>
#include <wend/capi/settings.h>
#include <wend/core/error.h>
#include <wend/guide/field.h>
#include <wend/guide/scatter_fit.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

using namespace wend;
using namespace wend::capi;

namespace {

guide::Record to_record(const wend_record& r) {
    return {to_vector(r.position), to_vector(r.direction), r.radiance,  r.density,       r.distance,
            r.classical_density,   r.guided_density,       r.scattered, to_rgb(r.colour)};
}

guide::ScatterRecord to_record(const wend_scatter_record& r) {
    return {to_vector(r.position), to_vector(r.normal),   r.leaving,
            r.connected,           to_vector(r.to_light), r.light_distance};
}

/// Copies of records that C gave.
template <class Records, class Record>
Records to_records(const Record* records, std::size_t count) {
    require(records || count == 0, "the records are null");
    require(count < std::numeric_limits<std::uint32_t>::max(), "there are 2^32 - 1 records or more");
    Records copies;
    copies.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        copies.push_back(to_record(records[i]));
    }
    return copies;
}

}  // namespace

wend_status wend_field_create(wend_bounds bounds, wend_field** field, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(field, "the place for the field is null");
        *field = new wend_field{guide::Field::empty(to_box(bounds))};
        return WEND_OK;
    });
}

void wend_field_destroy(wend_field* field) noexcept {
    delete field;
}

wend_fit_settings wend_fit_settings_default(void) noexcept {
    return from_settings({});
}

wend_status wend_field_fit(const wend_field* previous, const wend_record* records, size_t count,
                           const wend_fit_settings* settings, int threads, wend_field** next, wend_fit_report* report,
                           wend_error* error) noexcept {
    return guarded(error, [&] {
        require(previous, "the previous field is null");
        require(next, "the place for the next field is null");
        require_threads(threads);
        const guide::FitSettings chosen = settings ? to_settings(*settings) : guide::FitSettings();
        const auto copies = to_records<guide::Records>(records, count);
        guide::FitResult result = guide::fit(previous->value, copies, chosen, threads);
        *next = new wend_field{std::move(result.field)};
        if (report) {
            *report = from_report(result.report);
        }
        return WEND_OK;
    });
}

wend_status wend_field_fit_scattered(const wend_field* previous, const wend_scatter_record* records, size_t count,
                                     double decay, int threads, wend_field** next, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(previous, "the previous field is null");
        require(next, "the place for the next field is null");
        require_threads(threads);
        const auto copies = to_records<guide::ScatterRecords>(records, count);
        *next = new wend_field{guide::fit_scattered(previous->value, copies, decay, threads)};
        return WEND_OK;
    });
}

wend_status wend_field_summarize(const wend_field* field, wend_field_summary* summary, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(field, "the field is null");
        require(summary, "the place for the summary is null");
        const guide::Field& f = field->value;
        wend_field_summary s{};
        s.bounds = {from_vector(f.bounds().min), from_vector(f.bounds().max)};
        s.cells = f.size();
        s.bytes = f.bytes();
        s.learned = f.find(f.bounds().min) ? 1 : 0;
        f.for_each_cell([&](const Box3&, const guide::Region& region, double records) {
            s.lobes += static_cast<std::size_t>(region.mixture().size());
            s.records += records;
        });
        *summary = s;
        return WEND_OK;
    });
}

wend_status wend_field_save(const wend_field* field, void* buffer, size_t capacity, size_t* size,
                            wend_error* error) noexcept {
    return guarded(error, [&] {
        require(field, "the field is null");
        require(size, "the place for the size is null");
        const std::string bytes = guide::to_bytes(field->value);
        *size = bytes.size();
        if (!buffer) {
            return WEND_OK;
        }
        if (capacity < bytes.size()) {
            return answer(error, WEND_BUFFER_TOO_SMALL, "the buffer is smaller than the field");
        }
        std::memcpy(buffer, bytes.data(), bytes.size());
        return WEND_OK;
    });
}

wend_status wend_field_load(const void* bytes, size_t size, wend_field** field, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(field, "the place for the field is null");
        require(bytes || size == 0, "the bytes are null");
        try {
            *field = new wend_field{guide::field_from_bytes(std::string_view(static_cast<const char*>(bytes), size))};
        } catch (const InputError& e) {
            throw Refusal{WEND_BAD_BYTES, e.what()};
        }
        return WEND_OK;
    });
}
