#include "core/io/stop_image_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/refuse_file.h"

namespace ghostlight {
namespace {

constexpr int most_side_px = 16384;
constexpr long most_pixels = 1L << 26;  // 64 Mi: a quarter of a gigabyte as it is read

/// One value a pixel, of all its channels.
float share_of(const float* pixel, int channels, int alpha) {
    float sum = 0.0F;
    int count = 0;
    for (int c = 0; c < channels && count < 3; ++c) {
        if (c == alpha) continue;
        sum += pixel[c];
        ++count;
    }
    // Alpha alone: it is the shape. OpenImageIO has multiplied colours by it already.
    return count > 0 ? sum / static_cast<float>(count) : pixel[0];
}

}  // namespace

StopImage read_stop_image(const std::filesystem::path& file) {
    const auto in = OIIO::ImageInput::open(file.string());
    if (!in)
        refuse_file(file, "the stop's image cannot be read", OIIO::geterror(),
                    "a PNG, TIFF, EXR or JPEG file");
    const OIIO::ImageSpec spec = in->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        refuse_file(file, "the stop's image is empty",
                    fmt::format("{} x {} pixels", spec.width, spec.height), "at least one pixel");
    const long pixels = static_cast<long>(spec.width) * spec.height;
    if (spec.width > most_side_px || spec.height > most_side_px || pixels > most_pixels)
        refuse_file(file, "the stop's image is too large",
                    fmt::format("{} x {} pixels", spec.width, spec.height),
                    "at most 16384 pixels a side and 64 million in all; 1024 across are used");
    std::vector<float> values(static_cast<std::size_t>(pixels) *
                              static_cast<std::size_t>(spec.nchannels));
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
        refuse_file(file, "the stop's image cannot be read", in->geterror(), "a complete image");
    std::vector<float> open(static_cast<std::size_t>(pixels));
    for (std::size_t k = 0; k < open.size(); ++k) {
        const float share = share_of(&values[k * static_cast<std::size_t>(spec.nchannels)],
                                     spec.nchannels, spec.alpha_channel);
        if (!std::isfinite(share))
            refuse_file(file, "the stop's image has a value that is no number",
                        fmt::format("{}", share), "shares from 0 to 1");
        open[k] = std::clamp(share, 0.0F, 1.0F);
    }
    StopImage image{file.string(),
                    std::make_shared<const StopPicture>(spec.width, spec.height, open)};
    if (image.picture->mean_over_circle() <= 0.0)
        refuse_file(file, "the stop's image lets no light through", "black everywhere in the stop",
                    "an image that is white where the stop is open");
    return image;
}

}  // namespace ghostlight
