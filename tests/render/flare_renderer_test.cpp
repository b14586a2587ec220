#include "render/flare_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/flare/tone_map.h"
#include "render/offscreen.h"
#include "tests/support/error_of.h"

namespace ghostlight {
namespace {

/// Of 8-bit output: rounding on both sides and a shader's exp and pow.
constexpr double display_tolerance = 1.5 / 255.0;

struct Rgb8 {
    int r, g, b;
    bool operator==(const Rgb8&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Rgb8& c) {
    return out << '(' << c.r << ", " << c.g << ", " << c.b << ')';
}

/// A picture of its own size, drawn one to one.
class Screen {
   public:
    Screen(int width_px, int height_px)
        : width_(width_px), height_(height_px), target_(width_px, height_px) {}

    void draw(FlareRenderer& renderer, const PictureTexture& picture, const PictureFrame& frame,
              const PictureLook& look) {
        target_.bind();
        renderer.draw(picture, frame, look, width_, height_);
        pixels_ = target_.read();
    }
    Rgb8 at(int x, int y_from_top) const {
        const auto i = static_cast<std::size_t>(4 * (y_from_top * width_ + x));
        return {pixels_[i], pixels_[i + 1], pixels_[i + 2]};
    }

   private:
    int width_, height_;
    OffscreenTarget target_;
    std::vector<std::uint8_t> pixels_;
};

class FlareRendererTest : public testing::Test {
   protected:
    static FlareImage picture(int width_px, int height_px) {
        FlareImage image;
        image.width_px = width_px;
        image.height_px = height_px;
        image.sensor_width_mm = width_px;
        image.sensor_height_mm = height_px;
        const auto pixels = static_cast<std::size_t>(width_px * height_px);
        image.rgb.assign(3 * pixels, 0.0F);
        image.irradiance.assign(pixels, 0.0F);
        return image;
    }
    static void set(FlareImage& image, int column, int row, float r, float g, float b) {
        const auto i = static_cast<std::size_t>(3 * (row * image.width_px + column));
        image.rgb[i] = r;
        image.rgb[i + 1] = g;
        image.rgb[i + 2] = b;
    }
    static PictureFrame whole(const FlareImage& image, double width_px, double height_px) {
        return framed(width_px, height_px, image.sensor_width_mm, image.sensor_height_mm);
    }

    OffscreenContext context_;
    FlareRenderer renderer_;
    PictureUpload upload_;
};

TEST_F(FlareRendererTest, ToneMapsAsTheCoreDoes) {
    // Every decade from far below the first code value to far above the shoulder, in all hues.
    constexpr int columns = 96, rows = 24;
    FlareImage image = picture(columns, rows);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float value = static_cast<float>(std::pow(10.0, -5.0 + 7.0 * column / columns));
            const float share = static_cast<float>(row) / (rows - 1);
            set(image, column, row, value, value * share, value * (1.0F - share) * 0.3F);
        }
    }
    upload_.upload(image);
    for (const double ev : {-3.0, 0.0, 1.0 / 3.0, 6.0}) {
        PictureLook look;
        look.exposure_ev = ev;
        Screen screen(columns, rows);
        screen.draw(renderer_, upload_.texture(), whole(image, columns, rows), look);
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x) {
                // Upright: right is −x, top is −y, so only left and right are exchanged.
                const auto i = static_cast<std::size_t>(3 * (y * columns + columns - 1 - x));
                const auto expected =
                    tone_mapped({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}, ev);
                const Rgb8 shown = screen.at(x, y);
                ASSERT_NEAR(shown.r / 255.0, static_cast<double>(expected[0]), display_tolerance);
                ASSERT_NEAR(shown.g / 255.0, static_cast<double>(expected[1]), display_tolerance);
                ASSERT_NEAR(shown.b / 255.0, static_cast<double>(expected[2]), display_tolerance);
            }
        }
    }
}

TEST_F(FlareRendererTest, CurvesAndFalseColoursAreTheCores) {
    constexpr int columns = 96, rows = 4;
    FlareImage image = picture(columns, rows);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float value = static_cast<float>(std::pow(10.0, -5.0 + 7.0 * column / columns));
            set(image, column, row, value, 0.5F * value, 0.1F * value);
            image.irradiance[static_cast<std::size_t>(row * columns + column)] = value;
        }
    }
    PictureLook linear, log, colors;
    linear.tone = ToneCurve::linear;
    log.tone = ToneCurve::log;
    colors.false_color = PictureLook::Decades{-4.0F, 1.0F};
    for (const PictureLook& look : {linear, log, colors}) {
        look.false_color ? upload_.upload_irradiance(image) : upload_.upload(image);
        Screen screen(columns, rows);
        screen.draw(renderer_, upload_.texture(), whole(image, columns, rows), look);
        for (int x = 0; x < columns; ++x) {
            const auto i = static_cast<std::size_t>(columns - 1 - x);
            const auto expected =
                shown_color(look, {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]},
                            image.irradiance[i]);
            const Rgb8 shown = screen.at(x, rows - 1);
            ASSERT_NEAR(shown.r / 255.0, static_cast<double>(expected[0]), display_tolerance) << x;
            ASSERT_NEAR(shown.g / 255.0, static_cast<double>(expected[1]), display_tolerance) << x;
            ASSERT_NEAR(shown.b / 255.0, static_cast<double>(expected[2]), display_tolerance) << x;
        }
    }
}

TEST_F(FlareRendererTest, LeavesWhatIsLeftOfADivider) {
    FlareImage red = picture(40, 20), green = picture(40, 20);
    for (int row = 0; row < 20; ++row) {
        for (int column = 0; column < 40; ++column) {
            set(red, column, row, 0.5F, 0.0F, 0.0F);
            set(green, column, row, 0.0F, 0.5F, 0.0F);
        }
    }
    PictureUpload other;
    upload_.upload(red);
    other.upload(green);
    const PictureFrame frame = whole(red, 40, 20);
    OffscreenTarget target(40, 20);
    target.bind();
    renderer_.draw(upload_.texture(), frame, {}, 40, 20);
    PictureLook right;
    right.from_share = 0.25;
    renderer_.draw(other.texture(), frame, right, 40, 20);
    const std::vector<std::uint8_t> pixels = target.read();
    EXPECT_GT(pixels[4 * 9], 100);       // red left of the tenth column
    EXPECT_GT(pixels[4 * 10 + 1], 100);  // green from there on
    EXPECT_EQ(pixels[4 * 10], 0);
}

TEST_F(FlareRendererTest, ShowsTheUprightCameraPicture) {
    // One mark near the sensor's (+x, +y) corner: low on the left of the picture.
    FlareImage image = picture(30, 20);
    set(image, 27, 18, 0.5F, 0.0F, 0.0F);
    upload_.upload(image);
    Screen screen(30, 20);
    screen.draw(renderer_, upload_.texture(), whole(image, 30, 20), {});
    EXPECT_GT(screen.at(2, 18).r, 100);
    const std::vector<float> upright =
        upright_picture(image.rgb, image.width_px, image.height_px, 3);
    EXPECT_EQ(upright[3 * (18 * 30 + 2)], 0.5F) << "the file's picture is the same way up";
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 30; ++x) {
            if (x != 2 || y != 18) {
                EXPECT_EQ(screen.at(x, y), (Rgb8{0, 0, 0})) << x << ", " << y;
            }
        }
    }
}

TEST_F(FlareRendererTest, LetterBoxesIntoTheSurround) {
    FlareImage image = picture(30, 20);
    image.rgb.assign(image.rgb.size(), 0.2F);
    upload_.upload(image);
    PictureLook look;
    look.surround = {1.0F, 0.0F, 0.0F};
    Screen screen(60, 20);
    screen.draw(renderer_, upload_.texture(), whole(image, 60, 20), look);
    EXPECT_EQ(screen.at(14, 10), (Rgb8{255, 0, 0}));
    EXPECT_EQ(screen.at(45, 10), (Rgb8{255, 0, 0}));
    EXPECT_EQ(screen.at(15, 10).r, screen.at(15, 10).g);
    EXPECT_EQ(screen.at(44, 0).r, screen.at(44, 0).g);
}

TEST_F(FlareRendererTest, ShowsPixelsAsSquaresWhenMuchEnlarged) {
    FlareImage image = picture(6, 4);
    set(image, 2, 1, 0.5F, 0.5F, 0.5F);
    upload_.upload(image);
    Screen screen(60, 40);
    screen.draw(renderer_, upload_.texture(), whole(image, 60, 40), {});
    const Rgb8 inside = screen.at(35, 15);
    EXPECT_GT(inside.r, 100);
    EXPECT_EQ(screen.at(30, 10), inside);
    EXPECT_EQ(screen.at(39, 19), inside);
    EXPECT_EQ(screen.at(29, 15), (Rgb8{0, 0, 0}));
    EXPECT_EQ(screen.at(35, 20), (Rgb8{0, 0, 0}));
}

TEST_F(FlareRendererTest, TintsAndOutlinesHighlightedGhosts) {
    FlareImage image = picture(60, 40);
    image.rgb.assign(image.rgb.size(), 0.2F);
    image.highlight.assign(60 * 40, 0.0F);
    for (int row = 10; row < 30; ++row) {
        for (int column = 20; column < 40; ++column) {
            image.highlight[static_cast<std::size_t>(row * 60 + column)] = 1e-9F;  // faint
        }
    }
    upload_.upload(image);
    PictureLook look;
    look.highlight = {0.0F, 1.0F, 1.0F};
    Screen screen(60, 40);
    screen.draw(renderer_, upload_.texture(), whole(image, 60, 40), look);
    const Rgb8 outside = screen.at(5, 5), inside = screen.at(30, 20), edge = screen.at(20, 20);
    EXPECT_EQ(outside.r, outside.g);
    EXPECT_LT(inside.r, inside.g - 30);
    EXPECT_LT(edge.r, inside.r) << "the edge stands out";
    EXPECT_GT(edge.g, inside.g);

    look.show_highlight = false;
    screen.draw(renderer_, upload_.texture(), whole(image, 60, 40), look);
    EXPECT_EQ(screen.at(30, 20), outside);
}

TEST_F(FlareRendererTest, DropsTheHighlightOfThePictureBefore) {
    FlareImage image = picture(60, 40);
    image.rgb.assign(image.rgb.size(), 0.2F);
    image.highlight.assign(60 * 40, 1e-6F);
    upload_.upload(image);
    image.highlight.clear();
    upload_.upload(image);
    EXPECT_EQ(upload_.texture().highlight, 0U);
}

TEST_F(FlareRendererTest, TakesPicturesOfAnotherSize) {
    upload_.upload(picture(64, 48));
    FlareImage image = picture(33, 7);  // rows of no round number of bytes
    image.rgb.assign(image.rgb.size(), 0.3F);
    set(image, 32, 6, 0.0F, 0.0F, 0.0F);
    upload_.upload(image);
    Screen screen(33, 7);
    screen.draw(renderer_, upload_.texture(), whole(image, 33, 7), {});
    EXPECT_EQ(screen.at(0, 6), (Rgb8{0, 0, 0}));
    EXPECT_EQ(screen.at(1, 6), screen.at(20, 2));
}

TEST_F(FlareRendererTest, DrawsOnlyTheSurroundWithoutAPicture) {
    PictureLook look;
    look.surround = {0.0F, 0.0F, 1.0F};
    Screen screen(8, 8);
    screen.draw(renderer_, {}, framed(8.0, 8.0, 36.0, 24.0), look);
    EXPECT_EQ(screen.at(4, 4), (Rgb8{0, 0, 255}));
}

TEST_F(FlareRendererTest, RefusesDataThatDoNotMatchTheirSize) {
    FlareImage image = picture(30, 20);
    image.rgb.pop_back();
    EXPECT_EQ(error_of([&] { upload_.upload(image); }).where, "rgb");
    image.rgb.push_back(0.0F);
    image.highlight.assign(10, 0.0F);
    EXPECT_EQ(error_of([&] { upload_.upload(image); }).where, "highlight");
    FlareImage none;
    error_of([&] { upload_.upload(none); });
    FlareImage huge;
    huge.width_px = 1'000'000;
    huge.height_px = 1;
    huge.rgb.assign(3'000'000, 0.0F);
    EXPECT_NE(error_of([&] { upload_.upload(huge); }).found.find("1000000"), std::string::npos);
}

TEST_F(FlareRendererTest, AShaderThatDoesNotCompileIsAnError) {
    const Error::Parts parts = error_of([] {
        const GlProgram program("#version 150\nvoid main() { gl_Position = vec4(0); }",
                                "#version 150\nvoid main() { nonsense; }");
    });
    EXPECT_EQ(parts.where, "fragment shader");
    EXPECT_NE(parts.found.find("nonsense"), std::string::npos);
}

}  // namespace
}  // namespace ghostlight
