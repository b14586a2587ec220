// The accuracy panel and the veiling glare index by their own events.

#include "widgets/panels/accuracy_panel.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <filesystem>

#include "core/flare/veiling_index.h"
#include "tests/widgets/window_kit.h"
#include "widgets/actions.h"
#include "widgets/document.h"
#include "widgets/log_chart_view.h"
#include "widgets/panels/plan_page.h"
#include "widgets/panels/veiling_strip.h"

namespace ghostlight {
namespace {

class AccuracyPanelSlow : public testing::Test {
   protected:
    AccuracyPanelSlow() : actions_(&host_) {}
    void show(MakeGlEngine make_gl) {
        panel_ = std::make_unique<AccuracyPanel>(document_, actions_, std::move(make_gl));
        panel_->resize(900, 480);
        panel_->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(panel_.get()));
        ASSERT_FALSE(document_.open(test::tessar()));
        panel_->width_px().setValue(96);
        panel_->reference_percent().setValue(10.0);
        panel_->budget_s().setValue(0.2);
    }
    bool settle() {
        return QTest::qWaitFor([this] { return panel_->is_settled(); }, test::patience_ms);
    }
    bool has_method(const std::string& name) const {
        const auto& points = panel_->measured()->cases.front().report.points;
        return std::ranges::any_of(points,
                                   [&](const AccuracyPoint& p) { return p.method == name; });
    }

    QWidget host_;
    Actions actions_;
    Document document_;
    std::unique_ptr<AccuracyPanel> panel_;
};

TEST_F(AccuracyPanelSlow, MeasuresBothEnginesAndSaves) {
    show(offscreen_gl_engine);
    EXPECT_FALSE(panel_->save_button().isEnabled());
    QTest::mouseClick(&panel_->measure_button(), Qt::LeftButton);
    EXPECT_TRUE(panel_->is_measuring());
    ASSERT_TRUE(settle());
    ASSERT_TRUE(panel_->measured()) << panel_->reason().toStdString();
    EXPECT_EQ(panel_->reason(), "");
    EXPECT_TRUE(has_method("planned"));
    EXPECT_TRUE(has_method("planned, OpenGL"));
    const AccuracyReport& report = panel_->measured()->cases.front().report;
    EXPECT_EQ(panel_->table().rowCount(), static_cast<int>(report.points.size()));
    ASSERT_TRUE(panel_->error_chart().chart());
    EXPECT_TRUE(panel_->error_chart().chart()->band_y);
    // Two engines draw one plan: their first pictures differ by less than both tolerances.
    const auto first = [&](const std::string& name) {
        return std::ranges::find(report.points, name, &AccuracyPoint::method)->errors.relative_l1;
    };
    EXPECT_NEAR(first("planned"), first("planned, OpenGL"), 0.2);

    QTemporaryDir folder;
    ASSERT_TRUE(panel_->save(folder.path()));
    for (const char* name :
         {"accuracy.csv", "ghosts.csv", "accuracy.html", "accuracy_promised.svg"}) {
        EXPECT_TRUE(std::filesystem::exists(folder.filePath(name).toStdString())) << name;
    }
    // Another light: what was measured is not of it.
    Scene scene = document_.scene();
    scene.light().direction.field_deg += 1.0;
    document_.edit_scene(scene, "move the light", "light");
    EXPECT_TRUE(panel_->state().contains("measure again")) << panel_->state().toStdString();
}

TEST_F(AccuracyPanelSlow, WithoutOpenGlTheCpuIsMeasuredAndTheReasonSaid) {
    show([]() -> GlEngine { throw Error("no driver here"); });
    QTest::mouseClick(&panel_->measure_button(), Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_TRUE(panel_->measured());
    EXPECT_TRUE(has_method("planned"));
    EXPECT_FALSE(has_method("planned, OpenGL"));
    EXPECT_TRUE(panel_->reason().contains("no driver here")) << panel_->reason().toStdString();
}

TEST_F(AccuracyPanelSlow, CancelEndsAtOnce) {
    show(offscreen_gl_engine);
    panel_->width_px().setValue(2048);
    panel_->reference_percent().setValue(0.05);
    QTest::mouseClick(&panel_->measure_button(), Qt::LeftButton);
    EXPECT_TRUE(panel_->is_measuring());
    QTest::mouseClick(&panel_->cancel_button(), Qt::LeftButton);
    EXPECT_FALSE(panel_->is_measuring());
    EXPECT_EQ(panel_->state(), "stopped");
    EXPECT_TRUE(panel_->measure_button().isEnabled());
}

TEST(PlanPageSlow, SaysWhatThePictureLeavesOutAndItsTrueError) {
    test::OpenWindow open(test::tessar());
    ASSERT_TRUE(open.window.begin_study("plan"));
    ASSERT_TRUE(open.settle());
    PlanPage& page = open.window.accuracy_panel().plan();
    ASSERT_TRUE(QTest::qWaitFor([&] { return page.table().rowCount() > 0; }, test::patience_ms));
    // The sum claims no more than its rows do.
    bool estimates = false;
    for (int row = 0; row < page.table().rowCount(); ++row) {
        const QString known = page.table().item(row, 3)->text();
        const QString changes = page.table().item(row, 2)->text();
        EXPECT_EQ(changes.startsWith("≈"), known == "estimated" && changes != "nothing")
            << changes.toStdString() << ' ' << known.toStdString();
        estimates = estimates || changes.startsWith("≈");
    }
    EXPECT_EQ(page.sum().contains("estimated"), estimates) << page.sum().toStdString();
    EXPECT_TRUE(page.measure().isEnabled());
}

TEST(VeilingStripSlow, WorksOutTheIndexOfTheCore) {
    Document document;
    VeilingStrip strip(document);
    strip.show();
    ASSERT_FALSE(document.open(test::tessar()));
    EXPECT_FALSE(strip.index());
    QTest::mouseClick(&strip.button(), Qt::LeftButton);
    EXPECT_TRUE(strip.is_busy());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !strip.is_busy(); }, test::patience_ms));
    ASSERT_TRUE(strip.index()) << strip.text().toStdString();
    // A share of light, above zero for a lens whose glass reflects.
    EXPECT_GT(strip.index()->index(), 0.0);
    EXPECT_LT(strip.index()->index(), 1.0);
    EXPECT_TRUE(strip.text().contains('%'));
    // The light does not matter to it; the lens does.
    Scene scene = document.scene();
    scene.light().direction.field_deg += 1.0;
    document.edit_scene(scene, "move the light", "light");
    EXPECT_TRUE(strip.index());
    Prescription lens = document.lens();
    lens.surfaces[0].coating = Uncoated{};
    document.edit_lens(lens, "take a coating off");
    EXPECT_FALSE(strip.index());
    EXPECT_TRUE(strip.text().contains(QStringLiteral("–")));
}

}  // namespace
}  // namespace ghostlight
