#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/optics/prescription.h"

namespace ghostlight::bench {

/// What a benchmark measured, the median of its repetitions: "real_s" and "cpu_s" per iteration,
/// and its counters by name.
using Measured = std::map<std::string, double, std::less<>>;

/// All benchmarks of a run, by name.
class Results {
   public:
    void add(const std::string& benchmark, const Measured& repetition);
    /// Not a number where there is no such benchmark or counter.
    double median(const std::string& benchmark, std::string_view counter) const;
    double smallest(const std::string& benchmark, std::string_view counter) const;

   private:
    std::map<std::string, std::vector<Measured>> runs_;
    std::vector<double> sorted(const std::string& benchmark, std::string_view counter) const;
};

/// A benchmark program: `declare` registers its benchmarks, `summary` prints what they came to.
struct Program {
    std::vector<std::string> default_flags;  ///< of Google Benchmark; the user's come after
    std::function<void()> declare;
    std::function<void(const Results&)> summary;
};
/// Runs it, with the calibration loops "fma/f32" and "fma/f64" beside its benchmarks.
int run(int argc, char** argv, const Program& program);

/// What one core can do at most: multiply-adds that depend on nothing, counted as two operations,
/// with the instruction set that the traces use. Times divided by it travel between machines.
inline constexpr const char* fma_f32 = "fma/f32";
inline constexpr const char* fma_f64 = "fma/f64";
/// The calibration's counter, operations per second.
inline constexpr const char* fma_rate = "flop/s";

/// The bundled lens of that file name, in a configuration.
Prescription lens_named(std::string_view file, std::string_view configuration = {});

/// Half the angle at which the sensor's corner is seen, degrees: a field every lens covers.
double middle_field_deg(const Prescription& lens);

/// "12.3", or "-" for what was not measured.
std::string number(double value, int digits);

}  // namespace ghostlight::bench
