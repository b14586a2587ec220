#pragma once

#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/flare/direct_beam.h"
#include "core/flare/flare_image.h"
#include "core/flare/ghost_mesh.h"
#include "core/flare/polar_pattern.h"
#include "core/flare/spectrum.h"
#include "core/optics/prescription.h"

namespace ghostlight {

/// What to draw of the direct light.
struct StarburstRequest {
    LightDirection light;
    Spectrum spectrum = Monochromatic{};
    int width_px = 1280;  ///< the height follows from the sensor's shape, as for the ghosts
    unsigned threads = 0;
    /// Artistic, 0 by default: the mean of the pattern turned by up to half of this either way, as
    /// of blades that do not quite agree.
    double smoothing_deg = 0.0;
};

/// The direct image in its diffracted form: the light that comes straight through, spread by the
/// stop's mask. Irradiance / E0 like the ghosts', in the same frame; its total flux at every
/// wavelength is the direct path's, times what the stop's dirt leaves of it. flux_mm2 is all of it,
/// flux_on_sensor_mm2 what lands within the frame. Each pixel has the mean over its area.
/// Physics.md §9: each wavelength's pattern is scaled by λ|B|/(2πa) from the stop to the sensor,
/// 1/cosθ' across the field and 1/cos³θ' along it; out of focus it is the Fresnel pattern of the
/// direct path's own number. Aberrations other than defocus are not in it. Bit-identical for any
/// number of threads. Returns nothing when stopped. Throws Error like compile().
std::optional<FlareImage> render_starburst(const Prescription& lens,
                                           const StarburstRequest& request,
                                           std::stop_token stop = {});

/// A pattern of all wavelengths together, per mm² of the direct light's flux: what does not change
/// while light moves by little.
class StarburstTable {
   public:
    static constexpr int channels = 4;  ///< linear Rec.709 and irradiance

    /// One pattern of each wavelength of `samples`, or one for all of them. `weights`: of each
    /// sample, flux × the light's share. `blur_mm`: radius of what is out of focus.
    StarburstTable(const std::vector<PolarPattern>& patterns,
                   const std::vector<SpectralSample>& samples, const std::vector<Rgb>& colors,
                   const std::vector<double>& weights, double radius_per_k_mm_per_nm,
                   double blur_mm, double smoothing_deg, unsigned threads);

    /// How the pattern lies on a picture.
    struct Placement {
        double x_mm = 0.0, y_mm = 0.0;
        double tangential_rad = 0.0;
        double sagittal_stretch = 1.0, tangential_stretch = 1.0;
        double gain = 1.0;
    };
    /// Draws rgb and irradiance of the frame's size. False when stopped.
    bool draw(const Placement& placement, const PixelFrame& frame, unsigned threads,
              const std::stop_token& stop, FlareImage& image) const;

    double flux_mm2() const { return flux_[channels - 1]; }

   private:
    using Color = std::array<float, channels>;
    int rings_ = 0;
    double blur_mm_ = 0.0;
    bool half_turn_ = true;
    double turned_rad_ = 0.0;
    double first_radius_mm_ = 0.0;
    /// Flux below each sector of a ring: rings × (sectors + 1).
    std::vector<Color> below_;
    std::array<double, channels> inside_{}, flux_{};
    std::vector<double> edge_mm_;          ///< of the rings, one more than there are
    std::vector<double> sectors_per_mm2_;  ///< of each ring

    double ring_of(double radius_mm) const;
    Color flux_between(int ring, double from_sector, double to_sector) const;
    Color density(double ring, double from_sector, double to_sector) const;
    Color mean_at(double radius_mm, double turn_rad, double pitch_mm) const;
    void add_density(float ring, float from_sector, float to_sector, float scale,
                     float (&color)[channels]) const;
    void draw_core(const Placement& placement, const PixelFrame& frame, double core_mm,
                   FlareImage& image) const;
};

/// Starbursts of one lens and spectrum while its light moves: patterns at a few fields are kept,
/// each drawn once about its middle, and a frame is that picture moved by whole pixels. What it
/// leaves out against render_starburst(): parts of a pixel, and the change of shape and flux
/// between the fields kept. A light whose image is beside the frame is drawn in full.
class MovingStarburst {
   public:
    MovingStarburst(Prescription lens, StarburstRequest request);
    ~MovingStarburst();
    /// The frame for a light. The first of each field draws it, as long as a render does.
    const FlareImage& frame(const LightDirection& light);

   private:
    struct Kept;
    Prescription lens_;
    StarburstRequest request_;
    OpticalSystem system_;
    std::vector<std::unique_ptr<Kept>> kept_;
    FlareImage frame_;
};

}  // namespace ghostlight
