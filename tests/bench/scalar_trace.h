#pragma once

#include "core/ghosts/bundle.h"

namespace ghostlight::bench {

// What the SIMD traces are compared with: the same templates, one ray after another in double,
// into the same arrays. `bundle` must have been traced once, so that nothing is allocated here.

/// For the processor that the whole program is compiled for.
namespace scalar_portable {
void trace_rays(const TracePath<double>& path, const BeamFrame& frame, Weights weights,
                Bundle<double>& bundle);
}
#ifdef GHOSTLIGHT_HAVE_X86_ISA
/// With the scalar instructions of AVX2 processors, fused multiply-adds among them.
namespace scalar_v3 {
void trace_rays(const TracePath<double>& path, const BeamFrame& frame, Weights weights,
                Bundle<double>& bundle);
}
#endif

}  // namespace ghostlight::bench
