// The same picture from every variant of the kernels that this machine runs.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

std::vector<float> pixels_of(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    const OIIO::ImageSpec spec = input->spec();
    std::vector<float> pixels(static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(spec.nchannels));
    input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data());
    return pixels;
}

class InstructionSets : public InTemporaryFolder {};

TEST_F(InstructionSets, AgreeInEveryPixel) {
    std::map<std::string, std::vector<float>> pictures;
    for (const std::string set : {"v2", "v3", "v4"}) {
        const auto file = folder / (set + ".exr");
        RunOptions options;
        options.environment["GHOSTLIGHT_INSTRUCTION_SET"] = set;
        const Outcome outcome = cli({"render", tessar(), "--field", "10", "--spectrum", "D65",
                                     "--width", "320", "--out", file.string()},
                                    options);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        pictures[set] = pixels_of(file);
    }
    // In single precision the order of operations differs: 1e-5 of the picture's light in all, and
    // of the brightest pixel in any.
    constexpr double tolerance = 1e-5;
    const std::vector<float>& usual = pictures["v3"];
    double sum = 0.0, brightest = 0.0;
    for (const float value : usual) {
        sum += std::abs(static_cast<double>(value));
        brightest = std::max(brightest, std::abs(static_cast<double>(value)));
    }
    ASSERT_GT(sum, 0.0);
    for (const char* set : {"v2", "v4"}) {
        double difference = 0.0, largest = 0.0;
        ASSERT_EQ(pictures[set].size(), usual.size());
        for (std::size_t i = 0; i < usual.size(); ++i) {
            const double d = std::abs(static_cast<double>(pictures[set][i] - usual[i]));
            difference += d;
            largest = std::max(largest, d);
        }
        EXPECT_LE(difference, tolerance * sum) << set;
        EXPECT_LE(largest, 10.0 * tolerance * brightest) << set;
    }
}

}  // namespace
}  // namespace ghostlight::test
