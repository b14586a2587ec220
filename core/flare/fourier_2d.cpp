#include "core/flare/fourier_2d.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "core/parallel.h"

namespace ghostlight {
namespace {

constexpr int lines_together = 16;  ///< a cache line of columns, and one set of twiddles

/// Padded fields are dark in most of their lines.
bool is_empty(const std::complex<float>* line, std::size_t count) {
    return std::all_of(line, line + count,
                       [](const std::complex<float>& value) { return value == 0.0F; });
}

}  // namespace

bool transform_2d(std::vector<std::complex<float>>& field, int across, bool inverse,
                  unsigned threads, const std::stop_token& stop) {
    using Complex = std::complex<float>;
    const auto n = static_cast<std::size_t>(across);
    assert(field.size() == n * n && (n & (n - 1)) == 0);
    const std::size_t blocks = (n + lines_together - 1) / lines_together;
    auto pass = [&](std::size_t step, std::size_t line_step) {
        return parallel_for(blocks, threads, stop, [&](std::size_t block) {
            Eigen::FFT<float> fft;
            fft.SetFlag(Eigen::FFT<float>::Unscaled);
            const std::size_t first = block * lines_together;
            const std::size_t count = std::min<std::size_t>(lines_together, n - first);
            std::vector<Complex> lines(count * n), out(n);
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t l = 0; l < count; ++l)
                    lines[l * n + k] = field[(first + l) * line_step + k * step];
            for (std::size_t l = 0; l < count; ++l) {
                Complex* line = lines.data() + l * n;
                if (is_empty(line, n)) continue;
                if (inverse)
                    fft.inv(out.data(), line, static_cast<Eigen::Index>(n));
                else
                    fft.fwd(out.data(), line, static_cast<Eigen::Index>(n));
                std::copy(out.begin(), out.end(), line);
            }
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t l = 0; l < count; ++l)
                    field[(first + l) * line_step + k * step] = lines[l * n + k];
        });
    };
    return pass(1, n) && pass(n, 1);
}

}  // namespace ghostlight
