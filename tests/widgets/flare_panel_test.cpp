#include "widgets/panels/flare_panel.h"

#include <gtest/gtest.h>

#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <cmath>

#include "core/flare/tone_map.h"
#include "render/flare_renderer.h"
#include "widgets/flare_overlay.h"
#include "widgets/flare_view.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"
#include "widgets/software_picture.h"

namespace ghostlight {
namespace {

constexpr double efl_mm = 100.0;

/// Brighter towards +x and +y, so that no mirroring goes unnoticed.
std::shared_ptr<FlareImage> gradient() {
    auto image = std::make_shared<FlareImage>();
    image->width_px = 90;
    image->height_px = 60;
    for (int row = 0; row < 60; ++row) {
        for (int column = 0; column < 90; ++column) {
            const float value = 1e-6F + 1e-5F * static_cast<float>(column + 2 * row);
            image->irradiance.push_back(value);
            image->rgb.insert(image->rgb.end(), 3, value);
        }
    }
    return image;
}

class FlarePanelTest : public testing::Test {
   protected:
    FlarePanelTest() {
        panel_.resize(620, 440);
        panel_.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&panel_));
    }
    void show_gradient() {
        panel_.set_light({5.0, 90.0}, efl_mm);
        panel_.show_image(gradient());
    }
    void mouse(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons buttons) {
        QMouseEvent event(type, at, view().mapToGlobal(at), button, buttons, Qt::NoModifier);
        QCoreApplication::sendEvent(&view(), &event);
    }
    void drag(QPointF from, QPointF to) {
        mouse(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
        mouse(QEvent::MouseMove, (from + to) / 2.0, Qt::NoButton, Qt::LeftButton);
        mouse(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton);
        mouse(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
    }
    void wheel(QPointF at, int eighths, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QWheelEvent event(at, view().mapToGlobal(at), {}, {0, eighths}, Qt::NoButton, modifiers,
                          Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(&view(), &event);
    }
    QPointF on_view(double x_mm, double y_mm) {
        const glm::dvec2 at = view().frame().view_from_sensor({x_mm, y_mm});
        return {at.x, at.y};
    }
    FlareView& view() { return *panel_.view(); }
    QString header() { return panel_.findChild<PanelHeader*>()->state(); }

    FlarePanel panel_;
};

TEST_F(FlarePanelTest, ShowsThePictureUprightAndToneMapped) {
    ASSERT_TRUE(view().has_gl()) << "these tests need OpenGL";
    show_gradient();
    const QImage shown = panel_.grab_view();
    ASSERT_FALSE(shown.isNull());
    const qreal ratio = panel_.devicePixelRatio();
    const auto image = gradient();
    // Clear of the light's marker, at places inside the four quadrants.
    for (const auto& [x_mm, y_mm] :
         {std::pair{12.0, 2.0}, {12.0, -8.0}, {-12.0, 2.0}, {-12.0, -8.0}}) {
        const QPointF at = on_view(x_mm, y_mm) * ratio;
        const QColor got = shown.pixelColor(at.toPoint());
        const float value = irradiance_at(*image, x_mm, y_mm).value();
        const auto expected = tone_mapped({value, value, value}, panel_.exposure_ev());
        EXPECT_NEAR(got.redF(), expected[0], 0.02F) << x_mm << ", " << y_mm;  // a pixel's gradient
        EXPECT_EQ(got.red(), got.blue());
    }
}

TEST_F(FlarePanelTest, GrabbingTheWindowShowsThePictureAndItsOverlay) {
    show_gradient();
    const QImage shown = panel_.grab().toImage();
    int amber = 0;
    for (int y = 0; y < shown.height(); ++y) {
        for (int x = 0; x < shown.width(); ++x) {
            const QColor color = shown.pixelColor(x, y);
            amber += color.red() > 180 && color.red() > color.blue() + 80 ? 1 : 0;
            ASSERT_EQ(color.alpha(), 255);
        }
    }
    EXPECT_GT(amber, 20) << "the light's ring";
}

TEST_F(FlarePanelTest, SoftwareDrawingMatchesOpenGl) {
    show_gradient();
    auto image = gradient();
    image->highlight.assign(image->irradiance.size(), 0.0F);
    for (std::size_t i = 0; i < image->highlight.size() / 2; ++i) {
        image->highlight[i] = 1e-8F;
    }
    panel_.show_image(image);
    const QImage gl = panel_.grab_view();
    const QImage software = software_picture(*image, view().frame(), view().size(), view().look());
    for (const auto& [x_mm, y_mm] :
         {std::pair{12.0, 5.0}, {12.0, -8.0}, {-12.0, 5.0}, {-12.0, -8.0}}) {
        const QPointF at = on_view(x_mm, y_mm);
        const QColor a = gl.pixelColor((at * panel_.devicePixelRatio()).toPoint());
        const QColor b = software.pixelColor(at.toPoint());
        EXPECT_NEAR(a.red(), b.red(), 6) << x_mm << ", " << y_mm;  // nearest against linear
        EXPECT_NEAR(a.green(), b.green(), 6);
        EXPECT_NEAR(a.blue(), b.blue(), 6);
    }
}

TEST_F(FlarePanelTest, DraggingTheLightFollowsTheCursor) {
    show_gradient();
    QSignalSpy dragged(&panel_, &FlarePanel::light_dragged);
    QSignalSpy finished(&panel_, &FlarePanel::light_drag_finished);
    drag(on_view(-10.0, -5.0), on_view(9.0, 6.0));
    ASSERT_GE(dragged.size(), 2);
    EXPECT_EQ(finished.size(), 1);
    const auto light = dragged.back().front().value<LightDirection>();
    EXPECT_NEAR(light.field_deg, std::atan(std::hypot(9.0, 6.0) / efl_mm) * 180.0 / M_PI, 1e-9);
    EXPECT_NEAR(light.azimuth_deg, std::atan2(6.0, 9.0) * 180.0 / M_PI, 1e-9);
}

TEST_F(FlarePanelTest, DraggingByTheMarkerKeepsTheGrip) {
    show_gradient();
    const QPointF marker = on_view(0.0, efl_mm * std::tan(5.0 * M_PI / 180.0));
    QSignalSpy dragged(&panel_, &FlarePanel::light_dragged);
    drag(marker + QPointF(5.0, 3.0), marker + QPointF(5.0, 3.0 - 80.0));
    ASSERT_FALSE(dragged.isEmpty());
    const auto light = dragged.back().front().value<LightDirection>();
    const double moved_mm = 80.0 * view().frame().sensor_height_mm / view().frame().height_px;
    const double y_mm = efl_mm * std::tan(5.0 * M_PI / 180.0) - moved_mm;
    EXPECT_NEAR(light.field_deg, std::atan(std::abs(y_mm) / efl_mm) * 180.0 / M_PI, 1e-9);
}

TEST_F(FlarePanelTest, DraggingOutOfTheFrameGoesOn) {
    show_gradient();
    QSignalSpy dragged(&panel_, &FlarePanel::light_dragged);
    drag(on_view(0.0, 0.0), on_view(400.0, 0.0));
    ASSERT_FALSE(dragged.isEmpty());
    const auto light = dragged.back().front().value<LightDirection>();
    EXPECT_NEAR(light.field_deg, std::atan(4.0) * 180.0 / M_PI, 1e-9);
    EXPECT_NEAR(light.azimuth_deg, 0.0, 1e-9);
    EXPECT_FALSE(panel_.grab_view().isNull()) << "with the arrow at the border";
}

TEST_F(FlarePanelTest, AClickMovesNothing) {
    show_gradient();
    QSignalSpy dragged(&panel_, &FlarePanel::light_dragged);
    QSignalSpy finished(&panel_, &FlarePanel::light_drag_finished);
    mouse(QEvent::MouseButtonPress, {200, 200}, Qt::LeftButton, Qt::LeftButton);
    mouse(QEvent::MouseMove, {201, 200}, Qt::NoButton, Qt::LeftButton);
    mouse(QEvent::MouseButtonRelease, {201, 200}, Qt::LeftButton, Qt::NoButton);
    EXPECT_EQ(dragged.size(), 0);
    EXPECT_EQ(finished.size(), 0);
}

TEST_F(FlarePanelTest, TheWheelChangesTheExposureByThirdsOfAStop) {
    show_gradient();
    QSignalSpy changed(&panel_, &FlarePanel::exposure_changed);
    const double before = panel_.exposure_ev();
    wheel({300, 200}, 120);
    EXPECT_NEAR(panel_.exposure_ev(), before + 1.0 / 3.0, 1e-12);
    wheel({300, 200}, -240);
    EXPECT_NEAR(panel_.exposure_ev(), before - 1.0 / 3.0, 1e-12);
    EXPECT_EQ(changed.size(), 2);
}

TEST_F(FlarePanelTest, ControlWheelZoomsAboutTheCursorAndFShowsAll) {
    show_gradient();
    const double ev = panel_.exposure_ev();
    const PictureFrame all = view().frame();
    const glm::dvec2 before = all.sensor_from_view({150.0, 120.0});
    wheel({150, 120}, 360, Qt::ControlModifier);
    const glm::dvec2 after = view().frame().sensor_from_view({150.0, 120.0});
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);
    EXPECT_GT(view().frame().width_px, 1.9 * all.width_px);
    EXPECT_EQ(panel_.exposure_ev(), ev);

    const glm::dvec2 held = view().frame().sensor_from_view({200.0, 200.0});
    mouse(QEvent::MouseButtonPress, {200, 200}, Qt::MiddleButton, Qt::MiddleButton);
    mouse(QEvent::MouseMove, {230, 180}, Qt::NoButton, Qt::MiddleButton);
    mouse(QEvent::MouseButtonRelease, {230, 180}, Qt::MiddleButton, Qt::NoButton);
    const glm::dvec2 there = view().frame().sensor_from_view({230.0, 180.0});
    EXPECT_NEAR(there.x, held.x, 1e-9);
    EXPECT_NEAR(there.y, held.y, 1e-9);

    QTest::keyClick(&view(), Qt::Key_F);
    EXPECT_EQ(view().frame(), all);
}

TEST_F(FlarePanelTest, ExposesOncePerLens) {
    EXPECT_EQ(header(), QString());
    show_gradient();
    const double exposed = panel_.exposure_ev();
    EXPECT_GT(exposed, 5.0);
    EXPECT_TRUE(header().startsWith("exposure +")) << header().toStdString();
    panel_.set_exposure_ev(2.0);
    panel_.show_image(gradient());
    EXPECT_EQ(panel_.exposure_ev(), 2.0) << "the next picture of the same lens";
    panel_.begin_lens();
    panel_.show_image(gradient());
    EXPECT_EQ(panel_.exposure_ev(), exposed);
    panel_.set_exposure_ev(-1.25);
    QTest::mouseDClick(&view(), Qt::LeftButton, {}, {200, 200});
    EXPECT_EQ(panel_.exposure_ev(), exposed);
}

TEST_F(FlarePanelTest, SurvivesAnotherWindow) {
    show_gradient();
    const QImage before = panel_.grab_view();
    QWidget other;
    other.resize(panel_.size());
    auto* column = new QVBoxLayout(&other);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(&panel_);
    other.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&other));
    const QImage after = panel_.grab_view();
    EXPECT_EQ(after.size(), before.size());
    EXPECT_EQ(after.pixel(after.width() / 4, after.height() / 4),
              before.pixel(before.width() / 4, before.height() / 4));
    panel_.setParent(nullptr);
}

TEST(FlareReadout, ReadsThePixelUnderTheCursor) {
    const auto image = gradient();
    // Column 0 is the lowest x, row 0 the lowest y.
    EXPECT_EQ(irradiance_at(*image, -17.99, -11.99), image->irradiance.front());
    EXPECT_EQ(irradiance_at(*image, 17.99, 11.99), image->irradiance.back());
    EXPECT_EQ(irradiance_at(*image, 0.2, -11.99), image->irradiance[45]);
    EXPECT_EQ(irradiance_at(*image, 18.01, 0.0), std::nullopt);
    EXPECT_EQ(irradiance_at(*image, 0.0, -12.01), std::nullopt);
    EXPECT_EQ(position_text(12.411, -3.068), QStringLiteral("12.41, −3.07 mm"));
    EXPECT_EQ(position_text(-0.001, 0.0), QStringLiteral("0.00, 0.00 mm"));
}

}  // namespace
}  // namespace ghostlight
