#include "tests/kits/random_lens.h"

#include <cmath>

namespace ghostlight {
namespace {

Medium glass(double n) { return {n == 1.0 ? "" : "glass", ConstantIndex{n}}; }

Coating plausible_coating(Dice& dice) {
    switch (dice.integer(0, 3)) {
        case 0:
            return Uncoated{};
        case 1:
            return QuarterWave{dice.between(400.0, 700.0)};
        case 2:
            return QuarterWave{dice.between(400.0, 700.0), IdealIndex{}};
        default: {
            LayerStack stack;
            const int layers = dice.integer(1, 6);
            for (int k = 0; k < layers; ++k)
                stack.layers.push_back(
                    {glass(dice.between(1.35, 2.4)), dice.between(20.0, 180.0), 0.0});
            return stack;
        }
    }
}

Prescription plausible(Dice& dice) {
    Prescription lens;
    lens.name = "random";
    const int elements = dice.integer(1, 8);
    const double aperture_mm = dice.between(6.0, 25.0);
    for (int k = 0; k < elements; ++k) {
        // Cemented partners share a surface.
        const int surfaces = dice.chance(0.3) ? 3 : 2;
        for (int s = 0; s < surfaces; ++s) {
            Surface surface;
            const double radius_mm =
                dice.magnitude(1.15 * aperture_mm, 400.0) * (dice.chance(0.5) ? 1.0 : -1.0);
            if (!dice.chance(0.1)) surface.curve = Radius{radius_mm};
            const bool last = s + 1 == surfaces;
            surface.medium_after = glass(last ? 1.0 : dice.between(1.43, 1.95));
            surface.thickness_mm = last ? dice.between(0.1, 12.0) : dice.between(1.0, 9.0);
            surface.semi_diameter_mm = aperture_mm * dice.between(0.7, 1.0);
            if (dice.chance(0.15)) surface.conic = dice.between(-1.5, 0.5);
            if (dice.chance(0.1))
                surface.aspheric = {dice.between(-1.0, 1.0) * 1e-6, dice.between(-1.0, 1.0) * 1e-9};
            surface.coating = plausible_coating(dice);
            lens.surfaces.push_back(std::move(surface));
        }
    }
    Surface stop;
    stop.semi_diameter_mm = aperture_mm * dice.between(0.2, 0.8);
    stop.thickness_mm = dice.between(0.5, 5.0);
    std::size_t at = 0;
    while (at < lens.surfaces.size() && dice.chance(0.7)) ++at;
    // Between glasses there is no room for one.
    while (at > 0 && at < lens.surfaces.size() &&
           !(lens.surfaces[at - 1].medium_after == glass(1.0)))
        ++at;
    lens.surfaces.insert(lens.surfaces.begin() + static_cast<std::ptrdiff_t>(at), stop);
    lens.stop.surface = at;
    if (dice.chance(0.4)) {
        lens.stop.blades = dice.integer(5, 11);
        lens.stop.rotation_deg = dice.between(0.0, 90.0);
        lens.stop.blade_curvature = dice.chance(0.5) ? dice.between(0.0, 1.0) : 0.0;
    }
    lens.surfaces.back().thickness_mm = dice.between(10.0, 120.0);
    return lens;
}

Coating hostile_coating(Dice& dice) {
    switch (dice.integer(0, 6)) {
        case 0:
            return QuarterWave{dice.magnitude(100.0, 1e5), glass(dice.magnitude(0.05, 8.0)), 0.0};
        case 1:
            return QuarterWave{dice.magnitude(100.0, 1e4), IdealIndex{}, dice.magnitude(1e-6, 1e3)};
        case 2:
            return ConstantReflectance{dice.between(0.0, 1.0), 0.0};
        case 3:
        case 4: {
            LayerStack stack;
            const int layers = dice.integer(0, 12);
            for (int k = 0; k < layers; ++k)
                stack.layers.push_back({glass(dice.magnitude(0.05, 6.0)),
                                        dice.chance(0.2) ? 0.0 : dice.magnitude(1e-3, 1e5),
                                        dice.chance(0.3) ? dice.magnitude(1e-6, 20.0) : 0.0});
            return stack;
        }
        default:
            return Uncoated{};
    }
}

Prescription hostile(Dice& dice) {
    Prescription lens;
    lens.name = "hostile";
    const int rows = dice.integer(1, 30);
    const double size_mm = dice.magnitude(1e-3, 1e3);
    double before = 1.0;
    for (int k = 0; k < rows; ++k) {
        Surface surface;
        surface.semi_diameter_mm = size_mm * dice.magnitude(1e-3, 10.0);
        const double sign = dice.chance(0.5) ? 1.0 : -1.0;
        switch (dice.integer(0, 5)) {
            case 0:
                break;  // a plane
            case 1:     // barely wide enough, or not
                surface.curve =
                    Radius{sign * surface.semi_diameter_mm * (1.0 + dice.magnitude(1e-12, 1e-2))};
                break;
            case 2:
                surface.curve = Radius{sign * surface.semi_diameter_mm * dice.between(0.3, 1.0)};
                break;
            case 3:
                surface.curve = Radius{sign * dice.magnitude(1e6, 1e12)};
                break;
            default:
                surface.curve = Radius{sign * surface.semi_diameter_mm * dice.magnitude(1.0, 1e3)};
        }
        const double n = dice.chance(0.2)   ? before
                         : dice.chance(0.3) ? 1.0
                                            : dice.between(1.0, 4.0);
        surface.medium_after = glass(n);
        before = n;
        surface.thickness_mm = dice.chance(0.15)   ? 0.0
                               : dice.chance(0.05) ? 1e6
                                                   : size_mm * dice.magnitude(1e-9, 10.0);
        if (dice.chance(0.2)) surface.conic = dice.between(-20.0, 20.0);
        if (dice.chance(0.15)) {
            const int terms = dice.integer(1, 8);
            for (int t = 0; t < terms; ++t)
                surface.aspheric.push_back(dice.between(-1.0, 1.0) *
                                           std::pow(surface.semi_diameter_mm, -3.0 - 2.0 * t) *
                                           dice.magnitude(1e-4, 10.0));
        }
        surface.coating = hostile_coating(dice);
        lens.surfaces.push_back(std::move(surface));
    }
    lens.stop.surface = static_cast<std::size_t>(
        dice.chance(0.3) ? (dice.chance(0.5) ? 0 : rows - 1) : dice.integer(0, rows - 1));
    if (dice.chance(0.3))
        lens.stop.semi_diameter_mm =
            lens.surfaces[lens.stop.surface].semi_diameter_mm * dice.magnitude(1e-5, 1.0);
    if (dice.chance(0.4)) {
        lens.stop.blades = dice.integer(3, 13);
        lens.stop.blade_curvature = dice.between(0.0, 1.0);
    }
    if (dice.chance(0.3)) lens.sensor.reflectance = UniformReflectance{dice.between(0.0, 1.0)};
    return lens;
}

}  // namespace

double Dice::between(double low, double high) {
    return low + static_cast<double>(engine_() >> 11) * 0x1.0p-53 * (high - low);
}

double Dice::magnitude(double low, double high) {
    return low * std::pow(high / low, between(0.0, 1.0));
}

int Dice::integer(int low, int high) {
    return low + static_cast<int>(between(0.0, 1.0) * (high - low + 1));
}

Prescription random_lens(LensKind kind, std::uint64_t number) {
    Dice dice(2 * number + (kind == LensKind::hostile ? 1 : 0) + 0x9e3779b97f4a7c15U);
    return kind == LensKind::plausible ? plausible(dice) : hostile(dice);
}

}  // namespace ghostlight
