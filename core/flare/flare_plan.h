#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/flare/color_misplacement.h"
#include "core/ghosts/ghost_path.h"
#include "core/ghosts/pupil.h"

namespace ghostlight {

struct WeightShares;

/// What becomes of a ghost in a picture.
enum class GhostFate {
    drawn,
    off_sensor,      ///< its light lands beside the sensor
    nothing_passes,  ///< no ray was found that passes
    left_out,        ///< its light is not computed: only bounded
    folded           ///< not drawn by itself: its light is spread over the veil by its moments
};

/// A ghost's light on the sensor plane, on the sensor or beside it: where it lands, how far it
/// spreads, its flux and colour.
struct GhostSpot {
    double x_mm = 0.0, y_mm = 0.0;                    ///< centroid
    double xx_mm2 = 0.0, yy_mm2 = 0.0, xy_mm2 = 0.0;  ///< second moments about it
    std::array<double, 4> flux_mm2{};                 ///< over E0: linear Rec.709, irradiance

    double flux() const { return flux_mm2[3]; }
    /// Standard deviations along the principal axes, the smaller first, mm.
    std::array<double, 2> sigmas_mm() const;
};

/// What other colours than the main one need of the entrance beside a ghost's box, in shares of its
/// breadth.
struct ColorRoom {
    double u = 0.0, v_below = 0.0, v_above = 0.0;  ///< u on both sides
    bool is_none() const { return u == 0.0 && v_below == 0.0 && v_above == 0.0; }
};

/// What the first look at a ghost spares a picture for a light close by.
struct FirstLook {
    PupilBox box;               ///< of the nodes that pass, with a cell to spare
    double cells_wanted = 0.0;  ///< across the box, by the first look's errors; 0: not known
    std::optional<ColorMisplacement> colors;  ///< of a spectrum; empty: not known
    ColorRoom room;
    /// What its weights have beyond the films' tables; null: not known.
    std::shared_ptr<const WeightShares> shares;
    bool in_double = false;  ///< single precision moves its rays by what shows
};

/// How one ghost of a picture is drawn, and what that costs. Fluxes are over E0, mm².
struct PlannedGhost {
    GhostPath path;
    GhostFate fate = GhostFate::drawn;
    PupilBox box;           ///< of the entrance, in a frame whose field lies in the y–z plane
    int cells = 0;          ///< across the box
    int level = 0;          ///< drawn at 1/2^level of the size
    int bands = 1;          ///< of the spectrum, each with a geometry of its own
    double flux_mm2 = 0.0;  ///< on the sensor, from the probe
    double whole_flux_mm2 = 0.0;  ///< on the whole plane, from the probe
    GhostSpot spot;              ///< all that light, from the probe; its colours where it is folded
    double allowance_mm2 = 0.0;  ///< error that the plan grants
    double error_mm2 = 0.0;      ///< estimated L1 error of its picture
    double bound_mm2 = 0.0;      ///< of the light through its box: what leaving it out may cost
    std::size_t rays = 0;
    FirstLook look;
};

/// Rims that keep their sharp edge since their fringes change too little.
struct FringesLeftOut {
    std::size_t ghosts = 0;
    double changed_mm2 = 0.0;  ///< L1 on the sensor over E0 that they would change, at most
};

/// What is drawn for a tolerance, how finely, and what is left out.
struct FlarePlan {
    double tolerance = 0.0;  ///< asked: relative L1 error of the ghost layer on the sensor
    std::vector<PlannedGhost> ghosts;
    double flux_mm2 = 0.0;            ///< of the ghost layer on the sensor
    double folded_mm2 = 0.0;          ///< on the sensor, of ghosts that the veil has instead
    double error_mm2 = 0.0;           ///< estimated, of all that is drawn
    double left_out_mm2 = 0.0;        ///< sum of the bounds of what is left out
    FringesLeftOut fringes_left_out;  ///< where ringing was asked for
    /// Light of four reflections, which no plan draws: an estimate (plane surfaces at normal
    /// incidence) over that of two.
    double not_modelled = 0.0;

    /// Of what is drawn and what is left out, over the light.
    double estimated_error() const {
        return flux_mm2 > 0.0 ? (error_mm2 + left_out_mm2) / flux_mm2 : 0.0;
    }
    double left_out_share() const { return flux_mm2 > 0.0 ? left_out_mm2 / flux_mm2 : 0.0; }
    std::size_t count(GhostFate fate) const;
};

/// What an error is shared out by.
struct ErrorShare {
    double flux_mm2 = 0.0;
    double difficulty_mm2 = 0.0;  ///< error of a plain drawing
};

/// Shares an error out among ghosts. With the cost of a ghost falling as difficulty / error, the
/// least work for a given sum of errors has each error in proportion to the root of what it
/// multiplies: the light itself, for the picture's size, and the first look's errors, for grids and
/// bands. None exceeds `most_share` of its ghost's light, so that faint ghosts stay recognisable.
std::vector<double> share_out(const std::vector<ErrorShare>& ghosts, double error_mm2,
                              double most_share);

}  // namespace ghostlight
