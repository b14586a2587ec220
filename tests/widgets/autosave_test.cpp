#include "widgets/autosave.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

struct AutosaveTest : testing::Test {
    AutosaveTest() { EXPECT_FALSE(document.open(test::tessar())); }
    void edit() {
        Prescription lens = document.lens();
        lens.surfaces[0].curve = Radius{44.0};
        document.edit_lens(std::move(lens), "change radius of surface 1");
    }
    qsizetype copies() { return QDir(folder.path()).entryList({"*.json"}).size(); }

    Document document;
    QTemporaryDir folder;
};

TEST_F(AutosaveTest, KeepsUnsavedEditsAndRemovesThemWhenUndone) {
    Autosave autosave(document, folder.path());
    edit();
    autosave.write_now();
    EXPECT_EQ(copies(), 1);
    EXPECT_FALSE(Autosave::find_leftover(folder.path())) << "this program still runs";
    document.history().undo();
    EXPECT_EQ(copies(), 0);
}

TEST_F(AutosaveTest, WhatACrashLeftIsFound) {
    {
        Autosave autosave(document, folder.path());
        edit();
        autosave.write_now();
        // As if the program had ended here: the copy belongs to no running process.
        const QString copy = QDir(folder.path()).entryList({"*.json"}).front();
        ASSERT_TRUE(QFile::copy(folder.filePath(copy), folder.filePath("999999999.json")));
    }
    EXPECT_EQ(copies(), 1);
    const auto leftover = Autosave::find_leftover(folder.path());
    ASSERT_TRUE(leftover);
    EXPECT_EQ(leftover->state, document.state());
    EXPECT_EQ(leftover->file, document.file());

    Document recovered;
    recovered.adopt(leftover->state, leftover->file);
    EXPECT_TRUE(recovered.is_modified());
    EXPECT_EQ(recovered.lens(), document.lens());
}

TEST_F(AutosaveTest, ATornCopyIsDropped) {
    write_file_safely(folder.filePath("999999999.json").toStdString(), "{\"ghostlight_lens\": 1,");
    EXPECT_FALSE(Autosave::find_leftover(folder.path()));
    EXPECT_EQ(copies(), 0);
}

}  // namespace
}  // namespace ghostlight
