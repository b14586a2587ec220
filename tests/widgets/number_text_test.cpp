#include "widgets/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ghostlight {
namespace {

TEST(NumberText, FourSignificantDigits) {
    EXPECT_EQ(significant(0.0431894), "0.04319");
    EXPECT_EQ(significant(34.0), "34.00");
    EXPECT_EQ(significant(9.99996), "10.00");
    EXPECT_EQ(significant(-127.944), "−127.9");
    EXPECT_EQ(significant(5.3714e-5), "5.371e−05");
    EXPECT_EQ(significant(4.53e-4), "4.530e−04");
    EXPECT_EQ(significant(0.0), "0");
    EXPECT_EQ(significant(std::numeric_limits<double>::infinity()), "∞");
}

TEST(NumberText, WhatWasTypedIsShown) {
    EXPECT_EQ(at_least_decimals(42.97, 3), "42.970");
    EXPECT_EQ(at_least_decimals(-115.33, 3), "−115.330");
    EXPECT_EQ(at_least_decimals(1.23456789, 3), "1.23456789");
    EXPECT_EQ(at_least_decimals(7, 0), "7");
}

TEST(NumberText, ShortestReadsBackExactly) {
    for (const double value : {0.1, 1.0 / 3.0, -115.33, 1e-300, 6.02214076e23}) {
        EXPECT_EQ(parse_number(shortest(value)), value);
    }
}

TEST(NumberText, ReadsWhatPeopleWrite) {
    EXPECT_EQ(parse_number(" 12.5 "), 12.5);
    EXPECT_EQ(parse_number("12,5"), 12.5);
    EXPECT_EQ(parse_number("−3"), -3.0);
    EXPECT_EQ(parse_number("+3"), 3.0);
    EXPECT_EQ(parse_number("1e-5"), 1e-5);
}

TEST(NumberText, RefusesTheRest) {
    for (const char* text : {"", "abc", "1 2", "1,2,3", "1.2,3", "nan", "inf", "1e999", "12 mm"}) {
        EXPECT_FALSE(parse_number(text)) << text;
    }
}

TEST(NumberText, GroupsOfThree) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(61440), QString::fromUtf8("61\u2009440"));
    EXPECT_EQ(grouped(48399573), QString::fromUtf8("48\u2009399\u2009573"));
}

}  // namespace
}  // namespace ghostlight
