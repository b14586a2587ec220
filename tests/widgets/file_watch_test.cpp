#include "widgets/file_watch.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QPushButton>
#include <QTemporaryDir>

#include "tests/widgets/window_kit.h"
#include "widgets/panels/banner.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

constexpr int soon_ms = 20'000;

/// A lens of the person's own, open in a window, and what another program does with its file.
struct FileWatchTest : testing::Test {
    FileWatchTest() : file(folder.filePath("mine.json")) {
        EXPECT_TRUE(QFile::copy(QString::fromStdString(test::tessar().string()), file));
        QFile::setPermissions(file, QFile::ReadOwner | QFile::WriteOwner);
        shown.window.open(file.toStdString());
        before = document().lens();
    }
    Document& document() { return shown.window.document(); }
    Banner& banner() { return shown.window.banner(); }
    void write_elsewhere(double radius_mm) {
        Prescription lens = before;
        lens.surfaces[0].curve = Radius{radius_mm};
        write_lens(lens, file.toStdString());  // aside, then renamed, as most programs do
    }
    Prescription on_file() const {
        return document_from_lens(read_lens(file.toStdString()).lens).lens;
    }
    bool waits_for(const char* words) {
        return QTest::qWaitFor([&] { return banner().text().contains(words); }, soon_ms);
    }
    void click(const char* text) {
        for (QPushButton* button : banner().findChildren<QPushButton*>()) {
            if (button->text() == text && button->isVisible()) {
                QTest::mouseClick(button, Qt::LeftButton);
                return;
            }
        }
        ADD_FAILURE() << "no button " << text;
    }

    QTemporaryDir folder;
    QString file;
    OpenWindow shown;
    Prescription before;
};

TEST_F(FileWatchTest, AChangeByAnotherProgramIsOfferedAndCanBeUndone) {
    write_elsewhere(50.0);
    ASSERT_TRUE(waits_for("changed by another program"));
    EXPECT_EQ(document().lens(), before) << "not touched without being asked";
    EXPECT_TRUE(document().is_modified()) << "no file holds it any more";
    click("Reload");
    EXPECT_EQ(document().lens().surfaces[0].curve, BaseCurve(Radius{50.0}));
    EXPECT_FALSE(document().is_modified());
    EXPECT_EQ(banner().text(), "");
    document().history().undo();
    EXPECT_EQ(document().lens(), before);
    EXPECT_TRUE(document().is_modified());
}

TEST_F(FileWatchTest, KeepingMineAsksOnceForEachChange) {
    write_elsewhere(50.0);
    ASSERT_TRUE(waits_for("changed by another program"));
    click("Keep Mine");
    EXPECT_EQ(banner().text(), "");
    EXPECT_EQ(document().lens(), before);
    QTest::qWait(600);  // three times as long as it waits for a file to settle
    EXPECT_EQ(banner().text(), "");
    write_elsewhere(60.0);
    EXPECT_TRUE(waits_for("changed by another program"));
    // Saving is an answer too.
    EXPECT_FALSE(document().save_as(document().file()));
    EXPECT_EQ(banner().text(), "");
    EXPECT_EQ(on_file(), before);
}

TEST_F(FileWatchTest, ItsOwnSavingIsNoChange) {
    Prescription lens = before;
    lens.surfaces[0].curve = Radius{45.0};
    document().edit_lens(lens, "change radius of surface 1");
    EXPECT_FALSE(document().save_as(document().file()));
    QTest::qWait(800);
    EXPECT_EQ(banner().text(), "");
    EXPECT_FALSE(document().is_modified());
}

TEST_F(FileWatchTest, ABrokenChangeLeavesTheLensInHand) {
    QFile broken(file);
    ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
    broken.write("{\"ghostlight_lens\": 1, \"surfaces\": 3}");
    broken.close();
    ASSERT_TRUE(waits_for("changed by another program"));
    click("Reload");
    EXPECT_TRUE(banner().text().contains("surfaces")) << qPrintable(banner().text());
    EXPECT_EQ(document().lens(), before);
    EXPECT_TRUE(document().is_modified());
}

TEST_F(FileWatchTest, ARemovedFileIsSaidAndSavedAnew) {
    ASSERT_TRUE(QFile::remove(file));
    ASSERT_TRUE(waits_for("removed by another program"));
    EXPECT_EQ(document().lens(), before);
    EXPECT_TRUE(document().is_modified());
    shown.window.actions()["file.save"].trigger();
    EXPECT_EQ(on_file(), before);
    EXPECT_FALSE(document().is_modified());
}

TEST_F(FileWatchTest, AChangeThatIsTakenBackIsForgotten) {
    QFile original(file);
    ASSERT_TRUE(original.open(QIODevice::ReadOnly));
    const QByteArray bytes = original.readAll();
    write_elsewhere(50.0);
    ASSERT_TRUE(waits_for("changed by another program"));
    QFile back(file);
    ASSERT_TRUE(back.open(QIODevice::WriteOnly));
    back.write(bytes);
    back.close();
    EXPECT_TRUE(QTest::qWaitFor([&] { return banner().text().isEmpty(); }, soon_ms));
}

}  // namespace
}  // namespace ghostlight
