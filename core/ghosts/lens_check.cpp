#include "core/ghosts/lens_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/optics/paraxial.h"
#include "core/optics/paraxial_rays.h"
#include "core/optics/rim.h"
#include "core/units.h"

namespace ghostlight {
namespace {

using Severity = Note::Severity;

/// Optical glasses and crystals that are sold have nd and Vd within these.
constexpr double least_nd = 1.38, most_nd = 2.15, least_vd = 15.0, most_vd = 100.0;
/// A quarter-wave layer is centred where somebody sees.
constexpr double least_center_nm = 350.0, most_center_nm = 1100.0;
/// A stack thicker than this is a filter, not an antireflection coating.
constexpr double most_stack_nm = 5000.0;
/// Mean reflectance of the coated over the bare surface from which the coating looks wrong.
constexpr double worse_than_bare = 1.05;
/// A marginal ray this share outside a rim is clipped by it for certain, not by rounding.
constexpr double clipped_share = 1.001;
/// Of the focal length, between sensor and focus.
constexpr double largest_usual_defocus = 0.02;
constexpr std::array visible_nm = {450.0, 500.0, 550.0, 600.0, 650.0};

class Check {
   public:
    Check(const Prescription& lens, const LensCheckRequest& request)
        : lens_(lens), request_(request) {}

    std::vector<Finding> all() {
        for (std::size_t row = 0; row < lens_.surfaces.size(); ++row) {
            rim(row);
            gap(row);
            glass(row);
            coating(row);
        }
        trace();
        std::ranges::stable_sort(found_, [](const Finding& a, const Finding& b) {
            if (a.severity != b.severity) return a.severity > b.severity;
            const auto row = [](const Finding& f) {
                return f.surface.value_or(std::numeric_limits<std::size_t>::max());
            };
            return row(a) < row(b);
        });
        return std::move(found_);
    }

   private:
    const Prescription& lens_;
    const LensCheckRequest& request_;
    std::vector<Finding> found_;

    void add(Severity severity, std::optional<std::size_t> row, LensCell cell, std::string text,
             std::string proposal = {}) {
        found_.push_back({severity, row, cell, std::move(text), std::move(proposal), {}});
    }

    void rim(std::size_t row) {
        const Surface& surface = lens_.surfaces[row];
        const double edge_mm = edge_height_mm(surface);
        if (surface.semi_diameter_mm <= edge_mm) return;
        add(Severity::warning, row, LensCell::semi_diameter,
            fmt::format("semi-diameter {:.4g} mm is larger than the radius of curvature allows "
                        "({:.4g} mm)",
                        surface.semi_diameter_mm, edge_mm),
            "halve it if it is a diameter, or check the radius");
    }

    void gap(std::size_t row) {
        if (row + 1 >= lens_.surfaces.size()) return;
        const Surface& front = lens_.surfaces[row];
        const RimGap rims = rim_gap(lens_, row);
        if (rims.crosses()) {
            add(Severity::warning, row, LensCell::thickness,
                fmt::format("surfaces {} and {} cross: at {:.4g} mm from the axis they overlap by "
                            "{:.3g} mm",
                            row + 1, row + 2, rims.height_mm, -rims.gap_mm),
                "check the thickness, the radii and the semi-diameters");
        } else if (front.thickness_mm == 0.0 && !is_air(front.medium_after)) {
            add(Severity::warning, row, LensCell::thickness,
                fmt::format("the glass between surfaces {} and {} has no thickness", row + 1,
                            row + 2),
                "give it a thickness, or make it air");
        }
    }

    void glass(std::size_t row) {
        const Medium& medium = lens_.surfaces[row].medium_after;
        if (is_air(medium)) return;
        if (std::holds_alternative<UnknownGlass>(medium.dispersion)) {
            add(Severity::error, row, LensCell::medium,
                fmt::format("glass {} is in no catalogue at hand", describe(medium)),
                "choose another name, or give nd and Vd");
            return;
        }
        if (const auto range = wavelength_range_nm(medium)) {
            if ((range->first > 0.0 && request_.shortest_nm < range->first) ||
                request_.longest_nm > range->second)
                add(Severity::warning, row, LensCell::medium,
                    fmt::format("{} has an index from {:.4g} to {:.4g} nm only; the light has "
                                "{:.4g} to {:.4g} nm",
                                describe(medium), range->first, range->second, request_.shortest_nm,
                                request_.longest_nm),
                    "take a glass of a catalogue that covers the light");
        }
        try {
            const double nd = refractive_index(medium, d_line_nm);
            if (!(nd >= least_nd && nd <= most_nd))
                add(Severity::warning, row, LensCell::medium,
                    fmt::format("index {:.4f} at d is outside what optical glasses have ({} to {})",
                                nd, least_nd, most_nd),
                    "check the digits");
            const double vd = abbe_number(medium);
            if (std::isfinite(vd) && !(vd >= least_vd && vd <= most_vd))
                add(Severity::warning, row, LensCell::medium,
                    fmt::format("Abbe number {:.4g} is outside what optical glasses have ({} to "
                                "{})",
                                vd, least_vd, most_vd),
                    "check the digits");
        } catch (const Error&) {
            // Beyond its range: already found above.
        }
    }

    void coating(std::size_t row) {
        const Surface& surface = lens_.surfaces[row];
        if (std::holds_alternative<Uncoated>(surface.coating)) {
            bare_among_coated(row);
            return;
        }
        const Medium& before = medium_before(lens_, row);
        if (const auto* quarter = std::get_if<QuarterWave>(&surface.coating)) {
            if (!(quarter->center_nm >= least_center_nm && quarter->center_nm <= most_center_nm))
                add(Severity::warning, row, LensCell::coating,
                    fmt::format("the quarter-wave layer is centred at {:.4g} nm, far from the "
                                "visible",
                                quarter->center_nm),
                    "check the unit: nm");
        }
        if (const auto* stack = std::get_if<LayerStack>(&surface.coating)) {
            double thickness_nm = 0.0;
            for (const Layer& layer : stack->layers) thickness_nm += layer.thickness_nm;
            if (thickness_nm > most_stack_nm)
                add(Severity::warning, row, LensCell::coating,
                    fmt::format("the layers are {:.4g} nm thick together, unlikely for an "
                                "antireflection coating",
                                thickness_nm),
                    "check the unit: nm");
        }
        try {
            double coated = 0.0, bare = 0.0;
            for (const double nm : visible_nm) {
                coated +=
                    reflectances(film_at(surface.coating, before, surface.medium_after, nm), 1.0)
                        .r();
                bare +=
                    reflectances(film_at(Uncoated{}, before, surface.medium_after, nm), 1.0).r();
            }
            const double count = visible_nm.size();
            if (coated > worse_than_bare * bare && coated / count > 1e-3)
                add(Severity::warning, row, LensCell::coating,
                    fmt::format("the coating ({}) reflects {:.2g} % in the visible, more than the "
                                "bare surface would ({:.2g} %)",
                                describe(surface.coating), 100.0 * coated / count,
                                100.0 * bare / count),
                    is_air(before) == is_air(surface.medium_after)
                        ? "cemented surfaces are seldom coated"
                        : "check the order of the layers and their indices");
        } catch (const Error& error) {
            add(Severity::error, row, LensCell::coating, error.what());
        }
    }

    /// The others have coatings: a bare one is a slip more often than not.
    void bare_among_coated(std::size_t row) {
        const auto faces_air = [&](std::size_t k) {
            return is_air(medium_before(lens_, k)) != is_air(lens_.surfaces[k].medium_after);
        };
        if (!faces_air(row)) return;
        std::size_t coated = 0, bare = 0;
        for (std::size_t k = 0; k < lens_.surfaces.size(); ++k) {
            if (!faces_air(k)) continue;
            (std::holds_alternative<Uncoated>(lens_.surfaces[k].coating) ? bare : coated) += 1;
        }
        if (coated > bare)
            add(Severity::info, row, LensCell::coating,
                "not coated, though most surfaces of this lens are", "give it a coating");
    }

    void trace() {
        try {
            validate(lens_);
            const OpticalSystem system = compile(lens_, request_.wavelength_nm);
            aperture(system);
            focused_ghosts(system);
        } catch (const Error& error) {
            const bool is_known = std::ranges::any_of(
                found_, [](const Finding& f) { return f.severity == Severity::error; });
            if (!is_known) add(Severity::error, std::nullopt, LensCell::whole, error.what());
        }
    }

    void aperture(const OpticalSystem& system) {
        const FirstOrder order = first_order(system);
        const auto rays = paraxial_rays(system, 0.0);
        for (std::size_t row = 0; row < system.surfaces.size() && row < rays.size(); ++row) {
            const double y = std::abs(rays[row].marginal.y_mm);
            if (row == system.stop || !(y > clipped_share * system.surfaces[row].semi_diameter_mm))
                continue;
            add(Severity::warning, row, LensCell::semi_diameter,
                fmt::format("the rim ({:.4g} mm) is narrower than the axial beam through the stop "
                            "({:.4g} mm)",
                            system.surfaces[row].semi_diameter_mm, y),
                "widen it, or close the stop");
        }
        if (std::isfinite(order.efl_mm) &&
            std::abs(order.paraxial_defocus_mm) > largest_usual_defocus * std::abs(order.efl_mm))
            add(Severity::info, lens_.surfaces.size() - 1, LensCell::thickness,
                fmt::format("the sensor is {:.4g} mm {} the paraxial focus of a far object",
                            std::abs(order.paraxial_defocus_mm),
                            order.paraxial_defocus_mm > 0.0 ? "behind" : "before"),
                "right for a near object; else set the sensor to the paraxial focus");
    }

    void focused_ghosts(const OpticalSystem& system) {
        const double diagonal_mm = std::hypot(system.sensor_width_mm, system.sensor_height_mm);
        for (const GhostPath& path : two_reflection_ghosts(system)) {
            const ParaxialGhost ghost = paraxial_ghost(system, path);
            if (!(ghost.diameter_mm <= request_.focused_share * diagonal_mm)) continue;
            Finding finding;
            finding.severity = Severity::warning;
            finding.surface = path.reflections.front();
            if (*finding.surface >= lens_.surfaces.size())
                finding.surface = path.reflections.back();
            finding.cell = LensCell::coating;
            finding.text = fmt::format(
                "ghost {} is focused {:.3g} mm {} the sensor: its light falls on {:.2g} mm",
                name(path, system.surfaces.size()), std::abs(ghost.focus_from_sensor_mm),
                ghost.focus_from_sensor_mm < 0.0 ? "before" : "behind", ghost.diameter_mm);
            finding.proposal = "coat these two surfaces best, or bend one of them";
            finding.ghosts = {path};
            found_.push_back(std::move(finding));
        }
    }
};

}  // namespace

const char* name_of(LensCell cell) {
    switch (cell) {
        case LensCell::curve:
            return "radius";
        case LensCell::asphere:
            return "asphere";
        case LensCell::thickness:
            return "thickness";
        case LensCell::medium:
            return "glass";
        case LensCell::semi_diameter:
            return "semi-diameter";
        case LensCell::coating:
            return "coating";
        case LensCell::whole:
            break;
    }
    return "";
}

std::vector<Finding> check_lens(const Prescription& configured, const LensCheckRequest& request) {
    if (configured.surfaces.empty()) return {};
    return Check(configured, request).all();
}

}  // namespace ghostlight
