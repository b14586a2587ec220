#include "widgets/main_window.h"

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QClipboard>
#include <QCompleter>
#include <QDir>
#include <QDropEvent>
#include <QFile>
#include <QGuiApplication>
#include <QLineEdit>
#include <QMimeData>
#include <QMouseEvent>
#include <QPixmap>
#include <QSignalSpy>
#include <QTableView>
#include <QTemporaryDir>
#include <QUrl>

#include <set>

#include "core/io/table_file.h"
#include "tests/support/test_paths.h"
#include "tests/widgets/window_kit.h"
#include "widgets/file_actions.h"
#include "widgets/flare_view.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/prescription_model.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/layout_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/scene_bar.h"
#include "widgets/panels/scene_field.h"
#include "widgets/panels/status_line.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

/// Number of different colours among some thousand points of a picture.
std::size_t colors_in(const QImage& image) {
    std::set<QRgb> colors;
    for (int y = 0; y < image.height(); y += 9) {
        for (int x = 0; x < image.width(); x += 7) {
            colors.insert(image.pixel(x, y));
        }
    }
    return colors.size();
}

void drag(QWidget& widget, QPoint from, QPoint to) {
    const auto send = [&](QEvent::Type type, QPoint at, Qt::MouseButton button,
                          Qt::MouseButtons buttons) {
        QMouseEvent event(type, at, widget.mapToGlobal(at), button, buttons, Qt::NoModifier);
        QApplication::sendEvent(&widget, &event);
    };
    send(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
    constexpr int steps = 8;
    for (int k = 1; k <= steps; ++k) {
        send(QEvent::MouseMove, from + (to - from) * k / steps, Qt::NoButton, Qt::LeftButton);
        QTest::qWait(5);
    }
    send(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
}

bool set_cell(MainWindow& window, int row, PrescriptionModel::Column column, const char* text) {
    PrescriptionModel& model = window.prescription_panel().model();
    return model.setData(model.index(row, column), QString::fromUtf8(text), Qt::EditRole);
}

QLineEdit* type_into_cell(MainWindow& window, int row, PrescriptionModel::Column column,
                          const char* text) {
    QTableView& table = window.prescription_panel().table();
    table.setFocus();
    table.setCurrentIndex(table.model()->index(row, column));
    table.edit(table.currentIndex());
    auto* editor = table.viewport()->findChild<QLineEdit*>();
    if (editor != nullptr) {
        editor->selectAll();
        QTest::keyClicks(editor, text);
    }
    return editor;
}

/// The view takes an editor's text from its event loop.
void press_return(QLineEdit* editor) {
    QTest::keyClick(editor, Qt::Key_Return);
    QTest::qWait(10);
}

struct EveryLensSlow : testing::TestWithParam<std::string> {};

TEST_P(EveryLensSlow, AnEditReachesAllViews) {
    OpenWindow shown(test::bundled(GetParam()));
    MainWindow& window = shown.window;
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.picture().has_value(); }, test::patience_ms));
    const QImage before = window.layout_panel().grab_view();
    const double radius_mm = 1.0 / curvature_per_mm(window.document().lens().surfaces[0].curve);
    const auto changed = QByteArray::number(std::isfinite(radius_mm) ? radius_mm * 1.2 : 400.0);
    ASSERT_TRUE(set_cell(window, 0, PrescriptionModel::radius, changed.constData()));
    EXPECT_EQ(window.windowTitle().contains("[*]"), true);
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(window.banner().text(), "");
    EXPECT_EQ(window.picture()->revision, window.document().revision());
    EXPECT_TRUE(window.picture()->is_final);
    EXPECT_FALSE(window.ghost_panel().model().is_stale());
    EXPECT_GT(window.ghost_panel().model().rowCount(), 0);
    EXPECT_NE(window.layout_panel().grab_view(), before);
}

std::vector<std::string> every_lens() {
    std::vector<std::string> files;
    const QDir folder(QString::fromStdString(lens_folder().string()));
    for (const QString& file : folder.entryList({"*.json"}, QDir::Files)) {
        files.push_back(file.toStdString());
    }
    return files;
}
INSTANTIATE_TEST_SUITE_P(Bundled, EveryLensSlow, testing::ValuesIn(every_lens()),
                         [](const auto& each) {
                             std::string name = each.param;
                             for (char& letter : name) {
                                 letter = std::isalnum(static_cast<unsigned char>(letter)) != 0
                                              ? letter
                                              : '_';
                             }
                             return name;
                         });

TEST(MainWindow, EmptyStateOffersToOpen) {
    OpenWindow shown;
    EXPECT_TRUE(shown.window.is_settled());
    EXPECT_GT(colors_in(shown.window.grab().toImage()), 3U);
}

TEST(MainWindow, TypingIntoACellAndUndo) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    QLineEdit* editor = type_into_cell(window, 0, PrescriptionModel::radius, "50");
    ASSERT_NE(editor, nullptr);
    press_return(editor);
    EXPECT_EQ(window.document().lens().surfaces[0].curve, BaseCurve(Radius{50.0}));
    EXPECT_EQ(window.actions()["edit.undo"].text(), "&Undo change radius of surface 1");
    window.actions()["edit.undo"].trigger();
    EXPECT_EQ(window.document().lens().surfaces[0].curve, BaseCurve(Radius{42.97}));
    window.actions()["edit.redo"].trigger();
    EXPECT_EQ(window.document().lens().surfaces[0].curve, BaseCurve(Radius{50.0}));
}

TEST(MainWindow, ARefusedTextKeepsItsEditorOpenWithTheReason) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    const Prescription before = window.document().lens();
    QLineEdit* editor = type_into_cell(window, 0, PrescriptionModel::semi_diameter, "0");
    ASSERT_NE(editor, nullptr);
    press_return(editor);
    EXPECT_TRUE(editor->isVisible());
    EXPECT_EQ(editor->text(), "0");
    EXPECT_FALSE(window.prescription_panel().reason().isEmpty());
    EXPECT_EQ(window.document().lens(), before);
    QTest::keyClicks(editor, ".5");  // now 0.5
    EXPECT_TRUE(window.prescription_panel().reason().isEmpty());
    press_return(editor);
    EXPECT_EQ(window.document().lens().surfaces[0].semi_diameter_mm, 0.5);
}

TEST(MainWindow, SelectedGhostsAreSelectedEverywhere) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());
    const QImage layout = window.layout_panel().grab_view();
    window.ghost_panel().table().selectRow(0);
    ASSERT_EQ(window.selection().ghosts().size(), 1U);
    const auto strongest = window.ghost_panel().model().table()->ghosts.front().path;
    EXPECT_EQ(window.selection().ghosts().front(), strongest);
    ASSERT_TRUE(shown.settle());
    EXPECT_FALSE(window.picture()->image->highlight.empty());
    EXPECT_NE(window.layout_panel().grab_view(), layout);
    // The ghost stays selected while the light and with it the order changes.
    Scene scene = window.document().scene();
    scene.light().direction.field_deg = 3.0;
    window.document().edit_scene(scene, "move the light");
    ASSERT_TRUE(shown.settle());
    ASSERT_EQ(window.selection().ghosts().size(), 1U);
    EXPECT_EQ(window.selection().ghosts().front(), strongest);
    EXPECT_TRUE(window.ghost_panel().table().selectionModel()->hasSelection());
    window.actions()["ghosts.clear"].trigger();
    EXPECT_FALSE(window.ghost_panel().table().selectionModel()->hasSelection());
}

TEST(MainWindow, DraggingTheLightMovesItInOneStep) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());
    const LightDirection before = window.document().scene().light().direction;
    const int steps = window.document().history().count();
    QWidget& view = *window.flare_panel().view();
    drag(view, view.rect().center(), view.rect().center() + QPoint(60, 40));
    EXPECT_NE(window.document().scene().light().direction, before);
    EXPECT_EQ(window.document().history().count(), steps + 1);
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(window.picture()->revision, window.document().revision());
    EXPECT_FALSE(window.document().is_modified());
    window.actions()["edit.undo"].trigger();
    EXPECT_EQ(window.document().scene().light().direction, before);
}

TEST(MainWindow, TheWayFromKeyToPictureIsTimed) {
    OpenWindow shown(test::tessar());
    ASSERT_TRUE(shown.settle());
    set_cell(shown.window, 0, PrescriptionModel::radius, "44");
    ASSERT_TRUE(shown.settle());
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return shown.window.status_line().timing_text().contains("raster"); }, 5000));
}

TEST(MainWindow, SceneBarEditsAndRefusals) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    SceneBar& bar = window.scene_bar();
    const auto enter = [](NumberField& field, const char* text) {
        field.editor().setFocus();
        field.editor().selectAll();
        QTest::keyClicks(&field.editor(), text);
        QTest::keyClick(&field.editor(), Qt::Key_Return);
    };
    enter(bar.field(), "7.5");
    EXPECT_EQ(window.document().scene().light().direction.field_deg, 7.5);
    enter(bar.field(), "95");
    EXPECT_EQ(window.document().scene().light().direction.field_deg, 7.5);
    EXPECT_FALSE(window.banner().text().isEmpty());
    enter(bar.field(), "8");
    EXPECT_EQ(window.banner().text(), "");
    enter(bar.f_number(), "5.6");
    EXPECT_EQ(window.document().lens().stop.f_number, 5.6);
    Q_EMIT bar.spectrum().entered("550 nm");
    EXPECT_EQ(window.document().scene().light().spectrum, Spectrum(Monochromatic{550.0}));
    Q_EMIT bar.spectrum().entered("green");
    EXPECT_TRUE(window.banner().text().contains("green"));
}

TEST(MainWindow, AGlassWithoutAnIndexShowsWhyAndKeepsThePicture) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());
    const auto image = window.picture()->image;
    Prescription lens = window.document().lens();
    lens.surfaces[0].medium_after = {"narrow", FormulaGlass{2, {1.2, 0.01}, 500.0, 510.0}};
    window.document().edit_lens(lens, "change glass of surface 1");
    ASSERT_TRUE(shown.settle());
    EXPECT_TRUE(window.banner().text().contains("narrow"));
    EXPECT_EQ(window.picture()->image, image);
    window.document().history().undo();
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(window.banner().text(), "");
}

TEST(MainWindow, Exports) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());
    const QTemporaryDir folder;
    std::map<QString, QString> written;
    window.files().ask_file_to_write = [&](const QString&, const QString& suggested,
                                           const QString&) {
        return written[suggested.section('.', -1)] = folder.filePath(suggested);
    };
    for (const char* id : {"file.export_table", "file.export_exr", "file.export_png"}) {
        window.actions()[id].trigger();
    }
    EXPECT_EQ(window.banner().text(), "");
    QFile csv(written["csv"]);
    ASSERT_TRUE(csv.open(QIODevice::ReadOnly));
    EXPECT_EQ(csv.readAll().toStdString(),
              ghost_table_csv(*window.ghost_panel().model().table(), GhostColumns::all));
    EXPECT_GT(QFile(written["exr"]).size(), 1000);
    EXPECT_FALSE(QImage(written["png"]).isNull());
    // Where nothing can be written, the reason is shown.
    window.files().ask_file_to_write = [&](const QString&, const QString&, const QString&) {
        return written["csv"] + "/below/a/file.csv";
    };
    window.actions()["file.export_table"].trigger();
    EXPECT_FALSE(window.banner().text().isEmpty());
}

TEST(MainWindow, CopiesSelectedGhosts) {
    OpenWindow shown(test::tessar());
    ASSERT_TRUE(shown.settle());
    shown.window.ghost_panel().table().selectRow(1);
    shown.window.actions()["ghosts.copy"].trigger();
    const QStringList lines = QGuiApplication::clipboard()->text().split('\n', Qt::SkipEmptyParts);
    ASSERT_EQ(lines.size(), 2);
    EXPECT_TRUE(lines[0].startsWith("ghost\tflux_mm2\t"));
}

TEST(MainWindow, UnsavedEditsAreAskedAbout) {
    const QTemporaryDir folder;
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    using Answer = FileActions::Answer;
    int asked = 0;
    Answer answer = Answer::cancel;
    window.files().ask_about_unsaved = [&] {
        ++asked;
        return answer;
    };
    EXPECT_TRUE(window.open(test::tessar()));
    EXPECT_EQ(asked, 0);
    ASSERT_TRUE(set_cell(window, 0, PrescriptionModel::radius, "50"));
    EXPECT_FALSE(window.close());
    EXPECT_EQ(asked, 1);
    EXPECT_FALSE(window.open(test::tessar()));
    EXPECT_EQ(window.document().lens().surfaces[0].curve, BaseCurve(Radius{50.0}));
    // A bundled lens is not written over: saving asks for a file.
    answer = Answer::save;
    const QString file = folder.filePath("mine.json");
    window.files().ask_file_to_write = [&](const QString&, const QString&, const QString&) {
        return file;
    };
    EXPECT_TRUE(window.close());
    EXPECT_TRUE(QFile::exists(file));
    EXPECT_EQ(read_lens(file.toStdString()).lens.surfaces[0].curve, BaseCurve(Radius{50.0}));
}

TEST(MainWindow, ABadFileSaysWhyAndLeavesTheLens) {
    const QTemporaryDir folder;
    OpenWindow shown(test::tessar());
    const auto bad = folder.filePath("bad.json");
    write_file_safely(bad.toStdString(), "{\"ghostlight_lens\": 1, \"surfaces\": 3}");
    EXPECT_FALSE(shown.window.open(bad.toStdString()));
    EXPECT_TRUE(shown.window.banner().text().contains("surfaces"));
    EXPECT_EQ(shown.window.document().lens().surfaces.size(), 8U);
}

TEST(MainWindow, ADroppedLensIsOpened) {
    OpenWindow shown;
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromStdString(test::tessar().string()))});
    QDragEnterEvent enter(QPoint(20, 20), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&shown.window, &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop(QPointF(20, 20), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&shown.window, &drop);
    EXPECT_EQ(shown.window.document().lens().surfaces.size(), 8U);
}

TEST(MainWindow, RowsAreEditedByActions) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    QTableView& table = window.prescription_panel().table();
    table.setCurrentIndex(table.model()->index(0, PrescriptionModel::radius));
    window.actions()["edit.insert"].trigger();
    EXPECT_EQ(window.document().lens().surfaces.size(), 9U);
    EXPECT_EQ(table.currentIndex().row(), 1);
    window.actions()["edit.delete"].trigger();
    EXPECT_EQ(window.document().lens().surfaces.size(), 8U);
    table.setCurrentIndex(table.model()->index(3, PrescriptionModel::radius));
    window.actions()["edit.delete"].trigger();
    EXPECT_TRUE(window.prescription_panel().reason().contains("stop"));
    window.actions()["edit.move_down"].trigger();
    EXPECT_EQ(window.document().lens().stop.surface, 4U);
}

TEST(MainWindow, AspheresAreShownWhereThereAreSomeAndOnDemand) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    const QTableView& table = window.prescription_panel().table();
    const auto is_hidden = [&] { return table.isColumnHidden(PrescriptionModel::aspheric); };
    EXPECT_TRUE(QTest::qWaitFor(is_hidden));
    window.actions()["view.aspheres"].trigger();
    EXPECT_FALSE(is_hidden());
    EXPECT_TRUE(set_cell(window, 0, PrescriptionModel::aspheric, "A4=1e-7, A6=-2e-11"));
    EXPECT_EQ(window.document().lens().surfaces[0].aspheric, (std::vector{1e-7, -2e-11}));
    window.actions()["view.aspheres"].trigger();
    EXPECT_FALSE(is_hidden()) << "this lens has one now";
}

TEST(MainWindow, GlassNamesAreCompleted) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    const QString name = QString::fromStdString(bundled_glasses().glasses.front().name);
    QLineEdit* editor = type_into_cell(window, 0, PrescriptionModel::medium, "");
    ASSERT_NE(editor, nullptr);
    ASSERT_NE(editor->completer(), nullptr);
    QTest::keyClicks(editor, name.toLower());
    EXPECT_GT(editor->completer()->completionCount(), 0);
    editor->completer()->popup()->hide();
    press_return(editor);
    EXPECT_EQ(window.document().lens().surfaces[0].medium_after, bundled_glasses().glasses.front());
}

TEST(MainWindow, ASnapshotIsNotBlank) {
    const QTemporaryDir folder;
    OpenWindow shown(test::tessar());
    const std::filesystem::path out = folder.filePath("out").toStdString();
    write_snapshot(shown.window, out);
    EXPECT_TRUE(std::filesystem::exists(out / "ghosts.csv"));
    EXPECT_TRUE(std::filesystem::exists(out / "flare.exr"));
    const QImage picture(QString::fromStdString((out / "workbench.png").string()));
    ASSERT_EQ(picture.size(), shown.window.size());
    const auto part = [&](const QWidget& widget) {
        return picture.copy(QRect(widget.mapTo(&shown.window, QPoint(0, 0)), widget.size()));
    };
    constexpr std::size_t some = 12;  // more than ground, lines and text would give a blank panel
    EXPECT_GT(colors_in(part(shown.window.layout_panel())), some);
    EXPECT_GT(colors_in(part(shown.window.flare_panel())), some);
    EXPECT_GT(colors_in(part(shown.window.ghost_panel())), some);
    EXPECT_GT(colors_in(part(shown.window.prescription_panel())), some);
}

TEST(Actions, IdsAndKeysAreUnique) {
    std::set<std::string> ids;
    std::set<std::string> keys;
    for (const ActionText& text : action_texts()) {
        EXPECT_TRUE(ids.insert(text.id).second) << text.id;
        if (*text.keys != '\0') {
            EXPECT_TRUE(keys.insert(text.keys).second) << text.keys;
        }
    }
}

}  // namespace
}  // namespace ghostlight
