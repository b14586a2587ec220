#include "widgets/understanding.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QDockWidget>
#include <QHeaderView>
#include <QLineEdit>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QSlider>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QTreeView>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/flare/false_color.h"
#include "tests/widgets/window_kit.h"
#include "widgets/flare_view.h"
#include "widgets/layout_view.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/surface_sums_model.h"
#include "widgets/panels/check_panel.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_matrix.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/layout_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/sweep_panel.h"
#include "widgets/panels/sweep_view.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

std::filesystem::path triplet() { return test::bundled("cooke_triplet_50_f5.json"); }

void click(QWidget& on, QPointF at, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    for (const auto& [type, buttons] : {std::pair{QEvent::MouseButtonPress, Qt::LeftButton},
                                        {QEvent::MouseButtonRelease, Qt::NoButton}}) {
        QMouseEvent event(type, at, on.mapToGlobal(at), Qt::LeftButton, buttons, modifiers);
        QCoreApplication::sendEvent(&on, &event);
    }
}

void move(QWidget& on, QPointF at, Qt::MouseButtons buttons = Qt::NoButton) {
    QMouseEvent event(QEvent::MouseMove, at, on.mapToGlobal(at), Qt::NoButton, buttons,
                      Qt::NoModifier);
    QCoreApplication::sendEvent(&on, &event);
}

void drag(QWidget& on, QPointF from, QPointF to) {
    QMouseEvent press(QEvent::MouseButtonPress, from, on.mapToGlobal(from), Qt::LeftButton,
                      Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&on, &press);
    move(on, (from + to) / 2.0, Qt::LeftButton);
    move(on, to, Qt::LeftButton);
    QMouseEvent release(QEvent::MouseButtonRelease, to, on.mapToGlobal(to), Qt::LeftButton,
                        Qt::NoButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&on, &release);
}

TEST(GhostPanelLooks, WordsSayWhichGhostsAreListed) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    GhostPanel& panel = shown.window.ghost_panel();
    const QAbstractItemModel* listed = panel.table().model();
    ASSERT_EQ(listed->rowCount(), 15);  // pairs of six surfaces
    QTest::keyClicks(&panel.filter_line(), "touches 1");
    EXPECT_EQ(panel.filter_problem(), "");
    EXPECT_EQ(listed->rowCount(), 5);  // 1 with each of the five others
    for (int row = 0; row < listed->rowCount(); ++row) {
        EXPECT_TRUE(listed->index(row, 0).data().toString().endsWith("-1"));
    }
    QTest::keyClicks(&panel.filter_line(), " and bright");
    EXPECT_TRUE(panel.filter_problem().contains("'bright'"));
    EXPECT_EQ(listed->rowCount(), 5);  // as it was, while it is not understood
    panel.filter_line().clear();
    EXPECT_EQ(panel.filter_problem(), "");
    EXPECT_EQ(listed->rowCount(), 15);
}

TEST(GhostPanelLooks, WhatIsFilteredAwayStaysSelected) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    GhostPanel& panel = shown.window.ghost_panel();
    panel.table().selectRow(0);
    const auto selected = shown.window.selection().ghosts();
    ASSERT_EQ(selected.size(), 1U);
    panel.filter_line().setText("below 1e-12");
    EXPECT_EQ(panel.table().model()->rowCount(), 0);
    EXPECT_EQ(shown.window.selection().ghosts(), selected);
    panel.filter_line().clear();
    EXPECT_TRUE(panel.table().selectionModel()->hasSelection());
}

TEST(GhostPanelLooks, MatrixSelectsForAllViews) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    window.actions()["ghosts.as_matrix"].trigger();
    GhostMatrix& matrix = window.ghost_panel().matrix();
    ASSERT_TRUE(matrix.isVisible());
    const GhostTable& table = *window.ghost_panel().model().table();
    const GhostPath strongest = table.ghosts.front().path, weakest = table.ghosts.back().path;
    click(matrix, matrix.cell_of(strongest)->center());
    EXPECT_EQ(window.selection().ghosts(), (std::vector{strongest}));
    click(matrix, matrix.cell_of(weakest)->center(), Qt::ControlModifier);
    EXPECT_EQ(window.selection().ghosts(), (std::vector{strongest, weakest}));
    // The cell has the colour of its flux, the strongest that of the scale's end.
    const auto top = false_color(1.0F);
    const QColor cell = matrix.grab().toImage().pixelColor(
        (matrix.cell_of(table.ghosts[1].path)->center() * matrix.devicePixelRatio()).toPoint());
    EXPECT_EQ(cell.rgb(), matrix.color_of(table.ghosts[1].flux_mm2).rgb());
    EXPECT_NEAR(matrix.color_of(table.ghosts.front().flux_mm2).redF(), top[0], 0.01);
    EXPECT_FALSE(matrix.cell_of(GhostPath{{1, 1}}));
    // Table and matrix show one selection.
    window.actions()["ghosts.as_table"].trigger();
    EXPECT_EQ(window.ghost_panel().table().selectionModel()->selectedRows().size(), 2);
}

TEST(GhostPanelLooks, SurfacesAreSummed) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    window.actions()["ghosts.as_surfaces"].trigger();
    QTreeView& sums = window.ghost_panel().surfaces();
    ASSERT_TRUE(sums.isVisible());
    auto& model = dynamic_cast<SurfaceSumsModel&>(*sums.model());
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    ASSERT_EQ(model.rowCount(), 6);
    double all = 0.0, twice = 0.0;
    for (const GhostRow& row : window.ghost_panel().model().table()->ghosts) {
        all += row.flux_mm2;
    }
    for (int row = 0; row < model.rowCount(); ++row) {
        twice += model.sum(row).sum.flux_mm2;
    }
    EXPECT_NEAR(twice, 2.0 * all, 1e-9 * all);  // each ghost at both of its surfaces
    // A surface lists its ghosts.
    const QModelIndex group = model.index(0, 0);
    const std::size_t surface = model.sum(0).surface;
    QTest::mouseClick(sums.viewport(), Qt::LeftButton, {}, sums.visualRect(group).center());
    EXPECT_EQ(window.ghost_panel().filter_line().text(),
              QStringLiteral("touches %1").arg(surface + 1));
    // The right arrow opens the group: its ghosts, which add up to its total.
    QTest::keyClick(&sums, Qt::Key_Right);
    ASSERT_TRUE(sums.isExpanded(group));
    double in_group = 0.0;
    for (int row = 0; row < model.rowCount(group); ++row) {
        const GhostRow& ghost = *model.ghost(model.index(row, 0, group));
        EXPECT_TRUE(std::ranges::count(ghost.path.reflections, surface) > 0);
        in_group += ghost.flux_mm2;
    }
    EXPECT_NEAR(in_group, model.sum(0).sum.flux_mm2, 1e-9 * all);
    // One of them, and it is chosen in every view, in the group of its other surface as well.
    QTest::keyClick(&sums, Qt::Key_Down);
    const GhostPath strongest = model.ghost(model.index(0, 0, group))->path;
    EXPECT_EQ(window.selection().ghosts(), std::vector<GhostPath>{strongest});
    EXPECT_EQ(window.ghost_panel().table().selectionModel()->selectedRows().size(), 1);
    // What is open stays open while the table is worked out anew.
    Prescription lens = window.document().lens();
    lens.surfaces[0].semi_diameter_mm *= 0.99;
    window.document().edit_lens(lens, "make the front smaller");
    ASSERT_TRUE(shown.settle());
    EXPECT_TRUE(sums.isExpanded(model.group_of(surface)));
    EXPECT_EQ(window.selection().ghosts(), std::vector<GhostPath>{strongest});
}

TEST(GhostPanelLooks, ColumnsAreKept) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    const QTableView& table = shown.window.ghost_panel().table();
    EXPECT_TRUE(table.isColumnHidden(GhostTableModel::incidence_1));
    EXPECT_FALSE(table.isColumnHidden(GhostTableModel::flux));
    EXPECT_TRUE(table.isColumnHidden(GhostTableModel::ratio));
}

TEST(FlareProbe, AClickSelectsTheGhostThatIsThere) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    FlareView& view = *window.flare_panel().view();
    // The brightest pixel of the strongest ghost's own picture has that ghost in it.
    const GhostPath path = window.ghost_panel().model().table()->ghosts.front().path;
    window.selection().set_ghosts({path});
    ASSERT_TRUE(shown.settle());
    const FlareImage& image = *window.picture()->image;
    ASSERT_FALSE(image.highlight.empty());
    const auto brightest = std::ranges::max_element(image.highlight) - image.highlight.begin();
    const double x = (static_cast<double>(brightest % image.width_px) + 0.5) / image.width_px - 0.5;
    const double y =
        (static_cast<double>(brightest / image.width_px) + 0.5) / image.height_px - 0.5;
    const glm::dvec2 at =
        view.frame().view_from_sensor({x * image.sensor_width_mm, y * image.sensor_height_mm});
    move(view, {at.x, at.y});
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view.probe().empty(); }, test::patience_ms));
    EXPECT_TRUE(view.probe().front().amount.endsWith("%"));
    window.selection().set_ghosts({});
    click(view, {at.x, at.y});
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return !window.selection().ghosts().empty(); }, test::patience_ms));
    EXPECT_EQ(QString::fromStdString(ghostlight::name(window.selection().ghosts().front())),
              view.probe().front().name);
    EXPECT_TRUE(window.ghost_panel().table().selectionModel()->hasSelection());
}

TEST(FlareLooks, FalseColoursAreThoseOfTheScale) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    FlareView& view = *window.flare_panel().view();
    window.actions()["flare.false_color"].setChecked(true);
    ASSERT_TRUE(view.look().false_color);
    const FlareImage& image = *window.picture()->image;
    const float brightest = *std::ranges::max_element(image.irradiance);
    EXPECT_LE(std::log10(brightest), view.look().false_color->high);
    EXPECT_GT(std::log10(brightest), view.look().false_color->high - 1.0F);
    const QImage seen = view.grab_view();
    // A dark corner has the scale's lower end.
    const glm::dvec2 corner = view.frame().view_from_sensor({17.5, 11.5});
    const auto irradiance = irradiance_at(image, 17.5, 11.5);
    ASSERT_TRUE(irradiance);
    const auto wanted = false_color(
        log_place(*irradiance, view.look().false_color->low, view.look().false_color->high));
    const QColor found =
        seen.pixelColor((QPointF(corner.x, corner.y) * view.devicePixelRatio()).toPoint());
    EXPECT_NEAR(found.redF(), wanted[0], 0.06);  // interpolated between pixels
    EXPECT_NEAR(found.greenF(), wanted[1], 0.06);
    window.actions()["flare.false_color"].setChecked(false);
    EXPECT_FALSE(view.look().false_color);
}

TEST(FlareLooks, ClippingIsMarked) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    FlareView& view = *shown.window.flare_panel().view();
    const auto marked = [&] {
        const QImage seen = view.grab_view();
        const auto& color = view.look().clipping;
        int count = 0;
        for (int y = 0; y < seen.height(); y += 2) {
            for (int x = 0; x < seen.width(); ++x) {
                const QColor at = seen.pixelColor(x, y);
                count += std::abs(at.redF() - color[0]) < 0.02F &&
                                 std::abs(at.greenF() - color[1]) < 0.02F &&
                                 std::abs(at.blueF() - color[2]) < 0.02F
                             ? 1
                             : 0;
            }
        }
        return count;
    };
    shown.window.flare_panel().set_exposure_ev(view.exposure_ev() + 6.0);
    EXPECT_LT(marked(), 20);
    shown.window.actions()["flare.clipping"].setChecked(true);
    EXPECT_GT(marked(), 500);
    shown.window.actions()["flare.clipping"].setChecked(false);
}

TEST(Compare, EditsAreSeenAgainstThePinnedLens) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    GhostPanel& ghosts = window.ghost_panel();
    const Prescription bare = with_air_coating(window.document().lens(), Uncoated{});
    window.document().edit_lens(bare, "take the coatings off");
    ASSERT_TRUE(shown.settle());
    window.actions()["compare.pin"].trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return ghosts.model().compares(); }, test::patience_ms));
    EXPECT_FALSE(ghosts.table().isColumnHidden(GhostTableModel::ratio));
    EXPECT_TRUE(window.flare_panel().view()->compares());
    // The same lens: nothing has changed.
    const auto ratio = [&](int row) {
        return ghosts.model()
            .index(row, GhostTableModel::ratio)
            .data(GhostTableModel::sort_role)
            .toDouble();
    };
    EXPECT_NEAR(ratio(0), 1.0, 1e-12);
    // A coating on a bare surface takes light from every ghost that turns there.
    const std::size_t surface = ghosts.model().table()->ghosts.front().path.reflections.front();
    Prescription lens = bare;
    ASSERT_TRUE(std::holds_alternative<Uncoated>(lens.surfaces[surface].coating));
    lens.surfaces[surface].coating = QuarterWave{};
    window.document().edit_lens(lens, "coat a surface");
    ASSERT_TRUE(shown.settle());
    int fallen = 0;
    for (int row = 0; row < ghosts.model().rowCount(); ++row) {
        const auto& turns = ghosts.model().row(row).path.reflections;
        if (std::ranges::find(turns, surface) != turns.end()) {
            EXPECT_LT(ratio(row), 0.7) << row;  // MgF2 halves R of glass and more
            ++fallen;
        } else {
            EXPECT_GT(ratio(row), 0.9) << row;
        }
    }
    EXPECT_EQ(fallen, 5);
    // The divider is dragged, away from the light's marker; what lies left of it is A.
    FlareView& view = *window.flare_panel().view();
    const QPointF divider(view.split_share() * view.width(), 0.4 * view.height());
    drag(view, divider, {0.25 * view.width(), 0.4 * view.height()});
    EXPECT_NEAR(view.split_share(), 0.25, 0.01);
    const LightDirection light = window.document().scene().light().direction;
    EXPECT_EQ(window.document().scene().light().direction, light);
    window.actions()["compare.restore"].trigger();
    EXPECT_EQ(window.document().lens(), bare);
    EXPECT_TRUE(window.document().history().undoText().contains("pinned"));
    window.actions()["compare.unpin"].trigger();
    EXPECT_FALSE(ghosts.model().compares());
    EXPECT_TRUE(ghosts.table().isColumnHidden(GhostTableModel::ratio));
    EXPECT_FALSE(view.compares());
}

TEST(Compare, BlinksAAndB) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    FlareView& view = *window.flare_panel().view();
    window.actions()["compare.pin"].trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return view.compares(); }, test::patience_ms));
    window.actions()["compare.blink"].trigger();
    EXPECT_TRUE(QTest::qWaitFor([&] { return view.is_showing_a(); }, 10'000));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !view.is_showing_a(); }, 10'000));
    window.actions()["compare.unpin"].trigger();
    EXPECT_FALSE(view.is_showing_a());
}

TEST(SweepPanel, RunsExportsAndStops) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    SweepPanel& sweep = window.understanding().sweep_panel();
    window.understanding().sweep_dock()->show();
    auto* from = sweep.findChild<QLineEdit*>("sweep_from");
    auto* to = sweep.findChild<QLineEdit*>("sweep_to");
    auto* count = sweep.findChild<QLineEdit*>("sweep_count");
    from->setText("0");
    to->setText("10");
    count->setText("1");
    sweep.start();
    EXPECT_TRUE(sweep.problem().contains("2 to"));
    count->setText("3");
    QTest::keyClick(count, Qt::Key_Return);
    EXPECT_TRUE(sweep.is_running());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !sweep.is_running(); }, test::patience_ms));
    ASSERT_EQ(sweep.view().points().size(), 3U);
    EXPECT_EQ(sweep.view().points()[1].value, 5.0);
    EXPECT_EQ(sweep.csv().count('\n'), 1 + 3 * 15);
    // A flare of the strip takes the light there; a curve selects its ghost.
    click(sweep.view(), sweep.view().flare_place(2).center());
    EXPECT_EQ(window.document().scene().light().direction.field_deg, 10.0);
    const GhostCurve& curve = sweep.view().curves().front();
    click(sweep.view(), sweep.view().curve_place(curve, curve.worst));
    ASSERT_EQ(window.selection().ghosts().size(), 1U);
    // The same by keyboard alone.
    QTest::keyClick(&sweep.view(), Qt::Key_Home);
    QTest::keyClick(&sweep.view(), Qt::Key_Right);
    QTest::keyClick(&sweep.view(), Qt::Key_Return);
    EXPECT_EQ(window.document().scene().light().direction.field_deg, 5.0);
    const auto first = window.selection().ghosts();
    QTest::keyClick(&sweep.view(), Qt::Key_Down);
    ASSERT_EQ(window.selection().ghosts().size(), 1U);
    EXPECT_NE(window.selection().ghosts(), first);
    QTest::keyClick(&sweep.view(), Qt::Key_Up);
    EXPECT_EQ(window.selection().ghosts(), first);
    sweep.start();
    sweep.stop();
    EXPECT_FALSE(sweep.is_running());
    // Nothing of what was stopped comes later.
    const std::size_t points = sweep.view().points().size();
    QTest::qWait(300);
    EXPECT_EQ(sweep.view().points().size(), points);
}

TEST(CheckPanel, AClickGoesToTheCell) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    CheckPanel& check = window.understanding().check_panel();
    window.understanding().check_dock()->show();
    QAbstractItemModelTester tester(&check.model(),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal);
    const auto find = [&](LensCell cell, std::size_t row) {
        for (int k = 0; k < check.model().rowCount(); ++k) {
            const Finding& finding = check.model().finding(k);
            if (finding.cell == cell && finding.surface == row && finding.ghosts.empty()) {
                return k;
            }
        }
        return -1;
    };
    EXPECT_EQ(find(LensCell::semi_diameter, 2), -1);
    Prescription lens = window.document().lens();
    lens.surfaces[2].semi_diameter_mm = 2.0 / std::abs(curvature_per_mm(lens.surfaces[2].curve));
    window.document().edit_lens(lens, "widen a rim");
    ASSERT_TRUE(shown.settle());
    const int row = find(LensCell::semi_diameter, 2);
    ASSERT_GE(row, 0);
    QTableView& table = check.table();
    table.scrollTo(check.model().index(row, 0));
    click(*table.viewport(), table.visualRect(check.model().index(row, 0)).center());
    auto* cells = window.prescription_panel().findChild<QTableView*>();
    EXPECT_EQ(cells->currentIndex().row(), 2);
    EXPECT_TRUE(cells->model()
                    ->headerData(cells->currentIndex().column(), Qt::Horizontal)
                    .toString()
                    .startsWith("Semi"));
    window.document().history().undo();
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(find(LensCell::semi_diameter, 2), -1);
}

TEST(LayoutLooks, MeetingsMarksFieldsAndMeasures) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    LayoutView& view = *window.layout_panel().view();
    EXPECT_EQ(view.fans().size(), 1U);
    window.actions()["layout.fields"].setChecked(true);
    EXPECT_EQ(view.fans().size(), 4U);
    window.actions()["layout.fields"].setChecked(false);
    window.actions()["layout.marks"].setChecked(true);
    EXPECT_EQ(view.marks().size(), 6U);
    const auto& table = *window.ghost_panel().model().table();
    window.selection().set_ghosts({table.ghosts[0].path, table.ghosts[1].path});
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(view.fans().size(), 3U);
    EXPECT_EQ(view.marks().size(), 8U);  // and a focus for each ghost
    window.actions()["layout.marks"].setChecked(false);
    // Nothing absorbs: R + T = 1 at each meeting.
    for (const RayFan& fan : view.fans()) {
        ASSERT_FALSE(fan.meetings.empty());
        for (const RayMeeting& meeting : fan.meetings) {
            EXPECT_NEAR(meeting.reflectance + meeting.transmittance, 1.0, 1e-9);
        }
    }
    const RayMeeting& meeting = view.fans()[1].meetings.front();
    EXPECT_NE(view.meeting_at(view.plane().to_view(meeting.at)), nullptr);
    window.actions()["layout.measure"].setChecked(true);
    const QPointF a = view.plane().to_view({0.0, 0.0}), b = view.plane().to_view({3.0, 4.0});
    drag(view, a, b);
    EXPECT_NEAR(view.measured_mm(), 5.0, 1e-6);
    window.actions()["layout.measure"].setChecked(false);
    EXPECT_EQ(view.measured_mm(), 0.0);
    // The light walks: half of its way is half of the length.
    auto* walk = window.layout_panel().findChild<QSlider*>("walk");
    ASSERT_TRUE(walk->isVisible());
    const QImage whole = view.grab_view();
    walk->setValue(walk->maximum() / 2);
    EXPECT_EQ(view.walk(), 0.5);
    EXPECT_NE(view.grab_view(), whole);
}

TEST(LayoutLooks, ExportsDrawings) {
    OpenWindow shown(triplet());
    ASSERT_TRUE(shown.settle());
    LayoutPanel& layout = shown.window.layout_panel();
    const QTemporaryDir folder;
    const auto begins = [&](const char* file, const char* with) {
        EXPECT_TRUE(layout.export_to(folder.filePath(file))) << file;
        std::ifstream in(folder.filePath(file).toStdString(), std::ios::binary);
        std::string head(8, ' ');
        in.read(head.data(), 8);
        EXPECT_NE(head.find(with), std::string::npos) << file;
    };
    begins("layout.svg", "<svg");
    begins("layout.pdf", "%PDF");
    begins("layout.png", "PNG");
    EXPECT_FALSE(layout.export_to(folder.filePath("layout.doc")));
}

TEST(RayWalk, KeepsAShareOfEachRaysWay) {
    const std::vector<RayStretch> ways = {{RayLeg::in, {{0.0, 0.0}, {3.0, 4.0}}, 0},
                                          {RayLeg::out, {{3.0, 4.0}, {3.0, 9.0}}, 0},
                                          {RayLeg::direct, {{0.0, 1.0}, {2.0, 1.0}}, 1}};
    const auto half = walked(ways, 0.5);
    ASSERT_EQ(half.size(), 2U);
    EXPECT_NEAR(half[0].points.back().y, 4.0, 1e-12);
    EXPECT_NEAR(half[1].points.back().x, 1.0, 1e-12);
    EXPECT_EQ(walked(ways, 0.75)[1].points.back().y, 6.5);
    EXPECT_EQ(walked(ways, 1.0).size(), 3U);
    EXPECT_TRUE(walked(ways, 0.0).empty());
}

}  // namespace
}  // namespace ghostlight
