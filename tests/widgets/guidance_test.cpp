// The tour, the gallery, the keyboard's way from panel to panel, and how large letters are.

#include <gtest/gtest.h>

#include <QDir>
#include <QDockWidget>
#include <QFrame>
#include <QHeaderView>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include <set>

#include "tests/widgets/window_kit.h"
#include "widgets/lens_gallery.h"
#include "widgets/lens_thumbnails.h"
#include "widgets/models/prescription_model.h"
#include "widgets/palette.h"
#include "widgets/panels/flare_panel.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/scene_field.h"
#include "widgets/settings.h"
#include "widgets/tour.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

std::size_t colors_in(const QImage& image, const QRect& part) {
    std::set<QRgb> colors;
    for (int y = part.top(); y <= part.bottom(); y += 2) {
        for (int x = part.left(); x <= part.right(); x += 2) {
            colors.insert(image.pixel(x, y));
        }
    }
    return colors.size();
}

TEST(Tour, ThreeStepsPointAtTheLightTheTableAndTheCoating) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    window.findChild<QDockWidget*>("ghosts")->hide();  // it brings up what it points at
    window.actions()["help.tour"].trigger();
    auto* tour = window.findChild<Tour*>();
    ASSERT_NE(tour, nullptr);
    const QWidget* targets[] = {&window.flare_panel(), &window.ghost_panel(),
                                &window.prescription_panel()};
    for (int step = 0; step < 3; ++step) {
        ASSERT_TRUE(tour->isVisible());
        EXPECT_EQ(tour->step(), step);
        QTest::qWait(20);
        EXPECT_TRUE(window.rect().contains(tour->geometry()));
        EXPECT_TRUE(targets[step]->isVisible());
        // The window is in use meanwhile.
        Scene scene = window.document().scene();
        scene.light().direction.field_deg = 2.0 + step;
        window.document().edit_scene(scene, "move the light");
        tour->go_to(step + 1);
    }
    EXPECT_FALSE(tour->isVisible());
    EXPECT_FALSE(settings::tour_is_due()) << "shown once";
}

TEST(Tour, EscapeAndSkipEndIt) {
    OpenWindow shown(test::tessar());
    shown.window.actions()["help.tour"].trigger();
    auto* tour = shown.window.findChild<Tour*>();
    QTest::keyClick(tour, Qt::Key_Escape);
    EXPECT_FALSE(tour->isVisible());
    shown.window.actions()["help.tour"].trigger();
    EXPECT_TRUE(tour->isVisible());
    for (QPushButton* button : tour->findChildren<QPushButton*>()) {
        if (button->text() == "Skip") {
            QTest::mouseClick(button, Qt::LeftButton);
        }
    }
    EXPECT_FALSE(tour->isVisible());
}

TEST(FirstStart, ABundledLensIsOpenAndTheTourBegins) {
    QSettings().remove("tour_seen");
    MainWindow window(true);
    window.show();
    window.welcome();
    EXPECT_FALSE(window.document().is_empty());
    EXPECT_TRUE(window.findChild<Tour*>()->isVisible());
    window.findChild<Tour*>()->end();
    MainWindow next(true);
    next.show();
    next.welcome();
    EXPECT_TRUE(next.document().is_empty());
    EXPECT_FALSE(next.findChild<Tour*>()->isVisible());
}

TEST(Gallery, EveryLayoutIsDrawn) {
    for (const BundledLens& lens : bundled_lenses()) {
        const QImage layout = layout_thumbnail(read_lens(lens.file).lens, 1.0);
        ASSERT_EQ(layout.size(), QSize(thumbnail_width_px, thumbnail_height_px));
        // Ground, glass, outlines, rays, axis: more than a few colours, with the blends of edges.
        EXPECT_GT(colors_in(layout, layout.rect()), 20U) << lens.name;
    }
}

TEST(Gallery, ThumbnailsAreMadeOnceAndKept) {
    const QTemporaryDir cache;
    const std::vector<std::filesystem::path> files{test::tessar()};
    QImage made, kept;
    for (QImage* picture : {&made, &kept}) {
        LensThumbnails thumbnails(files, cache.path(), 1.0);
        QObject::connect(&thumbnails, &LensThumbnails::flare_made, &thumbnails,
                         [picture](int, const QImage& flare) { *picture = flare; });
        QSignalSpy finished(&thumbnails, &LensThumbnails::finished);
        ASSERT_TRUE(finished.wait(test::patience_ms));
        ASSERT_FALSE(picture->isNull());
    }
    EXPECT_EQ(made.convertToFormat(QImage::Format_RGB32),
              kept.convertToFormat(QImage::Format_RGB32));
    EXPECT_EQ(QDir(cache.path()).entryList({"*.png"}).size(), 1);
    EXPECT_GT(colors_in(made, made.rect()), 20U) << "there is a flare in it";
}

TEST(Gallery, AChosenLensIsOpened) {
    OpenWindow shown;
    MainWindow& window = shown.window;
    window.actions()["file.gallery"].trigger();
    auto* gallery = window.findChild<LensGallery*>();
    ASSERT_NE(gallery, nullptr);
    EXPECT_EQ(gallery->list().count(), static_cast<int>(bundled_lenses().size()));
    gallery->list().setCurrentRow(2);
    const QString name = gallery->list().item(2)->text();
    QTest::keyClick(&gallery->list(), Qt::Key_Return);
    EXPECT_EQ(window.document().title(), name);
}

TEST(Gallery, ClosingItEndsTheWork) {
    OpenWindow shown;
    shown.window.actions()["file.gallery"].trigger();
    auto* gallery = shown.window.findChild<LensGallery*>();
    QTest::qWait(50);
    gallery->close();
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return shown.window.findChild<LensGallery*>() == nullptr; }, 20'000));
}

TEST(Keyboard, F6ReachesEveryPanelAndComesRound) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    std::set<const QWidget*> reached;
    int visible = 2;  // the scene bar and the flare
    for (const QDockWidget* dock : window.findChildren<QDockWidget*>()) {
        visible += dock->isHidden() ? 0 : 1;
    }
    const auto place = [&]() -> const QWidget* {
        for (const QWidget* at = QApplication::focusWidget(); at != nullptr;
             at = at->parentWidget()) {
            if (qobject_cast<const QDockWidget*>(at) != nullptr || at == &window.flare_panel() ||
                at->inherits("QToolBar")) {
                return at;
            }
        }
        return nullptr;
    };
    QString names;
    for (int k = 0; k < visible; ++k) {
        window.actions()["view.next_panel"].trigger();
        QTest::qWait(10);
        reached.insert(place());
        names += (place() == nullptr ? QStringLiteral("nothing") : place()->objectName()) + ' ';
    }
    EXPECT_EQ(reached.size(), static_cast<std::size_t>(visible)) << qPrintable(names);
    EXPECT_FALSE(reached.contains(nullptr));
    const QWidget* last = place();
    window.actions()["view.next_panel"].trigger();
    EXPECT_TRUE(reached.contains(place()));
    window.actions()["view.previous_panel"].trigger();
    EXPECT_EQ(place(), last);
}

TEST(Looks, LettersGrowAndShrinkWithinLimits) {
    OpenWindow shown;
    settings::set_look({});
    apply_theme(*qApp, Theme::dark);
    const int usual = QApplication::font().pixelSize();
    for (int k = 0; k < 20; ++k) {
        shown.window.actions()["view.larger_text"].trigger();
    }
    EXPECT_EQ(QApplication::font().pixelSize(), qRound(usual * most_text_scale));
    EXPECT_EQ(shown.window.prescription_panel().font().pixelSize(),
              QApplication::font().pixelSize());
    settings::set_look({});
    apply_theme(*qApp, Theme::dark);
    EXPECT_EQ(QApplication::font().pixelSize(), usual);
}

TEST(Looks, WhatIsThereHasRoomForLargerLetters) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    window.resize(1200, 800);
    window.arrange_panels();
    ASSERT_TRUE(shown.settle());
    for (int k = 0; k < 3; ++k) {
        window.actions()["view.larger_text"].trigger();
    }
    ASSERT_TRUE(shown.settle());
    for (const NumberField* field : window.findChildren<NumberField*>()) {
        const auto* editor = field->findChild<QLineEdit*>();
        EXPECT_GE(editor->width(), editor->fontMetrics().horizontalAdvance(editor->text()))
            << qPrintable(editor->text());
    }
    const QHeaderView& header = *window.prescription_panel().table().horizontalHeader();
    for (const int column : {PrescriptionModel::radius, PrescriptionModel::thickness}) {
        EXPECT_GE(header.sectionSize(column),
                  header.fontMetrics().horizontalAdvance(
                      header.model()->headerData(column, Qt::Horizontal).toString()));
    }
    // That of the ghosts has the name as well.
    QStringList cut_off;
    const auto nothing_is_cut_off = [&] {
        cut_off.clear();
        for (const QFrame* strip : window.findChildren<QFrame*>("layers_strip")) {
            for (const QToolButton* button : strip->findChildren<QToolButton*>()) {
                if (button->isVisible() && button->width() < button->sizeHint().width()) {
                    cut_off << QString("%1: %2 px of %3")
                                   .arg(button->text())
                                   .arg(button->width())
                                   .arg(button->sizeHint().width());
                }
            }
        }
        return cut_off.isEmpty();
    };
    constexpr int laid_out_after_ms = 3000;
    EXPECT_TRUE(QTest::qWaitFor(nothing_is_cut_off, laid_out_after_ms))
        << qPrintable(cut_off.join(", "));
    apply_theme(*qApp, Theme::dark);
}

TEST(Looks, OtherLettersLeaveTheThemeAsItIs) {
    OpenWindow shown;
    apply_theme(*qApp, Theme::light);
    const QColor ground = current_palette().panel;
    shown.window.actions()["view.larger_text"].trigger();
    EXPECT_EQ(current_theme(), Theme::light);
    EXPECT_EQ(current_palette().panel, ground);
    apply_theme(*qApp, Theme::dark);
    EXPECT_NE(current_palette().panel, ground);
}

}  // namespace
}  // namespace ghostlight
