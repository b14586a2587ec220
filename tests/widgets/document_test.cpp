#include "widgets/document.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

struct DocumentTest : testing::Test {
    DocumentTest() { EXPECT_FALSE(document.open(test::tessar())); }
    void set_radius(double mm) {
        Prescription lens = document.lens();
        lens.surfaces[0].curve = Radius{mm};
        document.edit_lens(std::move(lens), "change radius of surface 1", "0/radius");
    }
    QByteArray content(const QString& file) {
        QFile open(file);
        EXPECT_TRUE(open.open(QIODevice::ReadOnly));
        return open.readAll();
    }

    Document document;
    QTemporaryDir folder;
};

TEST_F(DocumentTest, OpensClean) {
    EXPECT_FALSE(document.is_modified());
    EXPECT_FALSE(document.history().canUndo());
    EXPECT_EQ(document.first_revision(), document.revision());
    EXPECT_EQ(document.title(), "Tessar 100 mm f/2.8 (Brendel)");
}

TEST_F(DocumentTest, SameFieldEditsMergeAndNoOpsVanish) {
    set_radius(43.0);
    set_radius(44.0);
    EXPECT_EQ(document.history().count(), 1);
    set_radius(42.97);  // back to where it was
    EXPECT_EQ(document.history().count(), 0);
    EXPECT_FALSE(document.is_modified());
    set_radius(42.97);
    EXPECT_EQ(document.history().count(), 0);
}

TEST_F(DocumentTest, EveryChangeHasARevision) {
    QSignalSpy changed(&document, &Document::changed);
    const auto first = document.revision();
    set_radius(43.0);
    document.history().undo();
    document.history().redo();
    EXPECT_EQ(document.revision(), first + 3);
    EXPECT_EQ(changed.count(), 3);
}

TEST_F(DocumentTest, TheLightIsUndoneButIsNoEdit) {
    Scene scene = document.scene();
    scene.light().direction.field_deg = 5.0;
    document.edit_scene(scene, "move the light", "light");
    EXPECT_FALSE(document.is_modified());
    document.history().undo();
    EXPECT_NE(document.scene().light().direction.field_deg, 5.0);
}

TEST_F(DocumentTest, SavesLensAndSceneAndReadsThemBack) {
    set_radius(43.0);
    Scene scene = document.scene();
    scene.light().direction = {7.25, 30.0};
    scene.light().spectrum = Monochromatic{550.0};
    scene.tolerance = 0.02;
    document.edit_scene(scene, "change light");
    const std::filesystem::path file = folder.filePath("lens.json").toStdString();
    ASSERT_FALSE(document.save_as(file));
    EXPECT_FALSE(document.is_modified());
    EXPECT_TRUE(document.saved_at().isValid());

    Document read;
    ASSERT_FALSE(read.open(file));
    EXPECT_EQ(read.lens(), document.lens());
    EXPECT_EQ(read.scene(), document.scene());
}

TEST_F(DocumentTest, AFailingOpenHarmsNothing) {
    set_radius(43.0);
    const auto revision = document.revision();
    const std::filesystem::path bad = folder.filePath("bad.json").toStdString();
    write_file_safely(bad, R"({"ghostlight_lens": 1, "surfaces": 7})");
    const auto error = document.open(bad);
    ASSERT_TRUE(error);
    EXPECT_NE(std::string(error->what()).find("surfaces"), std::string::npos);
    EXPECT_TRUE(document.open(folder.filePath("none.json").toStdString()));
    EXPECT_EQ(document.revision(), revision);
    EXPECT_TRUE(document.is_modified());
    EXPECT_TRUE(document.history().canUndo());
}

TEST_F(DocumentTest, AFailingSaveKeepsTheOldFile) {
    const QString file = folder.filePath("lens.json");
    ASSERT_FALSE(document.save_as(file.toStdString()));
    const QByteArray before = content(file);
    set_radius(43.0);
    // A folder that is a file cannot be written into, even by root.
    const auto impossible = (file + "/lens.json").toStdString();
    const auto error = document.save_as(impossible);
    ASSERT_TRUE(error);
    EXPECT_EQ(content(file), before);
    EXPECT_TRUE(document.is_modified());
    EXPECT_EQ(document.file().string(), file.toStdString());
}

TEST_F(DocumentTest, ABadSceneIsNoReasonToRefuseALens) {
    Prescription lens = document.lens();
    lens.unknown["scene"] =
        R"({"configuration": "nowhere", "field_deg": 95, "spectrum": "green", "tolerance": -1})";
    const DocumentState state = document_from_lens(lens);
    EXPECT_EQ(state.scene, default_scene(document.lens()));
    EXPECT_EQ(state.lens, document.lens());
}

}  // namespace
}  // namespace ghostlight
