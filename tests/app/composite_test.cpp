// The flare of a light that passes behind a post, in an HDR sequence made here.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/io/frame_sequence.h"
#include "tests/app/program.h"

namespace ghostlight::test {
namespace {

constexpr int width = 192, height = 128, frames = 32;
constexpr double post_left = 90.0, post_right = 104.0;
constexpr float sky = 0.25F, sun = 4000.0F, post = 0.05F;
constexpr double sun_radius = 4.0;

double sun_x(int frame) { return 60.3 + 2.37 * frame; }
double sun_y(int frame) { return 40.6 + 0.41 * frame; }

/// Sky, sun and post of one frame, each pixel the mean of 8 × 8 points.
LinearPicture scene_of(int frame) {
    LinearPicture picture{width, height, {}};
    constexpr int parts = 8;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            double value = 0.0;
            for (int q = 0; q < parts; ++q)
                for (int p = 0; p < parts; ++p) {
                    const double x = column + (p + 0.5) / parts, y = row + (q + 0.5) / parts;
                    if (x >= post_left && x < post_right)
                        value += static_cast<double>(post);
                    else if (std::hypot(x - sun_x(frame), y - sun_y(frame)) < sun_radius)
                        value += static_cast<double>(sun);
                    else
                        value += static_cast<double>(sky);
                }
            const auto mean = static_cast<float>(value / (parts * parts));
            picture.rgb.insert(picture.rgb.end(), {mean, 0.9F * mean, 0.8F * mean});
        }
    return picture;
}

class CommandLineComposite : public InTemporaryFolder {
   protected:
    std::string in() const { return (folder / "shot.####.exr").string(); }
    std::string out() const { return (folder / "flare.####.exr").string(); }
    std::filesystem::path shot(int frame) const {
        return parse_frame_pattern(in()).file(frame + 1);
    }
    std::filesystem::path result(int frame) const {
        return parse_frame_pattern(out()).file(frame + 1);
    }
    void make(int count) const {
        for (int k = 0; k < count; ++k) write_frame(scene_of(k), shot(k));
    }
    std::vector<std::string> command(std::vector<std::string> more = {}) const {
        std::vector<std::string> all = {"composite", in(), "--lens", tessar(), "--out", out()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void expect_refused(const std::vector<std::string>& arguments, const char* word) const {
        const Outcome outcome = cli(arguments);
        EXPECT_EQ(outcome.status, 2) << word;
        EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    }
};

/// The sun's part that the post leaves free: strips of a disc.
double free_share(int frame) {
    const auto left_of = [&](double x) {
        const double t = std::clamp((x - sun_x(frame)) / sun_radius, -1.0, 1.0);
        return 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / std::numbers::pi;
    };
    return 1.0 - (left_of(post_right) - left_of(post_left));
}

TEST_F(CommandLineComposite, FollowsFadesAndDoesNotFlicker) {
    make(frames);
    const Csv table = cli_csv(command({"--csv", "--lights", "1"}));
    ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(frames));
    double most_e0 = 0.0, most_flare = 0.0;
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
        most_e0 = std::max(most_e0, table.number(k, "e0_g"));
        most_flare = std::max(most_flare, table.number(k, "flare_mean"));
    }
    ASSERT_GT(most_flare, 0.0);
    int hidden = 0, whole = 0;
    for (int k = 0; k < frames; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const double e0 = table.number(row, "e0_g") / most_e0;
        const double flare = table.number(row, "flare_mean") / most_flare;
        // Follows: where the sun is whole its centroid is known.
        if (free_share(k) > 0.999) {
            ++whole;
            // The threshold cuts the rim's pixels alike on all sides.
            EXPECT_NEAR(table.number(row, "x_px"), sun_x(k), 0.05) << k;
            EXPECT_NEAR(table.number(row, "y_px"), sun_y(k), 0.05) << k;
        }
        // Fades: in proportion to what the post leaves free. Rim pixels below the threshold of a
        // fifth and half-covered ones: a few per cent of the disc; cos⁴ over the path: 2 %.
        EXPECT_NEAR(e0, free_share(k), 0.06) << k;
        if (free_share(k) == 0.0) {
            ++hidden;
            EXPECT_EQ(flare, 0.0) << k;
        }
        // Does not flicker: from frame to frame the flare changes with the light, and over one
        // frame's motion by a few per cent of itself, twice the picture's tolerance.
        if (k > 0) {
            const double before = table.number(row - 1, "flare_mean") / most_flare;
            const double light_before = table.number(row - 1, "e0_g") / most_e0;
            EXPECT_LE(std::abs(flare - before), 1.05 * std::abs(e0 - light_before) + 0.05) << k;
        }
    }
    EXPECT_GE(hidden, 2);
    EXPECT_GE(whole, 12);
    // The frames hold what was there and the flare.
    const int bright = 2, dark = static_cast<int>((97.0 - 60.3) / 2.37);
    const LinearPicture with = read_frame(result(bright), false);
    const LinearPicture without = read_frame(shot(bright), false);
    double sum = 0.0;
    for (std::size_t i = 0; i < with.rgb.size(); ++i) {
        EXPECT_GE(with.rgb[i], without.rgb[i] * (1.0F - 1e-5F));
        sum += static_cast<double>(with.rgb[i] - without.rgb[i]);
    }
    EXPECT_NEAR(sum / static_cast<double>(with.rgb.size()),
                table.number(static_cast<std::size_t>(bright), "flare_mean"), 0.01 * most_flare);
    EXPECT_EQ(read_frame(result(dark), false).rgb, read_frame(shot(dark), false).rgb);
}

TEST_F(CommandLineComposite, TakesTheLightsThatItPrints) {
    make(3);
    const std::string lights = cli_output(command({"--csv", "--dry-run"}));
    EXPECT_FALSE(std::filesystem::exists(result(0)));
    write_file(folder / "lights.csv", lights);
    cli_output(command());
    const auto found = read_frame(result(1), false).rgb;
    cli_output(command({"--light", (folder / "lights.csv").string()}));
    EXPECT_EQ(read_frame(result(1), false).rgb, found);
}

TEST_F(CommandLineComposite, SaysWhatIsWrongWithAFrameAndKeepsThoseWritten) {
    expect_refused(command(), "no frame is there");
    make(4);
    const auto lights = (folder / "lights.csv").string();
    write_file(lights, cli_output(command({"--csv", "--dry-run"})));

    LinearPicture broken = scene_of(2);
    broken.rgb[3 * (5 * width + 7)] = std::numeric_limits<float>::quiet_NaN();
    write_frame(broken, shot(2));
    expect_refused(command(), "column 7, row 5");
    // With given lights the frames before it are there.
    expect_refused(command({"--light", lights}), "shot.0003.exr");
    EXPECT_TRUE(std::filesystem::exists(result(0)));
    EXPECT_TRUE(std::filesystem::exists(result(1)));
    EXPECT_FALSE(std::filesystem::exists(result(2)));
    EXPECT_EQ(cli(command({"--clamp"})).status, 0);
    broken.rgb[3 * (5 * width + 7)] = -0.5F;
    write_frame(broken, shot(2));
    expect_refused(command(), "-0.5");

    write_frame({8, 8, std::vector<float>(192, 1.0F)}, shot(2));
    expect_refused(command(), "another size");
    std::filesystem::remove(shot(2));
    expect_refused(command(), "frames are missing; found all but 3");
    EXPECT_EQ(cli(command({"--frames", "1:2"})).status, 0);
    expect_refused(command({"--frames", "1:3"}), "no such picture");
}

TEST_F(CommandLineComposite, SaysThatNoLightWasFound) {
    make(2);
    expect_refused(command({"--threshold", "1e6"}), "no light was found");
    // An even frame has nothing that stands out; what somebody calls a light is one.
    for (const int k : {0, 1})
        write_frame({64, 48, std::vector<float>(std::size_t{3} * 64 * 48, 0.25F)}, shot(k));
    expect_refused(command(), "no light was found; found nothing but spots of more than 10 %");
    EXPECT_EQ(cli(command({"--threshold", "0.05", "--dry-run"})).status, 0);
    make(2);
    expect_refused(command({"--threshold", "-1"}), "--threshold");
    write_file(folder / "lights.csv", "frame,light,x_px,y_px,e0_r,e0_g\n1,1,2,3,4,5\n");
    expect_refused(command({"--light", (folder / "lights.csv").string()}), "e0_b");
    expect_refused({"composite", in(), "--lens", tessar(), "--out", in()}, "not replaced");
    expect_refused({"composite", in(), "--lens", tessar(), "--out", (folder / "a.exr").string()},
                   "####");
}

}  // namespace
}  // namespace ghostlight::test
