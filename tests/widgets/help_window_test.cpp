#include "widgets/help_window.h"

#include <gtest/gtest.h>

#include <QDockWidget>
#include <QFile>
#include <QScrollBar>
#include <QTableView>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>

#include "tests/widgets/window_kit.h"
#include "widgets/gl_view.h"
#include "widgets/help_pages.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/prescription_panel.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

TEST(HelpPages, AHeadingIsFoundByThePanelsTitle) {
    const QStringList all{"User guide",       "The prescription", "The ghost table",
                          "First-order data", "Lights",           "Panels and themes"};
    EXPECT_EQ(heading_about("Prescription", all), "The prescription");
    EXPECT_EQ(heading_about("Ghosts", all), "The ghost table");
    EXPECT_EQ(heading_about("First order", all), "First-order data");
    EXPECT_EQ(heading_about("Light", all), "Lights");
    EXPECT_EQ(heading_about("Themes", all), "Panels and themes");
    EXPECT_EQ(heading_about("Something else", all), "");
}

TEST(HelpPages, HeadingsOfCodeDoNotCount) {
    EXPECT_EQ(headings("# One\n```\n# two\n```\n## Three  \nfour"), (QStringList{"One", "Three"}));
}

TEST(HelpPages, TheGuideHasASectionForEveryPanelThatThereIs) {
    const auto folder = docs_folder();
    ASSERT_TRUE(folder);
    QFile guide(*folder + "/user-guide.md");
    ASSERT_TRUE(guide.open(QIODevice::ReadOnly));
    const QStringList all = headings(QString::fromUtf8(guide.readAll()));
    OpenWindow shown;
    const auto docks = shown.window.findChildren<QDockWidget*>();
    ASSERT_GE(docks.size(), 7);
    for (const QDockWidget* dock : docks) {
        EXPECT_FALSE(heading_about(guide_title(dock->objectName()), all).isEmpty())
            << qPrintable(dock->windowTitle()) << " has no heading in docs/user-guide.md";
    }
}

TEST(HelpWindow, F1OpensThePageOfThePanelInUse) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    ASSERT_TRUE(shown.settle());  // until then an empty state stands for the table
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    window.ghost_panel().table().setFocus();
    ASSERT_EQ(QApplication::focusWidget(), &window.ghost_panel().table());
    QTest::keyClick(&window.ghost_panel().table(), Qt::Key_F1);
    auto* help = window.findChild<HelpWindow*>();
    ASSERT_NE(help, nullptr);
    ASSERT_TRUE(QTest::qWaitForWindowExposed(help));
    const auto shows = [&](const char* heading) {
        return QTest::qWaitFor([&] { return help->heading_in_view() == heading; }, 5000);
    };
    EXPECT_TRUE(shows("The ghost table"))
        << qPrintable(help->heading_in_view()) << help->browser().verticalScrollBar()->value()
        << " of " << help->browser().verticalScrollBar()->maximum();

    // From another panel while the help is open, scrolled to elsewhere, or with another page in it.
    const auto ask_from = [&](QWidget& field) {
        window.activateWindow();
        // A window counts as active while one that belongs to it is.
        if (!QTest::qWaitFor([&] { return QApplication::activeWindow() == &window; }, 5000)) {
            ADD_FAILURE() << "the window does not come back";
        }
        field.setFocus();
        QTest::keyClick(&field, Qt::Key_F1);
    };
    ask_from(window.prescription_panel().table());
    EXPECT_TRUE(shows("The prescription")) << qPrintable(help->heading_in_view());
    help->browser().verticalScrollBar()->setValue(0);
    ask_from(window.prescription_panel().table());
    EXPECT_TRUE(shows("The prescription")) << qPrintable(help->heading_in_view());
    window.actions()["help.about"].trigger();
    ASSERT_TRUE(help->browser().toPlainText().contains("VTK"));
    ask_from(window.ghost_panel().table());
    EXPECT_TRUE(shows("The ghost table")) << qPrintable(help->heading_in_view());
    EXPECT_EQ(window.findChildren<HelpWindow*>().size(), 1);
}

TEST(HelpWindow, PicturesOfTheGuideAreThereAndFit) {
    HelpWindow help;
    ASSERT_TRUE(help.show_guide());
    int pictures = 0;
    const QTextDocument& page = *help.browser().document();
    for (QTextBlock block = page.begin(); block.isValid(); block = block.next()) {
        for (auto it = block.begin(); !it.atEnd(); ++it) {
            if (!it.fragment().charFormat().isImageFormat()) {
                continue;
            }
            const QString name = it.fragment().charFormat().toImageFormat().name();
            const auto image =
                help.browser().loadResource(QTextDocument::ImageResource, QUrl(name));
            EXPECT_FALSE(image.value<QImage>().isNull()) << name.toStdString();
            EXPECT_LE(image.value<QImage>().deviceIndependentSize().width(), 800)
                << name.toStdString();
            ++pictures;
        }
    }
    EXPECT_GE(pictures, 5);
}

TEST(HelpWindow, AboutNamesLibrariesAndOpenGl) {
    OpenWindow shown;
    shown.window.actions()["help.about"].trigger();
    auto* help = shown.window.findChild<HelpWindow*>();
    ASSERT_NE(help, nullptr);
    const QString text = help->browser().toPlainText();
    for (const char* library : {"Qt", "VTK", "OpenImageIO", "Ceres", "Eigen", "fmt"}) {
        EXPECT_TRUE(text.contains(library)) << library;
    }
    EXPECT_TRUE(text.contains(qVersion()));
    EXPECT_TRUE(text.contains(gl_support().renderer));
    EXPECT_FALSE(gl_support().renderer.isEmpty());
}

TEST(HelpWindow, TheShortcutsPageHasEveryKey) {
    OpenWindow shown;
    const QString page = shortcuts_page(shown.window);
    for (const ActionText& text : action_texts()) {
        if (*text.keys != '\0') {
            const QString key =
                shown.window.actions()[text.id].shortcut().toString(QKeySequence::NativeText);
            EXPECT_TRUE(page.contains(key.toHtmlEscaped())) << text.id;
        }
    }
}

}  // namespace
}  // namespace ghostlight
