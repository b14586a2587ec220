#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/color_mesh.h"
#include "core/flare/flare_image.h"

namespace ghostlight {

/// A ghost to be drawn, and at which level of the picture (picture_levels.h).
template <int C>
struct DrawnGhost {
    ColorMesh<C> mesh;
    int level = 0;
};

/// A black picture of a lens's sensor.
FlareImage empty_image(const OpticalSystem& system, const PixelFrame& frame);

/// The levels of a picture while it is drawn, a batch of ghosts after the other, so that not all
/// meshes have to be held at once. Rows in bands, each by one thread and in the ghosts' order: the
/// picture does not depend on the number of threads.
template <int C>
class LevelPictures {
   public:
    explicit LevelPictures(const PixelFrame& frame);
    /// False when stopped. Adds to the time of the raster.
    bool add(const std::vector<DrawnGhost<C>>& ghosts, unsigned threads,
             const std::stop_token& stop, FlareTimes& times);
    /// A level to add to, C values a pixel of level_size().
    std::vector<float>& level(int level);
    /// Brings the levels together, C values a pixel; the levels are used up. Nothing when stopped.
    std::optional<std::vector<float>> take(unsigned threads, const std::stop_token& stop,
                                           FlareTimes& times);
    /// The same, into rgb, irradiance and flux on the sensor. False when stopped.
    bool finish(unsigned threads, const std::stop_token& stop, FlareImage& image);

   private:
    PixelFrame frame_;
    int coarsest_ = 0;
    std::vector<std::vector<float>> levels_;

    /// Adds the next coarser level, complete, to a band of rows.
    void bring_up(int level, std::size_t band);
    /// All levels from the coarsest down to `last`. False when stopped.
    bool bring_up_to(int last, unsigned threads, const std::stop_token& stop);
};

/// Draws ghosts into rgb, irradiance, flux on the sensor and the times of raster and composite.
/// False when stopped.
template <int C>
bool draw_picture(const std::vector<DrawnGhost<C>>& ghosts, const PixelFrame& frame,
                  unsigned threads, const std::stop_token& stop, FlareImage& image);

/// A picture of the highlighted ghosts as FlareImage::highlight. False when stopped.
bool finish_highlight(LevelPictures<gray_channels>& ghosts, unsigned threads,
                      const std::stop_token& stop, FlareImage& image);

}  // namespace ghostlight
