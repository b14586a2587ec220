#include "core/fit/fit_parameters.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/fit/fit_kinds.h"

namespace ghostlight {
namespace {

/// Adds to an index at every wavelength of use. A glass's own formula is kept by its table.
void add_index(Medium& medium, double added) {
    if (added == 0.0) return;
    if (auto* constant = std::get_if<ConstantIndex>(&medium.dispersion)) {
        constant->n += added;
        return;
    }
    if (auto* model = std::get_if<ModelGlass>(&medium.dispersion)) {
        // The dispersion nF − nC stays.
        const double spread = (model->nd - 1.0) / model->vd;
        model->nd += added;
        model->vd = (model->nd - 1.0) / spread;
        return;
    }
    if (auto* table = std::get_if<TabulatedGlass>(&medium.dispersion)) {
        for (SpectralValue& each : table->index) each.value += added;
        return;
    }
    TabulatedGlass table;
    const auto range = wavelength_range_nm(medium);
    for (double nm = 380.0; nm <= 780.0; nm += 20.0)
        if (!range || ((range->first == 0.0 || nm >= range->first) &&
                       (range->second == 0.0 || nm <= range->second)))
            table.index.push_back({nm, refractive_index(medium, nm) + added});
    table.held_beyond = true;
    medium.dispersion = table;
    medium.name += fmt::format("{:+.5f}", added);
}

}  // namespace

bool is_coating(FitKind kind) {
    return kind == FitKind::center || kind == FitKind::thickness ||
           kind == FitKind::layer_thickness || kind == FitKind::layer_index ||
           kind == FitKind::reflectance;
}

std::string name(const FitParameter& parameter) {
    const FitKindData& data = data_of(parameter.kind);
    if (data.of_stop) return std::string(data.words);
    std::string rows;
    for (const std::size_t row : parameter.rows)
        rows += fmt::format("{}{}", rows.empty() ? "" : "+", row + 1);
    const std::string layer = data.layered ? fmt::format(" {}", parameter.layer + 1) : "";
    const bool after = data.words.ends_with("after");
    return fmt::format("{}{}{}{}", data.words, layer, after ? " " : " of ", rows);
}

std::string unit(const FitParameter& parameter) {
    return std::string(data_of(parameter.kind).unit);
}

void set_coating(Coating& coating, const FitParameter& parameter, double value) {
    auto* stack = std::get_if<LayerStack>(&coating);
    // It is no longer the library's.
    if (stack != nullptr) stack->name.clear();
    switch (parameter.kind) {
        case FitKind::center:
            std::get<QuarterWave>(coating).center_nm = value;
            break;
        case FitKind::thickness:
            if (stack != nullptr)
                for (Layer& layer : stack->layers) layer.thickness_nm *= value;
            else
                std::get<QuarterWave>(coating).thickness_factor = value;
            break;
        case FitKind::layer_thickness:
            stack->layers[parameter.layer].thickness_nm = value;
            break;
        case FitKind::layer_index:
            add_index(*layer_medium(coating, parameter.layer), value);
            break;
        case FitKind::reflectance: {
            auto& fixed = std::get<ConstantReflectance>(coating);
            // What is absorbed stays absorbed.
            const double absorbed = 1.0 - fixed.reflectance - fixed.transmittance;
            fixed.reflectance = value;
            fixed.transmittance = std::max(0.0, 1.0 - absorbed - value);
            break;
        }
        default:
            break;
    }
}

void set(FittedLens& fitted, const FitParameter& parameter, double value) {
    Prescription& lens = fitted.lens;
    switch (parameter.kind) {
        case FitKind::stop_size: {
            if (lens.stop.f_number)
                *lens.stop.f_number /= value;
            else
                lens.stop.semi_diameter_mm =
                    value * lens.stop.semi_diameter_mm.value_or(
                                lens.surfaces[lens.stop.surface].semi_diameter_mm);
            // It is the blades that are varied, not the ring that carries them.
            Surface& row = lens.surfaces[lens.stop.surface];
            row.semi_diameter_mm *= std::max(1.0, value);
            return;
        }
        case FitKind::stop_x:
            fitted.stop.x_mm = value;
            return;
        case FitKind::stop_y:
            fitted.stop.y_mm = value;
            return;
        case FitKind::stop_rotation:
            lens.stop.rotation_deg = value;
            return;
        default:
            break;
    }
    for (const std::size_t row : parameter.rows) {
        Surface& surface = lens.surfaces[row];
        switch (parameter.kind) {
            case FitKind::radius:
                surface.curve = Radius{value};
                break;
            case FitKind::gap:
                surface.thickness_mm = value;
                break;
            case FitKind::index:
                add_index(surface.medium_after, value);
                break;
            case FitKind::semi_diameter:
                surface.semi_diameter_mm = value;
                break;
            default:
                set_coating(surface.coating, parameter, value);
                break;
        }
    }
}

}  // namespace ghostlight
