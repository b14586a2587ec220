// What of a photograph counts and where it lies, by mouse and keyboard in the fit panel.

#include "widgets/panels/fit_photographs.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableView>

#include <cmath>

#include "core/io/photo_file.h"
#include "tests/widgets/fit_kit.h"
#include "widgets/panels/fit_ghost_page.h"
#include "widgets/panels/fit_photo_form.h"
#include "widgets/panels/fit_variables.h"

namespace ghostlight {
namespace {

using test::photograph;

class FitPhotographsTest : public test::FitPanelTest {
   protected:
    void open_with_photo() {
        ASSERT_FALSE(document_.open(test::tessar()));
        panel_.add_photographs({photograph()});
        ASSERT_TRUE(settle());
        ASSERT_EQ(panel_.reason(), "");
    }
    FitPhotoSetup photo_setup() const {
        return fit_setup_from_json(document_.fit()).photos.front();
    }
    QPoint on_screen(double x_px, double y_px) {
        return panel_.picture().on_screen({x_px, y_px}).toPoint();
    }
    /// With the left button down from the first point to the last.
    void drag(const std::vector<FilePoint>& points) {
        FitPictureView* view = &panel_.picture();
        const auto at = [&](const FilePoint& p) { return on_screen(p.x_px, p.y_px); };
        QTest::mousePress(view, Qt::LeftButton, {}, at(points.front()));
        for (const FilePoint& each : points) {
            QTest::mouseMove(view, at(each));
        }
        QTest::mouseRelease(view, Qt::LeftButton, {}, at(points.back()));
        ASSERT_TRUE(settle());
    }
    void type(const QString& field, const QString& text) {
        QLineEdit& edit = panel_.photographs().form().field(field);
        edit.setFocus();
        edit.selectAll();
        QTest::keyClicks(&edit, text);
        QTest::keyClick(&edit, Qt::Key_Return);
        ASSERT_TRUE(settle());
    }
    int alpha_at(double x_px, double y_px) {
        const QImage& mask = panel_.picture().pictures().mask;
        return qAlpha(mask.pixel(static_cast<int>(x_px), static_cast<int>(y_px)));
    }
};

/// A pixel of the screen, in pixels of this photograph, is less than one.
constexpr double screen_px = 1.0;

TEST_F(FitPhotographsTest, RegionsArePaintedErasedAndUndone) {
    open_with_photo();
    const int steps = document_.history().count();
    click("tool_box");
    drag({{20, 30}, {60, 50}});
    ASSERT_EQ(photo_setup().masked.size(), 1U);
    const MaskRegion box = photo_setup().masked.front();
    ASSERT_EQ(box.points.size(), 4U);
    EXPECT_NEAR(box.points[0].x_px, 20.0, screen_px);
    EXPECT_NEAR(box.points[2].y_px, 50.0, screen_px);
    EXPECT_EQ(document_.history().count(), steps + 1);
    // It is seen, and told.
    EXPECT_GT(alpha_at(40, 40), 0);
    EXPECT_EQ(alpha_at(100, 60), 0);
    EXPECT_TRUE(panel_.photographs().about().contains("painted"))
        << panel_.photographs().about().toStdString();

    click("tool_lasso");
    drag({{100, 60}, {130, 60}, {130, 90}, {100, 90}});
    ASSERT_EQ(photo_setup().masked.size(), 2U);
    EXPECT_TRUE(covers(photo_setup().masked[1], {115, 75}));
    click("tool_brush");
    panel_.photographs().brush_px().setValue(10);
    drag({{150, 20}, {170, 20}});
    ASSERT_EQ(photo_setup().masked.size(), 3U);
    EXPECT_EQ(photo_setup().masked[2].brush_px, 10.0);
    EXPECT_TRUE(covers(photo_setup().masked[2], {160, 24}));
    EXPECT_FALSE(covers(photo_setup().masked[2], {160, 28}));
    EXPECT_EQ(document_.history().count(), steps + 3);

    click("tool_erase");
    QTest::mouseClick(&panel_.picture(), Qt::LeftButton, {}, on_screen(115, 75));
    ASSERT_TRUE(settle());
    ASSERT_EQ(photo_setup().masked.size(), 2U);
    EXPECT_GT(photo_setup().masked[1].brush_px, 0.0);  // the lasso's is gone
    document_.history().undo();
    EXPECT_EQ(photo_setup().masked.size(), 3U);
    // Nothing of it placed the light.
    EXPECT_EQ(photo_setup().light, "auto");
}

TEST_F(FitPhotographsTest, ADrawingIsGivenUpByEscape) {
    open_with_photo();
    click("tool_box");
    FitPictureView* view = &panel_.picture();
    QTest::mousePress(view, Qt::LeftButton, {}, on_screen(20, 30));
    QTest::mouseMove(view, on_screen(60, 60));
    QTest::keyClick(view, Qt::Key_Escape);
    QTest::mouseRelease(view, Qt::LeftButton, {}, on_screen(60, 60));
    ASSERT_TRUE(settle());
    EXPECT_TRUE(photo_setup().masked.empty());
}

TEST_F(FitPhotographsTest, ACropIsDraggedTypedAndTakenAway) {
    open_with_photo();
    click("tool_crop");
    drag({{30, 20}, {160, 110}});
    ASSERT_TRUE(photo_setup().crop);
    EXPECT_NEAR(photo_setup().crop->width_px, 130.0, 2.0 * screen_px);
    EXPECT_TRUE(panel_.photographs().about().contains("outside of the crop"));
    QTest::mouseClick(&panel_.picture(), Qt::LeftButton, {}, on_screen(80, 60));
    ASSERT_TRUE(settle());
    EXPECT_FALSE(photo_setup().crop);
    click("details");
    type("crop", "10,10,150,100");
    ASSERT_TRUE(photo_setup().crop);
    EXPECT_EQ(photo_setup().crop->height_px, 100.0);
    type("crop", "10,10");
    EXPECT_TRUE(panel_.reason().contains("WIDTH,HEIGHT")) << panel_.reason().toStdString();
    EXPECT_EQ(photo_setup().crop->height_px, 100.0);
    document_.history().undo();
    EXPECT_FALSE(photo_setup().crop);
}

TEST_F(FitPhotographsTest, PlaceAndNoiseAreTyped) {
    open_with_photo();
    FitPhotoForm& form = panel_.photographs().form();
    EXPECT_FALSE(form.isVisible());
    click("details");
    EXPECT_TRUE(form.isVisible());
    // What stands where nothing is typed: the sensor's width, and what the file says of its noise.
    EXPECT_TRUE(form.field("width").placeholderText().startsWith("36"));
    EXPECT_TRUE(form.field("noise").placeholderText().contains("by the file"));
    type("width", "30");
    type("axis", "90,60");
    type("rotation", "-2.5");
    type("noise", "1e-4,2e-6");
    type("saturation", "0.8");
    const FitPhotoSetup photo = photo_setup();
    EXPECT_EQ(photo.width_mm, 30.0);
    EXPECT_EQ(photo.axis, (FilePoint{90.0, 60.0}));
    EXPECT_EQ(photo.rotation_deg, -2.5);
    EXPECT_EQ(photo.noise->shot, 1e-4);
    EXPECT_EQ(photo.saturation, 0.8);
    // The cross stays on the light's image: it was found in the picture, wherever that lies.
    const LightSpot spot = find_light(test::flare_photo());
    const QPointF found =
        panel_.picture().on_screen({test::flare_photo().width_px - spot.column, spot.row});
    EXPECT_TRUE(panel_.picture().picture_rect().contains(found));
    for (int undone = 0; undone < 5; ++undone) {
        document_.history().undo();
    }
    EXPECT_EQ(photo_setup(), [&] {
        FitPhotoSetup plain;
        plain.file = photograph().toStdString();
        return plain;
    }());
    type("width", "wide");
    EXPECT_TRUE(panel_.reason().contains("wide"));
    EXPECT_FALSE(photo_setup().width_mm);
    type("mask", "/nowhere/mask.png");
    EXPECT_TRUE(panel_.reason().contains("mask.png")) << panel_.reason().toStdString();
    EXPECT_FALSE(panel_.button("start").isEnabled());
}

TEST_F(FitPhotographsTest, GhostsAreLeftOutByHandAndByTheNoise) {
    open_wrong();
    panel_.add_photographs({photograph()});
    type_spec("center@1");
    make_quick();
    ASSERT_TRUE(settle());
    FitGhostPage& page = panel_.variables().ghosts();
    panel_.variables().pages().setCurrentWidget(&page);
    const int all = page.model().rowCount();
    ASSERT_GT(all, 10);
    EXPECT_EQ(page.model().counted(), static_cast<std::size_t>(all));
    const auto toggle = [&](int row) {
        const QModelIndex index = page.model().index(row, FitGhostModel::ghost);
        const QRect cell = page.table().visualRect(index);
        QTest::mouseClick(page.table().viewport(), Qt::LeftButton, {},
                          QPoint(cell.left() + 10, cell.center().y()));
    };
    const std::string first = page.model().name_at(0);
    toggle(0);
    EXPECT_EQ(fit_setup_from_json(document_.fit()).left_out, first);
    EXPECT_EQ(page.model().counted(), static_cast<std::size_t>(all) - 1);
    document_.history().undo();
    EXPECT_EQ(fit_setup_from_json(document_.fit()).left_out, "");

    page.table().selectRow(1);
    click("ghosts_leave");
    const std::string gone = fit_setup_from_json(document_.fit()).left_out;
    EXPECT_FALSE(gone.empty());
    ASSERT_TRUE(settle());
    click("start");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(panel_.report()) << panel_.reason().toStdString();
    // Each ghost has one fate, and they add up.
    int fitted = 0, by_hand = 0, below = 0, elsewhere = 0;
    for (int row = 0; row < all; ++row) {
        const QString fate = page.model().index(row, FitGhostModel::fate).data().toString();
        by_hand += fate == "left out by you" ? 1 : 0;
        fitted += fate == "fitted" || fate.startsWith("not told") ? 1 : 0;
        below += fate.startsWith("below the noise: at most") ? 1 : 0;
        elsewhere += fate == "not on the photographs" ? 1 : 0;
        if (fate == "left out by you") {
            EXPECT_EQ(page.model().name_at(row), gone);
        }
    }
    EXPECT_EQ(by_hand, 1);
    EXPECT_EQ(fitted, static_cast<int>(panel_.report()->ghosts.size()));
    EXPECT_EQ(static_cast<std::size_t>(below), panel_.report()->left_out.size());
    EXPECT_EQ(fitted + by_hand + below + elsewhere, all);
    page.table().selectRow(0);
    click("ghosts_only");
    EXPECT_EQ(page.model().counted(), 1U);
    click("ghosts_all");
    EXPECT_EQ(page.model().counted(), static_cast<std::size_t>(all));
}

TEST_F(FitPhotographsTest, BracketedExposuresAreMergedInTheFit) {
    // A short one whose light alone clips, and one of eight times the time in which much of the
    // flare clips too.
    constexpr double times = 8.0;
    QTemporaryDir folder;
    write_photo(test::flare_photo(1.0, 1), 0, folder.filePath("brief.exr").toStdString());
    write_photo(test::flare_photo(times, 2), 0, folder.filePath("lengthy.exr").toStdString());
    open_wrong();
    panel_.add_photographs({folder.filePath("brief.exr")});
    type_spec("center@1");
    make_quick();
    ASSERT_TRUE(settle());
    click("start");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(panel_.report()) << panel_.reason().toStdString();
    const FittedNumber alone = panel_.report()->numbers.front();
    panel_.add_photographs({folder.filePath("lengthy.exr")});
    ASSERT_TRUE(settle());
    QTest::mouseClick(&panel_.button("merge"), Qt::LeftButton, {}, QPoint(8, 8));
    EXPECT_TRUE(fit_setup_from_json(document_.fit()).merge);
    ASSERT_TRUE(settle());
    ASSERT_EQ(panel_.reason(), "");
    click("start");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(panel_.report()) << panel_.reason().toStdString();
    ASSERT_EQ(panel_.report()->photos.size(), 1U);
    const FittedNumber& found = panel_.report()->numbers.front();
    // More light of the same flare moves the number by less than one of the short one's errors.
    EXPECT_NEAR(found.value, alone.value, alone.standard_error);
    EXPECT_EQ(found.knowledge, FitKnowledge::determined);
}

TEST_F(FitPhotographsTest, TheLossIsChosenAndKept) {
    open_with_photo();
    QComboBox& loss = panel_.variables().loss();
    loss.setFocus();
    QTest::keyClick(&loss, Qt::Key_End);
    EXPECT_EQ(fit_setup_from_json(document_.fit()).loss, FitLoss::tukey);
    QLineEdit& scale = panel_.variables().loss_scale();
    scale.setFocus();
    scale.selectAll();
    QTest::keyClicks(&scale, "6");
    QTest::keyClick(&scale, Qt::Key_Return);
    EXPECT_EQ(fit_setup_from_json(document_.fit()).loss_scale, 6.0);
    scale.selectAll();
    QTest::keyClicks(&scale, "-1");
    QTest::keyClick(&scale, Qt::Key_Return);
    EXPECT_NE(panel_.reason(), "");
    document_.history().undo();
    document_.history().undo();
    EXPECT_EQ(loss.currentText(), "Cauchy");
    EXPECT_EQ(scale.text(), "4");
}

}  // namespace
}  // namespace ghostlight
