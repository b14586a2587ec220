#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/io/seq_commands.h"
#include "core/optics/glass.h"

namespace ghostlight {

/// The private glasses of a .seq (PRV … END), by name in capitals.
class PrivateGlasses {
   public:
    /// A command between PRV and END.
    void add(const SeqCommand& command, Notes& notes);
    const Medium* find(std::string_view name) const;

   private:
    std::vector<double> wavelengths_nm_;
    std::map<std::string, Medium> glasses_;
};

/// A glass as a surface names it: NBK7_SCHOTT, 517642, 516800.641700, 1.5168:64.17, AIR, a private
/// name. Throws Error for a mirror, naming file and place.
Medium seq_glass(std::string_view name, const PrivateGlasses& known, const std::string& file,
                 const std::string& where, Notes& notes);

/// Cauchy's formula through indices at wavelengths: exact for up to three, least squares beyond.
/// A single index is constant.
Dispersion fitted_dispersion(const std::vector<double>& wavelengths_nm,
                             const std::vector<double>& indices, double* largest_error);

}  // namespace ghostlight
