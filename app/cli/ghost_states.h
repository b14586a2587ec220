#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/spectrum_option.h"
#include "core/flare/spectrum.h"
#include "core/io/table.h"

namespace ghostlight::cli {

/// One of the states of a sweep: the lens as it stands there, and the light.
struct GhostState {
    LoadedLens loaded;
    double f_number = 0.0;  ///< paraxial, with the stop as it stands
    Spectrum spectrum;
    LightDirection light;
};

/// What was asked for, each option as a list: `--config` names or "all", `--f-number`,
/// `--wavelength` (or one `--spectrum`), `--field`, `--azimuth`. Fields run fastest, then azimuths,
/// wavelengths, f-numbers, configurations. Throws Error.
std::vector<GhostState> ghost_states(const LensOptions& lens, const LightOptions& light,
                                     const SpectrumOptions& spectrum);

/// The columns that tell a state: configuration, f_number, spectrum, wavelength_nm, field_deg,
/// azimuth_deg.
std::vector<std::string> state_columns();
std::vector<Cell> state_cells(const GhostState& state);

/// A table of one state of a sweep.
struct StateTable {
    const GhostState* state;
    Table table;
};

/// One row for each row of each state, the state's columns in front ("tidy"): what a pivot table or
/// a data frame takes. A column that a state lacks is empty there. Where there are several fields,
/// `worst_field_deg` says at which of them a row's `key` has its largest `flux_mm2`, all else
/// equal.
Table tidy(const std::vector<StateTable>& states, const std::string& key);

/// One row for each value of `key`, one column for each state's `quantity`, named
/// "flux_mm2 at field_deg=10 azimuth_deg=90": only what differs between states is in the name.
/// Throws Error for a column that does not exist.
Table wide(const std::vector<StateTable>& states, const std::string& key,
           const std::string& quantity);

}  // namespace ghostlight::cli
