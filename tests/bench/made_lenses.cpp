#include "tests/bench/made_lenses.h"

#include <fmt/format.h>

namespace ghostlight::bench {

Prescription train(int surfaces) {
    Prescription lens;
    lens.name = fmt::format("train of {} surfaces", surfaces);
    for (int k = 0; k < surfaces / 2; ++k) {
        const double radius_mm = (k % 2 == 0 ? 1.0 : -1.0) * (400.0 + 10.0 * k);
        Surface front, back;
        front.curve = Radius{radius_mm};
        front.thickness_mm = 2.0;
        front.medium_after = {"", ModelGlass{k % 2 == 0 ? 1.6 : 1.7, k % 2 == 0 ? 60.0 : 30.0}};
        front.semi_diameter_mm = back.semi_diameter_mm = 12.0;
        front.coating = back.coating = QuarterWave{};
        back.curve = Radius{-radius_mm};
        back.thickness_mm = 1.0;
        lens.surfaces.push_back(front);
        lens.surfaces.push_back(back);
        if (k == surfaces / 4) {
            Surface stop;
            stop.thickness_mm = 1.0;
            stop.semi_diameter_mm = 8.0;
            lens.stop.surface = lens.surfaces.size();
            lens.surfaces.push_back(stop);
        }
    }
    lens.surfaces.back().thickness_mm = 60.0;
    return lens;
}

}  // namespace ghostlight::bench
