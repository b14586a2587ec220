#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/io/table.h"

namespace ghostlight::cli {

/// One demonstration of what fits can and cannot do: what was done, in words, and its numbers.
struct StudySection {
    std::string key;    ///< of --only, and of the files
    std::string title;  ///< for people
    std::string text;   ///< Markdown
    Table table;
    std::vector<std::string> pictures;  ///< files in the study's folder
};

struct StudyRequest {
    int draws = 50;      ///< of the noise, for the coverage of the intervals
    bool quick = false;  ///< smaller photographs, looser references, fewer lenses
    std::uint64_t seed = 1;
    std::filesystem::path folder;  ///< for pages and pictures
    std::function<void(double)> progress = {};
};

// Photographs are made from the reference picture, never from the fit's own model. Each writes the
// HTML reports of its fits into the folder.

/// Every λ0 of a Tessar wrong by up to 105 nm, unknown exposure, balance and place; one picture,
/// many draws of 1 % noise: how many of the 95 % intervals hold the truth.
StudySection study_coverage(const StudyRequest& request);
/// A lens whose radii are 0.3 % off from those that the fit is told; then with radii freed.
StudySection study_radii(const StudyRequest& request);
/// Two surfaces that share their only visible ghost, and a light on the axis; what a second
/// photograph, at the angle that the fit suggests, changes.
StudySection study_undetermined(const StudyRequest& request);
/// A scene behind, a lamp that is in no model, 8 bits and JPEG.
StudySection study_clutter(const StudyRequest& request);
/// A photograph of another lens.
StudySection study_wrong_lens(const StudyRequest& request);
/// Slopes of the model's picture against differences, every kind of number, on bundled lenses.
StudySection study_derivatives(const StudyRequest& request);
/// Kinds of coating chosen by their BIC, against a truth whose kinds differ.
StudySection study_kinds(const StudyRequest& request);
/// Twelve coatings, alone and with six numbers of geometry, and a file of 24 megapixels.
StudySection study_speed(const StudyRequest& request);

}  // namespace ghostlight::cli
