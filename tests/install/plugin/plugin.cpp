#include <wend/guide.hpp>
#include <wend/subsurface.hpp>

#include <exception>
#include <vector>

/// Learns from light that comes from above alone; the density upwards over that of the uniform distribution, or a
/// negative number where an exception does not arrive.
extern "C" __attribute__((visibility("default"))) float learn_and_ask() {
    const wend::Box3 bounds({0, 0, 0}, {1, 1, 1});
    std::vector<wend::guide::Record> records;
    for (int i = 0; i < 1000; ++i) {
        const float z = 2 * (static_cast<float>(i) + 0.5f) / 1000 - 1;
        const wend::Vec3 w = wend::direction_from_cosine(z, static_cast<float>(i % 37) / 37);
        records.push_back({{0.5f, 0.5f, 0.5f}, w, z > 0.9f ? 1.0f : 0.0f, wend::inv_4pi, 1});
    }
    const auto field = wend::guide::fit(wend::guide::Field::empty(bounds), records, {}).field;
    try {
        wend::guide::field_from_bytes("no field");
        return -1;
    } catch (const std::exception&) {
    }
    return field.find({0.5f, 0.5f, 0.5f})->incident({0.5f, 0.5f, 0.5f}).density({0, 0, 1}) / wend::inv_4pi;
}
