#include <wend/io/spectrum/named_spectra.h>

#include <wend/core/error.h>
#include <wend/io/spectrum/colorimetry.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace wend {
namespace {

/// Optical constants at a wavelength in nanometres.
struct OpticalConstants {
    double wavelength, eta, k;
};

// Ag, Al, Au, Cu: palik1985. The steps are those of the source: 0.1 eV.
constexpr std::array<OpticalConstants, 17> silver{{{381.490, 0.198063, 1.735},
                                                   {399.949, 0.173, 1.950},
                                                   {413.281, 0.173, 2.110},
                                                   {427.532, 0.160, 2.260},
                                                   {442.801, 0.157, 2.400},
                                                   {459.201, 0.144, 2.560},
                                                   {476.862, 0.132, 2.720},
                                                   {495.937, 0.130, 2.880},
                                                   {516.601, 0.130, 3.070},
                                                   {539.062, 0.129, 3.250},
                                                   {563.564, 0.120, 3.450},
                                                   {590.401, 0.121, 3.660},
                                                   {619.921, 0.131, 3.880},
                                                   {652.548, 0.140, 4.150},
                                                   {688.801, 0.140, 4.440},
                                                   {729.319, 0.148, 4.740},
                                                   {774.901, 0.143, 5.090}}};
constexpr std::array<OpticalConstants, 17> aluminium{{{381.490, 0.445688, 4.63375},
                                                      {399.949, 0.490, 4.860},
                                                      {413.281, 0.523, 5.020},
                                                      {427.532, 0.558, 5.200},
                                                      {442.801, 0.598, 5.380},
                                                      {459.201, 0.644, 5.580},
                                                      {476.862, 0.695, 5.800},
                                                      {495.937, 0.755, 6.030},
                                                      {516.601, 0.826, 6.280},
                                                      {539.062, 0.912, 6.550},
                                                      {563.564, 1.020, 6.850},
                                                      {590.401, 1.150, 7.150},
                                                      {619.921, 1.300, 7.480},
                                                      {652.548, 1.490, 7.820},
                                                      {688.801, 1.740, 8.210},
                                                      {729.319, 2.140, 8.570},
                                                      {774.901, 2.630, 8.600}}};
constexpr std::array<OpticalConstants, 17> gold{{{381.490, 1.68475, 1.9225},
                                                 {399.949, 1.658, 1.956},
                                                 {413.281, 1.636, 1.958},
                                                 {427.532, 1.616, 1.940},
                                                 {442.801, 1.562, 1.904},
                                                 {459.201, 1.426, 1.846},
                                                 {476.862, 1.242, 1.796},
                                                 {495.937, 0.916, 1.840},
                                                 {516.601, 0.608, 2.120},
                                                 {539.062, 0.402, 2.540},
                                                 {563.564, 0.306, 2.880},
                                                 {590.401, 0.236, 2.970},
                                                 {619.921, 0.194, 3.060},
                                                 {652.548, 0.166, 3.150},
                                                 {688.801, 0.160, 3.800},
                                                 {729.319, 0.164, 4.357},
                                                 {774.901, 0.176, 4.860}}};
constexpr std::array<OpticalConstants, 17> copper{{{381.490, 1.200, 2.121562},
                                                   {399.949, 1.175, 2.130},
                                                   {413.281, 1.180, 2.210},
                                                   {427.532, 1.175, 2.289},
                                                   {442.801, 1.170, 2.362},
                                                   {459.201, 1.160, 2.433},
                                                   {476.862, 1.150, 2.504},
                                                   {495.937, 1.135, 2.564},
                                                   {516.601, 1.120, 2.605},
                                                   {539.062, 1.040, 2.583},
                                                   {563.564, 0.826, 2.599},
                                                   {590.401, 0.468, 2.809},
                                                   {619.921, 0.272, 3.240},
                                                   {652.548, 0.214, 3.670},
                                                   {688.801, 0.213, 4.050},
                                                   {729.319, 0.223, 4.430},
                                                   {774.901, 0.250, 4.817}}};
// Brass of 70 % copper and 30 % zinc: querry1985.
constexpr std::array<OpticalConstants, 20> brass{
    {{380, 1.487, 1.818}, {400, 1.445, 1.805}, {420, 1.350, 1.786}, {440, 1.191, 1.797}, {460, 0.994, 1.883},
     {480, 0.816, 2.046}, {500, 0.686, 2.250}, {520, 0.602, 2.464}, {540, 0.549, 2.668}, {560, 0.505, 2.860},
     {580, 0.468, 3.059}, {600, 0.450, 3.253}, {620, 0.449, 3.434}, {640, 0.444, 3.609}, {660, 0.445, 3.778},
     {680, 0.444, 3.943}, {700, 0.446, 4.106}, {720, 0.450, 4.266}, {740, 0.455, 4.424}, {760, 0.458, 4.579}}};
// Magnesium and titanium oxide: palik1985. Neither absorbs visible light.
constexpr std::array<OpticalConstants, 12> magnesia{{{382.065, 1.76680, 0},
                                                     {404.634, 1.76104, 0},
                                                     {435.782, 1.75471, 0},
                                                     {457.829, 1.75120, 0},
                                                     {486.005, 1.74711, 0},
                                                     {508.532, 1.74446, 0},
                                                     {546.167, 1.74077, 0},
                                                     {589.259, 1.73737, 0},
                                                     {632.874, 1.73460, 0},
                                                     {656.326, 1.73335, 0},
                                                     {690.696, 1.73191, 0},
                                                     {767.678, 1.72872, 0}}};
constexpr std::array<OpticalConstants, 19> titania{{{388, 3.49, 0},
                                                    {400, 3.40, 0},
                                                    {420, 3.29, 0},
                                                    {440, 3.20, 0},
                                                    {460, 3.13, 0},
                                                    {480, 3.08, 0},
                                                    {500, 3.03, 0},
                                                    {520, 3.00, 0},
                                                    {540, 2.97, 0},
                                                    {560, 2.94, 0},
                                                    {580, 2.92, 0},
                                                    {600, 2.90, 0},
                                                    {620, 2.88, 0},
                                                    {640, 2.87, 0},
                                                    {660, 2.85, 0},
                                                    {680, 2.84, 0},
                                                    {700, 2.83, 0},
                                                    {720, 2.82, 0},
                                                    {780, 2.80, 0}}};

struct Metal {
    std::string_view name;
    std::span<const OpticalConstants> constants;
};
constexpr std::array<Metal, 7> metals{{{"Ag", silver},
                                       {"Al", aluminium},
                                       {"Au", gold},
                                       {"Cu", copper},
                                       {"CuZn", brass},
                                       {"MgO", magnesia},
                                       {"TiO2", titania}}};

/// A dispersion formula: n² = 1 + sum of b λ² / (λ² - c), λ in micrometres.
struct Glass {
    std::string_view name;
    std::array<double, 3> b, c;
};
// schott2017, under the names that pbrt gives them: its F5, F10 and F11 are the dense flints SF5, SF10 and SF11.
constexpr std::array<Glass, 7> glasses{{
    {"glass-BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
    {"glass-BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
    {"glass-FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
    {"glass-LASF9", {2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},
    {"glass-F5", {1.52481889, 0.187085527, 1.42729015}, {0.011254756, 0.0588995392, 129.141675}},
    {"glass-F10", {1.62153902, 0.256287842, 1.64447552}, {0.0122241457, 0.0595736775, 147.468793}},
    {"glass-F11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}},
}};

/// A light by its chromaticity, which is all that is left of its spectrum in three channels at luminance 1.
struct Illuminant {
    std::string_view name;
    double x, y;
};
// cie15; the white of ACES: smpte2065
constexpr std::array<Illuminant, 16> illuminants{{{"stdillum-A", 0.44758, 0.40745},
                                                  {"stdillum-D50", 0.34567, 0.35851},
                                                  {"stdillum-D65", 0.31272, 0.32903},
                                                  {"stdillum-F1", 0.3131, 0.3371},
                                                  {"stdillum-F2", 0.3721, 0.3751},
                                                  {"stdillum-F3", 0.4091, 0.3941},
                                                  {"stdillum-F4", 0.4402, 0.4031},
                                                  {"stdillum-F5", 0.3138, 0.3452},
                                                  {"stdillum-F6", 0.3779, 0.3882},
                                                  {"stdillum-F7", 0.3129, 0.3292},
                                                  {"stdillum-F8", 0.3458, 0.3586},
                                                  {"stdillum-F9", 0.3741, 0.3727},
                                                  {"stdillum-F10", 0.3458, 0.3588},
                                                  {"stdillum-F11", 0.3805, 0.3769},
                                                  {"stdillum-F12", 0.4370, 0.4042},
                                                  {"illum-acesD60", 0.32168, 0.33767}}};

template <class Row>
const Row* find(std::span<const Row> rows, std::string_view name) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
    return found == rows.end() ? nullptr : &*found;
}

/// One of the two constants, constant beyond the ends of the table.
std::function<double(double)> interpolated(std::span<const OpticalConstants> table,
                                           double OpticalConstants::*constant) {
    return [table, constant](double w) {
        const auto above = std::upper_bound(table.begin(), table.end(), w,
                                            [](double at, const OpticalConstants& row) { return at < row.wavelength; });
        if (above == table.begin() || above == table.end()) {
            return (above == table.begin() ? table.front() : table.back()).*constant;
        }
        const OpticalConstants& low = *(above - 1);
        const double t = (w - low.wavelength) / (above->wavelength - low.wavelength);
        return std::lerp(low.*constant, (*above).*constant, t);
    };
}

double refractive_index(const Glass& glass, double wavelength) {
    const double squared = wavelength * wavelength * 1e-6;
    double n_squared = 1;
    for (int i = 0; i < 3; ++i) {
        n_squared += glass.b[i] * squared / (squared - glass.c[i]);
    }
    return std::sqrt(n_squared);
}

constexpr std::string_view metal_prefix = "metal-";

}  // namespace

std::optional<Rgb> find_named_spectrum(std::string_view name) {
    if (const Glass* glass = find(std::span<const Glass>(glasses), name)) {
        return rgb_from_spectrum([glass](double w) { return refractive_index(*glass, w); }, SpectrumKind::unbounded);
    }
    if (const Illuminant* light = find(std::span<const Illuminant>(illuminants), name)) {
        return rgb_from_chromaticity(light->x, light->y);
    }
    const auto metal = find_metal_constant(name);
    return metal ? std::optional(rgb_from_spectrum(metal, SpectrumKind::unbounded)) : std::nullopt;
}

std::function<double(double)> find_metal_constant(std::string_view name) {
    if (!name.starts_with(metal_prefix)) {
        return {};
    }
    name.remove_prefix(metal_prefix.size());
    const std::size_t dash = std::min(name.find('-'), name.size());
    const Metal* metal = find(std::span<const Metal>(metals), name.substr(0, dash));
    const std::string_view constant = name.substr(dash);
    if (!metal || (constant != "-eta" && constant != "-k")) {
        return {};
    }
    return interpolated(metal->constants, constant == "-k" ? &OpticalConstants::k : &OpticalConstants::eta);
}

Rgb named_spectrum(std::string_view name) {
    if (const auto rgb = find_named_spectrum(name)) {
        return *rgb;
    }
    throw InputError(fmt::format("unknown spectrum `{}`; known are {}", name, fmt::join(spectrum_names(), ", ")));
}

std::optional<float> glass_index(std::string_view name) {
    constexpr double d_line = 587.5618;
    const Glass* glass = find(std::span<const Glass>(glasses), name);
    return glass ? std::optional(static_cast<float>(refractive_index(*glass, d_line))) : std::nullopt;
}

std::vector<std::string> spectrum_names() {
    std::vector<std::string> names;
    for (const Metal& metal : metals) {
        names.push_back(fmt::format("{}{}-eta", metal_prefix, metal.name));
        names.push_back(fmt::format("{}{}-k", metal_prefix, metal.name));
    }
    for (const Glass& glass : glasses) {
        names.emplace_back(glass.name);
    }
    for (const Illuminant& light : illuminants) {
        names.emplace_back(light.name);
    }
    return names;
}

}  // namespace wend
