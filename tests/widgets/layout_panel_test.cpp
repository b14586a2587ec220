#include "widgets/panels/layout_panel.h"

#include <gtest/gtest.h>

#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <filesystem>

#include "core/io/lens_file.h"
#include "tests/support/test_paths.h"
#include "widgets/layout_view.h"
#include "widgets/palette.h"
#include "widgets/panel_header.h"

namespace ghostlight {
namespace {

constexpr double d_nm = 587.5618;

Prescription bundled_lens(const std::string& file) { return read_lens(lens_folder() / file).lens; }

class LayoutPanelTest : public testing::Test {
   protected:
    LayoutPanelTest() : tessar_(bundled_lens("tessar_brendel_100_f2.8.json")) {
        panel_.resize(830, 360);
        panel_.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&panel_));
    }
    void show(const std::vector<std::string>& ghosts = {}, double field_deg = 10.0) {
        std::vector<GhostPath> paths;
        for (const std::string& ghost : ghosts) {
            paths.push_back(parse_ghost(ghost, compile(tessar_, d_nm)));
        }
        panel_.show_lens(tessar_, {field_deg, 90.0}, d_nm, paths);
    }
    void mouse(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButtons buttons) {
        QMouseEvent event(type, at, view().mapToGlobal(at), button, buttons, Qt::NoModifier);
        QCoreApplication::sendEvent(&view(), &event);
    }
    LayoutView& view() { return *panel_.view(); }
    QString header() { return panel_.findChild<PanelHeader*>()->state(); }
    /// How many pixels are near a colour.
    static int count(const QImage& image, const QColor& wanted, int tolerance = 24) {
        int found = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const QColor color = image.pixelColor(x, y);
                found += std::abs(color.red() - wanted.red()) <= tolerance &&
                                 std::abs(color.green() - wanted.green()) <= tolerance &&
                                 std::abs(color.blue() - wanted.blue()) <= tolerance
                             ? 1
                             : 0;
            }
        }
        return found;
    }

    Prescription tessar_;
    LayoutPanel panel_;
};

TEST_F(LayoutPanelTest, DrawsTheLensAndTheGhostsThreeLegs) {
    ASSERT_TRUE(view().has_gl()) << "these tests need OpenGL";
    const Palette colors = dark_palette();
    show();
    const QImage plain = panel_.grab_view();
    ASSERT_FALSE(plain.isNull());
    EXPECT_GT(count(plain, colors.panel, 2), plain.width() * plain.height() / 3);
    EXPECT_EQ(count(plain, colors.amber), 0);
    // Glass is neither ground nor line.
    const QPointF inside = view().plane().to_view({5.0, 12.0}) * panel_.devicePixelRatio();
    const QColor glass = plain.pixelColor(inside.toPoint());
    EXPECT_GT(glass.blue(), colors.panel.blue() + 10);

    show({"5-3"});
    const QImage ghost = panel_.grab_view();
    EXPECT_GT(count(ghost, colors.amber), 100);
    EXPECT_GT(count(ghost, colors.red_orange), 40);
    EXPECT_GT(count(ghost, colors.teal), 100);
    EXPECT_EQ(header(), QStringLiteral("ghost 5-3 · 7 rays · legs: in, between, out"));
}

TEST_F(LayoutPanelTest, TheWindowsPictureHoldsTheDrawing) {
    show({"5-3"});
    const QImage grabbed = panel_.grab().toImage();
    EXPECT_GT(count(grabbed, dark_palette().teal), 100);
    for (int x = 0; x < grabbed.width(); x += 7) {
        ASSERT_EQ(grabbed.pixelColor(x, grabbed.height() / 2).alpha(), 255);
    }
}

TEST_F(LayoutPanelTest, HoveringASurfaceNamesIt) {
    show();
    QSignalSpy hovered(&panel_, &LayoutPanel::surface_hovered);
    const QPointF fifth = view().plane().to_view(view().drawing().surfaces[4].points[40]);
    mouse(QEvent::MouseMove, fifth + QPointF(2.0, 0.0), Qt::NoButton, Qt::NoButton);
    ASSERT_EQ(hovered.size(), 1);
    EXPECT_EQ(hovered.front().front().toInt(), 5);
    EXPECT_TRUE(header().startsWith(QStringLiteral("surface 5 · R −59.06 mm · n 1.6398")))
        << header().toStdString();
    mouse(QEvent::MouseMove, {3.0, 3.0}, Qt::NoButton, Qt::NoButton);
    ASSERT_EQ(hovered.size(), 2);
    EXPECT_EQ(hovered.back().front().toInt(), 0);
    EXPECT_TRUE(header().startsWith("direct light at 10.0°"));
}

TEST_F(LayoutPanelTest, TheStopIsNamedToo) {
    show();
    const StopBars& stop = view().drawing().stop;
    const QPointF bar =
        view().plane().to_view({stop.z_mm, (stop.opening_mm + stop.outer_mm) / 2.0});
    EXPECT_EQ(view().row_at(bar), static_cast<int>(tessar_.stop.surface) + 1);
}

TEST_F(LayoutPanelTest, ZoomsAboutTheCursorPansAndFits) {
    show();
    const DrawingPoint center = view().plane().center();
    const double scale = view().plane().mm_per_px();
    const QPointF at(200.0, 100.0);
    const DrawingPoint before = view().plane().to_drawing(at);
    QWheelEvent wheel(at, view().mapToGlobal(at), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&view(), &wheel);
    EXPECT_LT(view().plane().mm_per_px(), 0.75 * scale);
    const DrawingPoint after = view().plane().to_drawing(at);
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);

    mouse(QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton);
    mouse(QEvent::MouseMove, at + QPointF(30.0, -12.0), Qt::NoButton, Qt::LeftButton);
    mouse(QEvent::MouseButtonRelease, at + QPointF(30.0, -12.0), Qt::LeftButton, Qt::NoButton);
    const DrawingPoint held = view().plane().to_drawing(at + QPointF(30.0, -12.0));
    EXPECT_NEAR(held.x, before.x, 1e-9);
    EXPECT_NEAR(held.y, before.y, 1e-9);

    show({}, 12.0);
    EXPECT_NEAR(view().plane().to_drawing(at + QPointF(30.0, -12.0)).x, before.x, 1e-9)
        << "an edit leaves the view alone";
    QTest::keyClick(&view(), Qt::Key_F);
    EXPECT_NEAR(view().plane().mm_per_px(), scale, 1e-12);
    EXPECT_NEAR(view().plane().center().x, center.x, 1e-9);
}

TEST_F(LayoutPanelTest, FitShowsTheWholeLensAtAnySize) {
    show();
    for (const QSize size : {QSize(830, 360), QSize(300, 700), QSize(1600, 200)}) {
        panel_.resize(size);
        QCoreApplication::processEvents();
        const DrawingBox& box = view().drawing().box;
        const QPointF low = view().plane().to_view({box.z_min, box.y_min});
        const QPointF high = view().plane().to_view({box.z_max, box.y_max});
        EXPECT_GE(low.x(), 0.0);
        EXPECT_LE(low.y(), view().height());
        EXPECT_LE(high.x(), view().width());
        EXPECT_GE(high.y(), 0.0);
    }
}

TEST_F(LayoutPanelTest, SaysWhenNoRayPasses) {
    show({"5-3"}, 50.0);
    EXPECT_EQ(header(), QStringLiteral("ghost 5-3 · no ray of this plane reaches the sensor"));
    show({}, 50.0);
    EXPECT_EQ(header(), QStringLiteral("direct light at 50.0° · no ray passes"));
}

TEST_F(LayoutPanelTest, ALensThatCannotBeTracedIsStillDrawn) {
    tessar_.surfaces[0].semi_diameter_mm = -1.0;
    panel_.show_lens(tessar_, {10.0, 90.0}, d_nm, {});
    EXPECT_TRUE(header().startsWith("no rays: ")) << header().toStdString();
    EXPECT_FALSE(view().drawing().elements.empty());
    EXPECT_TRUE(view().fans().empty());
}

TEST_F(LayoutPanelTest, GhostsOfAnotherLensAreLeftOut) {
    panel_.show_lens(tessar_, {10.0, 90.0}, d_nm, {GhostPath{{40, 2}}, GhostPath{}});
    EXPECT_TRUE(header().startsWith("direct light"));
}

TEST_F(LayoutPanelTest, ClearingShowsTheEmptyState) {
    show({"5-3"});
    panel_.clear();
    EXPECT_EQ(header(), QString());
    EXPECT_EQ(count(panel_.grab_view(), dark_palette().teal), 0);
    mouse(QEvent::MouseMove, {200.0, 100.0}, Qt::NoButton, Qt::NoButton);
    panel_.fit();
}

TEST_F(LayoutPanelTest, SurvivesAnotherWindow) {
    show({"5-3"});
    const QImage before = panel_.grab_view();
    QWidget other;
    other.resize(panel_.size());
    auto* column = new QVBoxLayout(&other);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(&panel_);
    other.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&other));
    const QImage after = panel_.grab_view();
    ASSERT_EQ(after.size(), before.size());
    EXPECT_GT(count(after, dark_palette().teal), 100);
    panel_.setParent(nullptr);
    panel_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel_));
    EXPECT_GT(count(panel_.grab_view(), dark_palette().teal), 100);
}

}  // namespace
}  // namespace ghostlight
