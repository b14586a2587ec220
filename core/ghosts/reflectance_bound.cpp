#include "core/ghosts/reflectance_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/affine.h"

namespace ghostlight {
namespace {

constexpr int slice_count = 128;  ///< errors fall with its square: a few 1e-5 of R

struct AffineComplex {
    Affine re, im;
};

enum class Polarisation { s, p };

/// Of a lossless film over a slice of cosines; physics as in core/optics/thin_film.h.
double most_reflected(const Film& film, const Affine& cosine, Polarisation polarisation) {
    const AffineDomain whole;
    const Affine q2 = (film.n_in * film.n_in) * (1.0 - square(cosine));
    auto normal_index = [&](double n, Affine& w) {
        const Affine w2 = n * n - q2;
        const Interval size = range(w2, whole);
        if (!(size.low > 0.0)) return false;
        w = sqrt(w2, size);
        return true;
    };
    auto admittance = [&](double n, const Affine& w) {
        return polarisation == Polarisation::s ? w : (1.0 / (n * n)) * w;
    };
    Affine w;
    if (!normal_index(film.n_out, w)) return 1.0;
    const Affine exit = admittance(film.n_out, w);
    const Affine entrance = admittance(film.n_in, film.n_in * cosine);
    AffineComplex b{constant(1.0), constant(0.0)}, c{exit, constant(0.0)};
    for (auto layer = film.layers.rbegin(); layer != film.layers.rend(); ++layer) {
        if (!normal_index(layer->n, w)) return 1.0;
        const Affine delta =
            (2.0 * std::numbers::pi / film.wavelength_nm * layer->thickness_nm) * w;
        const Affine y = admittance(layer->n, w);
        const Interval size = range(y, whole);
        if (!(size.low > 0.0)) return 1.0;
        const Affine cos_d = cosine_of(delta), sin_d = sine_of(delta);
        const Affine up = sin_d * reciprocal(y, size), down = sin_d * y;
        const AffineComplex b_next{cos_d * b.re + up * c.im, cos_d * b.im - up * c.re};
        c = {down * b.im + cos_d * c.re, cos_d * c.im - down * b.re};
        b = b_next;
    }
    const Affine sum2 = square(entrance * b.re + c.re) + square(entrance * b.im + c.im);
    const Interval size = range(sum2, whole);
    if (!(size.low > 0.0)) return 1.0;
    const Affine transmitted = 4.0 * ((entrance * exit) * reciprocal(sum2, size));
    return std::clamp(just_above(1.0 - range(transmitted, whole).low), 0.0, 1.0);
}

}  // namespace

ReflectanceBound::ReflectanceBound(const Film& film) : slices_(slice_count, 1.0) {
    if (is_absorbing(film)) return;
    for (int i = 0; i < slice_count; ++i) {
        const double half = 0.5 / slice_count;
        const Affine cosine{(i + 0.5) / slice_count, half, 0.0, 0.0};
        slices_[static_cast<std::size_t>(i)] =
            std::max(most_reflected(film, cosine, Polarisation::s),
                     most_reflected(film, cosine, Polarisation::p));
    }
}

double ReflectanceBound::over(const Interval& cos_incidence) const {
    auto slice = [](double cosine) {
        return std::clamp(static_cast<int>(cosine * slice_count), 0, slice_count - 1);
    };
    const int first = slice(just_below(cos_incidence.low));
    const int last = slice(just_above(cos_incidence.high));
    double most = 0.0;
    for (int i = first; i <= last; ++i) most = std::max(most, slices_[static_cast<std::size_t>(i)]);
    return most;
}

}  // namespace ghostlight
