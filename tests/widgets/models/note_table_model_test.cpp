#include "widgets/models/note_table_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QColor>

#include <algorithm>
#include <cmath>

#include "widgets/palette.h"

namespace ghostlight {
namespace {

struct NoteTableModelTest : testing::Test {
    NoteTableModelTest() {
        filter.setSourceModel(&model);
        lens.surfaces.resize(4);
    }
    QString cell(int row, int column) { return model.index(row, column).data().toString(); }

    Prescription lens;
    NoteTableModel model;
    NoteFilter filter;
    QAbstractItemModelTester tester{&model, QAbstractItemModelTester::FailureReportingMode::Fatal};
    QAbstractItemModelTester filter_tester{&filter,
                                           QAbstractItemModelTester::FailureReportingMode::Fatal};
    const Notes notes = {
        {Note::Severity::info, "line 4", "lengths in IN: times 25.4 to mm", Note::Fate::converted},
        {Note::Severity::warning, "SURF 3", "an obstruction", Note::Fate::left_out, true, "see it"},
        {Note::Severity::error, "line 9", "glass X is not known", Note::Fate::noticed}};
};

TEST_F(NoteTableModelTest, SaysWhatBecameOfEachLine) {
    EXPECT_EQ(model.rowCount(), 0);
    model.set_notes(notes, lens);
    ASSERT_EQ(model.rowCount(), 3);
    EXPECT_EQ(cell(2, NoteTableModel::place), "line 4");
    EXPECT_EQ(cell(2, NoteTableModel::fate), "converted");
    EXPECT_EQ(cell(2, NoteTableModel::matters), "");
    EXPECT_EQ(cell(1, NoteTableModel::fate), "left out");
    EXPECT_EQ(cell(1, NoteTableModel::matters), "matters");
    EXPECT_EQ(cell(1, NoteTableModel::proposal), "see it");
    EXPECT_EQ(cell(0, NoteTableModel::matters), "mend") << "what has to be mended is first";
    EXPECT_EQ(model.count(Note::Severity::warning), 2);
    EXPECT_EQ(model.count(Note::Severity::error), 1);
    EXPECT_EQ(model.index(1, 0).data(NoteTableModel::surface_role), 2);
    EXPECT_EQ(model.index(2, 0).data(NoteTableModel::surface_role), -1);
    model.set_notes({}, lens);
    EXPECT_EQ(model.rowCount(), 0);
}

TEST_F(NoteTableModelTest, TheFilterLeavesWhatMatters) {
    model.set_notes(notes, lens);
    EXPECT_EQ(filter.rowCount(), 3);
    filter.set_only_what_matters(true);
    ASSERT_EQ(filter.rowCount(), 2);
    EXPECT_EQ(filter.index(1, NoteTableModel::place).data().toString(), "SURF 3");
    model.set_notes({notes[0]}, lens);
    EXPECT_EQ(filter.rowCount(), 0);
    filter.set_only_what_matters(false);
    EXPECT_EQ(filter.rowCount(), 1);
}

/// Contrast by WCAG 2: (L1 + 0.05) / (L2 + 0.05).
double contrast(const QColor& a, const QColor& b) {
    const auto luminance = [](const QColor& color) {
        const auto linear = [](double s) {
            return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
               0.0722 * linear(color.blueF());
    };
    const double x = luminance(a), y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST_F(NoteTableModelTest, EveryLineIsLegibleInBothThemes) {
    model.set_notes(notes, lens);
    const Palette before = current_palette();
    for (const Palette& theme : {dark_palette(), light_palette()}) {
        current_palette() = theme;
        for (int row = 0; row < model.rowCount(); ++row) {
            for (int column = 0; column < model.columnCount(); ++column) {
                const auto pen = model.index(row, column).data(Qt::ForegroundRole).value<QColor>();
                EXPECT_GE(contrast(pen, theme.panel), 4.5) << row << ", " << column;
            }
        }
    }
    current_palette() = before;
}

}  // namespace
}  // namespace ghostlight
