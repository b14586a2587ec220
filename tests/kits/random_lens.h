#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/optics/prescription.h"

// Lenses that nobody designed, and what must hold for every one of them.

namespace ghostlight {

/// Random numbers that are the same with every standard library.
class Dice {
   public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high);
    /// Even in the logarithm; both positive.
    double magnitude(double low, double high);
    int integer(int low, int high);
    bool chance(double share) { return between(0.0, 1.0) < share; }

   private:
    std::mt19937_64 engine_;
};

enum class LensKind {
    plausible,  ///< as a designer might leave half-way: glass, air, coatings, a stop
    hostile     ///< what the checks of prescriptions let through: every number at its worst
};

/// The same lens for the same kind and number, on every machine.
Prescription random_lens(LensKind kind, std::uint64_t number);

/// What a lens broke.
struct Violation {
    std::string law, what;
};

/// How often each law was put to the test: a law that is never tried holds by itself.
struct LawCounts {
    std::size_t finite = 0, energy = 0, films = 0, reversed = 0, scaled = 0, turned = 0,
                mirrored = 0, unfolded = 0;
    LawCounts& operator+=(const LawCounts& other);
};

/// Traces rays of the lens along some of its paths and holds:
/// - no NaN or infinity in any output, double or float, for rays that pass or fail;
/// - no ray ends with more than it began with;
/// - R + T = 1 for each film without absorption, R + T ≤ 1 with; T the same from both sides;
/// - a ray sent back arrives where it came from, with the same weight;
/// - the lens at 1024 times its size moves every ray by the same factor, exactly;
/// - turning the light about the axis turns the ray; mirroring it mirrors the ray;
/// - a ghost is the ordinary trace of its unfolded lens, by other formulas in long double.
/// Tolerances follow each ray's own amplification of rounding, times `strictness`'s inverse: at a
/// million, rounding itself breaks the laws, which shows that they can be broken.
std::vector<Violation> broken_laws(const Prescription& lens, std::uint64_t number,
                                   LawCounts& counts, double strictness = 1.0);

}  // namespace ghostlight
