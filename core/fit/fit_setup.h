#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/fit/photo_setup.h"

namespace ghostlight {

/// All that a fit is started from beside the lens; saved with the lens.
struct FitSetup {
    std::vector<FitPhotoSetup> photos;
    std::string vary;  ///< as parse_vary() reads it
    std::string held;  ///< listed, but not varied at present; the same words
    std::string spectrum = "D65";
    bool merge = false;  ///< the photographs are exposures of one scene
    FitLoss loss = FitLoss::cauchy;
    double loss_scale = 4.0;  ///< standard deviations of a sample
    std::string left_out;     ///< ghosts that do not count: "5-3,7-2"
    std::string only;         ///< the only ones that count; empty: all
    int across = 96;
    int starts = 6;
    int suggestions = 0;
    std::string kinds;      ///< of coating, to choose from: "none,qw:550,v-coat"; empty: as listed
    std::string kind_rows;  ///< surfaces from 1 whose kind is chosen; empty: those that are varied
    std::string profiled;   ///< of `vary`, those whose profile likelihood is wanted
    int bootstrap = 0;      ///< photographs drawn from the fitted model; 0: none
    std::uint64_t seed = 1;
    bool operator==(const FitSetup&) const = default;
};

/// "none", "huber", "cauchy" or "tukey". Throws Error.
FitLoss parse_loss(std::string_view text);

/// Names of the ghosts that two comma lists leave out: those of the first, and where the second is
/// not empty, all that are not in it. Throws Error for a ghost that the lens has not.
std::vector<std::string> ghosts_left_out(const std::string& left_out, const std::string& only,
                                         const Prescription& lens);

/// Which of `vary` a list of the same words names. Throws Error for one that it has not.
std::vector<std::size_t> profiled_in(const std::string& text, const std::vector<FitParameter>& vary,
                                     const Prescription& lens);

/// What `ghostlight-cli` makes the same fit by.
std::string fit_command(const FitSetup& setup, const std::string& lens);

/// Throws Error like parse_vary(), parse_spectrum() and ghosts_left_out().
FitRequest fit_request(const FitSetup& setup, const Prescription& lens);

}  // namespace ghostlight
