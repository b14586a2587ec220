#include "widgets/models/quantity_model.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QStringList>

#include <limits>

#include "core/io/lens_file.h"
#include "core/optics/paraxial.h"
#include "core/units.h"
#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

struct QuantityModelTest : testing::Test {
    QString value(int row) { return model.index(row, QuantityModel::value).data().toString(); }

    QuantityModel model;
    QAbstractItemModelTester tester{&model, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(QuantityModelTest, NumbersThatDoNotExistAreShownAsSuch) {
    const double infinite = std::numeric_limits<double>::infinity();
    model.set_quantities({{"a_mm", 100.0 / 3.0, "", "A", "mm", "what A is"},
                          {"b", {}, "", "B", "", ""},
                          {"c_mm", -infinite, "", "C", "mm", ""},
                          {"d_mm", 1.7e-15, "", "D", "mm", ""},
                          {"e", std::int64_t{21}, "", "E", "", ""}});
    EXPECT_EQ(value(0), "33.333");
    EXPECT_EQ(value(1), "–");
    EXPECT_EQ(value(2), "−∞");
    EXPECT_EQ(value(3), "0");
    EXPECT_EQ(value(4), "21");
    EXPECT_TRUE(model.index(0, 0).data(Qt::ToolTipRole).toString().contains("what A is"));
    const QStringList lines = model.clipboard_text({0, 1}).split('\n');
    EXPECT_EQ(lines[1], "a_mm\t33.333333333333336");
    EXPECT_EQ(lines[2], "b\t");
    model.set_stale(true);
    EXPECT_EQ(model.index(0, 0).data(QuantityModel::stale_role), true);
    model.set_quantities({});
    EXPECT_EQ(model.rowCount(), 0);
}

TEST_F(QuantityModelTest, EveryQuantityHasALabelAUnitAndADefinition) {
    const auto quantities = lens_quantities(compile(read_lens(test::tessar()).lens, d_line_nm));
    EXPECT_GE(quantities.size(), 20U);
    for (const LensQuantity& each : quantities) {
        EXPECT_FALSE(each.label.empty()) << each.name;
        EXPECT_FALSE(each.definition.empty()) << each.name;
        const QString name = QString::fromStdString(each.name);
        const QString unit = name.endsWith("_per_mm") ? "1/mm"
                             : name.endsWith("_mm")   ? "mm"
                             : name.endsWith("_deg")  ? "°"
                                                      : "";
        EXPECT_EQ(QString::fromStdString(each.unit), unit) << each.name;
    }
}

}  // namespace
}  // namespace ghostlight
