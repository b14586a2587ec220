// Compiled once per instruction set; see core/CMakeLists.txt. Nothing here may call an inline
// function that is shared with the rest of the program.
#include "core/optics/trace_steps.h"

#include "core/ghosts/bundle_kernel.h"

#define GHOSTLIGHT_JOIN_(a, b) a##b
#define GHOSTLIGHT_JOIN(a, b) GHOSTLIGHT_JOIN_(a, b)

namespace ghostlight::GHOSTLIGHT_JOIN(kernels_, GHOSTLIGHT_ISA) {
    namespace {

    template <class T>
    using Lanes = stdx::native_simd<T>;

    template <class V, class T>
    V load(const T* from) {
        return V(from, stdx::element_aligned);
    }
    template <class V, class T>
    void store(const V& value, T* to) {
        value.copy_to(to, stdx::element_aligned);
    }

    enum { no_weights, average_weights, polarised_weights };

    /// One vector of rays on its way.
    template <class V>
    struct Packet {
        RayAt<V> ray;
        V margin, r2_rel, average;
        JonesState<V> jones;
    };

    template <int mode, class T>
    GHOSTLIGHT_INLINE Packet<Lanes<T>> begin(const BundleView<T>& b, std::size_t i) {
        using V = Lanes<T>;
        const V u = load<V>(b.u + i), v = load<V>(b.v + i);
        Packet<V> p{{Vec3<V>(V(u * b.e1[0] + v * b.e2[0]), V(u * b.e1[1] + v * b.e2[1]),
                             V(u * b.e1[2] + v * b.e2[2])),
                     Vec3<V>(V(b.direction[0]), V(b.direction[1]), V(b.direction[2]))},
                    V(T(1)),
                    V(T(0)),
                    V(T(1)),
                    {}};
        if constexpr (mode == polarised_weights)
            p.jones = jones_start<V>(Vec3<T>(b.e1[0], b.e1[1], b.e1[2]));
        return p;
    }

    /// The least margin so far, or where the ray first failed: what comes after means nothing.
    template <class V>
    GHOSTLIGHT_INLINE void narrow(V& margin, const V& next) {
        margin = select(margin < V(Lane<V>(0)), margin, smaller(margin, next));
    }

    /// What is the same for all packets of a step.
    struct Place {
        std::size_t step;
        int crossing, reflection;
    };

    template <int mode, bool records, class T>
    GHOSTLIGHT_INLINE void pass(const BundleView<T>& b, std::size_t i, const TraceStep<T>& step,
                                const Place& place, Packet<Lanes<T>>& p) {
        using V = Lanes<T>;
        const Vec3<V> start = p.ray.position;
        const Meeting<V> meeting = meet(step, b.aspheric, p.margin, p.ray);
        if (records && b.lengths != nullptr) {
            const Vec3<V>& end = p.ray.position;
            const Vec3<V> leg(V(end.x - start.x), V(end.y - start.y),
                              V(end.z - start.z - step.gap_mm));
            store(dot(leg, p.ray.direction), b.lengths + place.step * b.count + i);
        }
        narrow(p.margin, smaller(meeting.turned_margin,
                                 smaller(meeting.miss_margin, meeting.hemisphere_margin)));
        if (records && b.cosines != nullptr)
            store(meeting.cos_incidence, b.cosines + place.step * b.count + i);
        const Vec3<V>& at = p.ray.position;
        if (step.at_stop) {
            store(at.x, b.stop_u[place.crossing] + i);
            store(at.y, b.stop_v[place.crossing] + i);
        } else {
            p.r2_rel = larger(p.r2_rel, r2_rel(step, at));
        }
        const Vec3<V> before = p.ray.direction;
        const V cos2_squared = turn(step, meeting, p.ray);
        if (place.step % 2 == 1) keep_unit(p.ray.direction);
        if (!step.reflects)
            narrow(p.margin, cos2_squared);
        else if (place.reflection < max_recorded_reflections)
            store(cos2_squared, b.onset[place.reflection] + i);
        if constexpr (mode != no_weights) {
            if (step.invisible) return;
            V mean;
            if constexpr (mode == polarised_weights) {
                const Amplitudes<V> film = amplitudes(step, b.layers, meeting.cos_incidence);
                mean = T(0.5) * (step.reflects ? norm(film.r_s) + norm(film.r_p)
                                               : norm(film.t_s) + norm(film.t_p));
                apply(film, step.reflects, meeting, before, p.jones);
            } else {
                mean = mean_share(step, b.layers, meeting.cos_incidence);
            }
            if (step.reflects && place.reflection < max_recorded_reflections)
                store(mean, b.reflectance[place.reflection] + i);
            p.average = p.average * mean;
        }
    }

    template <int mode, class T>
    GHOSTLIGHT_INLINE void finish(const BundleView<T>& b, std::size_t i, Packet<Lanes<T>>& p) {
        using V = Lanes<T>;
        using std::sqrt;
        const V zero{T(0)};
        V margin = p.margin;
        narrow(margin, p.ray.direction.z);
        const V t = -(p.ray.position.z + b.sensor_gap_mm) / p.ray.direction.z;
        if (b.lengths != nullptr) store(t, b.lengths + b.step_count * b.count + i);
        V x = p.ray.position.x + t * p.ray.direction.x;
        V y = p.ray.position.y + t * p.ray.direction.y;
        V weight = p.average;
        if constexpr (mode == polarised_weights)
            weight = T(0.5) * (p.jones.intensity(0) + p.jones.intensity(1));
        if constexpr (mode == no_weights) weight = zero;
        // What went wild far outside the bundle must not reach any sum.
        const V check = x + y + weight + p.average + p.r2_rel;
        const auto lost = !(check - check == zero);
        store(select(lost, zero, x), b.x + i);
        store(select(lost, zero, y), b.y + i);
        store(select(lost, zero, weight), b.weight + i);
        store(select(lost, zero, p.average), b.weight_average + i);
        store(select(lost, smaller(margin, V(T(-1e-3))), margin), b.margin + i);
        store(V(sqrt(select(lost, V(T(4)), p.r2_rel))), b.r_rel + i);
    }

    /// Most steps are spheres or planes at which light bends or is reflected. With that said by
    /// constants the compiler leaves out all tests that `pass` makes of its step, packet by packet.
    template <class T>
    bool is_plain(const TraceStep<T>& step) {
        return step.spherical && !step.at_stop && !step.rectangular && !step.invisible &&
               step.n_in != step.n_out;
    }
    template <bool reflects, class T>
    GHOSTLIGHT_INLINE TraceStep<T> plain(const TraceStep<T>& step) {
        TraceStep<T> known = step;
        known.spherical = true;
        known.aspheric_count = 0;
        known.at_stop = known.rectangular = known.invisible = false;
        known.reflects = reflects;
        return known;
    }

    /// Any step; kept apart, or it would be compiled once for every place in every loop.
    template <int mode, class T>
    [[gnu::noinline]] void pass_any(const BundleView<T>& b, std::size_t i, const TraceStep<T>& step,
                                    const Place& place, Packet<Lanes<T>>& p) {
        pass<mode, true>(b, i, step, place, p);
    }

    /// Several packets side by side: each is one long chain of dependent operations, and the others
    /// fill its gaps.
    template <int mode, bool records, int packets, class T>
    void trace_at(const BundleView<T>& b, std::size_t i) {
        constexpr std::size_t lanes = Lanes<T>::size();
        Packet<Lanes<T>> p[packets];
        for (std::size_t k = 0; k < packets; ++k) p[k] = begin<mode>(b, i + k * lanes);
        Place place{0, 0, 0};
        for (; place.step < b.step_count; ++place.step) {
            const TraceStep<T>& step = b.steps[place.step];
            if (!is_plain(step)) {
                for (std::size_t k = 0; k < packets; ++k)
                    pass_any<mode>(b, i + k * lanes, step, place, p[k]);
            } else if (step.reflects) {
                const TraceStep<T> known = plain<true>(step);
                for (std::size_t k = 0; k < packets; ++k)
                    pass<mode, records>(b, i + k * lanes, known, place, p[k]);
            } else {
                const TraceStep<T> known = plain<false>(step);
                for (std::size_t k = 0; k < packets; ++k)
                    pass<mode, records>(b, i + k * lanes, known, place, p[k]);
            }
            place.crossing += step.at_stop ? 1 : 0;
            place.reflection += step.reflects ? 1 : 0;
        }
        for (std::size_t k = 0; k < packets; ++k) finish<mode>(b, i + k * lanes, p[k]);
    }

    template <int mode, bool records, class T>
    void trace_records(const BundleView<T>& b) {
        constexpr std::size_t lanes = Lanes<T>::size();
        constexpr std::size_t side_by_side = mode == no_weights ? 4 : 2;
        // Bundles are padded to so many packets.
        constexpr std::size_t least = bundle_padding / lanes;
        std::size_t i = 0;
        for (; i + side_by_side * lanes <= b.count; i += side_by_side * lanes)
            trace_at<mode, records, side_by_side>(b, i);
        if constexpr (least < side_by_side)
            for (; i < b.count; i += least * lanes) trace_at<mode, records, least>(b, i);
    }

    template <int mode, class T>
    void trace_all(const BundleView<T>& b) {
        if (mode != no_weights || b.cosines != nullptr || b.lengths != nullptr)
            return trace_records<mode, true>(b);
        if constexpr (mode == no_weights) trace_records<mode, false>(b);
    }

    template <class T>
    void trace_mode(const BundleView<T>& b) {
        switch (b.weights) {
            case no_weights:
                return trace_all<no_weights>(b);
            case average_weights:
                return trace_all<average_weights>(b);
            default:
                return trace_all<polarised_weights>(b);
        }
    }

    }  // namespace

    void trace_bundle_lanes(const BundleView<float>& bundle) { trace_mode(bundle); }
    void trace_bundle_lanes(const BundleView<double>& bundle) { trace_mode(bundle); }

}  // namespace ghostlight::GHOSTLIGHT_JOIN(kernels_,GHOSTLIGHT_ISA)
