#include "core/ghosts/incoherent_stack.h"

namespace ghostlight {
namespace {

struct Interface {
    double forward_r, backward_r, t;
};

std::vector<Interface> interfaces(const OpticalSystem& system) {
    std::vector<Interface> all;
    for (std::size_t row = 0; row < turning_count(system); ++row) {
        const SurfaceAt& surface = surface_at(system, row);
        if (surface.uniform_reflectance) {
            const double r = *surface.uniform_reflectance;
            all.push_back({r, r, 1.0 - r});
            continue;
        }
        const Reflectances there = reflectances(surface.film, 1.0);
        const Reflectances back = reflectances(reversed(surface.film), 1.0);
        all.push_back({there.r(), back.r(), there.t()});
    }
    return all;
}

}  // namespace

std::vector<double> shares_by_reflections(const OpticalSystem& system, int most) {
    const std::vector<Interface> at = interfaces(system);
    const std::size_t rows = system.surfaces.size();
    // Light that arrives at each row, and at the sensor behind them, towards it and from it.
    std::vector<double> forward(rows + 1, 0.0), backward(rows + 1, 0.0);
    forward[0] = 1.0;
    for (std::size_t k = 0; k < rows; ++k) forward[k + 1] = forward[k] * at[k].t;
    std::vector<double> shares = {forward[rows]};
    for (int reflections = 1; reflections <= most; ++reflections) {
        std::vector<double> next_forward(rows + 1, 0.0), next_backward(rows + 1, 0.0);
        for (std::size_t k = rows; k-- > 0;) {
            const std::size_t behind = k + 1;
            const double turned = behind < at.size() ? forward[behind] * at[behind].forward_r : 0.0;
            const double passed = behind < rows ? next_backward[behind] * at[behind].t : 0.0;
            next_backward[k] = turned + passed;
        }
        for (std::size_t k = 0; k < rows; ++k)
            next_forward[k + 1] = backward[k] * at[k].backward_r + next_forward[k] * at[k].t;
        forward = std::move(next_forward);
        backward = std::move(next_backward);
        shares.push_back(forward[rows]);
    }
    return shares;
}

double higher_order_share(const OpticalSystem& system) {
    constexpr int most = 400;  // the rest is below rounding, mirrors apart
    const std::vector<double> shares = shares_by_reflections(system, most);
    double higher = 0.0;
    for (std::size_t k = 4; k < shares.size(); ++k) higher += shares[k];
    return shares[2] > 0.0 ? higher / shares[2] : 0.0;
}

}  // namespace ghostlight
