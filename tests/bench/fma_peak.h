#pragma once

namespace ghostlight::bench {

/// Runs a fixed number of independent multiply-adds in vectors as wide as the traces', and returns
/// how many operations that is, a multiply-add being two.
template <class T>
double fma_operations();
extern template double fma_operations<float>();
extern template double fma_operations<double>();

}  // namespace ghostlight::bench
