// Bad input to the C interface: an error with a clear message, never a crash.
#include <tests/capi/support.h>

#include <cmath>

namespace wend::capi {
namespace {

wend_distribution incident_of(const wend_field* field) {
    wend_distribution incident;
    EXPECT_EQ(wend_field_incident(field, inside, &incident, nullptr), WEND_OK);
    return incident;
}

wend_lobes cosine() {
    wend_lobes lobes;
    EXPECT_EQ(wend_lobes_cosine(&lobes, nullptr), WEND_OK);
    return lobes;
}

TEST(CErrors, SuccessLeavesNoMessage) {
    wend_error error;
    std::memset(&error, 'x', sizeof error);
    wend_lobes lobes;
    EXPECT_EQ(wend_lobes_cosine(&lobes, &error), WEND_OK);
    EXPECT_STREQ(error.message, "");
    wend_field_destroy(nullptr);
}

TEST(CErrors, BoundsMustBeABox) {
    wend_field* field = nullptr;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_create(unit_cube, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "bounds.max", wend_field_create({{0, 0, 0}, {1, nan, 1}}, &field, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "bounds.min", wend_field_create({{-inf, 0, 0}, {1, 1, 1}}, &field, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "above", wend_field_create({{0, 2, 0}, {1, 1, 1}}, &field, e));
    EXPECT_EQ(field, nullptr);
}

TEST(CErrors, NothingLearnedIsSaid) {
    const FieldPointer field = empty_field();
    wend_distribution incident;
    float fluence = -1;
    EXPECT_REFUSED(WEND_NOTHING_LEARNED, "nothing", wend_field_incident(field.get(), inside, &incident, e));
    EXPECT_REFUSED(WEND_NOTHING_LEARNED, "nothing", wend_field_fluence(field.get(), inside, &fluence, e));
    float colour[3];
    EXPECT_REFUSED(WEND_NOTHING_LEARNED, "nothing", wend_field_radiance(field.get(), inside, up, colour, e));
    EXPECT_EQ(fluence, -1);
    wend_field_summary summary;
    ASSERT_EQ(wend_field_summarize(field.get(), &summary, nullptr), WEND_OK);
    EXPECT_EQ(summary.learned, 0);
}

TEST(CErrors, FitsNeedArgumentsInRange) {
    const FieldPointer field = empty_field();
    wend_field* next = nullptr;
    const wend_record record = {inside, up, 1, 1, 1, 0, 0, 0, {1, 1, 1}};
    const auto fit = [&](auto change, wend_error* e) {
        wend_fit_settings settings = wend_fit_settings_default();
        change(settings);
        return wend_field_fit(field.get(), &record, 1, &settings, 1, &next, nullptr, e);
    };
    using S = wend_fit_settings;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_fit(nullptr, &record, 1, nullptr, 1, &next, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_fit(field.get(), &record, 1, nullptr, 1, nullptr, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_fit(field.get(), nullptr, 1, nullptr, 1, &next, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "threads",
                   wend_field_fit(field.get(), &record, 1, nullptr, -1, &next, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "2^32",
                   wend_field_fit(field.get(), &record, 0xffffffffu, nullptr, 1, &next, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "lobes", fit([](S& s) { s.lobes = 17; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "lobes", fit([](S& s) { s.lobes = 0; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "finite", fit([](S& s) { s.decay = nan; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "finite", fit([](S& s) { s.prior_weight = inf; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "memory", fit([](S& s) { s.max_bytes = 1; }, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "concentration", fit([](S& s) { s.max_kappa = 1e6f; }, e));
    EXPECT_EQ(next, nullptr);
}

TEST(CErrors, BadRecordsAreIgnoredAndCounted) {
    std::vector<wend_record> records(6, {inside, up, 1, 1, 1, 0, 0, 0, {1, 1, 1}});
    records[0].radiance = nan;
    records[1].direction = {0, 0, 2};
    records[2].density = 0;
    records[3].position.x = inf;
    records[4].colour[1] = -1;
    wend_field* next = nullptr;
    wend_fit_report report;
    ASSERT_EQ(wend_field_fit(empty_field().get(), records.data(), 6, nullptr, 1, &next, &report, nullptr), WEND_OK);
    const FieldPointer owner(next);
    EXPECT_EQ(report.records, 6u);
    EXPECT_EQ(report.ignored, 5u);
}

TEST(CErrors, NoRecordsAreFine) {
    wend_field* next = nullptr;
    ASSERT_EQ(wend_field_fit(empty_field().get(), nullptr, 0, nullptr, 1, &next, nullptr, nullptr), WEND_OK);
    const FieldPointer owner(next);
    wend_distribution incident;
    EXPECT_EQ(wend_field_incident(next, inside, &incident, nullptr), WEND_NOTHING_LEARNED);
    EXPECT_EQ(wend_records_of_path(nullptr, 0, nullptr, nullptr), WEND_OK);
}

TEST(CErrors, QuestionsNeedFinitePlacesAndUnitDirections) {
    const FieldPointer field = trained_field();
    wend_distribution incident = incident_of(field.get());
    wend_vec3 w;
    float x;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_incident(nullptr, inside, &incident, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_incident(field.get(), inside, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "position", wend_field_incident(field.get(), {nan, 0, 0}, &incident, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "position", wend_field_fluence(field.get(), {0, inf, 0}, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_fluence(field.get(), inside, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_radiance(field.get(), inside, up, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_summarize(field.get(), nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "unit length", wend_distribution_density(&incident, {0, 0, 0}, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "unit length", wend_distribution_density(&incident, {0, nan, 0}, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_distribution_density(nullptr, up, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_distribution_density(&incident, up, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)", wend_distribution_sample(&incident, 1, 0, &w, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "[0,1)", wend_distribution_sample(&incident, 0, nan, &w, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_distribution_sample(&incident, 0, 0, nullptr, &x, e));
}

TEST(CErrors, LobesNeedSensibleParts) {
    wend_lobes lobes;
    const auto phase = [&](float weight, float g, wend_error* e) {
        const wend_phase_part part = {weight, g};
        return wend_lobes_phase(&part, 1, &lobes, e);
    };
    const auto custom = [&](float weight, float kappa, wend_error* e) {
        const wend_axial_lobe part = {weight, kappa};
        return wend_lobes_custom(&part, 1, &lobes, e);
    };
    const std::vector<wend_phase_part> large(4, {3e38f, 0.5f});
    const std::vector<wend_axial_lobe> many(25, {1, 1});
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lobes_cosine(nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_lobes_phase(nullptr, 1, &lobes, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "1 to 4", wend_lobes_phase(large.data(), 0, &lobes, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "1 to 4", wend_lobes_phase(large.data(), 5, &lobes, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "sum", wend_lobes_phase(large.data(), 4, &lobes, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "mean cosine", phase(1, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "mean cosine", phase(1, nan, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", phase(0, 0, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "weight", custom(nan, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "sum", custom(0, 1, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "concentration", custom(1, -2e5f, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "1 to 24", wend_lobes_custom(many.data(), many.size(), &lobes, e));
    EXPECT_EQ(phase(1, 0.999f, nullptr), WEND_OK);
    EXPECT_EQ(custom(1, -5, nullptr), WEND_OK);
}

TEST(CErrors, OpaqueObjectsMustHaveBeenFilled) {
    const FieldPointer field = trained_field();
    const wend_distribution incident = incident_of(field.get());
    const wend_lobes lobes = cosine();
    wend_distribution blank, product;
    wend_lobes blank_lobes;
    std::memset(&blank, 0, sizeof blank);
    std::memset(&blank_lobes, 0x5a, sizeof blank_lobes);
    wend_vec3 w;
    float x;
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "filled", wend_distribution_sample(&blank, 0, 0, &w, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "filled", wend_distribution_density(&blank, up, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "filled",
                   wend_distribution_product(&incident, &blank_lobes, up, &product, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "come from", wend_distribution_product(&blank, &lobes, up, &product, &x, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "unit length",
                   wend_distribution_product(&incident, &lobes, {1, 1, 1}, &product, &x, e));
    ASSERT_EQ(wend_distribution_product(&incident, &lobes, up, &product, nullptr, nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "come from", wend_distribution_product(&product, &lobes, up, &product, &x, e));
    // Memory that is not aligned for the object.
    std::vector<unsigned char> memory(2 * sizeof(wend_distribution) + 1);
    auto* odd = memory.data() + (reinterpret_cast<std::uintptr_t>(memory.data()) % 2 == 0 ? 1 : 0);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "aligned",
                   wend_field_incident(field.get(), inside, reinterpret_cast<wend_distribution*>(odd), e));
}

TEST(CErrors, ForeignBytesAreNoField) {
    const std::vector<char> good = bytes_of(trained_field().get());
    wend_field* field = nullptr;
    const auto load = [&](const std::vector<char>& bytes, wend_error* e) {
        return wend_field_load(bytes.data(), bytes.size(), &field, e);
    };
    EXPECT_REFUSED(WEND_BAD_BYTES, "no bytes of a field", load(std::vector<char>(100, 'x'), e));
    EXPECT_REFUSED(WEND_BAD_BYTES, "no bytes of a field", wend_field_load(nullptr, 0, &field, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_load(nullptr, 5, &field, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_load(good.data(), good.size(), nullptr, e));
    for (std::size_t size = 0; size < good.size(); size += 1 + size / 7) {
        EXPECT_REFUSED(WEND_BAD_BYTES, "bytes", load({good.begin(), good.begin() + static_cast<long>(size)}, e));
    }
    for (std::size_t i = 0; i < good.size(); i += 1 + i / 11) {
        std::vector<char> changed = good;
        changed[i] = static_cast<char>(changed[i] ^ 0x10);
        EXPECT_REFUSED(WEND_BAD_BYTES, "", load(changed, e));
    }
    EXPECT_EQ(field, nullptr);
    ASSERT_EQ(load(good, nullptr), WEND_OK);
    EXPECT_EQ(bytes_of(FieldPointer(field).get()), good);
}

TEST(CErrors, SmallBuffersAreLeftAlone) {
    const FieldPointer field = trained_field();
    std::vector<char> buffer(10, 'x');
    std::size_t size = 0;
    EXPECT_REFUSED(WEND_BUFFER_TOO_SMALL, "smaller", wend_field_save(field.get(), buffer.data(), 10, &size, e));
    EXPECT_EQ(size, bytes_of(field.get()).size());
    EXPECT_EQ(buffer, std::vector<char>(10, 'x'));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_save(field.get(), buffer.data(), 10, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_field_save(nullptr, buffer.data(), 10, &size, e));
}

TEST(CErrors, PathsMustBeTrees) {
    std::vector<wend_path_vertex> path(3);
    std::vector<wend_record> records(3);
    std::vector<wend_scatter_record> scattered(3);
    for (int i = 0; i < 3; ++i) {
        path[static_cast<std::size_t>(i)].parent = i - 1;
    }
    EXPECT_EQ(wend_records_of_path(path.data(), 3, records.data(), nullptr), WEND_OK);
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_records_of_path(path.data(), 3, nullptr, e));
    EXPECT_REFUSED(WEND_BAD_ARGUMENT, "null", wend_scatter_records_of_path(nullptr, 3, scattered.data(), e));
    for (const int parent : {1, 2, 1000000, -2, std::numeric_limits<int>::min()}) {
        path[1].parent = parent;
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "parent", wend_records_of_path(path.data(), 3, records.data(), e));
        EXPECT_REFUSED(WEND_BAD_ARGUMENT, "parent", wend_scatter_records_of_path(path.data(), 3, scattered.data(), e));
    }
}

}  // namespace
}  // namespace wend::capi
