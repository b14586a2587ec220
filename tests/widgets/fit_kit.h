#pragma once

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QTest>

#include "core/fit/synthetic_photo.h"
#include "core/io/fit_setup_json.h"
#include "core/io/photo_file.h"
#include "tests/widgets/window_kit.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/panels/fit_panel.h"

namespace ghostlight::test {

inline constexpr double field_deg = 5.0;
/// One wavelength makes the reference quick; off λ0, where a reflectance has a slope.
inline constexpr double light_nm = 620.0;
inline constexpr double true_nm = 550.0, wrong_nm = 590.0;

/// The tessar with its own coatings before a camera.
inline SyntheticPhotoRequest flare_request() {
    SyntheticPhotoRequest request;
    request.light = {field_deg, 90.0};
    request.width_px = 192;
    request.spectrum = Monochromatic{light_nm};
    request.noise = 0.01;
    request.gains = {0.7, 1.0, 0.8};
    return request;
}

/// What the camera sees, `times` as long as an exposure whose flare reaches half of saturation.
inline Photo flare_photo(double times = 1.0, std::uint64_t seed = 1) {
    static const Prescription lens = read_lens(tessar()).lens;
    static const FlareImage subject = *photo_subject(lens, flare_request());
    SyntheticPhotoRequest request = flare_request();
    request.seed = seed;
    for (double* gain : {&request.gains.r, &request.gains.g, &request.gains.b}) {
        *gain *= times;
    }
    Photo photo = exposed(subject, lens, request);
    photo.exposure_s = 0.01 * times;
    return photo;
}

/// Its file, made once.
inline const QString& photograph() {
    static QTemporaryDir folder;
    static const QString file = [] {
        const QString name = folder.filePath("flare.exr");
        write_photo(flare_photo(), 0, name.toStdString());
        return name;
    }();
    return file;
}

class FitPanelTest : public testing::Test {
   protected:
    FitPanelTest() : actions_(&host_), panel_(document_, actions_) {
        panel_.resize(1200, 520);
        panel_.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&panel_));
    }
    /// The tessar with one coating wrong.
    void open_wrong() {
        ASSERT_FALSE(document_.open(tessar()));
        Prescription wrong = document_.lens();
        auto* film = std::get_if<QuarterWave>(&wrong.surfaces[0].coating);
        ASSERT_NE(film, nullptr);
        ASSERT_EQ(film->center_nm, true_nm);
        film->center_nm = wrong_nm;
        document_.edit_lens(wrong, "make a coating wrong");
    }
    /// Few samples and one first guess, by the set-up as a file holds it.
    void make_quick() {
        FitSetup setup = fit_setup_from_json(document_.fit());
        setup.spectrum = "620 nm";
        setup.across = 48;
        setup.starts = 1;
        document_.edit_fit(fit_setup_to_json(setup), "make it quick");
    }
    bool settle() {
        return QTest::qWaitFor([this] { return panel_.is_settled(); }, patience_ms);
    }
    void click(const QString& name) { QTest::mouseClick(&panel_.button(name), Qt::LeftButton); }
    void type_spec(const QString& text) {
        panel_.spec().setFocus();
        panel_.spec().selectAll();
        QTest::keyClicks(&panel_.spec(), text);
        QTest::keyClick(&panel_.spec(), Qt::Key_Return);
    }
    double center_nm() const {
        return std::get<QuarterWave>(document_.lens().surfaces[0].coating).center_nm;
    }

    QWidget host_;
    Actions actions_;
    Document document_;
    FitPanel panel_;
};

}  // namespace ghostlight::test
