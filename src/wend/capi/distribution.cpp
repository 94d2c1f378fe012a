#include <wend/capi/field.h>
#include <wend/capi/handles.h>
#include <wend/capi/media.h>
#include <wend/capi/opaque.h>

#include <array>
#include <cmath>
#include <span>

using namespace wend;
using namespace wend::capi;

namespace {

using Incident = Stored<guide::VmfMixture, 0x57454e4449434431>;
using Product = Stored<guide::MixtureProduct, 0x57454e4450524431>;
using Lobes = Stored<AxialLobes, 0x57454e444c4f4231>;

/// Calls body(value) with the mixture or product in a distribution.
template <class Body>
void visit(const wend_distribution* distribution, const Body& body) {
    require_object(distribution, "the distribution is null");
    if (const auto* product = stored<Product>(*distribution)) {
        body(*product);
        return;
    }
    const auto* incident = stored<Incident>(*distribution);
    require(incident, "the distribution was not filled by this library");
    body(*incident);
}

const guide::Region* find(const wend_field* field, const wend_vec3& position) {
    require(field, "the field is null");
    return field->value.find(to_position(position, "the position"));
}

}  // namespace

wend_status wend_field_fluence(const wend_field* field, wend_vec3 position, float* fluence,
                               wend_error* error) noexcept {
    return guarded(error, [&] {
        require(fluence, "the place for the fluence is null");
        const guide::Region* region = find(field, position);
        if (!region) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        *fluence = region->fluence();
        return WEND_OK;
    });
}

wend_status wend_field_radiance(const wend_field* field, wend_vec3 position, wend_vec3 direction, float radiance[3],
                                wend_error* error) noexcept {
    return guarded(error, [&] {
        require(radiance, "the place for the radiance is null");
        const Vec3 w = to_direction(direction, "the direction");
        const guide::Region* region = find(field, position);
        if (!region) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        put(region->radiance({position.x, position.y, position.z}, w), radiance);
        return WEND_OK;
    });
}

wend_status wend_field_classical_share(const wend_field* field, wend_vec3 position, float* share,
                                       wend_error* error) noexcept {
    return guarded(error, [&] {
        require(share, "the place for the share is null");
        const guide::Region* region = find(field, position);
        if (!region) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        *share = region->defensive_fraction();
        return WEND_OK;
    });
}

wend_status wend_field_incident(const wend_field* field, wend_vec3 position, wend_distribution* incident,
                                wend_error* error) noexcept {
    return guarded(error, [&] {
        require_object(incident, "the place for the distribution is null");
        const guide::Region* region = find(field, position);
        if (!region) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        store<Incident>(*incident, region->incident({position.x, position.y, position.z}));
        return WEND_OK;
    });
}

wend_status wend_field_in_scattered(const wend_field* field, wend_vec3 position, const wend_distribution* product,
                                    float in_scattered[3], wend_error* error) noexcept {
    return guarded(error, [&] {
        require(in_scattered, "the place for the radiance is null");
        require_object(product, "the product is null");
        const auto* mixture = stored<Product>(*product);
        require(mixture, "the distribution is no product: wend_distribution_product() makes one");
        const guide::Region* region = find(field, position);
        if (!region) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        put(region->in_scattered(*mixture), in_scattered);
        return WEND_OK;
    });
}

wend_status wend_lobes_cosine(wend_lobes* lobes, wend_error* error) noexcept {
    return guarded(error, [&] {
        require_object(lobes, "the place for the lobes is null");
        store<Lobes>(*lobes, AxialLobes::cosine());
        return WEND_OK;
    });
}

wend_status wend_lobes_phase(const wend_phase_part* parts, size_t count, wend_lobes* lobes,
                             wend_error* error) noexcept {
    return guarded(error, [&] {
        require(parts, "the parts are null");
        require(count >= 1, "a phase function has 1 to 4 parts");
        require_object(lobes, "the place for the lobes is null");
        store<Lobes>(*lobes, to_phase({parts, count}).lobes(Vec3(0, 0, 1)));
        return WEND_OK;
    });
}

wend_status wend_lobes_custom(const wend_axial_lobe* parts, size_t count, wend_lobes* lobes,
                              wend_error* error) noexcept {
    return guarded(error, [&] {
        require(parts, "the parts are null");
        require(count >= 1 && count <= AxialLobes::capacity, "a shape has 1 to 24 lobes");
        require_object(lobes, "the place for the lobes is null");
        std::array<AxialLobe, AxialLobes::capacity> copies;
        float total = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const wend_axial_lobe& part = parts[i];
            require(part.weight >= 0 && std::isfinite(part.weight), "the weight of a lobe must be finite and >= 0");
            require(std::abs(part.kappa) <= Vmf::max_kappa, "the concentration of a lobe must be within -1e5 and 1e5");
            copies[i] = {part.weight, part.kappa};
            total += part.weight;
        }
        require(total > 0 && std::isfinite(total), "the weights of the lobes must have a positive, finite sum");
        store<Lobes>(*lobes, AxialLobes(std::span(copies.data(), count)));
        return WEND_OK;
    });
}

wend_status wend_distribution_product(const wend_distribution* incident, const wend_lobes* lobes, wend_vec3 axis,
                                      wend_distribution* product, float* integral, wend_error* error) noexcept {
    return guarded(error, [&] {
        require_object(incident, "the incident distribution is null");
        require_object(lobes, "the lobes are null");
        require_object(product, "the place for the product is null");
        const auto* shape = stored<Lobes>(*lobes);
        require(shape, "the lobes were not filled by this library");
        const auto* mixture = stored<Incident>(*incident);
        require(mixture, "what is to be multiplied must come from wend_field_incident()");
        const guide::MixtureProduct result = mixture->product(shape->around(to_direction(axis, "the axis")));
        store<Product>(*product, result);
        if (integral) {
            *integral = result.integral();
        }
        return WEND_OK;
    });
}

wend_status wend_distribution_sample(const wend_distribution* distribution, float u, float v, wend_vec3* direction,
                                     float* density, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(direction, "the place for the direction is null");
        require(u >= 0 && u < 1 && v >= 0 && v < 1, "u and v must be in [0,1)");
        visit(distribution, [&](const auto& d) {
            const Vec3 w = d.sample({u, v});
            *direction = from_vector(w);
            if (density) {
                *density = d.density(w);
            }
        });
        return WEND_OK;
    });
}

wend_status wend_distribution_density(const wend_distribution* distribution, wend_vec3 direction, float* density,
                                      wend_error* error) noexcept {
    return guarded(error, [&] {
        require(density, "the place for the density is null");
        const Vec3 w = to_direction(direction, "the direction");
        visit(distribution, [&](const auto& d) { *density = d.density(w); });
        return WEND_OK;
    });
}
