// The panels beside the prescription: coating, configurations, glasses; each alone, with real keys
// and clicks, and once together in the window.

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSignalSpy>
#include <QSlider>
#include <QTableView>
#include <QToolButton>

#include <cmath>

#include "core/ghosts/surface_ghosts.h"
#include "core/io/coating_library.h"
#include "core/optics/between_configurations.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/widgets/window_kit.h"
#include "widgets/actions.h"
#include "widgets/coating_edits.h"
#include "widgets/configuration_edits.h"
#include "widgets/glass_map_view.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/prescription_model.h"
#include "widgets/number_text.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/coating_panel.h"
#include "widgets/panels/configuration_panel.h"
#include "widgets/panels/curve_chart.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/glass_panel.h"
#include "widgets/panels/number_handle.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/scene_bar.h"
#include "widgets/panels/scene_field.h"
#include "widgets/selection.h"

namespace ghostlight {
namespace {

void drag(QWidget& on, QPoint from, QPoint to) {
    QTest::mousePress(&on, Qt::LeftButton, {}, from);
    constexpr int steps = 10;
    for (int k = 1; k <= steps; ++k) {
        const QPoint at = from + (to - from) * k / steps;
        QMouseEvent move(QEvent::MouseMove, at, on.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                         {});
        QCoreApplication::sendEvent(&on, &move);
        QTest::qWait(2);
    }
    QTest::mouseRelease(&on, Qt::LeftButton, {}, to);
}

void show(QWidget& panel) {
    panel.resize(520, 620);
    panel.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&panel));
    panel.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&panel));
    QTest::qWait(20);
}

/// Types into a cell of a table, as with F2.
void type_into(QTableView& table, int row, int column, const QString& text) {
    table.setFocus();
    table.setCurrentIndex(table.model()->index(row, column));
    table.edit(table.currentIndex());
    auto* editor = table.viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    editor->selectAll();
    QTest::keyClicks(editor, text);
    QTest::keyClick(editor, Qt::Key_Return);
    QTest::qWait(10);
}

struct ConfigurationPanelTest : testing::Test {
    ConfigurationPanelTest() {
        EXPECT_FALSE(document.open(test::bundled("nikon_zoom_80_200_f2.8.json")));
        show(panel);
    }
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const Configuration& known : document.lens().configurations) {
            all.push_back(known.name);
        }
        return all;
    }
    const std::string& chosen() const { return document.scene().configuration; }

    Document document;
    ConfigurationPanel panel{document};
    QAbstractItemModelTester tester{panel.table().model(),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(ConfigurationPanelTest, PositionsAreAddedRenamedAndRemoved) {
    const DocumentState before = document.state();
    const auto at_first = names();
    QTest::mouseClick(panel.table().viewport(), Qt::LeftButton, {},
                      panel.table().visualRect(panel.table().model()->index(1, 0)).center());
    EXPECT_EQ(chosen(), at_first.front());
    QTest::mouseClick(&panel.add(), Qt::LeftButton);
    QTest::qWait(10);
    ASSERT_EQ(names().size(), at_first.size() + 1);
    EXPECT_EQ(chosen(), names().back());
    EXPECT_EQ(document.lens().configurations.back().thickness_mm,
              document.lens().configurations.front().thickness_mm)
        << "like the one that was in hand";
    const int row = static_cast<int>(names().size());
    type_into(panel.table(), row, 0, "portrait");
    EXPECT_EQ(names().back(), "portrait");
    EXPECT_EQ(chosen(), "portrait");
    QSignalSpy refused(&panel, &ConfigurationPanel::refused);
    type_into(panel.table(), row, 0, QString::fromStdString(at_first.front()));
    EXPECT_EQ(names().back(), "portrait") << "that name is taken";
    ASSERT_FALSE(refused.isEmpty());
    EXPECT_TRUE(refused.back()[0].toString().contains("taken"));
    EXPECT_EQ(panel.table().model()->index(row, 0).data().toString(), "portrait");
    QTest::mouseClick(&panel.remove(), Qt::LeftButton);
    EXPECT_EQ(names(), at_first);
    while (document.history().canUndo()) {
        document.history().undo();
    }
    EXPECT_EQ(document.state(), before);
}

TEST_F(ConfigurationPanelTest, TheSliderGoesFromOneToTheOtherInOneStep) {
    const DocumentState before = document.state();
    const std::string first = names().front(), last = names().back();
    const auto efl_mm = [&] {
        return first_order(compile(document.configured_lens(), d_line_nm)).efl_mm;
    };
    Scene scene = document.scene();
    scene.configuration = first;
    document.edit_scene(scene, "choose");
    const double short_mm = efl_mm();
    QTest::qWait(10);
    QSlider& slider = panel.slider();
    const QPoint handle(8, slider.height() / 2);
    const int steps = document.history().count();
    drag(slider, handle, QPoint(slider.width() / 2, slider.height() / 2));
    EXPECT_EQ(document.history().count(), steps + 1);
    EXPECT_EQ(chosen(), name_between(first, last));
    const double share = slider.value() / 1000.0;
    EXPECT_NEAR(share, 0.5, 0.1);
    EXPECT_EQ(document.lens().configurations.back().thickness_mm,
              between_configurations(before.lens, first, last, share).thickness_mm);
    EXPECT_GT(efl_mm(), short_mm);
    document.history().undo();
    document.history().undo();
    EXPECT_EQ(document.state(), before);
}

TEST(ConfigurationEditsTest, ALensWithoutPositionsGetsItsFirst) {
    Document document;
    ASSERT_FALSE(document.open(test::tessar()));
    ASSERT_TRUE(document.lens().configurations.empty());
    const DocumentState added = with_configuration_added(document.state());
    ASSERT_EQ(added.lens.configurations.size(), 1U);
    EXPECT_EQ(added.scene.configuration, added.lens.configurations[0].name);
    EXPECT_EQ(with_configuration_removed(added, added.scene.configuration), document.state());
    EXPECT_THROW(with_configuration_removed(added, ""), Error);
    EXPECT_THROW(with_configuration_renamed(added, added.scene.configuration, ""), Error);
    EXPECT_THROW(with_configuration_renamed(added, added.scene.configuration, "as listed"), Error);
}

struct CoatingPanelTest : testing::Test {
    CoatingPanelTest() {
        EXPECT_FALSE(document.open(test::tessar()));
        show(panel);
        panel.set_row(0);
        QTest::qWait(10);
    }
    const Coating& coating(std::size_t row = 0) const {
        return document.lens().surfaces[row].coating;
    }
    void choose(const QString& kind) {
        panel.kind().setFocus();
        panel.kind().setCurrentText(kind);
        Q_EMIT panel.kind().activated(panel.kind().currentIndex());
        QTest::qWait(10);
    }

    Document document;
    Selection selection;
    QWidget window;
    Actions actions{&window};
    CoatingPanel panel{document, selection, actions};
    QAbstractItemModelTester tester{panel.layers().model(),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(CoatingPanelTest, LayersKeepAQuarterWavesFilm) {
    choose("Quarter wave, MgF2");
    const Coating quarter = coating();
    const Medium& glass = document.lens().surfaces[0].medium_after;
    choose("Layers");
    ASSERT_TRUE(std::holds_alternative<LayerStack>(coating()));
    // The same layer at the centre wavelength, and the same dispersion.
    for (const double nm : {450.0, 550.0, 650.0}) {
        EXPECT_NEAR(reflectances(film_at(coating(), Medium{}, glass, nm), 0.8).r(),
                    reflectances(film_at(quarter, Medium{}, glass, nm), 0.8).r(), 1e-12);
    }
    type_into(panel.layers(), 0, 3, "=550/4/1.38");
    EXPECT_EQ(std::get<LayerStack>(coating()).layers[0].thickness_nm, 550.0 / 4.0 / 1.38);
    type_into(panel.layers(), 0, 1, "1.46");
    EXPECT_EQ(std::get<LayerStack>(coating()).layers[0].medium.dispersion,
              Dispersion(ConstantIndex{1.46}));
    const Coating before = coating();
    QSignalSpy refused(&panel, &CoatingPanel::refused);
    type_into(panel.layers(), 0, 3, "-5");
    EXPECT_EQ(coating(), before);
    EXPECT_FALSE(refused.isEmpty());
    QTest::qWait(10);
    EXPECT_NE(panel.layers().model()->index(0, 3).data().toString(), "-5") << "it gives way";
    EXPECT_EQ(document.history().undoText(), "change coating of surface 1");
}

TEST_F(CoatingPanelTest, TheLibraryIsAtHand) {
    for (const LibraryCoating& known : coating_library()) {
        choose(QString::fromStdString(known.name));
        EXPECT_EQ(coating(), known.coating) << known.name;
        QTest::qWait(5);
        if (std::holds_alternative<LayerStack>(known.coating)) {
            EXPECT_EQ(panel.kind().currentText().toStdString(), known.name);
        }
    }
}

TEST_F(CoatingPanelTest, ACoatingIsCopiedToManySurfacesInOneStep) {
    choose("Constant R");
    const Prescription before = document.lens();
    const int steps = document.history().count();
    panel.targets().setFocus();
    QTest::keyClicks(&panel.targets(), "2-3, 8");
    QTest::keyClick(&panel.targets(), Qt::Key_Return);
    for (const std::size_t row : {1U, 2U, 7U}) {
        EXPECT_EQ(coating(row), coating(0)) << row;
    }
    EXPECT_EQ(coating(5), before.surfaces[5].coating);
    EXPECT_EQ(document.history().count(), steps + 1);
    document.history().undo();
    EXPECT_EQ(document.lens(), before);
    for (const char* bad : {"", "9", "0", "3-2", "a", "1-2-3", "1-"}) {
        EXPECT_THROW(read_surfaces(bad, 8), Error) << bad;
    }
    EXPECT_EQ(read_surfaces(" 2 - 4,1,3 ", 8), (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST_F(CoatingPanelTest, CurvesAreTheFilmsAndGhostsAreMarked) {
    choose("MgF2");  // no such kind: nothing happens
    GhostTableRequest request;
    request.light = document.scene().light().direction;
    request.tolerance = 0.5;
    request.peaks = false;
    auto table = ghost_table(document.lens(), request);
    ASSERT_TRUE(table);
    const auto fed = ghosts_of_surface(*table, 0);
    ASSERT_GE(fed.size(), 2U);
    panel.set_table(std::make_shared<const GhostTable>(*table));
    QTest::qWait(10);
    for (int k = 0; k < 2; ++k) {
        EXPECT_TRUE(panel.ghosts_text().contains(QString::fromStdString(name(fed[k].path))));
    }
    const auto& marks = panel.over_angle_chart().marks();
    ASSERT_FALSE(marks.empty());
    EXPECT_EQ(marks[0].at, fed[0].turn.incidence_deg);
    EXPECT_EQ(marks[0].to, fed[0].turn.largest_incidence_deg);
    const auto& curves = panel.over_angle_chart().curves();
    ASSERT_EQ(curves.size(), 3U);
    const Medium& glass = document.lens().surfaces[0].medium_after;
    Film film = film_at(coating(), Medium{}, glass, 550.0);
    if (!fed[0].from_front) film = reversed(film);
    for (std::size_t k = 0; k < curves[2].points.size(); k += 20) {
        const QPointF at = curves[2].points[k];
        const Reflectances there = reflectances(film, std::cos(rad_from_deg(at.x())));
        EXPECT_NEAR(at.y(), 100.0 * there.r(), 1e-9) << at.x();
        EXPECT_NEAR(curves[0].points[k].y(), 100.0 * there.r_s, 1e-9) << at.x();
    }
}

struct GlassPanelTest : testing::Test {
    GlassPanelTest() {
        EXPECT_FALSE(document.open(test::tessar()));
        show(panel);
        panel.set_row(0);
        QTest::qWait(20);
    }
    std::string first() const {
        return panel.found().empty() ? std::string()
                                     : panel.glasses()[panel.found().front()].glass.medium.name;
    }

    Document document;
    GlassPanel panel{document};
    QAbstractItemModelTester tester{panel.table().model(),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(GlassPanelTest, AGlassIsSearchedForAndUsed) {
    const Prescription before = document.lens();
    EXPECT_FALSE(panel.use().isEnabled());
    panel.search().setFocus();
    QTest::keyClicks(&panel.search(), "nbk7");
    EXPECT_EQ(first(), "N-BK7");
    QTest::keyClick(&panel.search(), Qt::Key_Return);
    ASSERT_TRUE(panel.use().isEnabled());
    QTest::mouseClick(&panel.use(), Qt::LeftButton);
    EXPECT_EQ(document.lens().surfaces[0].medium_after.name, "N-BK7");
    EXPECT_EQ(document.history().undoText(), "put N-BK7 behind surface 1");
    document.history().undo();
    EXPECT_EQ(document.lens(), before);
    QTest::keyClicks(&panel.search(), "zzz");
    EXPECT_EQ(panel.table().model()->rowCount(), 0);
    EXPECT_FALSE(panel.use().isEnabled());
}

TEST_F(GlassPanelTest, TheNearestIsTheNearestThereIs) {
    const Medium model = document.lens().surfaces[0].medium_after;
    QTest::mouseClick(&panel.nearest(), Qt::LeftButton);
    const Medium& put = document.lens().surfaces[0].medium_after;
    ASSERT_FALSE(put.name.empty());
    const auto off = [&](double nd, double vd) {
        return std::hypot(nd - refractive_index(model, d_line_nm),
                          0.01 * (vd - abbe_number(model)));
    };
    const double there = off(refractive_index(put, d_line_nm), abbe_number(put));
    for (const MappedGlass& other : panel.glasses()) {
        EXPECT_LE(there, off(other.nd, other.vd) + 1e-9) << other.glass.medium.name;
    }
}

TEST_F(GlassPanelTest, AClickOnTheMapChooses) {
    panel.search().setFocus();
    QTest::keyClicks(&panel.search(), "N-SF6");
    ASSERT_FALSE(panel.found().empty());
    const std::size_t wanted = panel.found().front();
    const QPoint at = panel.map().place(panel.glasses()[wanted]).toPoint();
    QTest::mouseClick(&panel.map(), Qt::LeftButton, {}, at);
    EXPECT_TRUE(panel.use().isEnabled());
    EXPECT_EQ(panel.table().currentIndex().row(), 0);
}

/// In the window: the flare follows a drag of the handle while it moves, and all of it is one step.
TEST(EditingTest, TheFlareFollowsTheHandleSlow) {
    test::OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());
    const Prescription before = window.document().lens();
    PrescriptionPanel& panel = window.prescription_panel();
    EXPECT_EQ(panel.handle().editor().text(), "42.97") << "the first surface is in hand at first";
    panel.table().setFocus();
    panel.table().setCurrentIndex(panel.model().index(0, PrescriptionModel::thickness));
    const int steps = window.document().history().count();
    const auto first_revision = window.document().revision();
    QSlider& slider = panel.handle().slider();
    const QPoint from = slider.rect().center();
    QTest::mousePress(&slider, Qt::LeftButton, {}, from);
    const auto move_to = [&](int px) {
        const QPoint at = from + QPoint(px, 0);
        QMouseEvent move(QEvent::MouseMove, at, slider.mapToGlobal(at), Qt::NoButton,
                         Qt::LeftButton, {});
        QCoreApplication::sendEvent(&slider, &move);
    };
    int pictures = 0;
    auto shown_revision = window.picture()->revision;
    for (int k = 1; k <= 20; ++k) {
        move_to(2 * k);
        // The hand waits until something new is seen, as a slow one does.
        EXPECT_TRUE(QTest::qWaitFor([&] { return window.picture()->revision > shown_revision; },
                                    test::patience_ms));
        pictures += window.picture()->revision > shown_revision;
        shown_revision = window.picture()->revision;
    }
    EXPECT_GT(pictures, 10) << "pictures of the lens on its way, before the button is up";
    EXPECT_GT(shown_revision, first_revision);
    QTest::mouseRelease(&slider, Qt::LeftButton, {}, from + QPoint(40, 0));
    EXPECT_EQ(window.document().history().count(), steps + 1);
    window.document().history().undo();
    EXPECT_EQ(window.document().lens(), before);
    // The coating panel is about the row in hand, with the ghosts of the table that is there.
    ASSERT_TRUE(shown.settle());
    QTest::qWait(10);
    const auto fed = ghosts_of_surface(*window.ghost_panel().model().table(), 0);
    EXPECT_TRUE(
        window.coating_panel().ghosts_text().contains(QString::fromStdString(name(fed[0].path))));
}

TEST(EditingTest, ANameInTheSceneBarIsDragged) {
    test::OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    const double before_deg = window.document().scene().light().direction.field_deg;
    auto* name = window.scene_bar().field().findChild<QLabel*>();
    ASSERT_NE(name, nullptr);
    const int steps = window.document().history().count();
    drag(*name, QPoint(4, 4), QPoint(64, 4));
    EXPECT_GT(window.document().scene().light().direction.field_deg, before_deg);
    EXPECT_EQ(window.document().history().count(), steps + 1);
}

}  // namespace
}  // namespace ghostlight
