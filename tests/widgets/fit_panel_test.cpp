// The fit panel by its own events, on a photograph made from the reference picture.

#include "widgets/panels/fit_panel.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLineEdit>
#include <QSpinBox>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/fit/light_place.h"
#include "core/io/fit_setup_json.h"
#include "core/io/varied_cells.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "tests/widgets/fit_kit.h"
#include "widgets/document.h"
#include "widgets/panels/fit_profile_page.h"
#include "widgets/panels/fit_results.h"
#include "widgets/panels/fit_variables.h"
#include "widgets/panels/line_plot.h"

namespace ghostlight {
namespace {

using test::field_deg, test::photograph, test::true_nm, test::wrong_nm;
using FitPanelTest = test::FitPanelTest;

TEST_F(FitPanelTest, SaysWhatIsMissing) {
    ASSERT_FALSE(document_.open(test::tessar()));
    ASSERT_TRUE(settle());
    EXPECT_FALSE(panel_.button("start").isEnabled());
    EXPECT_EQ(panel_.state(), "no photograph");
    panel_.add_photographs({photograph()});
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel_.state(), "nothing varies");
    EXPECT_FALSE(panel_.button("start").isEnabled());
    click("all_coatings");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(panel_.button("start").isEnabled());
    EXPECT_EQ(panel_.reason(), "");
    // One row for each coated surface, as the command line's center@all has it.
    EXPECT_EQ(static_cast<std::size_t>(panel_.model().rowCount()),
              parse_vary("center@all", document_.lens()).size());
}

TEST_F(FitPanelTest, VariesWhatIsMarkedInThePrescription) {
    ASSERT_FALSE(document_.open(test::tessar()));
    ASSERT_TRUE(settle());
    click("vary_marked");
    EXPECT_NE(panel_.reason(), "") << "nothing is marked yet";
    Prescription lens = document_.lens();
    set_varied(lens.surfaces[2], "radius", true);
    document_.edit_lens(lens, "mark a radius", "");
    ASSERT_TRUE(settle());
    click("vary_marked");
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel_.reason(), "");
    EXPECT_EQ(panel_.model().rowCount(), 1);
    EXPECT_NE(document_.fit().find("radius@3"), std::string::npos) << document_.fit();
}

TEST_F(FitPanelTest, LightIsFoundClickedAndTyped) {
    ASSERT_FALSE(document_.open(test::tessar()));
    panel_.add_photographs({photograph()});
    ASSERT_TRUE(settle());
    ASSERT_FALSE(panel_.picture().pictures().photograph.isNull());
    // Where the lens images that field: upright, the light is mirrored against the sensor.
    const auto at = image_of_light(compile(document_.lens(), d_line_nm), {field_deg, 90.0});
    ASSERT_TRUE(at);
    const Sensor& sensor = document_.lens().sensor;
    const QPointF share(0.5 - at->x_mm / sensor.width_mm, 0.5 + at->y_mm / sensor.height_mm);
    const QRectF shown = panel_.picture().picture_rect();
    const QPoint place(qRound(shown.left() + share.x() * shown.width()),
                       qRound(shown.top() + share.y() * shown.height()));
    QTest::mouseClick(&panel_.picture(), Qt::LeftButton, {}, place);
    ASSERT_TRUE(settle());
    const FitSetup clicked = fit_setup_from_json(document_.fit());
    const QStringList parts = QString::fromStdString(clicked.photos.front().light).split(',');
    ASSERT_EQ(parts.size(), 2);
    // A pixel of the screen is less than a pixel of this photograph.
    EXPECT_NEAR(parts[0].toDouble(), share.x() * 192.0, 1.0);
    EXPECT_NEAR(parts[1].toDouble(), share.y() * 128.0, 1.0);
    EXPECT_EQ(panel_.light().text(), QString::fromStdString(clicked.photos.front().light));

    panel_.light().setFocus();
    panel_.light().selectAll();
    QTest::keyClicks(&panel_.light(), "deg:5:90");
    QTest::keyClick(&panel_.light(), Qt::Key_Return);
    ASSERT_TRUE(settle());
    EXPECT_EQ(fit_setup_from_json(document_.fit()).photos.front().light, "deg:5:90");
    EXPECT_EQ(panel_.reason(), "");
    click("find");
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel_.light().text(), "auto");

    panel_.light().setFocus();
    panel_.light().selectAll();
    QTest::keyClicks(&panel_.light(), "somewhere");
    QTest::keyClick(&panel_.light(), Qt::Key_Return);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(panel_.reason().contains("somewhere")) << panel_.reason().toStdString();
    EXPECT_FALSE(panel_.button("start").isEnabled());
}

TEST_F(FitPanelTest, BadPhotographsAreRefusedInWords) {
    ASSERT_FALSE(document_.open(test::tessar()));
    QTemporaryDir folder;
    const auto expect_refused = [&](const QString& file, const QString& word) {
        panel_.add_photographs({file});
        ASSERT_TRUE(settle());
        EXPECT_TRUE(panel_.reason().contains(word, Qt::CaseInsensitive))
            << file.toStdString() << ": " << panel_.reason().toStdString();
        EXPECT_FALSE(panel_.button("start").isEnabled());
        click("remove");
        ASSERT_TRUE(settle());
        EXPECT_EQ(fit_setup_from_json(document_.fit()).photos.size(), 0U);
    };
    QImage picture(192, 128, QImage::Format_RGB32);
    picture.fill(Qt::black);
    ASSERT_TRUE(picture.save(folder.filePath("black.png")));
    expect_refused(folder.filePath("black.png"), "black");
    picture.fill(Qt::white);
    ASSERT_TRUE(picture.save(folder.filePath("white.png")));
    expect_refused(folder.filePath("white.png"), "saturated");
    QImage turned(128, 192, QImage::Format_RGB32);
    for (int y = 0; y < turned.height(); ++y)
        for (int x = 0; x < turned.width(); ++x) turned.setPixel(x, y, qRgb(60 + y / 4, 50, x));
    turned.setPixel(40, 60, qRgb(255, 255, 255));
    ASSERT_TRUE(turned.save(folder.filePath("turned.png")));
    expect_refused(folder.filePath("turned.png"), "turned by 90");
    std::ofstream(folder.filePath("broken.cr2").toStdString()) << "no picture";
    expect_refused(folder.filePath("broken.cr2"), "broken.cr2");
}

TEST_F(FitPanelTest, WhatVariesIsTypedMarkedAndUndone) {
    ASSERT_FALSE(document_.open(test::tessar()));
    type_spec("center@1=480..620~25");
    ASSERT_EQ(panel_.model().rowCount(), 1);
    const FitParameter& typed = panel_.model().rows().front().parameter;
    EXPECT_EQ(typed.lower, 480.0);
    EXPECT_EQ(typed.upper, 620.0);
    EXPECT_EQ(typed.prior, 25.0);
    // The same through the table's own editor.
    const QModelIndex prior = panel_.model().index(0, FitParameterModel::prior);
    EXPECT_TRUE(panel_.model().setData(prior, "12.5", Qt::EditRole));
    QCoreApplication::processEvents();
    EXPECT_EQ(panel_.model().rows().front().parameter.prior, 12.5);
    EXPECT_FALSE(panel_.model().setData(panel_.model().index(0, FitParameterModel::lower), "600",
                                        Qt::EditRole));
    EXPECT_NE(panel_.reason(), "");
    EXPECT_EQ(panel_.model().rows().front().parameter.lower, 480.0);
    // Held, it stays in the list.
    EXPECT_TRUE(panel_.model().setData(panel_.model().index(0, FitParameterModel::what),
                                       Qt::Unchecked, Qt::CheckStateRole));
    QCoreApplication::processEvents();
    EXPECT_FALSE(panel_.model().rows().front().varies);
    EXPECT_EQ(fit_setup_from_json(document_.fit()).vary, "");
    type_spec("center@99");
    EXPECT_TRUE(panel_.reason().contains("99")) << panel_.reason().toStdString();
    document_.history().undo();
    EXPECT_TRUE(panel_.model().rows().front().varies);
    document_.history().undo();
    document_.history().undo();
    EXPECT_EQ(panel_.model().rowCount(), 0);
}

TEST_F(FitPanelTest, SetUpIsSavedWithTheLens) {
    QTemporaryDir folder;
    const QString photo = folder.filePath("pictures/flare.exr");
    ASSERT_TRUE(QDir().mkpath(folder.filePath("pictures")));
    ASSERT_TRUE(QFile::copy(photograph(), photo));
    ASSERT_FALSE(document_.open(test::tessar()));
    panel_.add_photographs({photo});
    type_spec("center@1~25");
    ASSERT_TRUE(settle());
    EXPECT_FALSE(document_.is_modified());  // the lens is as it was
    const std::filesystem::path file = folder.filePath("lens.json").toStdString();
    ASSERT_FALSE(document_.save_as(file));
    // The folder moves as a whole.
    QTemporaryDir elsewhere;
    std::filesystem::copy(folder.path().toStdString(), elsewhere.path().toStdString(),
                          std::filesystem::copy_options::recursive |
                              std::filesystem::copy_options::overwrite_existing);
    Document other;
    ASSERT_FALSE(other.open(elsewhere.filePath("lens.json").toStdString()));
    const FitSetup read = fit_setup_from_json(other.fit());
    ASSERT_EQ(read.photos.size(), 1U);
    EXPECT_EQ(QString::fromStdString(read.photos.front().file),
              elsewhere.filePath("pictures/flare.exr"));
    EXPECT_EQ(parse_vary(read.vary, other.lens()).front().prior, 25.0);
    EXPECT_EQ(other.lens(), document_.lens());
}

TEST_F(FitPanelTest, FitFindsTheCoatingAndAppliesItAsOneStep) {
    open_wrong();
    panel_.add_photographs({photograph()});
    type_spec("center@1");
    make_quick();
    ASSERT_TRUE(settle());
    ASSERT_EQ(panel_.reason(), "");
    click("start");
    EXPECT_TRUE(panel_.is_running());
    ASSERT_TRUE(settle());
    ASSERT_EQ(panel_.reason(), "");
    ASSERT_TRUE(panel_.report());
    const FittedNumber& found = panel_.report()->numbers.front();
    // Four standard errors: a miss of one in 16,000.
    EXPECT_NEAR(found.value, true_nm, 4.0 * found.standard_error);
    EXPECT_EQ(found.knowledge, FitKnowledge::determined);
    EXPECT_FALSE(panel_.results().costs().curves().empty());
    EXPECT_FALSE(panel_.results().reflectances().curves().empty());
    EXPECT_TRUE(
        panel_.results().words().contains(QString::fromStdString(panel_.report()->verdict)));
    const auto shown = [&](FitParameterModel::Column column) {
        return panel_.model().index(0, column).data().toString();
    };
    EXPECT_NEAR(shown(FitParameterModel::fitted).toDouble(), found.value, 0.1);
    EXPECT_EQ(shown(FitParameterModel::known), "determined");
    for (const char* mode : {"mode_model", "mode_difference", "mode_overlay", "mode_blink"}) {
        click(mode);
        EXPECT_FALSE(panel_.picture().shown().isNull()) << mode;
    }

    QTemporaryDir folder;
    ASSERT_TRUE(panel_.save_report(folder.filePath("fit.html")));
    std::ifstream page(folder.filePath("fit.html").toStdString());
    std::stringstream text;
    text << page.rdbuf();
    EXPECT_NE(text.str().find(panel_.report()->verdict), std::string::npos);

    const int steps = document_.history().count();
    click("apply");
    EXPECT_EQ(document_.history().count(), steps + 1);
    EXPECT_EQ(center_nm(), found.value);
    document_.history().undo();
    EXPECT_EQ(center_nm(), wrong_nm);
}

TEST_F(FitPanelTest, KindOfCoatingIsChosenAndApplied) {
    // Surface 1 is listed with a single layer of index 1.7, which the photograph's lens has not.
    ASSERT_FALSE(document_.open(test::tessar()));
    Prescription wrong = document_.lens();
    const Coating truth = wrong.surfaces[0].coating;
    std::get<QuarterWave>(wrong.surfaces[0].coating).layer = Medium{{}, ConstantIndex{1.7}};
    document_.edit_lens(wrong, "another layer");
    panel_.add_photographs({photograph()});
    type_spec("center@1");
    make_quick();
    ASSERT_TRUE(settle());
    const auto type = [&](const char* field, const char* text) {
        auto* edit = panel_.findChild<QLineEdit*>(field);
        ASSERT_NE(edit, nullptr) << field;
        edit->setFocus();
        edit->selectAll();
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
        ASSERT_TRUE(settle());
    };
    type("fit_kinds", "none, glossy");
    EXPECT_TRUE(panel_.reason().contains("glossy")) << panel_.reason().toStdString();
    type("fit_kinds", "none, qw:550");
    EXPECT_EQ(panel_.reason(), "");
    type("fit_kind_rows", "99");
    EXPECT_TRUE(panel_.reason().contains("99")) << panel_.reason().toStdString();
    type("fit_kind_rows", "1");
    EXPECT_EQ(panel_.reason(), "");
    const FitSetup setup = fit_setup_from_json(document_.fit());
    EXPECT_EQ(setup.kinds, "none,qw:550");
    EXPECT_EQ(setup.kind_rows, "1");
    click("start");
    ASSERT_TRUE(settle());
    ASSERT_EQ(panel_.reason(), "");
    ASSERT_TRUE(panel_.report());
    ASSERT_EQ(panel_.report()->kinds.size(), 1U);
    EXPECT_EQ(panel_.report()->kinds.front().tried.front().name, "qw:550");
    const int steps = document_.history().count();
    click("apply");
    EXPECT_EQ(document_.history().count(), steps + 1);
    const auto* applied = std::get_if<QuarterWave>(&document_.lens().surfaces[0].coating);
    ASSERT_NE(applied, nullptr);
    EXPECT_EQ(applied->layer, std::get<QuarterWave>(truth).layer);
    document_.history().undo();
    EXPECT_EQ(document_.lens().surfaces[0].coating, wrong.surfaces[0].coating);
}

TEST_F(FitPanelTest, CancelledFitKeepsItsBestIteration) {
    open_wrong();
    panel_.add_photographs({photograph()});
    type_spec("center@all");
    make_quick();
    ASSERT_TRUE(settle());
    click("start");
    // Until there is a first step, and then no further.
    ASSERT_TRUE(QTest::qWaitFor(
        [this] { return !panel_.results().costs().curves().empty() || !panel_.is_running(); },
        test::patience_ms));
    ASSERT_TRUE(panel_.is_running());
    click("pause");
    // Said only when it is so: the step in work ends first.
    ASSERT_TRUE(
        QTest::qWaitFor([this] { return panel_.state().startsWith("paused"); }, test::patience_ms));
    const auto points = [this] { return panel_.results().costs().curves().front().points.size(); };
    const auto before = points();
    QTest::qWait(300);
    EXPECT_EQ(points(), before);
    EXPECT_TRUE(panel_.is_running());
    click("cancel");
    EXPECT_FALSE(panel_.is_running());  // at once
    EXPECT_TRUE(panel_.state().contains("best so far"));
    ASSERT_TRUE(QTest::qWaitFor([this] { return panel_.state().startsWith("stopped"); },
                                test::patience_ms));
    EXPECT_FALSE(panel_.report());
    EXPECT_TRUE(panel_.button("apply").isEnabled());
    EXPECT_FALSE(panel_.button("report").isEnabled());
    click("apply");
    EXPECT_NE(center_nm(), wrong_nm);
    document_.history().undo();
    EXPECT_EQ(center_nm(), wrong_nm);
}

TEST_F(FitPanelTest, IntervalsAreProfiledAndDrawnOnRequest) {
    open_wrong();
    panel_.add_photographs({photograph()});
    type_spec("center@1");
    make_quick();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(panel_.button("profile").isEnabled());
    panel_.table().selectRow(0);
    click("profile");
    EXPECT_EQ(fit_setup_from_json(document_.fit()).profiled,
              fit_setup_from_json(document_.fit()).vary);
    EXPECT_EQ(panel_.model().index(0, FitParameterModel::interval).data().toString(), "profile");
    panel_.variables().bootstrap().setValue(4);
    EXPECT_EQ(fit_setup_from_json(document_.fit()).bootstrap, 4);
    ASSERT_TRUE(settle());
    click("start");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(panel_.report()) << panel_.reason().toStdString();
    ASSERT_EQ(panel_.report()->profiles.size(), 1U);
    EXPECT_TRUE(
        panel_.model().index(0, FitParameterModel::interval).data().toString().endsWith(" P"));
    FitProfilePage& page = panel_.results().profiles();
    EXPECT_EQ(page.numbers().count(), 1);
    EXPECT_EQ(page.plot().curves().size(), 3U);
    EXPECT_TRUE(page.words().contains("profile") && page.words().contains("bootstrap"))
        << page.words().toStdString();
    panel_.table().selectRow(0);
    click("profile");
    EXPECT_EQ(fit_setup_from_json(document_.fit()).profiled, "");
    document_.history().undo();
    EXPECT_NE(fit_setup_from_json(document_.fit()).profiled, "");
}

}  // namespace
}  // namespace ghostlight
