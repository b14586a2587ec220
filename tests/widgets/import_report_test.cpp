// A foreign file from opening to the flare: its report, its unknown glass, saving and exporting.

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QClipboard>
#include <QColor>
#include <QCompleter>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QGuiApplication>
#include <QLineEdit>
#include <QMimeData>
#include <QTableView>
#include <QTemporaryDir>
#include <QUrl>

#include <algorithm>

#include "core/io/formats.h"
#include "core/io/glass_library.h"
#include "core/units.h"
#include "tests/support/test_paths.h"
#include "tests/widgets/window_kit.h"
#include "widgets/file_actions.h"
#include "widgets/glass_folders.h"
#include "widgets/lens_filters.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/models/note_table_model.h"
#include "widgets/models/prescription_model.h"
#include "widgets/models/quantity_model.h"
#include "widgets/palette.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/first_order_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/import_report_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/settings.h"
#include "widgets/unknown_glass.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

std::filesystem::path sample(const std::string& file) { return test_data_folder() / file; }

constexpr int unknown_row = 2;  // SF2X follows surface 3

bool report_is_shown(MainWindow& window) {
    return !window.findChild<QDockWidget*>("import_report")->isHidden();
}

int row_about_surface(const NoteFilter& filter, int surface) {
    for (int row = 0; row < filter.rowCount(); ++row) {
        if (filter.index(row, 0).data(NoteTableModel::surface_role) == surface) {
            return row;
        }
    }
    return -1;
}

TEST(ImportReportPanel, OurOwnFileHasNothingToSay) {
    OpenWindow shown(test::tessar());
    ImportReportPanel& report = shown.window.import_report_panel();
    EXPECT_EQ(report.model().rowCount(), 0);
    EXPECT_FALSE(report.empty_text().isEmpty());
    EXPECT_FALSE(report_is_shown(shown.window));
}

TEST(ImportReportPanel, AForeignFileBringsItsReport) {
    OpenWindow shown(sample("zmx/tricky.zmx"));
    ImportReportPanel& report = shown.window.import_report_panel();
    EXPECT_TRUE(report_is_shown(shown.window));
    EXPECT_EQ(report.empty_text(), "");
    const Notes& notes = shown.window.document().notes();
    EXPECT_TRUE(std::ranges::is_permutation(report.model().notes(), notes)) << "none is lost";
    EXPECT_EQ(report.model().notes().front().severity, Note::Severity::error) << "first to mend";
    EXPECT_GT(report.model().rowCount(), 5);
    EXPECT_TRUE(report.state().contains("1 to mend")) << report.state().toStdString();
    const int all = report.filter().rowCount();
    shown.window.actions()["report.matters"].trigger();
    EXPECT_EQ(report.filter().rowCount(), report.model().count_what_matters());
    EXPECT_LT(report.filter().rowCount(), all);
    shown.window.actions()["report.all"].trigger();
    EXPECT_EQ(report.filter().rowCount(), all);
    shown.window.actions()["report.copy"].trigger();
    EXPECT_TRUE(QGuiApplication::clipboard()->text().contains("MYSTERY1"));
    // The next lens's report takes its place.
    EXPECT_TRUE(shown.window.open(test::tessar()));
    EXPECT_EQ(report.model().rowCount(), 0);
}

TEST(ImportReportPanel, ARowGoesToItsSurface) {
    OpenWindow shown(sample("zmx/tricky.zmx"));
    ImportReportPanel& report = shown.window.import_report_panel();
    const int row = row_about_surface(report.filter(), 3);
    ASSERT_GE(row, 0);
    const QModelIndex line = report.filter().index(row, NoteTableModel::text);
    report.table().scrollTo(line);
    QTest::mouseClick(report.table().viewport(), Qt::LeftButton, Qt::NoModifier,
                      report.table().visualRect(line).center());
    EXPECT_EQ(shown.window.prescription_panel().table().currentIndex().row(), 3);
}

TEST(UnknownGlass, IsSaidMarkedAndMendedInPlace) {
    OpenWindow shown(sample("zmx/unknown_glass.zmx"));
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());
    EXPECT_TRUE(window.banner().text().contains("SF2X")) << "in words, what is wrong";
    EXPECT_FALSE(window.picture().has_value());
    EXPECT_TRUE(window.first_order_panel().reason().contains("SF2X"));
    PrescriptionModel& model = window.prescription_panel().model();
    const QModelIndex cell = model.index(unknown_row, PrescriptionModel::medium);
    EXPECT_EQ(cell.data(Qt::ForegroundRole).value<QColor>(), current_palette().red_orange);
    EXPECT_TRUE(cell.data(Qt::ToolTipRole).toString().contains("not in the catalogues"));
    const QStringList offers = cell.data(PrescriptionModel::offers_role).toStringList();
    ASSERT_TRUE(offers.contains("SF2")) << offers.join(", ").toStdString();

    // Other cells can be edited meanwhile, and other views live on.
    EXPECT_TRUE(model.setData(model.index(0, PrescriptionModel::radius), "23", Qt::EditRole));
    window.document().history().undo();
    const Prescription before = window.document().lens();
    const int steps = window.document().history().index();

    window.actions()["edit.mend_glass"].trigger();
    auto* editor = window.prescription_panel().table().viewport()->findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    ASSERT_NE(editor->completer(), nullptr);
    ASSERT_TRUE(QTest::qWaitFor([&] { return editor->completer()->popup()->isVisible(); }, 5000));
    const QAbstractItemModel& list = *editor->completer()->completionModel();
    EXPECT_EQ(list.index(0, 0).data().toString(), offers.front()) << "what may be meant is first";
    editor->completer()->popup()->hide();
    editor->selectAll();
    QTest::keyClicks(editor, "sf2");
    editor->completer()->popup()->hide();
    QTest::keyClick(editor, Qt::Key_Return);
    QTest::qWait(10);

    const Medium& mended = window.document().lens().surfaces[unknown_row].medium_after;
    EXPECT_EQ(mended.name, "SF2");
    EXPECT_NEAR(refractive_index(mended, d_line_nm), 1.64769, 1e-4);  // Schott's data sheet
    EXPECT_EQ(window.document().history().index(), steps + 1);
    ASSERT_TRUE(shown.settle());
    EXPECT_EQ(window.banner().text(), "");
    ASSERT_TRUE(window.picture().has_value());
    EXPECT_TRUE(window.picture()->is_final);
    EXPECT_GT(window.ghost_panel().model().rowCount(), 0);
    EXPECT_EQ(window.first_order_panel().reason(), "");
    EXPECT_FALSE(window.actions()["edit.mend_glass"].isEnabled());
    window.actions()["edit.undo"].trigger();
    EXPECT_EQ(window.document().lens(), before);
    ASSERT_TRUE(shown.settle());
    EXPECT_TRUE(window.banner().text().contains("SF2X"));
}

TEST(UnknownGlass, TheNearestByIndexAreOfferedForAModelGlass) {
    const QStringList names = offered_glasses({"", ModelGlass{1.5168, 64.17}});
    EXPECT_TRUE(names.contains("N-BK7")) << names.join(", ").toStdString();
    EXPECT_TRUE(offered_glasses({}).isEmpty()) << "air needs none";
}

TEST(ForeignFile, SavingAsksForAJsonAndLeavesTheFile) {
    const QTemporaryDir folder;
    const QString foreign = folder.filePath("mine.zmx");
    ASSERT_TRUE(QFile::copy(QString::fromStdString(sample("zmx/triplet.zmx").string()), foreign));
    QFile file(foreign);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QByteArray content = file.readAll();
    OpenWindow shown(foreign.toStdString());
    MainWindow& window = shown.window;
    QString suggested;
    QString answer = foreign;
    window.files().ask_file_to_write = [&](const QString&, const QString& name, const QString&) {
        suggested = name;
        return answer;
    };
    EXPECT_FALSE(window.files().save());
    EXPECT_EQ(suggested, "mine.json");
    EXPECT_TRUE(window.banner().text().contains("json"));
    answer = folder.filePath("mine.json");
    EXPECT_TRUE(window.files().save());
    EXPECT_EQ(document_from_lens(read_lens(answer.toStdString()).lens).lens,
              window.document().lens());
    // From now on that is the file.
    suggested.clear();
    EXPECT_TRUE(window.files().save());
    EXPECT_EQ(suggested, "");
    file.seek(0);
    EXPECT_EQ(file.readAll(), content);
}

TEST(ForeignFile, AListingOfTheSameExtensionIsNotWrittenOver) {
    const QTemporaryDir folder;
    const QString foreign = folder.filePath("listing.json");
    const auto original = sample("listings/tessar_brendel_100_f2.8.json");
    ASSERT_TRUE(QFile::copy(QString::fromStdString(original.string()), foreign));
    OpenWindow shown(foreign.toStdString());
    QString suggested;
    shown.window.files().ask_file_to_write = [&](const QString&, const QString& name,
                                                 const QString&) {
        suggested = name;
        return foreign;
    };
    EXPECT_FALSE(shown.window.files().save());
    EXPECT_EQ(suggested, "listing_ghostlight.json");
    EXPECT_TRUE(shown.window.banner().text().contains("not written over"));
    EXPECT_FALSE(may_be_saved_over(foreign.toStdString()));
}

TEST(ForeignFile, DialogsListEveryFormat) {
    const QString open = lens_open_filter();
    const QString write = lens_export_filter();
    for (const LensFormat& format : lens_formats()) {
        const QString name = QString::fromStdString(std::string(format.name));
        EXPECT_TRUE(open.contains(name + " (")) << format.name;
        EXPECT_EQ(write.contains(name + " ("), format.write != nullptr) << format.name;
    }
}

TEST(ForeignFile, ADroppedOneIsOpened) {
    OpenWindow shown;
    for (const char* file :
         {"zmx/triplet_utf16.zmx", "seq/triplet.seq", "oslo/cooke_triplet.len",
          "pbrt/double_gauss.dat", "flaresim/double_gauss.lens", "open_lens_flare/heliar.xml",
          "optical_bench/zoom.txt", "realflare/double_gauss.json"}) {
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QString::fromStdString(sample(file).string()))});
        QDragEnterEvent enter(QPoint(20, 20), Qt::CopyAction, &data, Qt::LeftButton,
                              Qt::NoModifier);
        QApplication::sendEvent(&shown.window, &enter);
        EXPECT_TRUE(enter.isAccepted());
        QDropEvent drop(QPointF(20, 20), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&shown.window, &drop);
        EXPECT_EQ(shown.window.document().file().filename(), sample(file).filename());
    }
}

TEST(Export, ALensReadsBackAndTheReportSaysWhatIsLost) {
    const QTemporaryDir folder;
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    for (const char* extension : {"zmx", "seq", "lens", "json"}) {
        const QString file = folder.filePath(QStringLiteral("out.") + extension);
        window.files().ask_file_to_write = [&](const QString&, const QString&, const QString&) {
            return file;
        };
        window.actions()["file.export_lens"].trigger();
        EXPECT_EQ(window.banner().text(), "");
        const Prescription back = read_lens(file.toStdString()).lens;
        const Prescription& lens = window.document().lens();
        ASSERT_EQ(back.surfaces.size(), lens.surfaces.size()) << extension;
        EXPECT_EQ(back.stop.surface, lens.stop.surface) << extension;
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
            EXPECT_NEAR(curvature_per_mm(back.surfaces[row].curve),
                        curvature_per_mm(lens.surfaces[row].curve), 1e-9)
                << extension << ", surface " << row + 1;
        }
    }
    const QString file = folder.filePath("again.zmx");
    EXPECT_TRUE(window.files().export_lens(file.toStdString()));
    EXPECT_TRUE(report_is_shown(window)) << "coatings do not fit into a .zmx";
    EXPECT_TRUE(window.import_report_panel().state().contains("again.zmx"));
    EXPECT_FALSE(window.files().export_lens(folder.filePath("x.docx").toStdString()));
    EXPECT_TRUE(window.banner().text().contains("docx"));
}

TEST(Export, TheChosenGhostIsUnfolded) {
    const QTemporaryDir folder;
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    int asked = 0;
    const QString file = folder.filePath("ghost.zmx");
    window.files().ask_file_to_write = [&](const QString&, const QString& name, const QString&) {
        ++asked;
        EXPECT_TRUE(name.endsWith("_ghost_5-3.zmx")) << name.toStdString();
        return file;
    };
    window.actions()["file.export_ghost"].trigger();
    EXPECT_EQ(asked, 0);
    EXPECT_TRUE(window.banner().text().contains("Choose a ghost"));
    window.selection().set_ghosts({GhostPath{{4, 2}}});
    window.actions()["file.export_ghost"].trigger();
    EXPECT_EQ(asked, 1);
    QFile written(file);
    ASSERT_TRUE(written.open(QIODevice::ReadOnly));
    // 8 surfaces, and those from 5 back to 3 twice more, less one turn each: see the generator.
    const QByteArray text = written.readAll();
    EXPECT_TRUE(text.contains("MIRROR"));
    EXPECT_GT(text.count("SURF "), 8);
}

TEST(GlassFolders, AreKeptAndUsed) {
    const auto library = [] { return glass_library()->catalogs.size(); };
    OpenWindow shown(sample("zmx/unknown_glass.zmx"));
    MainWindow& window = shown.window;
    const std::size_t before = library();
    const int steps = window.document().history().count();
    const QTemporaryDir folder;
    // SAMPLE.AGF with the glass that the lens asks for.
    QFile agf(QString::fromStdString(sample("agf/SAMPLE.AGF").string()));
    ASSERT_TRUE(agf.open(QIODevice::ReadOnly));
    QByteArray text = agf.readAll();
    text.replace("NM BK7 ", "NM SF2X ");
    QFile mine(folder.filePath("MINE.AGF"));
    ASSERT_TRUE(mine.open(QIODevice::WriteOnly));
    mine.write(text);
    mine.close();

    GlassFoldersDialog dialog({});
    EXPECT_TRUE(dialog.summary().startsWith("0 catalogues"));
    dialog.add_folder(folder.path());
    EXPECT_TRUE(dialog.summary().startsWith("1 catalogue")) << dialog.summary().toStdString();
    window.files().ask_glass_folders = [&](const QStringList&) { return dialog.folders(); };
    window.actions()["file.glass_folders"].trigger();
    EXPECT_EQ(settings::glass_folders(), QStringList{folder.path()});
    EXPECT_EQ(library(), before + 1);
    // What the lens in hand asks for is there now: one step, which can be undone.
    EXPECT_EQ(first_unknown_glass(window.document().lens()), std::nullopt);
    EXPECT_EQ(window.document().history().count(), steps + 1);
    window.files().ask_glass_folders = [](const QStringList&) { return QStringList(); };
    window.actions()["file.glass_folders"].trigger();
    EXPECT_EQ(library(), before);
}

TEST(FirstOrderPanel, FollowsEditsAndIsCopied) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    FirstOrderPanel& panel = window.first_order_panel();
    ASSERT_TRUE(shown.settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel.model().rowCount() > 0; }, 5000));
    const auto efl = [&] { return panel.model().index(0, 1).data().toString().toDouble(); };
    EXPECT_NEAR(efl(), 100.0, 1.0) << "a Tessar of 100 mm";
    window.actions()["first_order.copy"].trigger();
    EXPECT_TRUE(QGuiApplication::clipboard()->text().startsWith("quantity\tvalue\nefl_mm\t"));
    // Twice as large, twice as long.
    Prescription lens = window.document().lens();
    for (Surface& surface : lens.surfaces) {
        if (auto* radius = std::get_if<Radius>(&surface.curve)) {
            radius->mm *= 2.0;
        }
        surface.thickness_mm *= 2.0;
        surface.semi_diameter_mm *= 2.0;
    }
    const double before = efl();
    window.document().edit_lens(lens, "double");
    ASSERT_TRUE(QTest::qWaitFor([&] { return efl() != before; }, 5000));
    EXPECT_NEAR(efl(), 2.0 * before, 2e-4 * before);  // five digits are shown
    window.document().history().undo();
}

}  // namespace
}  // namespace ghostlight
