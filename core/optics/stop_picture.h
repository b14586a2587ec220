#pragma once

#include <vector>

namespace ghostlight {

/// An image that says where a stop is open. Coordinates are in semi-diameters of the stop: its
/// longer side spans the diameter, from −1 to 1, +x to the right and +y up in the image; what is
/// beside it is shut.
class StopPicture {
   public:
    /// Finer images are averaged down to this.
    static constexpr int most_across_px = 1024;

    /// `open`: shares from 0 to 1, row by row from the image's top.
    StopPicture(int width_px, int height_px, const std::vector<float>& open);

    int across_px() const { return across_px_; }
    /// across² shares from 0 to 1, row 0 the lowest y.
    const std::vector<float>& open() const { return open_; }
    /// Share at a point, bilinear between the pixels' middles.
    double open_at(double x, double y) const;
    /// Distance to the nearest place where the share crosses one half, positive where it is open,
    /// bilinear. Where nothing or everything is open, to the image's frame.
    double distance_at(double x, double y) const;
    /// Mean share over the circle of the stop.
    double mean_over_circle() const;

    bool operator==(const StopPicture& other) const { return open_ == other.open_; }

   private:
    int across_px_ = 0;
    std::vector<float> open_, distance_;

    double bilinear(const std::vector<float>& of, double x, double y) const;
    void measure_distances();
};

}  // namespace ghostlight
