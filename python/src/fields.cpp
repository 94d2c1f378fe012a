#include "fields.h"

#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/guide/field.h>
#include <wend/io/field_file.h>
#include <wend/medium/phase.h>

#include "bindings.h"

#include <nanobind/operators.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <optional>
#include <span>
#include <variant>

namespace wend::python {
namespace {

using guide::Field;
using guide::Fields;
using guide::MixtureProduct;
using guide::Region;
using guide::VmfMixture;

/// Rows of records: wend.guide.record_dtype is their layout.
constexpr std::size_t record_floats = sizeof(guide::Record) / sizeof(float);
using RecordRows = nb::ndarray<const float, nb::shape<-1, record_floats>, nb::c_contig, nb::device::cpu>;
static_assert(record_floats == 15);

/// Calls body(i) for every i, in blocks on all threads. Nothing depends on the division.
template <class Body>
void for_each(std::size_t count, int threads, const Body& body) {
    constexpr std::size_t block = 4096;
    parallel_for((count + block - 1) / block, threads, [&](std::size_t k) {
        for (std::size_t i = k * block; i < std::min(count, (k + 1) * block); ++i) {
            body(i);
        }
    });
}

void require_count(std::size_t count, std::size_t wanted, const char* what) {
    if (count != wanted) {
        throw InputError(std::string(what) + ": expected as many as there are positions, or directions");
    }
}

void require_trained(const Field& field) {
    if (!field.is_trained()) {
        throw InputError("the field has learned nothing yet: fit it to records first");
    }
}

/// A distribution of directions around one position.
class Distribution {
public:
    explicit Distribution(const VmfMixture& incident) : value_(incident) {}
    explicit Distribution(const MixtureProduct& product) : value_(product) {}

    auto sample(const Pairs& u, int threads) const {
        std::vector<Vec3> directions(u.shape(0));
        std::vector<float> densities(u.shape(0));
        {
            const nb::gil_scoped_release release;
            std::visit(
                [&](const auto& d) {
                    for_each(directions.size(), threads, [&](std::size_t i) {
                        directions[i] = d.sample(pairs(u)[i]);
                        densities[i] = d.density(directions[i]);
                    });
                },
                value_);
        }
        const std::size_t count = densities.size();
        return std::pair(to_rows(std::move(directions)), to_array(std::move(densities), {count}));
    }

    auto pdf(const Vectors& directions, int threads) const {
        std::vector<float> densities(directions.shape(0));
        {
            const nb::gil_scoped_release release;
            std::visit(
                [&](const auto& d) {
                    for_each(densities.size(), threads,
                             [&](std::size_t i) { densities[i] = d.density(vectors(directions)[i]); });
                },
                value_);
        }
        const std::size_t count = densities.size();
        return to_array(std::move(densities), {count});
    }

    Distribution product(const AxialLobes& lobes, const std::tuple<float, float, float>& axis) const {
        const auto* incident = std::get_if<VmfMixture>(&value_);
        if (!incident) {
            throw InputError("a product has no further product");
        }
        const auto [x, y, z] = axis;
        return Distribution(incident->product(lobes.around({x, y, z})));
    }

    /// Of the product; none for the incident radiance.
    std::optional<float> integral() const {
        const auto* product = std::get_if<MixtureProduct>(&value_);
        return product ? std::optional(product->integral()) : std::nullopt;
    }

    /// Weights, mean directions and concentrations of the incident radiance's lobes.
    auto lobes() const {
        const auto* incident = std::get_if<VmfMixture>(&value_);
        if (!incident) {
            throw InputError("the lobes of a product are not kept: ask those of what it was made of");
        }
        std::vector<float> weights, kappas;
        std::vector<Vec3> means;
        for (int i = 0; i < incident->size(); ++i) {
            const auto [weight, vmf] = incident->lobe(i);
            weights.push_back(weight);
            means.push_back(vmf.mean);
            kappas.push_back(vmf.kappa);
        }
        const std::size_t count = weights.size();
        return std::tuple(to_array(std::move(weights), {count}), to_rows(std::move(means)),
                          to_array(std::move(kappas), {count}));
    }

private:
    std::variant<VmfMixture, MixtureProduct> value_;
};

/// What scatters at each of many positions: the same lobes around an axis of each; none for the incident radiance.
struct Scatterers {
    const AxialLobes* lobes;
    std::optional<Vectors> axes;

    void require(std::size_t count) const {
        if ((lobes != nullptr) != axes.has_value()) {
            throw InputError("lobes and axis go together");
        }
        if (axes) {
            require_count(axes->shape(0), count, "axis");
        }
    }
    /// Calls body with the distribution at a position.
    template <class Body>
    void visit(const Region& region, const Vec3& position, std::size_t i, const Body& body) const {
        if (lobes) {
            body(region.incident(position).product(lobes->around(vectors(*axes)[i])));
        } else {
            body(VmfMixture(region.incident(position)));
        }
    }
};

auto sample(const Field& field, const Vectors& positions, const Pairs& u, const AxialLobes* lobes,
            std::optional<Vectors> axes, int threads) {
    const std::size_t count = positions.shape(0);
    const Scatterers scatterers{lobes, std::move(axes)};
    require_trained(field);
    require_count(u.shape(0), count, "u");
    scatterers.require(count);
    std::vector<Vec3> directions(count);
    std::vector<float> densities(count);
    {
        const nb::gil_scoped_release release;
        for_each(count, threads, [&](std::size_t i) {
            const Vec3& position = vectors(positions)[i];
            scatterers.visit(*field.find(position), position, i, [&](const auto& d) {
                directions[i] = d.sample(pairs(u)[i]);
                densities[i] = d.density(directions[i]);
            });
        });
    }
    return std::pair(to_rows(std::move(directions)), to_array(std::move(densities), {count}));
}

auto pdf(const Field& field, const Vectors& positions, const Vectors& directions, const AxialLobes* lobes,
         std::optional<Vectors> axes, int threads) {
    const std::size_t count = positions.shape(0);
    const Scatterers scatterers{lobes, std::move(axes)};
    require_trained(field);
    require_count(directions.shape(0), count, "direction");
    scatterers.require(count);
    std::vector<float> densities(count);
    {
        const nb::gil_scoped_release release;
        for_each(count, threads, [&](std::size_t i) {
            const Vec3& position = vectors(positions)[i];
            scatterers.visit(*field.find(position), position, i,
                             [&](const auto& d) { densities[i] = d.density(vectors(directions)[i]); });
        });
    }
    return to_array(std::move(densities), {count});
}

/// One number of the region of each position.
template <class Quantity>
auto by_region(const Field& field, const Vectors& positions, int threads, const Quantity& quantity) {
    const std::size_t count = positions.shape(0);
    require_trained(field);
    std::vector<float> values(count);
    {
        const nb::gil_scoped_release release;
        for_each(count, threads, [&](std::size_t i) { values[i] = quantity(*field.find(vectors(positions)[i])); });
    }
    return to_array(std::move(values), {count});
}

auto radiance(const Field& field, const Vectors& positions, const Vectors& directions, int threads) {
    const std::size_t count = positions.shape(0);
    require_trained(field);
    require_count(directions.shape(0), count, "direction");
    std::vector<Rgb> values(count);
    {
        const nb::gil_scoped_release release;
        for_each(count, threads, [&](std::size_t i) {
            const Vec3& position = vectors(positions)[i];
            values[i] = field.find(position)->radiance(position, vectors(directions)[i]);
        });
    }
    return to_rows(std::move(values));
}

auto in_scattered(const Field& field, const Vectors& positions, const AxialLobes& lobes, const Vectors& axes,
                  int threads) {
    const std::size_t count = positions.shape(0);
    require_trained(field);
    require_count(axes.shape(0), count, "axis");
    std::vector<Rgb> values(count);
    {
        const nb::gil_scoped_release release;
        for_each(count, threads, [&](std::size_t i) {
            const Vec3& position = vectors(positions)[i];
            values[i] = wend::in_scattered(*field.find(position), position, lobes.around(vectors(axes)[i]));
        });
    }
    return to_rows(std::move(values));
}

Vec3 vector_of(const std::tuple<float, float, float>& v) {
    return {std::get<0>(v), std::get<1>(v), std::get<2>(v)};
}

FieldPointer empty_field(const std::tuple<float, float, float>& min, const std::tuple<float, float, float>& max) {
    return std::make_shared<const Field>(Field::empty(Box3(vector_of(min), vector_of(max))));
}

std::pair<FieldPointer, Values> fit(const Field& field, const RecordRows& rows, int lobes, double leaf_samples,
                                    int max_depth, std::size_t max_bytes, double decay, int threads) {
    const std::span records(reinterpret_cast<const guide::Record*>(rows.data()), rows.shape(0));
    guide::FitSettings settings;
    settings.lobes = lobes;
    settings.leaf_samples = leaf_samples;
    settings.max_depth = max_depth;
    settings.max_bytes = max_bytes;
    settings.decay = decay;
    std::optional<guide::FitResult> result;
    {
        const nb::gil_scoped_release release;
        result = guide::fit(field, records, settings, threads);
    }
    Values report;
    report["records"] = result->report.records;
    report["ignored"] = result->report.ignored;
    report["dark"] = result->report.dark;
    report["cells"] = result->report.cells;
    report["bytes"] = result->report.bytes;
    report["memory_limited"] = result->report.memory_limited;
    return {std::make_shared<const Field>(std::move(result->field)), report};
}

/// Boxes (two corners each), fluence, number of lobes, classical share and records, by cell.
auto cells(const Field& field) {
    std::vector<Vec3> lower, upper;
    std::vector<float> fluence, lobes, shares, records;
    field.for_each_cell([&](const Box3& box, const Region& region, double taught) {
        lower.push_back(box.min);
        upper.push_back(box.max);
        fluence.push_back(region.fluence());
        lobes.push_back(static_cast<float>(region.mixture().size()));
        shares.push_back(region.defensive_fraction());
        records.push_back(static_cast<float>(taught));
    });
    const std::size_t n = fluence.size();
    return std::tuple(to_rows(std::move(lower)), to_rows(std::move(upper)), to_array(std::move(fluence), {n}),
                      to_array(std::move(lobes), {n}), to_array(std::move(shares), {n}),
                      to_array(std::move(records), {n}));
}

nb::bytes bytes_of(const Field& field) {
    const std::string bytes = guide::to_bytes(field);
    return nb::bytes(bytes.data(), bytes.size());
}

FieldPointer field_of(const nb::bytes& bytes) {
    return std::make_shared<const Field>(guide::field_from_bytes({bytes.c_str(), bytes.size()}));
}

AxialLobes lobes_of(const std::vector<std::pair<float, float>>& parts) {
    if (parts.empty() || parts.size() > AxialLobes::capacity) {
        throw InputError("expected 1 to " + std::to_string(AxialLobes::capacity) + " lobes");
    }
    std::vector<AxialLobe> lobes;
    float total = 0;
    for (const auto& [weight, kappa] : parts) {
        if (!(weight >= 0 && weight < 1e30f) || !(std::abs(kappa) <= Vmf::max_kappa)) {
            throw InputError("a lobe has a weight that is not negative, and a concentration of at most 1e5");
        }
        lobes.push_back({weight, kappa});
        total += weight;
    }
    if (!(total > 0)) {
        throw InputError("one lobe at least must have a positive weight");
    }
    return AxialLobes(lobes);
}

auto lobe_values(const AxialLobes& lobes) {
    std::vector<std::pair<float, float>> values;
    for (int j = 0; j < lobes.size(); ++j) {
        values.emplace_back(lobes.amplitude(j) / vmf_peak(std::abs(lobes.kappa(j))), lobes.kappa(j));
    }
    return values;
}

auto phase_values(const PhaseFunction& phase, const Floats& cosines) {
    std::vector<float> values(cosines.size());
    std::transform(cosines.data(), cosines.data() + cosines.size(), values.begin(),
                   [&](float c) { return phase.evaluate(c); });
    return to_array(std::move(values), {cosines.size()});
}

auto phase_sample(const PhaseFunction& phase, const Vectors& before, const Pairs& u) {
    require_count(u.shape(0), before.shape(0), "u");
    std::vector<Vec3> directions(before.shape(0));
    for (std::size_t i = 0; i < directions.size(); ++i) {
        directions[i] = phase.sample(vectors(before)[i], pairs(u)[i]);
    }
    return to_rows(std::move(directions));
}

PhaseFunction mixture_of(const std::vector<std::pair<float, float>>& parts) {
    if (parts.empty() || parts.size() > HenyeyGreensteinMixture::max_lobes) {
        throw InputError("a mixture has 1 to 4 parts");
    }
    HenyeyGreensteinMixture mixture;
    for (const auto& [weight, g] : parts) {
        if (!(weight > 0)) {
            throw InputError("the weights of a mixture are positive");
        }
        mixture.add(weight, g);
    }
    return PhaseFunction(mixture);
}

void bind_phases(nb::module_& module) {
    nb::class_<AxialLobes>(module, "Lobes", "A function of the angle to an axis, as von Mises-Fisher lobes.")
        .def_static("cosine", &AxialLobes::cosine, nb::rv_policy::copy)
        .def_static("custom", &lobes_of, nb::arg("parts"))
        .def_prop_ro("parts", &lobe_values);

    nb::class_<PhaseFunction>(module, "Phase", "A phase function.")
        .def_static(
            "henyey_greenstein", [](float g) { return PhaseFunction(HenyeyGreenstein{g}); }, nb::arg("g"))
        .def_static("mixture", &mixture_of, nb::arg("parts"))
        .def_static(
            "tabulated",
            [](const std::vector<double>& cosines, const std::vector<double>& values) {
                if (cosines.size() != values.size()) {
                    throw InputError("a table has as many cosines as values");
                }
                return PhaseFunction(TabulatedPhase(cosines, values));
            },
            nb::arg("cosines"), nb::arg("values"))
        .def_static(
            "fournier_forand", [](double index, double slope) { return PhaseFunction(fournier_forand(index, slope)); },
            nb::arg("index"), nb::arg("slope"))
        .def("evaluate", &phase_values, nb::arg("cosine"))
        .def("sample", &phase_sample, nb::arg("before"), nb::arg("u"))
        .def_prop_ro("mean_cosine", &PhaseFunction::mean_cosine)
        .def("moment", &PhaseFunction::moment, nb::arg("degree"))
        .def("lobes", [](const PhaseFunction& phase) {
            return phase.lobes({0, 0, 1});
        });
}

void bind_field(nb::module_& module) {
    nb::class_<Distribution>(module, "Distribution", "A distribution of directions at one position.")
        .def("sample", &Distribution::sample, nb::arg("u"), nb::arg("threads"))
        .def("pdf", &Distribution::pdf, nb::arg("direction"), nb::arg("threads"))
        .def("product", &Distribution::product, nb::arg("lobes"), nb::arg("axis"))
        .def_prop_ro("integral", &Distribution::integral)
        .def("lobes", &Distribution::lobes);

    nb::class_<Field>(module, "Field", "Incident radiance, learned.")
        .def_static("empty", &empty_field, nb::arg("min"), nb::arg("max"))
        .def_static("from_bytes", &field_of, nb::arg("bytes"))
        .def("to_bytes", &bytes_of)
        .def_prop_ro("is_trained", &Field::is_trained)
        .def_prop_ro("cell_count", &Field::size)
        .def_prop_ro("nbytes", &Field::bytes)
        .def_prop_ro("bounds",
                     [](const Field& f) {
                         const Box3& b = f.bounds();
                         return std::pair(std::tuple(b.min.x, b.min.y, b.min.z), std::tuple(b.max.x, b.max.y, b.max.z));
                     })
        .def("fit", &fit, nb::arg("records"), nb::arg("lobes"), nb::arg("leaf_samples"), nb::arg("max_depth"),
             nb::arg("max_bytes"), nb::arg("decay"), nb::arg("threads"))
        .def(
            "incident",
            [](const Field& field, const std::tuple<float, float, float>& position) {
                require_trained(field);
                const Vec3 p = vector_of(position);
                return Distribution(VmfMixture(field.find(p)->incident(p)));
            },
            nb::arg("position"))
        .def("sample", &sample, nb::arg("position"), nb::arg("u"), nb::arg("lobes").none(), nb::arg("axis").none(),
             nb::arg("threads"))
        .def("pdf", &pdf, nb::arg("position"), nb::arg("direction"), nb::arg("lobes").none(), nb::arg("axis").none(),
             nb::arg("threads"))
        .def(
            "fluence",
            [](const Field& field, const Vectors& positions, int threads) {
                return by_region(field, positions, threads, [](const Region& r) { return r.fluence(); });
            },
            nb::arg("position"), nb::arg("threads"))
        .def(
            "classical_share",
            [](const Field& field, const Vectors& positions, int threads) {
                return by_region(field, positions, threads, [](const Region& r) { return r.defensive_fraction(); });
            },
            nb::arg("position"), nb::arg("threads"))
        .def("radiance", &radiance, nb::arg("position"), nb::arg("direction"), nb::arg("threads"))
        .def("in_scattered", &in_scattered, nb::arg("position"), nb::arg("lobes"), nb::arg("axis"), nb::arg("threads"))
        .def("cells", &cells);
}

void bind_both_fields(nb::module_& module) {
    nb::class_<Fields>(module, "Fields", "The fields of surfaces and volumes.")
        .def(
            "__init__",
            [](Fields* self, const Field& surface, const Field& volume) {
                new (self) Fields{surface, volume};
            },
            nb::arg("surface"), nb::arg("volume"))
        .def_prop_ro("surface", [](const Fields& f) { return std::make_shared<const Field>(f.surface); })
        .def_prop_ro("volume", [](const Fields& f) { return std::make_shared<const Field>(f.volume); })
        .def(
            "save",
            [](const Fields& fields, const std::string& file) {
                const nb::gil_scoped_release release;
                write_fields(file, fields);
            },
            nb::arg("file"))
        .def_static(
            "load",
            [](const std::string& file) {
                const nb::gil_scoped_release release;
                return std::make_shared<Fields>(read_fields(file));
            },
            nb::arg("file"));
}

}  // namespace

void bind_fields(nb::module_& module) {
    bind_phases(module);
    bind_field(module);
    bind_both_fields(module);
}

}  // namespace wend::python
