// A camera RAW written byte by byte (an uncompressed DNG), read as the sensor counted: linear, in
// the camera's own channels, neither balanced nor brightened, with what its EXIF says.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/io/photo_file.h"

namespace ghostlight {
namespace {

namespace fs = std::filesystem;

constexpr int width = 128, height = 96;
constexpr int black = 512, white = 16'383;
/// What the rounding to whole counts does to a value of full scale 1.
constexpr double one_count = 1.0 / (white - black);

/// A little-endian TIFF directory; values that do not fit into an entry come after it.
class Directory {
   public:
    void add_bytes(std::uint16_t tag, std::uint16_t type, std::size_t count,
                   const std::vector<std::uint8_t>& data) {
        entries_.push_back({tag, type, static_cast<std::uint32_t>(count), data});
    }
    void ascii(std::uint16_t tag, const std::string& text) {
        std::vector<std::uint8_t> data(text.begin(), text.end());
        data.push_back(0);
        add_bytes(tag, 2, data.size(), data);
    }
    void bytes(std::uint16_t tag, const std::vector<std::uint8_t>& data) {
        add_bytes(tag, 1, data.size(), data);
    }
    void shorts(std::uint16_t tag, const std::vector<std::uint32_t>& values) {
        numbers(tag, 3, values, 2, 1);
    }
    void longs(std::uint16_t tag, const std::vector<std::uint32_t>& values) {
        numbers(tag, 4, values, 4, 1);
    }
    /// Numerators and denominators in turn.
    void rationals(std::uint16_t tag, const std::vector<std::uint32_t>& values, bool is_signed) {
        numbers(tag, is_signed ? 10 : 5, values, 4, 2);
    }
    std::size_t size() const {
        std::size_t bytes = 2 + 12 * entries_.size() + 4;
        for (const Entry& each : entries_)
            if (each.data.size() > 4) bytes += each.data.size() + each.data.size() % 2;
        return bytes;
    }
    /// As it stands at `offset` of the file.
    std::vector<std::uint8_t> at(std::size_t offset) const {
        std::vector<std::uint8_t> head, tail;
        put(head, entries_.size(), 2);
        const std::size_t tail_at = offset + 2 + 12 * entries_.size() + 4;
        for (const Entry& each : entries_) {
            put(head, each.tag, 2);
            put(head, each.type, 2);
            put(head, each.count, 4);
            if (each.data.size() > 4) {
                put(head, tail_at + tail.size(), 4);
                tail.insert(tail.end(), each.data.begin(), each.data.end());
                if (tail.size() % 2 != 0) tail.push_back(0);
            } else {
                std::vector<std::uint8_t> data = each.data;
                data.resize(4, 0);
                head.insert(head.end(), data.begin(), data.end());
            }
        }
        put(head, 0, 4);
        head.insert(head.end(), tail.begin(), tail.end());
        return head;
    }
    static void put(std::vector<std::uint8_t>& to, std::size_t value, int bytes) {
        for (int k = 0; k < bytes; ++k)
            to.push_back(static_cast<std::uint8_t>((value >> (8 * k)) & 0xFF));
    }

   private:
    struct Entry {
        std::uint16_t tag, type;
        std::uint32_t count;
        std::vector<std::uint8_t> data;
    };
    void numbers(std::uint16_t tag, std::uint16_t type, const std::vector<std::uint32_t>& values,
                 int bytes, std::size_t per_value) {
        std::vector<std::uint8_t> data;
        for (const std::uint32_t each : values) put(data, each, bytes);
        add_bytes(tag, type, values.size() / per_value, data);
    }
    std::vector<Entry> entries_;
};

/// Counts of a Bayer sensor, red in the upper left corner, for a scene of linear values.
template <class Scene>
std::vector<std::uint8_t> bayer(const Scene& scene) {
    std::vector<std::uint8_t> data;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::array<double, 3> rgb = scene(x, y);
            const std::size_t channel = y % 2 == 0 ? (x % 2 == 0 ? 0 : 1) : (x % 2 == 0 ? 1 : 2);
            const double count = black + rgb[channel] * (white - black);
            Directory::put(
                data, static_cast<std::size_t>(std::lround(std::min<double>(count, white))), 2);
        }
    return data;
}

template <class Scene>
void write_dng(const fs::path& file, std::uint32_t orientation, const Scene& scene) {
    Directory exif;
    exif.rationals(33434, {1, 50}, false);   // ExposureTime
    exif.rationals(33437, {28, 10}, false);  // FNumber
    exif.ascii(36867, "2026:11:25 12:34:56");
    exif.rationals(37386, {50, 1}, false);  // FocalLength
    const auto make = [&](std::uint32_t exif_at, std::uint32_t data_at) {
        Directory main;
        main.longs(254, {0});
        main.longs(256, {width});
        main.longs(257, {height});
        main.shorts(258, {16});
        main.shorts(259, {1});      // uncompressed
        main.shorts(262, {32803});  // colour filter array
        main.ascii(271, "Ghostlight");
        main.ascii(272, "Test Camera");
        main.longs(273, {data_at});
        main.shorts(274, {orientation});
        main.shorts(277, {1});
        main.longs(278, {height});
        main.longs(279, {2 * width * height});
        main.ascii(306, "2026:11:25 12:34:56");
        main.shorts(33421, {2, 2});
        main.bytes(33422, {0, 1, 1, 2});
        main.longs(34665, {exif_at});
        main.bytes(50706, {1, 4, 0, 0});
        main.ascii(50708, "Ghostlight Test Camera");
        main.longs(50714, {black});
        main.longs(50717, {white});
        // A matrix and a balance far from none: they must not be applied.
        main.rationals(50721,
                       {8, 10, static_cast<std::uint32_t>(-2), 10, static_cast<std::uint32_t>(-1),
                        10, static_cast<std::uint32_t>(-4), 10, 12, 10, 2, 10,
                        static_cast<std::uint32_t>(-1), 10, 2, 10, 6, 10},
                       true);
        main.rationals(50728, {1, 2, 1, 1, 7, 10}, false);  // AsShotNeutral
        main.shorts(50778, {21});
        return main;
    };
    const std::size_t exif_at = 8 + make(0, 0).size(), data_at = exif_at + exif.size();
    std::vector<std::uint8_t> all = {'I', 'I', 42, 0, 8, 0, 0, 0};
    for (const auto& part :
         {make(static_cast<std::uint32_t>(exif_at), static_cast<std::uint32_t>(data_at)).at(8),
          exif.at(exif_at), bayer(scene)})
        all.insert(all.end(), part.begin(), part.end());
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(all.data()), static_cast<std::streamsize>(all.size()));
}

class RawPhoto : public testing::Test {
   protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "ghostlight_raw_XXXXXX").string();
        folder = mkdtemp(name.data());
    }
    void TearDown() override { fs::remove_all(folder); }
    /// Of the upright picture; files are mirrored against the sensor's frame.
    static std::array<double, 3> value(const Photo& photo, int x, int y) {
        const float* rgb = photo.at(photo.width_px - 1 - x, y);
        return {rgb[0], rgb[1], rgb[2]};
    }
    fs::path folder;
};

/// Dim on the left, four times as bright on the right; a clipped square where asked for.
auto halves(bool with_light) {
    return [with_light](int x, int y) -> std::array<double, 3> {
        if (with_light && x >= 90 && x < 100 && y >= 20 && y < 30) return {1.0, 1.0, 1.0};
        const double level = x < width / 2 ? 0.05 : 0.2;
        return {level, 2.0 * level, 0.5 * level};
    };
}

TEST_F(RawPhoto, CountsComeBackLinearInTheCamerasChannels) {
    for (const bool with_light : {false, true}) {
        write_dng(folder / "a.dng", 1, halves(with_light));
        const Photo photo = read_photo(folder / "a.dng");
        ASSERT_EQ(photo.width_px, width);
        ASSERT_EQ(photo.height_px, height);
        for (const auto& [x, level] : {std::pair{20, 0.05}, std::pair{80, 0.2}}) {
            const auto rgb = value(photo, x, 60);
            EXPECT_NEAR(rgb[0], level, one_count) << x;
            EXPECT_NEAR(rgb[1], 2.0 * level, one_count) << x;
            EXPECT_NEAR(rgb[2], 0.5 * level, one_count) << x;
        }
        // A light in the picture changes nothing elsewhere, and is known to be clipped.
        EXPECT_EQ(count_masked(photo).saturated > 0, with_light);
    }
}

TEST_F(RawPhoto, EveryChannelClipsAtOneLevel) {
    write_dng(folder / "a.dng", 1, halves(true));
    const Photo photo = read_photo(folder / "a.dng");
    const auto rgb = value(photo, 95, 25);
    for (const double each : rgb) EXPECT_NEAR(each, 1.0, 2.0 * one_count);
    EXPECT_GE(rgb[2], photo.saturation);
}

TEST_F(RawPhoto, ExifIsRead) {
    write_dng(folder / "a.dng", 1, halves(false));
    const Photo photo = read_photo(folder / "a.dng");
    ASSERT_TRUE(photo.exposure_s && photo.f_number && photo.focal_length_mm);
    EXPECT_NEAR(*photo.exposure_s, 0.02, 1e-6);  // s
    EXPECT_NEAR(*photo.f_number, 2.8, 1e-5);
    EXPECT_NEAR(*photo.focal_length_mm, 50.0, 1e-4);
    EXPECT_NE(photo.taken.find("2026"), std::string::npos) << photo.taken;
    EXPECT_NE(photo.camera.find("Test Camera"), std::string::npos) << photo.camera;
}

TEST_F(RawPhoto, TheSensorsOwnOrientationIsKept) {
    write_dng(folder / "turned.dng", 6, halves(false));
    const Photo photo = read_photo(folder / "turned.dng");
    EXPECT_EQ(photo.width_px, width);
    EXPECT_NEAR(value(photo, 20, 60)[1], 0.1, one_count);
    EXPECT_NEAR(value(photo, 80, 60)[1], 0.4, one_count);
}

}  // namespace
}  // namespace ghostlight
