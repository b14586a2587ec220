#include "core/fit/lens_move.h"

namespace ghostlight {

std::vector<OpticalSystem> compiled_films(const FitScene& scene, const Prescription& lens) {
    std::vector<OpticalSystem> films;
    for (const SpectralSample& each : scene.samples)
        films.push_back(compile(lens, each.wavelength_nm));
    return films;
}

LensMove lens_move(const FitScene& scene, const FittedLens& less, const FittedLens& more,
                   const LightDirection& light, double width) {
    LensMove move{.less = {},
                  .more = {},
                  .film_less = compiled_films(scene, less.lens),
                  .film_more = compiled_films(scene, more.lens),
                  .stop_less = less.stop,
                  .stop_more = more.stop,
                  .light_less = light,
                  .light_more = light,
                  .width = width};
    for (const OpticalSystem& each : scene.geometry) {
        move.less.push_back(compile(less.lens, each.wavelength_nm));
        move.more.push_back(compile(more.lens, each.wavelength_nm));
    }
    return move;
}

LensMove light_move(const FitScene& scene, const LightDirection& less, const LightDirection& more,
                    double width) {
    return {.less = {},
            .more = {},
            .film_less = {},
            .film_more = {},
            .stop_less = scene.lens.stop,
            .stop_more = scene.lens.stop,
            .light_less = less,
            .light_more = more,
            .width = width};
}

}  // namespace ghostlight
