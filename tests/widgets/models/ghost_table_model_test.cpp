#include "widgets/models/ghost_table_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QStringList>

#include <cmath>

#include "widgets/ghost_colors.h"

namespace ghostlight {
namespace {

GhostRow ghost(std::size_t i, std::size_t j, double flux_mm2) {
    GhostRow row;
    row.path.reflections = {i, j};
    row.flux_mm2 = flux_mm2;
    row.relative_flux = flux_mm2 / 900.0;
    row.centroid_y_mm = -1.0 / 3.0;
    row.rays = 1234;
    return row;
}

std::shared_ptr<const GhostTable> table(std::vector<GhostRow> rows) {
    GhostTable made;
    made.ghosts = std::move(rows);
    return std::make_shared<const GhostTable>(std::move(made));
}

struct GhostTableModelTest : testing::Test {
    GhostTableModel model;
    QAbstractItemModelTester tester{&model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(GhostTableModelTest, FollowsTables) {
    EXPECT_EQ(model.rowCount(), 0);
    model.set_table(table({ghost(4, 2, 0.04), ghost(7, 5, 0.03)}));
    EXPECT_EQ(model.rowCount(), 2);
    EXPECT_EQ(model.index(0, GhostTableModel::ghost).data().toString(), "5-3");
    model.set_table(table({ghost(7, 5, 0.05), ghost(4, 2, 0.04)}));
    EXPECT_EQ(model.index(0, GhostTableModel::ghost).data().toString(), "8-6");
    EXPECT_EQ(model.find(GhostPath{{4, 2}}), 1);
    model.set_table(table({ghost(4, 2, 0.04)}));
    EXPECT_EQ(model.rowCount(), 1);
    model.set_table(nullptr);
    EXPECT_EQ(model.rowCount(), 0);
}

TEST_F(GhostTableModelTest, FourDigitsOnScreenAllOnCopy) {
    model.set_table(table({ghost(4, 2, 1.0 / 30.0)}));
    EXPECT_EQ(model.index(0, GhostTableModel::flux).data().toString(), "0.03333");
    EXPECT_EQ(model.index(0, GhostTableModel::centroid_y).data().toString(), "−0.3333");
    GhostRow symmetric = ghost(7, 5, 0.01);
    symmetric.centroid_x_mm = -1.66e-17;
    model.set_table(table({ghost(4, 2, 1.0 / 30.0), symmetric}));
    EXPECT_EQ(model.index(1, GhostTableModel::centroid_x).data().toString(), "0");
    const QStringList lines = model.clipboard_text({0}).split('\n', Qt::SkipEmptyParts);
    ASSERT_EQ(lines.size(), 2);
    EXPECT_EQ(lines[0].split('\t').size(), lines[1].split('\t').size());
    EXPECT_EQ(lines[0].split('\t')[1], "flux_mm2");
    EXPECT_EQ(lines[1].split('\t')[1].toDouble(), 1.0 / 30.0);
}

TEST_F(GhostTableModelTest, BarsAreLogarithmic) {
    model.set_table(table({ghost(4, 2, 1.0), ghost(7, 5, 0.01), ghost(6, 5, 0.0)}));
    const auto bar = [&](int row) {
        return model.index(row, GhostTableModel::magnitude).data(GhostTableModel::bar_role);
    };
    EXPECT_DOUBLE_EQ(bar(0).toDouble(), 1.0);
    EXPECT_DOUBLE_EQ(bar(1).toDouble(), 0.5);
    EXPECT_FALSE(bar(2).isValid());
}

TEST_F(GhostTableModelTest, StaleNumbersStay) {
    model.set_table(table({ghost(4, 2, 0.04)}));
    model.set_stale(true);
    const QModelIndex flux = model.index(0, GhostTableModel::flux);
    EXPECT_EQ(flux.data().toString(), "0.04000");
    EXPECT_TRUE(flux.data(GhostTableModel::stale_role).toBool());
    model.set_table(table({ghost(4, 2, 0.05)}));
    EXPECT_FALSE(flux.data(GhostTableModel::stale_role).toBool());
}

TEST_F(GhostTableModelTest, SortsByTheNumbersThemselves) {
    model.set_table(table({ghost(10, 2, 0.04), ghost(9, 2, 5e-7)}));
    const auto key = [&](int row, GhostTableModel::Column column) {
        return model.index(row, column).data(GhostTableModel::sort_role).toDouble();
    };
    EXPECT_GT(key(0, GhostTableModel::flux), key(1, GhostTableModel::flux));
    EXPECT_GT(key(0, GhostTableModel::ghost), key(1, GhostTableModel::ghost));  // 11-3, 10-3
}

TEST(GhostColors, StayWithTheirGhost) {
    EXPECT_EQ(ghost_color(GhostPath{{4, 2}}), ghost_color(GhostPath{{4, 2}}));
    EXPECT_NE(ghost_color(GhostPath{{4, 2}}), ghost_color(GhostPath{{4, 1}}));
    EXPECT_NE(ghost_color(GhostPath{{4, 2}}), ghost_color(GhostPath{{4, 3}}));
}

}  // namespace
}  // namespace ghostlight
