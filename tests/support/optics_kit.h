#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/io/lens_file.h"
#include "core/optics/optical_system.h"
#include "core/optics/prescription.h"
#include "tests/support/test_paths.h"

// Lenses and random numbers for tests.

namespace ghostlight {

inline Medium medium(double n) { return {n == 1.0 ? "" : "glass", ConstantIndex{n}}; }

/// A row of a made-up lens; a radius of 0 is a plane.
inline Surface row(double radius_mm, double thickness_mm, double n_after,
                   double semi_diameter_mm = 10.0, double conic = 0.0) {
    Surface made;
    if (radius_mm != 0.0) made.curve = Radius{radius_mm};
    made.thickness_mm = thickness_mm;
    made.medium_after = medium(n_after);
    made.semi_diameter_mm = semi_diameter_mm;
    made.conic = conic;
    return made;
}

inline Prescription lens_of(std::vector<Surface> rows, std::size_t stop = 0) {
    Prescription lens;
    lens.name = "test";
    lens.surfaces = std::move(rows);
    lens.stop.surface = stop;
    return lens;
}

/// A lens of the lenses folder, by its file's name without the extension.
inline Prescription bundled(const std::string& name) {
    return read_lens(lens_folder() / (name + ".json")).lens;
}

/// The same lens with its stop closed to a semi-diameter.
inline Prescription stopped_down(Prescription lens, double semi_diameter_mm) {
    lens.stop.f_number.reset();
    lens.stop.semi_diameter_mm = semi_diameter_mm;
    return lens;
}

class Random {
   public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        // 53 bits of the engine: the same numbers with every standard library.
        const double unit = static_cast<double>(engine_() >> 11) * 0x1.0p-53;
        return low + unit * (high - low);
    }
    int integer(int low, int high) {
        return low + static_cast<int>(between(0.0, 1.0) * (high - low + 1));
    }

   private:
    std::mt19937_64 engine_;
};

}  // namespace ghostlight
