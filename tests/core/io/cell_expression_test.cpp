#include "core/io/cell_expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "core/error.h"

namespace ghostlight {
namespace {

double in_mm(std::string_view text) {
    return read_cell_expression(text, CellUnit::mm, "a thickness in mm");
}

TEST(CellExpressionTest, NumbersAreTakenToTheLastBit) {
    EXPECT_EQ(in_mm("13.2"), 13.2);
    EXPECT_EQ(in_mm("-0.1"), -0.1);
    EXPECT_EQ(in_mm("−42.97"), -42.97);
    EXPECT_EQ(in_mm("+1e-3"), 1e-3);
    EXPECT_EQ(in_mm("1,5"), 1.5);
    EXPECT_EQ(in_mm(" = 0.1mm "), 0.1);
}

TEST(CellExpressionTest, ArithmeticIsSchoolArithmetic) {
    EXPECT_EQ(in_mm("=2*13.2"), 26.4);
    EXPECT_EQ(in_mm("1/3"), 1.0 / 3.0);
    EXPECT_EQ(in_mm("1+2*3"), 7.0);
    EXPECT_EQ(in_mm("10-4-3"), 3.0);
    EXPECT_EQ(in_mm("24/4/2"), 3.0);
    EXPECT_EQ(in_mm("2^3^2"), 512.0);
    EXPECT_EQ(in_mm("-2^2"), -4.0);
    EXPECT_EQ(in_mm("2*-3"), -6.0);
    EXPECT_EQ(in_mm("(1+2)*(3−1)"), 6.0);
    EXPECT_EQ(in_mm("7×2÷4"), 3.5);
    EXPECT_EQ(in_mm("sqrt(2)^2 * 0 + sqrt(16)"), 4.0);
    // Within rounding of the sine.
    EXPECT_NEAR(in_mm("100*sin(30)"), 50.0, 1e-13);
    EXPECT_EQ(in_mm("pi"), std::acos(-1.0));
}

TEST(CellExpressionTest, UnitsAreTheirDefinitions) {
    EXPECT_EQ(in_mm("0.5in"), 12.7);
    EXPECT_EQ(in_mm("0.5\""), 12.7);
    EXPECT_EQ(in_mm("3/16in"), 3 * 25.4 / 16);
    EXPECT_EQ(in_mm("1/2 in"), 12.7);
    EXPECT_EQ(in_mm("1ft"), 304.8);
    EXPECT_EQ(in_mm("2.5cm"), 25.0);
    EXPECT_EQ(in_mm("500nm"), 0.0005);
    EXPECT_EQ(in_mm("250 µm"), 0.25);
    EXPECT_EQ(in_mm("1in + 1"), 26.4);
    EXPECT_EQ(in_mm("1 + 1in"), 26.4);
    EXPECT_DOUBLE_EQ(in_mm("2in*3"), 152.4);
    EXPECT_EQ(in_mm("(1mm*4mm)/2mm"), 2.0);
    EXPECT_EQ(in_mm("sqrt(4)in"), 50.8);
    EXPECT_EQ(read_cell_expression("0.1um", CellUnit::nm, "nm"), 100.0);
    EXPECT_EQ(read_cell_expression("96.4", CellUnit::nm, "nm"), 96.4);
    EXPECT_EQ(read_cell_expression("1/50mm", CellUnit::per_mm, "1/mm"), 0.02);
    EXPECT_EQ(read_cell_expression("1/50", CellUnit::per_mm, "1/mm"), 0.02);
    EXPECT_EQ(read_cell_expression("10°", CellUnit::deg, "degrees"), 10.0);
    EXPECT_NEAR(read_cell_expression("pi rad", CellUnit::deg, "degrees"), 180.0, 1e-12);
}

TEST(CellExpressionTest, RefusesWithWhatIsWrong) {
    const std::string bad[] = {"",      "=",     "4o",        "2*",      "(1",      "1)",
                               "1/0",   "0/0",   "5kg",       "1mm*1mm", "1mm^0.5", "2in 3in",
                               "1 2",   "1e999", "sqrt(-1)",  "asin(2)", "sin",     "sqrt(1mm)",
                               "inf",   "nan",   "system(1)", "1;2",     "a1",      "1mm+1deg",
                               "10deg", "--",    "2**3",      "0x10",    "1..2",    "9^9^9"};
    for (const std::string& text : bad) {
        try {
            in_mm(text);
            ADD_FAILURE() << "took '" << text << "'";
        } catch (const Error& error) {
            EXPECT_FALSE(error.parts().problem.empty()) << text;
            EXPECT_NE(error.parts().expected.find("a thickness in mm"), std::string::npos) << text;
        }
    }
    EXPECT_THROW(read_cell_expression("3mm", CellUnit::none, "a conic constant"), Error);
    EXPECT_THROW(read_cell_expression("3mm", CellUnit::per_mm, "a curvature"), Error);
}

TEST(CellExpressionTest, WhateverAClipboardHoldsDoesNotRunAway) {
    EXPECT_THROW(in_mm(std::string(100'000, '(')), Error);
    EXPECT_THROW(in_mm(std::string(900, '(')), Error);
    EXPECT_THROW(in_mm(std::string(900, '-')), Error);
    EXPECT_EQ(in_mm(std::string(50, '(') + "1" + std::string(50, ')')), 1.0);
}

/// Numbers written with every digit come back to the last bit, signs and exponents included.
TEST(CellExpressionTest, WhatIsWrittenIsReadBack) {
    unsigned state = 1;
    for (int k = 0; k < 2000; ++k) {
        state = state * 1664525U + 1013904223U;
        const double value = (static_cast<double>(state) / 4294967296.0 - 0.5) *
                             std::pow(10.0, static_cast<int>(state >> 8U) % 12 - 6);
        char text[64];
        std::snprintf(text, sizeof text, "%.17g", value);
        EXPECT_EQ(in_mm(text), value) << text;
        EXPECT_EQ(in_mm(std::string(text) + " mm"), value) << text;
    }
}

}  // namespace
}  // namespace ghostlight
