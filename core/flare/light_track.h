#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace ghostlight {

/// A bright spot of a frame. Pixels count from the frame's left and top, 0.5 being the middle of
/// the first.
struct LightBlob {
    double x_px = 0.0, y_px = 0.0;  ///< centroid of its excess
    std::array<double, 3>
        excess{};            ///< Σ over its pixels of what is above the threshold, by channel
    std::size_t pixels = 0;  ///< that it has
    double luminance() const {
        return 0.2126 * excess[0] + 0.7152 * excess[1] + 0.0722 * excess[2];
    }
};

/// Spots brighter than a threshold: pixels that touch, by sides or corners, are one. A pixel counts
/// by its excess over the threshold, its colour kept, so that what passes the threshold enters from
/// zero and a light that something passes in front of fades as its pixels go. Strongest first.
/// `rgb` has 3 values a pixel, row 0 at the top.
std::vector<LightBlob> find_blobs(const std::vector<float>& rgb, int width, int height,
                                  double threshold);

/// One light through a sequence: its blob in each frame, dark where it is not seen.
struct LightTrack {
    std::vector<LightBlob> frames;
    double brightest() const;
};

struct TrackRequest {
    std::size_t most = 4;       ///< lights kept, the brightest
    double farthest_px = 40.0;  ///< that a light moves from frame to frame where it is seen
    /// Tracks whose brightest frame is below this share of the brightest of all are no lights.
    double least_share = 0.01;
};

/// Follows blobs from frame to frame, each to the nearest where its own motion takes it. While a
/// light is not seen its place is carried on along its motion, with a reach that grows; whatever
/// comes back there is the same light. Strongest first.
std::vector<LightTrack> track_lights(const std::vector<std::vector<LightBlob>>& frames,
                                     const TrackRequest& request);

}  // namespace ghostlight
