#include "core/flare/propagated_masks.h"

#include <algorithm>

#include "core/flare/flare_scene.h"

namespace ghostlight {
namespace {

constexpr std::size_t most_groups = 5;

}  // namespace

std::vector<ColorGroup> color_groups(const std::vector<SpectralSample>& samples) {
    const std::size_t count = std::min(samples.size(), most_groups);
    std::vector<ColorGroup> groups;
    for (std::size_t p = 0; p < count; ++p) {
        ColorGroup group{p * samples.size() / count, (p + 1) * samples.size() / count, 0.0};
        for (std::size_t w = group.first; w < group.last; ++w)
            group.middle_nm +=
                samples[w].wavelength_nm / static_cast<double>(group.last - group.first);
        groups.push_back(group);
    }
    return groups;
}

PropagatedMasks::Fields PropagatedMasks::of(const FlareScene& scene, double fresnel_number,
                                            const std::stop_token& stop) {
    {
        const std::scoped_lock lock(mutex_);
        const auto found =
            std::ranges::find(kept_, fresnel_number, &std::pair<double, Fields>::first);
        if (found != kept_.end()) return found->second;
    }
    const MaskRaster raster =
        mask_raster(scene.system().stop_mask, scene.dirt, propagation_raster(fresnel_number));
    const auto spectrum = mask_spectrum(raster, fresnel_number, 1, stop);
    if (!spectrum) return nullptr;
    auto fields = std::make_shared<std::vector<PropagatedMask>>();
    for (const ColorGroup& group : color_groups(scene.samples)) {
        const double number = fresnel_number * scene.system().wavelength_nm / group.middle_nm;
        auto field = propagated(*spectrum, std::max(least_propagated, number), 1, stop);
        if (!field) return nullptr;
        fields->push_back(std::move(*field));
    }
    const std::scoped_lock lock(mutex_);
    if (kept_.size() >= most_kept) kept_.erase(kept_.begin());
    kept_.emplace_back(fresnel_number, fields);
    return fields;
}

}  // namespace ghostlight
