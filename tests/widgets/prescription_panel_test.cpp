#include "widgets/panels/prescription_panel.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QLineEdit>
#include <QSlider>
#include <QTableView>

#include <random>

#include "core/io/imported_lens.h"
#include "core/io/varied_cells.h"
#include "core/optics/paraxial.h"
#include "core/optics/reverse.h"
#include "core/units.h"
#include "tests/widgets/window_kit.h"
#include "widgets/actions.h"
#include "widgets/models/prescription_model.h"
#include "widgets/panels/number_handle.h"
#include "widgets/panels/scale_strip.h"

namespace ghostlight {
namespace {

using Column = PrescriptionModel::Column;

/// The panel alone, without the work behind the views.
struct PrescriptionPanelTest : testing::Test {
    PrescriptionPanelTest() {
        EXPECT_FALSE(document.open(test::tessar()));
        panel.resize(800, 460);
        panel.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&panel));
        panel.activateWindow();
        EXPECT_TRUE(QTest::qWaitForWindowActive(&panel));
        QTest::qWait(10);
    }
    const Surface& surface(std::size_t row) const { return document.lens().surfaces[row]; }
    QModelIndex cell(int row, int column) { return panel.model().index(row, column); }
    void go_to(int row, int column) {
        panel.table().setFocus();
        panel.table().setCurrentIndex(cell(row, column));
    }
    /// As a person does: the first key opens the editor, Return closes it.
    void type(int row, int column, const QString& text) {
        go_to(row, column);
        QTest::keyClick(&panel.table(), Qt::Key_F2);
        auto* editor = panel.table().viewport()->findChild<QLineEdit*>();
        ASSERT_NE(editor, nullptr);
        editor->selectAll();
        if (text.isEmpty()) {
            QTest::keyClick(editor, Qt::Key_Delete);
        }
        QTest::keyClicks(editor, text);
        QTest::keyClick(editor, Qt::Key_Return);
        if (!panel.reason().isEmpty()) {
            QTest::keyClick(editor, Qt::Key_Escape);
        }
        QCoreApplication::processEvents();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    void drag(QWidget& on, QPoint from, QPoint to, Qt::MouseButton button) {
        QTest::mousePress(&on, button, {}, from);
        constexpr int steps = 10;
        for (int k = 1; k <= steps; ++k) {
            const QPoint at = from + (to - from) * k / steps;
            QMouseEvent move(QEvent::MouseMove, at, on.mapToGlobal(at), Qt::NoButton, button, {});
            QCoreApplication::sendEvent(&on, &move);
        }
        QTest::mouseRelease(&on, button, {}, to);
    }
    QPoint middle(int row, int column) {
        return panel.table().visualRect(cell(row, column)).center();
    }
    void undo_all() {
        while (document.history().canUndo()) {
            document.history().undo();
        }
    }

    Document document;
    QWidget window;
    Actions actions{&window};
    PrescriptionPanel panel{document, actions};
    QAbstractItemModelTester tester{&panel.model(),
                                    QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(PrescriptionPanelTest, CellsTakeArithmeticAndUnits) {
    type(0, Column::thickness, "=2*13.2");
    EXPECT_EQ(surface(0).thickness_mm, 26.4);
    type(0, Column::radius, "0.5in");
    EXPECT_EQ(surface(0).curve, BaseCurve(Radius{12.7}));
    type(2, Column::thickness, "1/3");
    EXPECT_EQ(surface(2).thickness_mm, 1.0 / 3.0);
    EXPECT_EQ(document.history().undoText(), "change thickness of surface 3");
    const Prescription before = document.lens();
    type(2, Column::thickness, "1/0");
    EXPECT_EQ(document.lens(), before);
}

TEST_F(PrescriptionPanelTest, RadiiAndCurvaturesAreTwoViewsOfOneNumber) {
    const Prescription before = document.lens();
    actions["view.curvatures"].setChecked(true);
    EXPECT_EQ(panel.model().headerData(Column::radius, Qt::Horizontal, Qt::DisplayRole).toString(),
              "Curvature /mm");
    EXPECT_NEAR(cell(0, Column::radius).data(Qt::EditRole).toDouble(), 1.0 / 42.97, 1e-15);
    EXPECT_EQ(document.lens(), before) << "to look is not to edit";
    type(0, Column::radius, "1/50");
    EXPECT_EQ(surface(0).curve, BaseCurve(Curvature{0.02}));
    type(1, Column::radius, "0");
    EXPECT_EQ(surface(1).curve, BaseCurve(Plane{}));
    type(2, Column::radius, "r=300");
    EXPECT_EQ(surface(2).curve, BaseCurve(Radius{300.0}));
    actions["view.curvatures"].setChecked(false);
    EXPECT_EQ(cell(0, Column::radius).data().toString(), "50.00000");
    EXPECT_EQ(cell(2, Column::radius).data().toString(), "300.000");
    undo_all();
    EXPECT_EQ(document.lens(), before);
}

TEST_F(PrescriptionPanelTest, CellsGoToASpreadsheetAndBack) {
    const Prescription before = document.lens();
    go_to(0, Column::radius);
    drag(*panel.table().viewport(), middle(0, Column::radius), middle(2, Column::thickness),
         Qt::LeftButton);
    EXPECT_EQ(panel.table().selectionModel()->selectedIndexes().size(), 6);
    QTest::keyClick(&panel.table(), Qt::Key_C, Qt::ControlModifier);
    const QString copied = QGuiApplication::clipboard()->text();
    const QStringList lines = copied.split('\n');
    ASSERT_EQ(lines.size(), 3);
    EXPECT_EQ(lines[0].split('\t')[0], "42.97");
    EXPECT_EQ(lines[0].split('\t').size(), 2);
    QTest::keyClick(&panel.table(), Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(document.lens(), before) << "what is pasted where it was copied changes nothing";

    // As a spreadsheet gives it: Windows line ends, a last one, a decimal comma.
    QGuiApplication::clipboard()->setText("43,5\t=1+2\r\nplane\t0.1in\r\n");
    go_to(0, Column::radius);
    QTest::keyClick(&panel.table(), Qt::Key_V, Qt::ControlModifier);
    EXPECT_EQ(surface(0).curve, BaseCurve(Radius{43.5}));
    EXPECT_EQ(surface(0).thickness_mm, 3.0);
    EXPECT_EQ(surface(1).curve, BaseCurve(Plane{}));
    EXPECT_EQ(surface(1).thickness_mm, 2.54);
    EXPECT_EQ(document.history().undoText(), "paste 4 cells");
    EXPECT_EQ(document.history().count(), 1);
    document.history().undo();
    EXPECT_EQ(document.lens(), before);

    // One value into every chosen cell.
    QGuiApplication::clipboard()->setText("7.5");
    panel.table().selectionModel()->select(
        QItemSelection(cell(0, Column::semi_diameter), cell(3, Column::semi_diameter)),
        QItemSelectionModel::ClearAndSelect);
    QTest::keyClick(&panel.table(), Qt::Key_V, Qt::ControlModifier);
    for (std::size_t row = 0; row < 4; ++row) {
        EXPECT_EQ(surface(row).semi_diameter_mm, 7.5);
    }
}

TEST_F(PrescriptionPanelTest, APasteThatDoesNotFitLeavesEverything) {
    const Prescription before = document.lens();
    const std::pair<QString, QString> bad[] = {{"1\n2\n3\n4\n5\n6\n7\n8\n9", "more rows"},
                                               {"1\t2\t3\t4\t5\t6\t7\t8\t9", "more columns"},
                                               {"12\t3\nsoft\t4", "surface 2"},
                                               {"0\t3\n5\t5", "surface 1"}};
    for (const auto& [text, said] : bad) {
        go_to(0, Column::radius);
        QGuiApplication::clipboard()->setText(text);
        QTest::keyClick(&panel.table(), Qt::Key_V, Qt::ControlModifier);
        EXPECT_EQ(document.lens(), before) << text.toStdString();
        EXPECT_TRUE(panel.reason().contains(said)) << panel.reason().toStdString();
    }
    EXPECT_FALSE(document.history().canUndo());
}

TEST_F(PrescriptionPanelTest, CellsAreMarkedForAFit) {
    const Prescription before = document.lens();
    panel.table().selectionModel()->select(
        QItemSelection(cell(0, Column::radius), cell(1, Column::thickness)),
        QItemSelectionModel::ClearAndSelect);
    actions["edit.vary"].trigger();
    EXPECT_EQ(vary_text(document.lens()), "gap@1,radius@1,gap@2,radius@2");
    EXPECT_EQ(cell(0, Column::radius).data(PrescriptionModel::mark_role).toString(), "V");
    EXPECT_EQ(document.history().undoText(), "mark as variable");
    // What is shown by a colour alone is not seen by everyone.
    EXPECT_TRUE(cell(0, Column::radius).data(Qt::ToolTipRole).toString().contains("Variable"));
    actions["edit.move_down"].trigger();
    panel.table().selectionModel()->select(cell(3, Column::radius),
                                           QItemSelectionModel::ClearAndSelect);
    actions["edit.vary"].trigger();  // the stop's plane: nothing to vary, and it is said
    EXPECT_FALSE(panel.reason().isEmpty());
    undo_all();
    EXPECT_EQ(document.lens(), before);
}

TEST_F(PrescriptionPanelTest, AnAutomaticSemiDiameterFollowsTheBeam) {
    type(0, Column::semi_diameter, "auto");
    EXPECT_TRUE(surface(0).semi_diameter_sized);
    EXPECT_EQ(cell(0, Column::semi_diameter).data(PrescriptionModel::mark_role).toString(), "A");
    EXPECT_EQ(document.lens(), sized_again(document.lens())) << "as an import would size it";
    const double at_first_mm = surface(0).semi_diameter_mm;
    // The beam that a wider stop takes in is wider in front, too.
    type(3, Column::semi_diameter,
         "=1.1*" + cell(3, Column::semi_diameter).data(Qt::EditRole).toString());
    Prescription wider = document.lens();
    EXPECT_EQ(wider, sized_again(wider));
    type(0, Column::semi_diameter, "17");
    EXPECT_FALSE(surface(0).semi_diameter_sized);
    EXPECT_EQ(surface(0).semi_diameter_mm, 17.0);
    EXPECT_GT(at_first_mm, 5.0);
    const Prescription before = document.lens();
    type(3, Column::semi_diameter, "auto");
    EXPECT_EQ(document.lens(), before) << "the stop sizes the beam, not the other way about";
}

TEST_F(PrescriptionPanelTest, RowsAreDraggedByTheirNumber) {
    const Prescription before = document.lens();
    drag(*panel.table().viewport(), middle(0, Column::number),
         middle(2, Column::number) + QPoint(0, 8), Qt::LeftButton);
    EXPECT_EQ(surface(2), before.surfaces[0]);
    EXPECT_EQ(surface(0), before.surfaces[1]);
    EXPECT_EQ(document.history().undoText(), "move surface 1");
    EXPECT_EQ(panel.current_row(), 2);
    document.history().undo();
    EXPECT_EQ(document.lens(), before);
    drag(*panel.table().viewport(), middle(1, Column::number),
         middle(1, Column::number) + QPoint(0, 6), Qt::LeftButton);
    EXPECT_EQ(document.lens(), before) << "put back where it was";
}

TEST_F(PrescriptionPanelTest, ALongDragOfTheHandleIsOneStep) {
    const Prescription before = document.lens();
    go_to(0, Column::thickness);
    QSlider& slider = panel.handle().slider();
    const auto revision = document.revision();
    const QPoint from = slider.rect().center();
    drag(slider, from, from + QPoint(slider.width() / 4, 0), Qt::LeftButton);
    EXPECT_GE(document.revision() - revision, 5U) << "it re-traces as it moves";
    EXPECT_EQ(document.history().count(), 1);
    EXPECT_EQ(document.history().undoText(), "change thickness of surface 1");
    const double drawn_mm = surface(0).thickness_mm;
    EXPECT_GT(drawn_mm, before.surfaces[0].thickness_mm);
    EXPECT_EQ(slider.value(), 0) << "it springs back";
    drag(slider, from, from + QPoint(slider.width() / 4, 0), Qt::LeftButton);
    EXPECT_EQ(document.history().count(), 2) << "another drag is another step";
    document.history().undo();
    EXPECT_EQ(surface(0).thickness_mm, drawn_mm);
    document.history().undo();
    EXPECT_EQ(document.lens(), before);
    // From the keyboard, too.
    slider.setFocus();
    QTest::keyClick(&slider, Qt::Key_Right);
    QTest::keyClick(&slider, Qt::Key_Right);
    EXPECT_GT(surface(0).thickness_mm, before.surfaces[0].thickness_mm);
    EXPECT_EQ(document.history().count(), 1);
}

TEST_F(PrescriptionPanelTest, NumbersAreDrawnInTheTableItself) {
    const Prescription before = document.lens();
    const QPoint from = middle(2, Column::radius);
    drag(*panel.table().viewport(), from, from + QPoint(60, 0), Qt::MiddleButton);
    EXPECT_GT(1.0 / curvature_per_mm(surface(2).curve), 306.84);
    EXPECT_EQ(document.history().count(), 1);
    document.history().undo();
    EXPECT_EQ(document.lens(), before);
}

TEST_F(PrescriptionPanelTest, AnAspheresTermsAreChosenAndDrawnOneByOne) {
    actions["view.aspheres"].setChecked(true);
    go_to(0, Column::aspheric);
    QComboBox& choice = panel.handle().choice();
    EXPECT_TRUE(choice.isVisibleTo(&panel));
    choice.setFocus();
    QTest::keyClick(&choice, Qt::Key_Down);
    EXPECT_EQ(choice.currentText(), "A6");
    panel.handle().editor().setFocus();
    panel.handle().editor().selectAll();
    QTest::keyClicks(&panel.handle().editor(), "=2e-9*1.5");
    QTest::keyClick(&panel.handle().editor(), Qt::Key_Return);
    ASSERT_EQ(surface(0).aspheric.size(), 2U);
    EXPECT_EQ(surface(0).aspheric[0], 0.0);
    EXPECT_EQ(surface(0).aspheric[1], 2e-9 * 1.5);
}

TEST_F(PrescriptionPanelTest, TheLensIsScaledToAFocalLength) {
    const Prescription before = document.lens();
    const double efl_mm = first_order(compile(before, d_line_nm)).efl_mm;
    actions["edit.scale"].trigger();
    ScaleStrip& strip = panel.scale_strip();
    ASSERT_TRUE(strip.isVisible());
    strip.efl().setFocus();
    strip.efl().selectAll();
    QTest::keyClicks(&strip.efl(), "50");
    QTest::keyClick(&strip.efl(), Qt::Key_Return);
    EXPECT_FALSE(strip.isVisible());
    // What is typed is exact; the focal length is worked out twice.
    EXPECT_NEAR(first_order(compile(document.lens(), d_line_nm)).efl_mm, 50.0, 1e-9);
    EXPECT_TRUE(document.history().undoText().startsWith("scale the lens by"));
    document.history().undo();
    EXPECT_EQ(document.lens(), before);
    actions["edit.scale"].trigger();
    strip.factor().selectAll();
    QTest::keyClicks(&strip.factor(), "=1/2");
    QTest::keyClick(&strip.factor(), Qt::Key_Return);
    EXPECT_NEAR(first_order(compile(document.lens(), d_line_nm)).efl_mm, efl_mm / 2.0, 1e-9);
    actions["edit.scale"].trigger();
    QTest::keyClick(&strip.factor(), Qt::Key_Escape);
    EXPECT_FALSE(strip.isVisible());
}

TEST_F(PrescriptionPanelTest, TheLensIsReversedInOneStep) {
    const Prescription before = document.lens();
    actions["edit.reverse"].trigger();
    EXPECT_EQ(document.lens(), reversed(before));
    EXPECT_EQ(document.history().undoText(), "reverse the lens");
    actions["edit.reverse"].trigger();
    EXPECT_EQ(document.lens(), before);
}

/// A thousand edits of every sort, with undo and redo among them: whatever was done, all undone is
/// the document as it was, to the last bit, and all redone is what it had become.
TEST_F(PrescriptionPanelTest, AThousandRandomEditsAreUndoneExactlySlow) {
    ASSERT_FALSE(document.open(test::bundled("nikon_zoom_80_200_f2.8.json")));
    QTest::qWait(10);
    Scene scene = document.scene();
    scene.configuration = document.lens().configurations.front().name;
    document.edit_scene(scene, "choose a position");
    const DocumentState at_first = document.state();
    const int first_step = document.history().index();
    std::mt19937 random(20261125);
    const auto below = [&](int count) {
        return static_cast<int>(random() % static_cast<unsigned>(count));
    };
    const QStringList values = {"12.5", "=2*13.2", "0.5in", "-1/3", "plane", "auto", "0",
                                "1e-4", "oops",    "",      "88",   "7,25",  "-40"};
    const QStringList glasses = {"N-BK7", "1.6910 / 54.8", "1.5", "", "F2", "NO-SUCH"};
    const QStringList coatings = {"none", "MgF2 λ/4 550", "1.38:96.4 | 2.1:50", "R=0.01", "dull"};
    const char* row_actions[] = {"edit.insert",    "edit.delete",       "edit.move_up",
                                 "edit.move_down", "edit.make_stop",    "edit.vary",
                                 "edit.auto_size", "edit.own_thickness"};
    constexpr int edits = 1000;
    int done = 0;
    for (int k = 0; k < edits; ++k) {
        const int row = below(panel.model().rowCount());
        const auto revision = document.revision();
        switch (below(10)) {
            case 0:
            case 1: {
                const int columns[] = {Column::radius, Column::thickness, Column::semi_diameter};
                type(row, columns[below(3)], values[below(static_cast<int>(values.size()))]);
                break;
            }
            case 2:
                panel.model().setData(cell(row, Column::medium),
                                      glasses[below(static_cast<int>(glasses.size()))],
                                      Qt::EditRole);
                break;
            case 3:
                panel.model().setData(cell(row, Column::coating),
                                      coatings[below(static_cast<int>(coatings.size()))],
                                      Qt::EditRole);
                break;
            case 4:
                type(row, Column::comment, "note " + QString::number(k));
                break;
            case 5:
                go_to(row, Column::radius + below(2));
                actions[row_actions[below(std::size(row_actions))]].trigger();
                break;
            case 6:
                go_to(row, Column::radius + below(2));
                QTest::keyClick(&panel.handle().slider(), Qt::Key_Right);
                break;
            case 7:
                QGuiApplication::clipboard()->setText("30\t2.5\n-30\t1.5\n");
                go_to(row, Column::radius);
                actions["edit.paste_cells"].trigger();
                break;
            case 8:
                for (int n = below(6); n > 0; --n) {
                    document.history().undo();
                }
                if (document.history().index() < first_step) {
                    document.history().redo();
                }
                break;
            default:
                for (int n = below(4); n > 0; --n) {
                    document.history().redo();
                }
                if (below(12) == 0) {
                    actions["edit.reverse"].trigger();
                }
                break;
        }
        done += document.revision() != revision;
    }
    EXPECT_GT(done, edits / 3) << "most attempts are edits";
    const DocumentState at_last = document.state();
    const int steps = document.history().index();
    document.history().setIndex(first_step);
    EXPECT_EQ(document.state(), at_first);
    document.history().setIndex(steps);
    EXPECT_EQ(document.state(), at_last);
}

}  // namespace
}  // namespace ghostlight
