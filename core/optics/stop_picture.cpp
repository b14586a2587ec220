#include "core/optics/stop_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ghostlight {
namespace {

constexpr float half_open = 0.5F;

std::size_t idx(int i) { return static_cast<std::size_t>(i); }

/// Squared distances along a line to the nearest source, each source with a height of its own
/// (Felzenszwalb and Huttenlocher 2012): the lower envelope of parabolas.
void nearest_on_line(std::vector<double>& height) {
    const int n = static_cast<int>(height.size());
    constexpr double none = std::numeric_limits<double>::infinity();
    std::vector<int> at(idx(n), 0);
    std::vector<double> from(idx(n) + 1, none), result(idx(n), none);
    int last = -1;
    for (int q = 0; q < n; ++q) {
        if (height[idx(q)] == none) continue;
        double start = -none;
        while (last >= 0) {
            const int p = at[idx(last)];
            start = ((height[idx(q)] + q * q) - (height[idx(p)] + p * p)) / (2.0 * (q - p));
            if (start > from[idx(last)]) break;
            --last;
            start = -none;
        }
        ++last;
        at[idx(last)] = q;
        from[idx(last)] = start;
        from[idx(last) + 1] = none;
    }
    int piece = 0;
    for (int q = 0; q < n && last >= 0; ++q) {
        while (from[idx(piece) + 1] < q) ++piece;
        const double d = q - at[idx(piece)];
        result[idx(q)] = d * d + height[idx(at[idx(piece)])];
    }
    height = std::move(result);
}

/// Distance of every pixel's middle to the nearest pixel that `is_source`, in pixels.
std::vector<float> distance_to(int across, const std::vector<char>& is_source) {
    std::vector<double> squared(is_source.size());
    for (std::size_t k = 0; k < squared.size(); ++k)
        squared[k] = is_source[k] ? 0.0 : std::numeric_limits<double>::infinity();
    std::vector<double> line(idx(across));
    for (int i = 0; i < across; ++i) {
        for (int j = 0; j < across; ++j) line[idx(j)] = squared[idx(j * across + i)];
        nearest_on_line(line);
        for (int j = 0; j < across; ++j) squared[idx(j * across + i)] = line[idx(j)];
    }
    std::vector<float> distance(squared.size());
    for (int j = 0; j < across; ++j) {
        std::copy_n(squared.begin() + j * across, across, line.begin());
        nearest_on_line(line);
        for (int i = 0; i < across; ++i)
            distance[idx(j * across + i)] = static_cast<float>(std::sqrt(line[idx(i)]));
    }
    return distance;
}

}  // namespace

StopPicture::StopPicture(int width_px, int height_px, const std::vector<float>& open) {
    const int longer = std::max(width_px, height_px);
    across_px_ = std::min(longer, most_across_px);
    open_.assign(idx(across_px_ * across_px_), 0.0F);
    // Each pixel gets its share of what lies over it; the shorter side is centred.
    const double step = static_cast<double>(longer) / across_px_;
    const double left = 0.5 * (width_px - longer), top = 0.5 * (height_px - longer);
    struct Span {
        int first, last;
        double from, to;
        double share(int i) const { return std::min(to, i + 1.0) - std::max(from, i + 0.0); }
    };
    auto span = [step](int pixel, double offset, int count) {
        const double from = std::max(0.0, offset + pixel * step);
        const double to = std::min<double>(count, offset + (pixel + 1) * step);
        return Span{static_cast<int>(std::floor(from)),
                    std::min(count - 1, static_cast<int>(std::ceil(to)) - 1), from, to};
    };
    for (int j = 0; j < across_px_; ++j) {
        const Span rows = span(j, top, height_px);
        float* out = &open_[idx((across_px_ - 1 - j) * across_px_)];
        for (int i = 0; i < across_px_; ++i) {
            const Span columns = span(i, left, width_px);
            double sum = 0.0;
            for (int y = rows.first; y <= rows.last && rows.to > rows.from; ++y)
                for (int x = columns.first; x <= columns.last && columns.to > columns.from; ++x)
                    sum += rows.share(y) * columns.share(x) *
                           static_cast<double>(open[idx(y) * idx(width_px) + idx(x)]);
            out[i] = static_cast<float>(std::clamp(sum / (step * step), 0.0, 1.0));
        }
    }
    measure_distances();
}

void StopPicture::measure_distances() {
    std::vector<char> is_open(open_.size()), is_shut(open_.size());
    for (std::size_t k = 0; k < open_.size(); ++k) {
        is_open[k] = open_[k] >= half_open ? 1 : 0;
        is_shut[k] = 1 - is_open[k];
    }
    const std::vector<float> to_open = distance_to(across_px_, is_open);
    const std::vector<float> to_shut = distance_to(across_px_, is_shut);
    distance_.resize(open_.size());
    const float pixel = 2.0F / static_cast<float>(across_px_);
    auto share = [&](int i, int j) {
        i = std::clamp(i, 0, across_px_ - 1);
        j = std::clamp(j, 0, across_px_ - 1);
        return open_[idx(j * across_px_ + i)];
    };
    for (int j = 0; j < across_px_; ++j)
        for (int i = 0; i < across_px_; ++i) {
            const std::size_t k = idx(j * across_px_ + i);
            const float frame = std::min({static_cast<float>(i), static_cast<float>(j),
                                          static_cast<float>(across_px_ - 1 - i),
                                          static_cast<float>(across_px_ - 1 - j)}) +
                                0.5F;
            // The edge runs half a pixel before the nearest pixel of the other kind.
            float signed_px = is_open[k] ? to_shut[k] - 0.5F : 0.5F - to_open[k];
            const float dx = 0.5F * (share(i + 1, j) - share(i - 1, j));
            const float dy = 0.5F * (share(i, j + 1) - share(i, j - 1));
            const float slope = std::hypot(dx, dy);
            // Beside a soft edge its own slope says more, to a fraction of a pixel.
            if (std::abs(signed_px) < 1.0F && slope > 0.1F)
                signed_px = std::clamp((open_[k] - half_open) / slope, -1.0F, 1.0F);
            if (is_open[k]) signed_px = std::min(signed_px, frame);
            distance_[k] = pixel * std::max(signed_px, -static_cast<float>(across_px_));
        }
}

double StopPicture::bilinear(const std::vector<float>& of, double x, double y) const {
    const double most = across_px_ - 1.0;
    const double column = std::clamp(0.5 * (x + 1.0) * across_px_ - 0.5, 0.0, most);
    const double row = std::clamp(0.5 * (y + 1.0) * across_px_ - 0.5, 0.0, most);
    const int i = std::min(static_cast<int>(column), std::max(across_px_ - 2, 0));
    const int j = std::min(static_cast<int>(row), std::max(across_px_ - 2, 0));
    const double fx = column - i, fy = row - j;
    auto at = [&](int a, int b) {
        return static_cast<double>(
            of[idx(std::min(b, across_px_ - 1) * across_px_ + std::min(a, across_px_ - 1))]);
    };
    return std::lerp(std::lerp(at(i, j), at(i + 1, j), fx),
                     std::lerp(at(i, j + 1), at(i + 1, j + 1), fx), fy);
}

double StopPicture::open_at(double x, double y) const {
    if (!(std::abs(x) <= 1.0 && std::abs(y) <= 1.0)) return 0.0;
    return bilinear(open_, x, y);
}

double StopPicture::distance_at(double x, double y) const {
    // A ray that failed before has no place in the stop.
    if (!std::isfinite(x) || !std::isfinite(y)) return -1.0;
    const double beyond =
        std::hypot(std::max(0.0, std::abs(x) - 1.0), std::max(0.0, std::abs(y) - 1.0));
    const double inside = bilinear(distance_, x, y);
    return beyond > 0.0 ? std::min(inside, 0.0) - beyond : inside;
}

double StopPicture::mean_over_circle() const {
    double sum = 0.0;
    int count = 0;
    for (int j = 0; j < across_px_; ++j)
        for (int i = 0; i < across_px_; ++i) {
            const double x = (2.0 * i + 1.0) / across_px_ - 1.0;
            const double y = (2.0 * j + 1.0) / across_px_ - 1.0;
            if (x * x + y * y > 1.0) continue;
            sum += static_cast<double>(open_[idx(j * across_px_ + i)]);
            ++count;
        }
    return count > 0 ? sum / count : static_cast<double>(open_.front());
}

}  // namespace ghostlight
