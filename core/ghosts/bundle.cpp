#include "core/ghosts/bundle.h"

#include <algorithm>

#include "core/ghosts/bundle_kernel.h"
#include "core/instruction_set.h"

namespace ghostlight {
namespace {

static_assert(max_recorded_reflections == max_reflections);

template <class T>
void run(const BundleView<T>& view) {
    GHOSTLIGHT_DISPATCH(trace_bundle_lanes, view);
}

/// What the media on the way leave of the light. Beyond a failure lengths mean nothing, and neither
/// do weights.
template <class T>
void absorb(const TracePath<T>& path, const std::vector<T>& lengths_mm, std::size_t stride,
            Bundle<T>& bundle) {
    std::vector<T> depth(stride, T(0));
    auto add = [&](T per_mm, std::size_t step) {
        if (!(per_mm > T(0))) return;
        for (std::size_t i = 0; i < stride; ++i) depth[i] += per_mm * lengths_mm[step * stride + i];
    };
    for (std::size_t k = 0; k < path.steps.size(); ++k) add(path.steps[k].absorption_per_mm, k);
    add(path.sensor_absorption_per_mm, path.steps.size());
    for (std::size_t i = 0; i < bundle.weight.size(); ++i) {
        const T share = passed_share(depth[i]);
        bundle.weight[i] *= share;
        bundle.weight_average[i] *= share;
    }
}

}  // namespace

template <class T>
void trace_bundle(const TracePath<T>& path, const BeamFrame& frame, Weights weights,
                  Bundle<T>& bundle) {
    const std::size_t count = bundle.u_mm.size();
    const std::size_t padded = (count + bundle_padding - 1) / bundle_padding * bundle_padding;
    // Spare lanes repeat the last ray, so that they cannot raise anything new.
    auto pad = [&](std::vector<T>& values) {
        values.resize(padded, values.empty() ? T(0) : values.back());
    };
    pad(bundle.u_mm);
    pad(bundle.v_mm);
    bundle.stop_crossings = path.stop_crossings;
    for (auto* channel : {&bundle.x_mm, &bundle.y_mm, &bundle.weight, &bundle.weight_average,
                          &bundle.margin, &bundle.r_rel})
        channel->resize(padded);
    bundle.reflections = static_cast<int>(
        std::ranges::count_if(path.steps, [](const TraceStep<T>& step) { return step.reflects; }));
    bundle.reflections = std::min(bundle.reflections, max_reflections);
    T* stop_u[max_stop_crossings] = {};
    T* stop_v[max_stop_crossings] = {};
    for (int k = 0; k < path.stop_crossings; ++k) {
        bundle.stop_u_mm[k].resize(padded);
        bundle.stop_v_mm[k].resize(padded);
        stop_u[k] = bundle.stop_u_mm[k].data();
        stop_v[k] = bundle.stop_v_mm[k].data();
    }
    BundleView<T> view{};
    view.steps = path.steps.data();
    view.step_count = path.steps.size();
    view.aspheric = path.aspheric.data();
    view.layers = path.layers.data();
    view.sensor_gap_mm = path.sensor_gap_mm;
    for (int k = 0; k < 3; ++k) {
        view.direction[k] = static_cast<T>(frame.direction[k]);
        view.e1[k] = static_cast<T>(frame.e1[k]);
        view.e2[k] = static_cast<T>(frame.e2[k]);
    }
    view.count = padded;
    view.u = bundle.u_mm.data();
    view.v = bundle.v_mm.data();
    view.x = bundle.x_mm.data();
    view.y = bundle.y_mm.data();
    view.weight = bundle.weight.data();
    view.weight_average = bundle.weight_average.data();
    view.margin = bundle.margin.data();
    view.r_rel = bundle.r_rel.data();
    view.stop_u = stop_u;
    view.stop_v = stop_v;
    for (std::size_t k = 0; k < static_cast<std::size_t>(bundle.reflections); ++k) {
        bundle.reflectance[k].resize(padded);
        bundle.onset[k].resize(padded);
        view.reflectance[k] = bundle.reflectance[k].data();
        view.onset[k] = bundle.onset[k].data();
    }
    if (bundle.keep_cosines) {
        bundle.cosine_stride = padded;
        bundle.cosines.resize(path.steps.size() * padded);
        view.cosines = bundle.cosines.data();
    }
    std::vector<T> lengths_mm;
    if (path.absorbs && (weights != Weights::none || bundle.keep_cosines)) {
        lengths_mm.resize((path.steps.size() + 1) * padded);
        view.lengths = lengths_mm.data();
    }
    view.weights = static_cast<int>(weights);
    run(view);
    if (view.lengths != nullptr && weights != Weights::none)
        absorb(path, lengths_mm, padded, bundle);
    if (bundle.keep_cosines) bundle.lengths_mm = std::move(lengths_mm);
    for (auto* channel : {&bundle.u_mm, &bundle.v_mm, &bundle.x_mm, &bundle.y_mm, &bundle.weight,
                          &bundle.margin, &bundle.r_rel})
        channel->resize(count);
    for (std::size_t k = 0; k < static_cast<std::size_t>(bundle.reflections); ++k) {
        bundle.reflectance[k].resize(count);
        bundle.onset[k].resize(count);
    }
}

template void trace_bundle(const TracePath<float>&, const BeamFrame&, Weights, Bundle<float>&);
template void trace_bundle(const TracePath<double>&, const BeamFrame&, Weights, Bundle<double>&);

}  // namespace ghostlight
