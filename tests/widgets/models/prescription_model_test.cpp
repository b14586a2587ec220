#include "widgets/models/prescription_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

struct Editing : testing::Test {
    Editing() { EXPECT_FALSE(document.open(test::tessar())); }
    QModelIndex cell(int row, PrescriptionModel::Column column) { return model.index(row, column); }
    bool set(int row, PrescriptionModel::Column column, const char* text) {
        return model.setData(cell(row, column), QString::fromUtf8(text), Qt::EditRole);
    }

    Document document;
    PrescriptionModel model{document};
    QAbstractItemModelTester tester{&model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

using PrescriptionModelTest = Editing;

TEST_F(PrescriptionModelTest, ShowsTheLens) {
    EXPECT_EQ(model.rowCount(), 8);
    EXPECT_EQ(cell(0, PrescriptionModel::radius).data().toString(), "42.970");
    EXPECT_EQ(cell(3, PrescriptionModel::radius).data().toString(), "stop");
    EXPECT_EQ(cell(0, PrescriptionModel::medium).data().toString(), "1.6910 / 54.8");
    EXPECT_EQ(cell(1, PrescriptionModel::coating).data().toString(), "cemented");
}

TEST_F(PrescriptionModelTest, EveryCellTakesItsOwnText) {
    const auto before = document.lens();
    for (int row = 0; row < model.rowCount(); ++row) {
        for (int column = 1; column < model.columnCount(); ++column) {
            const QModelIndex index = model.index(row, column);
            EXPECT_TRUE(model.setData(index, index.data(Qt::EditRole), Qt::EditRole));
        }
    }
    EXPECT_EQ(document.lens(), before);
    EXPECT_FALSE(document.history().canUndo());
}

TEST_F(PrescriptionModelTest, AnEditIsOneNamedStep) {
    const auto revision = document.revision();
    EXPECT_TRUE(set(2, PrescriptionModel::radius, "300"));
    EXPECT_GT(document.revision(), revision);
    EXPECT_EQ(document.history().undoText(), "change radius of surface 3");
    EXPECT_TRUE(set(2, PrescriptionModel::radius, "301"));
    EXPECT_EQ(document.history().count(), 1);  // the same field
    EXPECT_TRUE(set(2, PrescriptionModel::thickness, "4"));
    EXPECT_EQ(document.history().count(), 2);
    document.history().undo();
    document.history().undo();
    EXPECT_EQ(cell(2, PrescriptionModel::radius).data().toString(), "306.840");
}

TEST_F(PrescriptionModelTest, RefusesWithAReasonAndLosesNothing) {
    const auto before = document.lens();
    QSignalSpy refused(&model, &PrescriptionModel::refused);
    const std::pair<PrescriptionModel::Column, const char*> bad[] = {
        {PrescriptionModel::radius, "0"},         {PrescriptionModel::radius, "4o"},
        {PrescriptionModel::thickness, ""},       {PrescriptionModel::semi_diameter, "0"},
        {PrescriptionModel::semi_diameter, "-3"}, {PrescriptionModel::medium, "NO-GLASS"},
        {PrescriptionModel::coating, "shiny"},    {PrescriptionModel::aspheric, "A5=1"},
        {PrescriptionModel::conic, "round"},
    };
    for (const auto& [column, text] : bad) {
        EXPECT_FALSE(model.refusal(cell(0, column), text).isEmpty()) << text;
        EXPECT_FALSE(set(0, column, text)) << text;
    }
    EXPECT_EQ(refused.count(), static_cast<int>(std::size(bad)));
    EXPECT_EQ(document.lens(), before);
    EXPECT_FALSE(document.history().canUndo());
}

TEST_F(PrescriptionModelTest, RowsComeAndGoWithTheStop) {
    EXPECT_TRUE(model.insert_after(0));
    EXPECT_EQ(model.rowCount(), 9);
    EXPECT_EQ(document.lens().stop.surface, 4U);
    EXPECT_TRUE(model.move(4, 2));
    EXPECT_EQ(document.lens().stop.surface, 2U);
    EXPECT_FALSE(model.remove(2)) << "the stop's row stays";
    EXPECT_TRUE(model.make_stop(3));
    EXPECT_TRUE(model.remove(2));
    EXPECT_EQ(document.lens().stop.surface, 2U);
    while (document.history().canUndo()) {
        document.history().undo();
    }
    EXPECT_EQ(model.rowCount(), 8);
    EXPECT_FALSE(document.is_modified());
}

TEST_F(PrescriptionModelTest, AConfigurationsThicknessIsItsOwn) {
    ASSERT_FALSE(document.open(test::bundled("nikon_zoom_80_200_f2.8.json")));
    ASSERT_FALSE(document.lens().configurations.empty());
    const Configuration& position = document.lens().configurations.back();
    ASSERT_FALSE(position.thickness_mm.empty());
    const auto row = position.thickness_mm.begin()->first;
    const double listed = document.lens().surfaces[row].thickness_mm;
    Scene scene = document.scene();
    scene.configuration = position.name;
    document.edit_scene(scene, "change configuration");
    EXPECT_TRUE(set(static_cast<int>(row), PrescriptionModel::thickness, "1.25"));
    EXPECT_EQ(document.lens().surfaces[row].thickness_mm, listed);
    EXPECT_EQ(document.configured_lens().surfaces[row].thickness_mm, 1.25);
}

TEST_F(PrescriptionModelTest, ChipsForWhatReflects) {
    const auto chip = [&](int row) {
        return cell(row, PrescriptionModel::coating).data(Qt::DecorationRole).value<QColor>();
    };
    EXPECT_EQ(chip(0).alpha(), 255);
    EXPECT_EQ(chip(3).alpha(), 0);  // air on both sides of the stop
    // A quarter wave for 550 nm reflects least in the green.
    EXPECT_LT(chip(0).green(), chip(0).blue());
    EXPECT_LT(chip(0).green(), chip(0).red());
    // Without a coating, glass is as neutral as it can be, and brighter.
    EXPECT_TRUE(set(0, PrescriptionModel::coating, "none"));
    EXPECT_NEAR(chip(0).red(), chip(0).blue(), 12);
}

TEST_F(PrescriptionModelTest, AMovingLightIsNoNews) {
    QSignalSpy changed(&model, &PrescriptionModel::dataChanged);
    Scene scene = document.scene();
    scene.light().direction.field_deg = 3.0;
    document.edit_scene(scene, "move the light");
    EXPECT_EQ(changed.count(), 0);
    scene.light().spectrum = Monochromatic{450.0};
    document.edit_scene(scene, "change spectrum");
    EXPECT_EQ(changed.count(), 1);  // the chips
}

TEST_F(PrescriptionModelTest, HeadersSayUnitsAndSigns) {
    const auto header = [&](int column, int role) {
        return model.headerData(column, Qt::Horizontal, role).toString();
    };
    EXPECT_EQ(header(PrescriptionModel::radius, Qt::DisplayRole), "Radius mm");
    EXPECT_TRUE(header(PrescriptionModel::radius, Qt::ToolTipRole).contains("towards the sensor"));
}

}  // namespace
}  // namespace ghostlight
