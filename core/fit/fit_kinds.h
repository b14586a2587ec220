#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/fit/fit_parameters.h"

// What is known of each kind of number that a fit may vary.

namespace ghostlight {

struct FitKindData {
    FitKind kind;
    std::string_view key;    ///< in a list of what to vary
    std::string_view words;  ///< for people
    std::string_view unit;
    bool of_stop, layered;
};
std::span<const FitKindData> fit_kinds();
const FitKindData& data_of(FitKind kind);

/// The layer of a coating that a kind needs; null where it makes no sense.
Medium* layer_medium(Coating& coating, std::size_t layer);

/// The value that stands in the lens, or nothing where the parameter makes no sense.
std::optional<double> value_in(const Prescription& lens, FitKind kind, std::size_t row,
                               std::size_t layer);

/// What value_in() would have needed there, for people.
std::string why_not(const Prescription& lens, FitKind kind, std::size_t row);

/// Prior and bounds about the start: what is left to chance in a shop, or where a coating may be
/// centred; bounds wide of it.
void set_defaults(FitParameter& parameter);

}  // namespace ghostlight
