#include "core/ghosts/bundle.h"

#include "core/ghosts/bundle_kernel.h"
#include "core/instruction_set.h"

namespace ghostlight {
namespace {

template <class T>
void run(const BundleView<T>& view) {
    GHOSTLIGHT_DISPATCH(trace_bundle_lanes, view);
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
                          &bundle.margin, &bundle.r_rel, &bundle.reflectance[0],
                          &bundle.reflectance[1], &bundle.onset[0], &bundle.onset[1]})
        channel->resize(padded);
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
    view.reflectance[0] = bundle.reflectance[0].data();
    view.reflectance[1] = bundle.reflectance[1].data();
    view.onset[0] = bundle.onset[0].data();
    view.onset[1] = bundle.onset[1].data();
    if (bundle.keep_cosines) {
        bundle.cosine_stride = padded;
        bundle.cosines.resize(path.steps.size() * padded);
        view.cosines = bundle.cosines.data();
    }
    view.weights = static_cast<int>(weights);
    run(view);
    for (auto* channel : {&bundle.u_mm, &bundle.v_mm, &bundle.x_mm, &bundle.y_mm, &bundle.weight,
                          &bundle.margin, &bundle.r_rel, &bundle.reflectance[0],
                          &bundle.reflectance[1], &bundle.onset[0], &bundle.onset[1]})
        channel->resize(count);
}

template void trace_bundle(const TracePath<float>&, const BeamFrame&, Weights, Bundle<float>&);
template void trace_bundle(const TracePath<double>&, const BeamFrame&, Weights, Bundle<double>&);

}  // namespace ghostlight
