// The radiance in a plane-parallel medium whose source is a sum of exponentials in depth: what a planar walk asks.
#pragma once

#include <wend/medium/rough_boundary.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace wend {

// Depth x is in mean free paths from the near surface; a cosine mu is that of a direction of propagation and positive
// where it leads deeper (docs/theory/planar.md).

/// What bounds a plane-parallel medium on one side.
struct PlanarBoundary {
    double ior = 1;  ///< index inside over outside, >= 1; 1 is a matched boundary

    /// Radiance that arrives from outside, by the cosine outside in (0,1]; empty: dark.
    std::function<double(double)> illumination;

    /// Set for a boundary that is rough, of the same index.
    std::shared_ptr<const RoughBoundary> rough;

    /// Probability that a smooth boundary reflects a walk that arrives from inside at cosine t.
    double reflectance(double t) const;
    /// What a walk brings that leaves when it arrives from inside at cosine t; 0 where all is reflected.
    double illumination_inside(double t) const;
};

/// A medium between two parallel boundaries; infinitely thick, it is a half-space and the far boundary means nothing.
struct PlanarSlab {
    double thickness = std::numeric_limits<double>::infinity();
    PlanarBoundary near, far;
};

/// Terms of a source S(x, mu) = sum_k [a_k q_k(mu) exp(-x/v_k) + b_k q_k(-mu) exp(-(T-x)/v_k)], where S is the albedo
/// times the phase function's average over the incident radiance, and q_k is given by its Legendre coefficients.
struct PlanarModes {
    struct Mode {
        double length = 1;          ///< v_k > 0, in mean free paths; may be infinite
        double near = 0;            ///< a_k: what falls with depth
        double far = 0;             ///< b_k: what grows with depth; 0 in a half-space
        std::vector<double> shape;  ///< q_k(mu) = sum_l shape[l] P_l(mu)
    };
    std::vector<Mode> modes;
};

/// Radiance and source of such a medium, evaluated from closed forms: the radiance is the source carried along the ray
/// and what the boundary gives at its end, so that both fit together whatever the modes are.
class PlanarAdjoint {
public:
    static constexpr int max_modes = 72;

    /// A depth with the attenuation of every mode, shared by all questions asked there.
    struct Site {
        double depth = 0;
        std::array<double, max_modes> near;  // NOLINT: only the first modes() are set
        std::array<double, max_modes> far;
    };

    /// A ray from a site to the boundary ahead.
    struct Ray {
        double cosine = 1;                   ///< |mu|
        bool deeper = true;                  ///< towards the far boundary
        double length = 0;                   ///< optical distance to the boundary ahead
        double pass = 0;                     ///< exp(-length)
        double arrival = 0;                  ///< value of arriving there, B
        double scattered = 0;                ///< integral of transmittance times source
        double positive = 0;                 ///< the same of the positive terms alone
        std::array<double, max_modes> near;  ///< contribution of each term to `scattered`
        std::array<double, max_modes> far;

        double radiance() const { return scattered + pass * arrival; }
    };

    /// The source at a site in one direction, and the part of its positive terms.
    struct Source {
        double value = 0;
        double positive = 0;
    };

    /// At most max_modes modes. Throws std::invalid_argument for more, and for values that are not finite.
    PlanarAdjoint(const PlanarModes& modes, PlanarSlab slab);

    const PlanarSlab& slab() const { return slab_; }
    int modes() const { return count_; }
    /// Whether any term grows with depth.
    bool has_far() const { return has_far_; }
    double length(int k) const { return 1 / rate_[static_cast<std::size_t>(k)]; }
    double rate(int k) const { return rate_[static_cast<std::size_t>(k)]; }
    /// Whether every term is positive in every direction.
    bool all_positive() const { return all_positive_; }
    /// Terms may be negative. Where their sum would not stay clearly positive (a solution of too few modes, or a
    /// disturbed one), this makes the first mode, the longest, positive in all directions and lowers the negative terms
    /// of a direction until the sum is, so that the source can be sampled. Returns the smallest factor, 1 if nothing
    /// had to be lowered.
    double keep_positive();

    void at(double depth, Site& site) const;
    Ray ray(const Site& site, double mu) const;
    Source source(const Site& site, double mu) const;
    /// Incident radiance at a depth from direction mu.
    double radiance(double depth, double mu) const;
    /// Value of arriving from inside at a boundary with cosine t: what leaves, and what is reflected.
    double arrival(bool at_far, double t) const;

private:
    template <class Use>
    void with_amplitudes(double mu, const Use& use) const;
    void trace(const Site& site, double mu, Ray& ray) const;
    void raise_longest(std::vector<double>& amplitudes) const;
    void tabulate_rough_arrivals();
    double smooth_arrival(bool at_far, double t) const;

    PlanarSlab slab_;
    int count_ = 0;
    bool has_far_ = false;
    bool all_positive_ = true;
    std::array<Site, 2> ends_;
    std::array<std::vector<double>, 2> rough_arrival_;  // of a rough boundary, at equal steps of the cosine
    std::array<double, max_modes> rate_{};              // 1/v_k
    std::array<double, max_modes> through_{};           // exp(-T/v_k)
    int rows_ = 1;                                      // of the table below; one suffices where no q_k depends on mu
    std::vector<double> near_;                          // a_k q_k(mu) by row (equal angles) and mode
    std::vector<double> far_;                           // b_k q_k(-mu)
};

}  // namespace wend
