#include "widgets/panels/stop_panel.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include <cmath>

#include "core/optics/optical_system.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/widgets/window_kit.h"
#include "widgets/actions.h"
#include "widgets/document.h"

namespace ghostlight {
namespace {

class StopPanelTest : public testing::Test {
   protected:
    StopPanelTest() : actions_(&host_), panel_(document_, actions_) {
        panel_.resize(420, 700);
        panel_.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&panel_));
    }
    void open() { ASSERT_FALSE(document_.open(test::tessar())); }
    bool settle() {
        return QTest::qWaitFor([this] { return panel_.is_settled(); }, test::patience_ms);
    }
    void type(const QString& name, const QString& text) {
        QLineEdit& editor = panel_.editor(name);
        editor.setFocus();
        editor.selectAll();
        QTest::keyClicks(&editor, text);
        QTest::keyClick(&editor, Qt::Key_Return);
    }
    const Stop& stop() const { return document_.lens().stop; }

    QWidget host_;
    Actions actions_;
    Document document_;
    StopPanel panel_;
};

TEST_F(StopPanelTest, ShowsOpeningAndStarburstOfTheLens) {
    open();
    ASSERT_TRUE(settle());
    ASSERT_FALSE(panel_.opening().isNull());
    ASSERT_FALSE(panel_.starburst().isNull());
    const int middle = panel_.opening().width() / 2;
    EXPECT_EQ(qGray(panel_.opening().pixel(middle, middle)), 255);
    EXPECT_EQ(qGray(panel_.opening().pixel(1, 1)), 0);
    // The middle of the pattern is its brightest place.
    const int half = panel_.starburst().width() / 2;
    EXPECT_GT(qGray(panel_.starburst().pixel(half, half)), qGray(panel_.starburst().pixel(2, 2)));
}

TEST_F(StopPanelTest, EveryEntryIsAnEditThatCanBeUndone) {
    open();
    const Stop before = stop();
    struct Case {
        const char *name, *text;
        bool (*holds)(const Stop&);
    };
    const Case cases[] = {
        {"blades", "7", [](const Stop& s) { return s.blades == 7; }},
        {"curvature", "0.4", [](const Stop& s) { return s.blade_curvature == 0.4; }},
        {"rotation", "12.5", [](const Stop& s) { return s.rotation_deg == 12.5; }},
        {"dust", "2", [](const Stop& s) { return s.dirt.dust_coverage == 0.02; }},
        {"dust_largest", "0.3", [](const Stop& s) { return s.dirt.dust_largest_mm == 0.3; }},
        {"dust_smallest", "0.05", [](const Stop& s) { return s.dirt.dust_smallest_mm == 0.05; }},
        {"scratches", "30", [](const Stop& s) { return s.dirt.scratches == 30; }},
        {"scratch_widest", "0.05", [](const Stop& s) { return s.dirt.scratch_widest_mm == 0.05; }},
        {"scratch_thinnest", "0.01",
         [](const Stop& s) { return s.dirt.scratch_thinnest_mm == 0.01; }},
        {"fingerprint", "25", [](const Stop& s) { return s.dirt.fingerprint == 0.25; }},
        {"seed", "9", [](const Stop& s) { return s.dirt.seed == 9; }}};
    for (const Case& each : cases) {
        type(each.name, each.text);
        EXPECT_TRUE(each.holds(stop())) << each.name;
        EXPECT_EQ(panel_.reason(), "") << each.name;
        document_.history().undo();
        EXPECT_EQ(stop(), before) << each.name;
        document_.history().redo();
        EXPECT_TRUE(each.holds(stop())) << each.name;
        EXPECT_TRUE(panel_.reset_button(each.name).isEnabled()) << each.name;
        panel_.reset_button(each.name).click();
        EXPECT_FALSE(each.holds(stop())) << each.name;
        EXPECT_FALSE(panel_.reset_button(each.name).isEnabled()) << each.name;
        document_.history().setIndex(0);
    }
}

TEST_F(StopPanelTest, WhatCannotBeTakenIsSaidAndChangesNothing) {
    open();
    const Stop before = stop();
    for (const auto& [name, text] : {std::pair{"blades", "2"},
                                     {"blades", "1000000"},
                                     {"blades", "many"},
                                     {"curvature", "2"},
                                     {"dust", "70"},
                                     {"dust_smallest", "5"},
                                     {"scratches", "1.5"},
                                     {"fingerprint", "-1"},
                                     {"image", "/no/such/file.png"}}) {
        type(name, text);
        EXPECT_EQ(stop(), before) << name;
        EXPECT_NE(panel_.reason(), "") << name;
        panel_.editor(name).clear();
        panel_.editor(name).setModified(false);
    }
}

TEST_F(StopPanelTest, ImageIsTakenShownAndTakenAway) {
    open();
    ASSERT_TRUE(settle());
    QTemporaryDir folder;
    QImage half(64, 64, QImage::Format_Grayscale8);
    half.fill(0);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) half.scanLine(y)[x] = 255;
    const QString file = folder.filePath("half.png");
    ASSERT_TRUE(half.save(file));
    ASSERT_TRUE(panel_.take_image(file));
    EXPECT_EQ(panel_.editor("image").text(), "half.png");
    ASSERT_TRUE(QTest::qWaitFor([this] { return panel_.is_settled(); }, test::patience_ms));
    const int middle = panel_.opening().width() / 2;
    EXPECT_EQ(qGray(panel_.opening().pixel(middle, middle / 2)), 255);
    EXPECT_EQ(qGray(panel_.opening().pixel(middle, middle + middle / 2)), 0);
    panel_.reset_button("image").click();
    EXPECT_FALSE(stop().image.has_value());
    EXPECT_EQ(panel_.editor("image").text(), "");
}

TEST_F(StopPanelTest, TooMuchDirtIsARefusalInThePanel) {
    open();
    type("dust_smallest", "0.0001");
    type("dust_largest", "0.0001");
    type("dust", "50");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(panel_.reason().contains("specks")) << panel_.reason().toStdString();
}

TEST_F(StopPanelTest, TheFNumberIsSetHereToo) {
    open();
    const auto f_number = [this] {
        return first_order(compile(document_.configured_lens(), d_line_nm)).f_number;
    };
    const double open_f = f_number();
    EXPECT_EQ(panel_.editor("f_number").text().toDouble(), std::round(open_f * 100.0) / 100.0);
    type("f_number", "8");
    EXPECT_NEAR(f_number(), 8.0, 1e-9);
    // A third of a stop up, and back.
    QTest::keyClick(&panel_.editor("f_number"), Qt::Key_Up);
    EXPECT_NEAR(f_number(), 8.98, 1e-9);  // 8 × 2^(1/6), as people write it
    type("f_number", "wide");
    EXPECT_NE(panel_.reason(), "");
    EXPECT_NEAR(f_number(), 8.98, 1e-9);
    panel_.reset_button("f_number").click();
    EXPECT_NEAR(f_number(), open_f, 1e-9);
}

TEST_F(StopPanelTest, ArrowKeysGoByStepsOverWhatNoStopHas) {
    open();
    QLineEdit& blades = panel_.editor("blades");
    blades.setFocus();
    type("blades", "0");
    QTest::keyClick(&blades, Qt::Key_Up);
    EXPECT_EQ(stop().blades, 3);
    QTest::keyClick(&blades, Qt::Key_Up);
    EXPECT_EQ(stop().blades, 4);
    EXPECT_EQ(blades.text(), "4");
    QTest::keyClick(&blades, Qt::Key_Down);
    QTest::keyClick(&blades, Qt::Key_Down);
    EXPECT_EQ(stop().blades, 0);
    QTest::keyClick(&blades, Qt::Key_Down);
    EXPECT_EQ(stop().blades, 0);
    EXPECT_EQ(panel_.reason(), "") << "the end of a range is no mistake";
}

TEST_F(StopPanelTest, ANumberIsDrawnByItsNameInOneStepOfTheHistory) {
    open();
    QLabel* name = nullptr;
    for (QLabel* label : panel_.findChildren<QLabel*>()) {
        name = label->text() == "Rotation" ? label : name;
    }
    ASSERT_NE(name, nullptr);
    const int before = document_.history().count();
    QTest::mousePress(name, Qt::LeftButton, {}, QPoint(5, 5));
    for (int x = 10; x <= 95; x += 5) {
        QTest::mouseMove(name, QPoint(x, 5));
        QCoreApplication::processEvents();
    }
    QTest::mouseRelease(name, Qt::LeftButton, {}, QPoint(95, 5));
    EXPECT_GT(stop().rotation_deg, 5.0);
    EXPECT_EQ(document_.history().count(), before + 1);
    document_.history().undo();
    EXPECT_EQ(stop().rotation_deg, 0.0);
}

TEST_F(StopPanelTest, StatisticsSayWhatLiesOnIt) {
    open();
    type("blades", "7");
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel_.statistics(), "14 arms of the starburst");
    type("scratches", "1");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(panel_.statistics().contains("1 scratch takes "))
        << qPrintable(panel_.statistics());
    EXPECT_TRUE(panel_.statistics().contains(" % of the light passes"));
}

}  // namespace
}  // namespace ghostlight
