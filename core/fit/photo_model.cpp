#include "core/fit/photo_model.h"

#include <Eigen/Dense>

#include <algorithm>

#include "core/parallel.h"

namespace ghostlight {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr int band_rows = 8;

}  // namespace

ModelPicture ghost_picture(const std::vector<GhostBasis>& bases, const GhostWeights& weights,
                           const PixelFrame& frame, std::size_t coatings, bool slopes,
                           unsigned threads, std::stop_token stop) {
    ModelPicture picture;
    picture.columns = slopes ? 1 + coatings : 1;
    const std::size_t width = 3 * picture.columns;
    // Coefficients of every ghost: rows are nodes and terms, columns channel by channel.
    std::vector<Matrix> right(bases.size());
    parallel_for(bases.size(), threads, stop, [&](std::size_t g) {
        std::vector<double> values, by;
        weights.coefficients(bases[g], values, slopes ? &by : nullptr);
        const std::size_t rows = bases[g].width();
        Matrix& m = right[g];
        m.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(width));
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < 3; ++c) {
                const auto row = static_cast<Eigen::Index>(r);
                const auto first = static_cast<Eigen::Index>(c * picture.columns);
                m(row, first) = static_cast<float>(values[3 * r + c]);
                for (std::size_t p = 0; p + 1 < picture.columns; ++p)
                    m(row, first + 1 + static_cast<Eigen::Index>(p)) =
                        static_cast<float>(by[(3 * r + c) * coatings + p]);
            }
    });
    if (stop.stop_requested()) return picture;
    picture.values.assign(static_cast<std::size_t>(frame.width_px) *
                              static_cast<std::size_t>(frame.height_px) * width,
                          0.0);
    const int bands = (frame.height_px + band_rows - 1) / band_rows;
    parallel_for(static_cast<std::size_t>(bands), threads, stop, [&](std::size_t band) {
        const int first = static_cast<int>(band) * band_rows;
        const int last = std::min(frame.height_px, first + band_rows);
        Matrix product;
        for (std::size_t g = 0; g < bases.size(); ++g) {
            const GhostBasis& basis = bases[g];
            const int from = std::max(first, basis.first_row),
                      to = std::min(last, basis.first_row + basis.rows);
            if (from >= to) continue;
            const Eigen::Map<const Matrix> left(basis.at(basis.first_column, from),
                                                (to - from) * basis.columns,
                                                static_cast<Eigen::Index>(basis.width()));
            product.noalias() = left * right[g];
            for (int row = from; row < to; ++row)
                for (int i = 0; i < basis.columns; ++i) {
                    const float* add =
                        product.data() +
                        static_cast<std::size_t>((row - from) * basis.columns + i) * width;
                    double* sum =
                        &picture.values[width * static_cast<std::size_t>(row * frame.width_px +
                                                                         basis.first_column + i)];
                    for (std::size_t c = 0; c < width; ++c) sum[c] += static_cast<double>(add[c]);
                }
        }
    });
    return picture;
}

ModelPicture one_ghost(const GhostBasis& basis, const GhostWeights& weights,
                       const PixelFrame& frame) {
    ModelPicture picture;
    picture.values.assign(
        3 * static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px),
        0.0);
    std::vector<double> coefficients;
    weights.coefficients(basis, coefficients, nullptr);
    for (int row = 0; row < basis.rows; ++row)
        for (int i = 0; i < basis.columns; ++i) {
            const float* b = basis.at(basis.first_column + i, basis.first_row + row);
            double* to =
                picture.at(static_cast<std::size_t>((basis.first_row + row) * frame.width_px +
                                                    basis.first_column + i),
                           0);
            for (std::size_t r = 0; r < basis.width(); ++r)
                for (std::size_t c = 0; c < 3; ++c)
                    to[c] += static_cast<double>(b[r]) * coefficients[3 * r + c];
        }
    return picture;
}

std::array<double, 6> background_functions(const PixelFrame& frame, std::size_t sample) {
    const auto width = static_cast<std::size_t>(frame.width_px);
    const double x = (2.0 * static_cast<double>(sample % width) + 1.0) / frame.width_px - 1.0;
    const double y = (2.0 * static_cast<double>(sample / width) + 1.0) / frame.height_px - 1.0;
    return {1.0, x, y, x * x, x * y, y * y};
}

double corner_distance2(const PixelFrame& frame, std::size_t sample) {
    const auto width = static_cast<std::size_t>(frame.width_px);
    const double x = static_cast<double>(sample % width) + 0.5 - 0.5 * frame.width_px;
    const double y = static_cast<double>(sample / width) + 0.5 - 0.5 * frame.height_px;
    return (x * x + y * y) /
           (0.25 * (frame.width_px * frame.width_px + frame.height_px * frame.height_px));
}

}  // namespace ghostlight
