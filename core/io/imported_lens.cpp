#include "core/io/imported_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/import_steps.h"
#include "core/io/json_value.h"
#include "core/io/lens_json.h"
#include "core/optics/beam_size.h"
#include "core/optics/optical_system.h"
#include "core/units.h"

namespace ghostlight {
namespace {

using Fate = Note::Fate;
using Severity = Note::Severity;

constexpr double assumed_f_number = 4.0;
/// A semi-diameter that lets a lens compile until it is sized, over the stop's or the pupil's.
constexpr double provisional_share = 1.5;
/// Images within this of a full-frame sensor's half diagonal are meant for one.
constexpr double full_frame_half_diagonal_mm = 21.633307652783937;
constexpr double full_frame_tolerance = 0.03;
/// Beyond it, tan θ says little about a picture: lenses map so wide a field otherwise.
constexpr double widest_rectilinear_deg = 60.0;
/// Fields, as shares of the half field, whose beams size a surface.
constexpr double sizing_shares[] = {0.0, 0.5, 0.8, 1.0};
/// A round stop is in the next millionth as large as its semi-diameter says.
constexpr double same_size = 1e-6;

class Completion {
   public:
    Completion(ImportedLens imported, const std::string& file)
        : imported_(std::move(imported)), lens_(imported_.lens), file_(file) {}

    LensFile run() {
        if (lens_.surfaces.empty())
            throw Error({.problem = "the lens has no surfaces",
                         .file = file_,
                         .where = {},
                         .found = "none",
                         .expected = "at least one surface"});
        imported_.surfaces.resize(lens_.surfaces.size());
        settle_order(imported_, file_);
        drop_impossible_configurations();
        give_provisional_sizes();
        settle_stop();
        lens_.surfaces.back().thickness_mm =
            std::max(imported_.sensor_distance_mm.value_or(0.0), 0.0);
        check_that_it_compiles();
        settle_published();
        settle_configuration_pupils();
        settle_aperture();
        settle_sensor_distance();
        settle_sensor_size();
        size_surfaces();
        check_import(imported_, imported_.notes);
        validate_in_file(lens_, file_);
        const Notes odd = findings(lens_);
        imported_.notes.insert(imported_.notes.end(), odd.begin(), odd.end());
        return {std::move(lens_), std::move(imported_.notes)};
    }

   private:
    void note(Severity severity, std::string where, std::string text, Fate fate, bool matters,
              std::string proposal = {}) {
        imported_.notes.push_back(
            {severity, std::move(where), std::move(text), fate, matters, std::move(proposal)});
    }

    bool is_stated(std::size_t row) const {
        const auto& stated = imported_.surfaces[row].semi_diameter_mm;
        return stated && *stated > 0.0;
    }

    void drop_impossible_configurations() {
        std::erase_if(lens_.configurations, [this](const Configuration& each) {
            const auto bad = std::ranges::find_if(
                each.thickness_mm, [](const auto& entry) { return !(entry.second >= 0.0); });
            if (bad == each.thickness_mm.end()) return false;
            note(Severity::warning, fmt::format("configuration '{}'", each.name),
                 fmt::format("its thickness behind surface {} is {} mm: left out", bad->first + 1,
                             format_number(bad->second)),
                 Fate::left_out, true, "check the file's configurations and solves");
            return true;
        });
    }

    void give_provisional_sizes() {
        double largest = 0.0;
        for (std::size_t row = 0; row < lens_.surfaces.size(); ++row)
            if (is_stated(row))
                largest = std::max(largest, *imported_.surfaces[row].semi_diameter_mm);
        if (imported_.entrance_pupil_diameter_mm)
            largest = std::max(largest, 0.5 * *imported_.entrance_pupil_diameter_mm);
        if (!(largest > 0.0)) largest = 10.0;
        for (std::size_t row = 0; row < lens_.surfaces.size(); ++row) {
            Surface& surface = lens_.surfaces[row];
            surface.semi_diameter_mm = is_stated(row) ? *imported_.surfaces[row].semi_diameter_mm
                                                      : provisional_share * largest;
            if (!is_stated(row)) surface.semi_diameter_sized = true;
        }
    }

    void settle_stop() {
        if (imported_.stop && *imported_.stop < lens_.surfaces.size()) {
            lens_.stop.surface = *imported_.stop;
            return;
        }
        // A plane in the air is there for a reason; else where the lens is narrowest.
        const auto narrowest = [&](auto eligible) {
            std::optional<std::size_t> chosen;
            for (std::size_t row = 0; row < lens_.surfaces.size(); ++row)
                if (eligible(row) && (!chosen || lens_.surfaces[row].semi_diameter_mm <
                                                     lens_.surfaces[*chosen].semi_diameter_mm))
                    chosen = row;
            return chosen;
        };
        auto chosen = narrowest([&](std::size_t row) { return is_dummy(lens_, row); });
        if (!chosen) chosen = narrowest([&](std::size_t row) { return is_stated(row); });
        lens_.stop.surface = chosen.value_or(0);
        imported_.stop = lens_.stop.surface;
        note(Severity::warning, imported_.surfaces[lens_.stop.surface].where,
             fmt::format("the file names no stop: surface {} is taken ({})", lens_.stop.surface + 1,
                         !chosen                    ? "the first"
                         : is_dummy(lens_, *chosen) ? "a surface without glass"
                                                    : "the one with the smallest semi-diameter"),
             Fate::assumed, true, "set the stop to the surface where the iris is");
    }

    /// validate() says what is wrong before the lens is worked with.
    void check_that_it_compiles() { validate_in_file(traceable(lens_), file_); }

    void settle_published() {
        Published& published = lens_.published;
        if (!published.efl_mm) published.efl_mm = imported_.stated_efl_mm;
        if (!published.f_number) published.f_number = imported_.f_number;
        if (!published.half_field_deg) published.half_field_deg = imported_.half_field_deg;
    }

    void settle_configuration_pupils() {
        for (Configuration& each : lens_.configurations) {
            const auto pupil = imported_.configuration_pupils_mm.find(each.name);
            if (pupil == imported_.configuration_pupils_mm.end()) continue;
            const Prescription position = configured(lens_, each.name);
            const auto order = first_order_of(position);
            if (!order) continue;
            const double radius = 0.5 * pupil->second *
                                  position.surfaces[position.stop.surface].semi_diameter_mm /
                                  order->entrance_pupil_radius_mm;
            if (std::isfinite(radius) && radius > 0.0) each.stop_semi_diameter_mm = radius;
        }
    }

    /// Heights at the stop over those in the entrance pupil, and EFL, in the worst configuration.
    double stop_radius_needed() const {
        double needed = 0.0;
        for (const Configuration& each : lens_.configurations)
            needed = std::max(needed, each.stop_semi_diameter_mm.value_or(0.0));
        for (const Prescription& position : positions()) {
            if (position.stop.semi_diameter_mm) continue;
            const auto order = first_order_of(position);
            if (!order) continue;
            const double at_stop = position.surfaces[position.stop.surface].semi_diameter_mm /
                                   order->entrance_pupil_radius_mm;
            double pupil = std::numeric_limits<double>::quiet_NaN();
            if (imported_.entrance_pupil_diameter_mm)
                pupil = 0.5 * *imported_.entrance_pupil_diameter_mm;
            else if (const auto f =
                         position.stop.f_number ? position.stop.f_number : imported_.f_number)
                pupil = 0.5 * std::abs(order->efl_mm) / *f;
            if (std::isfinite(pupil * at_stop)) needed = std::max(needed, pupil * at_stop);
        }
        return needed;
    }

    /// The lens as listed and in each of its configurations.
    std::vector<Prescription> positions() const {
        std::vector<Prescription> all{configured(lens_, {})};
        for (const Configuration& each : lens_.configurations)
            all.push_back(configured(lens_, each.name));
        return all;
    }

    void settle_aperture() {
        const std::size_t row = lens_.stop.surface;
        const std::string& where = imported_.surfaces[row].where;
        const double needed = stop_radius_needed();
        Surface& stop = lens_.surfaces[row];
        if (needed > 0.0) {
            if (!is_stated(row)) {
                stop.semi_diameter_mm = needed;
                note(Severity::info, where,
                     fmt::format("the stop's semi-diameter follows from the aperture: {:.6g} mm",
                                 needed),
                     Fate::converted, true);
            } else if (needed > stop.semi_diameter_mm * (1.0 + 1e-3)) {
                note(Severity::warning, where,
                     fmt::format("the stated aperture needs a stop of {:.6g} mm semi-diameter, but "
                                 "the stop is listed with {:.6g} mm, which limits it",
                                 needed, stop.semi_diameter_mm),
                     Fate::noticed, true,
                     "enlarge the stop's semi-diameter, or close the f-number");
            }
            if (imported_.f_number && !imported_.entrance_pupil_diameter_mm)
                lens_.stop.f_number = imported_.f_number;
            else if (imported_.entrance_pupil_diameter_mm &&
                     std::abs(needed - stop.semi_diameter_mm) > same_size * needed)
                lens_.stop.semi_diameter_mm = needed;
            return;
        }
        if (is_stated(row)) return;
        const double through = collimated_stop_radius();
        const auto order = first_order_of(lens_);
        if (std::isfinite(through)) {
            stop.semi_diameter_mm = through;
            note(Severity::warning, where,
                 fmt::format("the file gives neither an aperture nor the stop's size: {:.6g} mm "
                             "lets the largest beam on the axis through",
                             through),
                 Fate::assumed, true, "set the f-number or the stop's semi-diameter");
        } else {
            double radius = stop.semi_diameter_mm;
            if (order && std::isfinite(order->efl_mm))
                radius *= std::abs(order->efl_mm) / (2.0 * assumed_f_number) /
                          order->entrance_pupil_radius_mm;
            stop.semi_diameter_mm = std::isfinite(radius) ? radius : stop.semi_diameter_mm;
            note(Severity::warning, where,
                 fmt::format("the file gives no aperture at all: f/{} is assumed",
                             format_number(assumed_f_number)),
                 Fate::assumed, true, "set the f-number or the stop's semi-diameter");
        }
    }

    /// Height at the stop of the widest collimated beam that the stated rims let through.
    double collimated_stop_radius() const {
        double y = 1.0, u = 0.0, n = 1.0, limit = std::numeric_limits<double>::infinity(),
               at_stop = 1.0;
        const Prescription known = traceable(lens_);
        for (std::size_t row = 0; row < known.surfaces.size(); ++row) {
            const Surface& surface = known.surfaces[row];
            if (is_stated(row)) limit = std::min(limit, surface.semi_diameter_mm / std::abs(y));
            if (row == lens_.stop.surface) at_stop = std::abs(y);
            const double after = refractive_index(surface.medium_after, d_line_nm);
            u = (n * u - y * curvature_per_mm(surface.curve) * (after - n)) / after;
            n = after;
            y += surface.thickness_mm * u;
        }
        return limit * at_stop;
    }

    void settle_sensor_distance() {
        const std::string& where = imported_.surfaces.back().where;
        if (imported_.sensor_distance_mm && *imported_.sensor_distance_mm >= 0.0) return;
        const bool negative = imported_.sensor_distance_mm.has_value();
        const std::string found =
            negative ? fmt::format("the sensor is stated {} mm behind the last surface",
                                   format_number(*imported_.sensor_distance_mm))
                     : "the file does not say where the sensor is";
        bool focuses = true;
        for (const Prescription& position : positions()) {
            const auto order = first_order_of(position);
            focuses = focuses && order && std::isfinite(order->bfd_mm) && order->bfd_mm > 0.0;
        }
        if (focuses) {
            lens_.sensor.at_paraxial_focus = true;
            note(negative ? Severity::warning : Severity::info, where,
                 found + ": it is put at the paraxial focus", Fate::assumed, true,
                 "set the sensor's distance if the lens is focused elsewhere");
            return;
        }
        double track_mm = 0.0;
        for (std::size_t row = 0; row + 1 < lens_.surfaces.size(); ++row)
            track_mm += lens_.surfaces[row].thickness_mm;
        if (!(track_mm > 0.0)) track_mm = 100.0;
        lens_.surfaces.back().thickness_mm = track_mm;
        note(
            Severity::warning, where,
            fmt::format("{}, and the lens has no real focus behind it: the sensor is put {:.6g} mm "
                        "behind the last surface, the lens's own length",
                        found, track_mm),
            Fate::assumed, true, "set the sensor's distance");
    }

    /// Half diagonal of what the stated field covers; nothing when there is no telling.
    std::optional<double> half_diagonal() const {
        if (imported_.image_height_mm && *imported_.image_height_mm > 0.0)
            return imported_.image_height_mm;
        const auto order = first_order_of(lens_);
        if (!imported_.half_field_deg || !(*imported_.half_field_deg > 0.0) || !order ||
            !std::isfinite(order->efl_mm))
            return std::nullopt;
        const double field = rad_from_deg(*imported_.half_field_deg);
        return std::abs(order->efl_mm) *
               (*imported_.half_field_deg < widest_rectilinear_deg ? std::tan(field) : field);
    }

    void settle_sensor_size() {
        if (imported_.has_sensor_size || lens_.sensor.width_mm != Sensor{}.width_mm ||
            lens_.sensor.height_mm != Sensor{}.height_mm)
            return;
        const auto half = half_diagonal();
        if (!half) {
            note(Severity::info, "sensor",
                 "the file does not say how large the sensor is: 36 x 24 mm is assumed",
                 Fate::assumed, false, "set the sensor's width and height");
            return;
        }
        if (std::abs(*half / full_frame_half_diagonal_mm - 1.0) > full_frame_tolerance) {
            const double height = 2.0 * *half * 2.0 / std::sqrt(13.0);
            lens_.sensor.width_mm = 1.5 * height;
            lens_.sensor.height_mm = height;
        }
        note(Severity::info, "sensor",
             fmt::format("the file does not say how large the sensor is: {:.4g} x {:.4g} mm (3:2), "
                         "as the image reaches {:.4g} mm from the axis",
                         lens_.sensor.width_mm, lens_.sensor.height_mm, *half),
             Fate::assumed, false, "set the sensor's width and height");
    }

    std::vector<BeamField> fields_to_size() const {
        std::vector<BeamField> fields;
        for (const ImportedField& field : imported_.fields)
            fields.push_back(
                {std::abs(field.field_deg), field.cut_upper, field.cut_lower, field.cut_sides});
        if (!fields.empty()) return fields;
        double half_deg = imported_.half_field_deg.value_or(0.0);
        const auto order = first_order_of(lens_);
        if (half_deg <= 0.0 && order && std::isfinite(order->efl_mm))
            half_deg = deg_from_rad(
                std::atan(0.5 * std::hypot(lens_.sensor.width_mm, lens_.sensor.height_mm) /
                          std::abs(order->efl_mm)));
        for (const double share : sizing_shares) fields.push_back({share * half_deg, 0, 0, 0});
        return fields;
    }

    void size_surfaces() {
        std::vector<bool> rims(lens_.surfaces.size());
        std::size_t unknown = 0;
        for (std::size_t row = 0; row < rims.size(); ++row) {
            rims[row] = is_stated(row);
            if (!rims[row] && row != lens_.stop.surface) ++unknown;
        }
        if (unknown == 0) return;
        std::vector<double> reached(rims.size(), 0.0);
        double widest_deg = 0.0;
        const std::vector<BeamField> fields = fields_to_size();
        for (const Prescription& position : positions()) {
            Prescription sized = traceable(position);
            sized.stop = position.stop;
            try {
                const BeamSizes sizes = beam_sizes(sized, fields, rims);
                for (std::size_t row = 0; row < rims.size(); ++row)
                    reached[row] = std::max(reached[row], sizes.height_mm[row]);
                widest_deg = std::max(widest_deg, sizes.widest_field_deg);
            } catch (const Error&) {
                // Too odd to trace: what is provisional stays, and is said below.
            }
        }
        const double largest = std::max(largest_stated(), *std::ranges::max_element(reached));
        std::string rows;
        for (std::size_t row = 0; row < rims.size(); ++row) {
            if (rims[row] || row == lens_.stop.surface) continue;
            Surface& surface = lens_.surfaces[row];
            // Where there is no glass there is no rim that a ghost could meet.
            double radius = is_dummy(lens_, row) ? std::max(largest, reached[row]) : reached[row];
            const double c = curvature_per_mm(surface.curve);
            const double edge = (1.0 + surface.conic) * c * c;
            if (edge > 0.0) radius = std::min(radius, 1.0 / std::sqrt(edge));
            if (radius > 0.0) surface.semi_diameter_mm = radius;
            rows += fmt::format("{}{}", rows.empty() ? "" : ", ", row + 1);
        }
        note(
            Severity::warning, "semi-diameters",
            fmt::format("the file gives no semi-diameter for surface{} {}: sized to let the direct "
                        "beam of fields up to {:.4g} degrees through",
                        unknown == 1 ? "" : "s", rows, widest_deg),
            Fate::assumed, true, "put in the real ones: rims cut ghosts");
        double wanted_deg = 0.0;
        for (const BeamField& field : fields) wanted_deg = std::max(wanted_deg, field.field_deg);
        if (widest_deg < wanted_deg)
            note(Severity::warning, "semi-diameters",
                 fmt::format("the chief ray of the field of {:.4g} degrees does not get through "
                             "the lens",
                             wanted_deg),
                 Fate::noticed, true, "check the field, the stop and the surfaces");
    }

    double largest_stated() const {
        double largest = 0.0;
        for (std::size_t row = 0; row < lens_.surfaces.size(); ++row)
            if (is_stated(row)) largest = std::max(largest, lens_.surfaces[row].semi_diameter_mm);
        return largest;
    }

    ImportedLens imported_;
    Prescription& lens_;
    const std::string& file_;
};

}  // namespace

Prescription traceable(const Prescription& lens) {
    Prescription known = lens;
    for (Surface& surface : known.surfaces) {
        surface.coating = Uncoated{};
        if (std::holds_alternative<UnknownGlass>(surface.medium_after.dispersion))
            surface.medium_after.dispersion = ConstantIndex{stand_in_index};
    }
    known.stop.f_number.reset();
    known.stop.semi_diameter_mm.reset();
    known.sensor.at_paraxial_focus = false;
    return known;
}

std::optional<FirstOrder> first_order_of(const Prescription& lens) {
    try {
        return first_order(compile(traceable(lens), d_line_nm));
    } catch (const Error&) {
        return std::nullopt;
    }
}

LensFile complete_import(ImportedLens imported, const std::string& file) {
    return Completion(std::move(imported), file).run();
}

Prescription sized_again(const Prescription& lens) {
    ImportedLens open;
    open.lens = lens;
    open.surfaces.resize(lens.surfaces.size());
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        if (!lens.surfaces[row].semi_diameter_sized)
            open.surfaces[row].semi_diameter_mm = lens.surfaces[row].semi_diameter_mm;
    open.stop = lens.stop.surface;
    open.f_number = lens.stop.f_number;
    if (!open.f_number) open.f_number = lens.published.f_number;
    open.half_field_deg = lens.published.half_field_deg;
    open.sensor_distance_mm = lens.surfaces.empty() ? 0.0 : lens.surfaces.back().thickness_mm;
    if (lens.sensor.at_paraxial_focus) open.sensor_distance_mm.reset();
    open.has_sensor_size = true;
    const Prescription completed = complete_import(std::move(open), {}).lens;
    Prescription result = lens;
    for (std::size_t row = 0; row < lens.surfaces.size(); ++row)
        if (lens.surfaces[row].semi_diameter_sized && completed.surfaces.size() > row)
            result.surfaces[row].semi_diameter_mm = completed.surfaces[row].semi_diameter_mm;
    return result;
}

}  // namespace ghostlight
