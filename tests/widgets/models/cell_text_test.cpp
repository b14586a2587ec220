#include "widgets/models/cell_text.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/io/lens_file.h"

namespace ghostlight {
namespace {

std::string refusal(const auto& read) {
    try {
        read();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(CellText, CurvesReadBack) {
    for (const BaseCurve& curve :
         {BaseCurve(Plane{}), BaseCurve(Radius{-115.33}), BaseCurve(Curvature{0.0125})}) {
        EXPECT_EQ(read_curve(text_of_curve(curve)), curve);
    }
    for (const char* plane : {"", "plane", "inf", " Infinity ", "∞", "flat"}) {
        EXPECT_EQ(read_curve(plane), BaseCurve(Plane{})) << plane;
    }
}

TEST(CellText, CurveRefusals) {
    EXPECT_NE(refusal([] { read_curve("0"); }).find("radius"), std::string::npos);
    EXPECT_NE(refusal([] { read_curve("4o"); }).find("4o"), std::string::npos);
}

TEST(CellText, MediaReadBack) {
    const GlassCatalog& catalog = bundled_glasses();
    ASSERT_FALSE(catalog.glasses.empty());
    for (const Medium& medium :
         {Medium{}, catalog.glasses.front(), Medium{{}, ModelGlass{1.691, 54.8}},
          Medium{{}, ConstantIndex{1.5}}}) {
        EXPECT_EQ(read_medium(text_of_medium(medium), catalog), medium);
    }
    EXPECT_EQ(read_medium("air", catalog), Medium{});
    EXPECT_EQ(read_medium("1", catalog), Medium{});
}

TEST(CellText, MediumRefusals) {
    const GlassCatalog& catalog = bundled_glasses();
    EXPECT_NE(refusal([&] { read_medium("N-BK777", catalog); }).find("catalogue"),
              std::string::npos);
    EXPECT_FALSE(refusal([&] { read_medium("0.9", catalog); }).empty());
    EXPECT_FALSE(refusal([&] { read_medium("1.5 / 0", catalog); }).empty());
    EXPECT_FALSE(refusal([&] { read_medium("1.5 / 60 / 3", catalog); }).empty());
}

TEST(CellText, AsphericTermsReadBack) {
    const std::vector<double> terms = {1.2e-5, 0.0, -3e-10};
    EXPECT_EQ(read_aspheric(text_of_aspheric(terms)), terms);
    EXPECT_EQ(read_aspheric("1e-5, -2e-8"), (std::vector{1e-5, -2e-8}));
    EXPECT_EQ(read_aspheric("A8 = 3e-10"), (std::vector{0.0, 0.0, 3e-10}));
    EXPECT_TRUE(read_aspheric("").empty());
    EXPECT_TRUE(read_aspheric("A4=0").empty());
    EXPECT_FALSE(refusal([] { read_aspheric("A5=1"); }).empty());
    EXPECT_FALSE(refusal([] { read_aspheric("A4=x"); }).empty());
}

TEST(CellText, CoatingsReadBack) {
    const GlassCatalog& catalog = bundled_glasses();
    const LayerStack stack{{{Medium{{}, ConstantIndex{1.38}}, 96.4, 0.0},
                            {Medium{{}, ConstantIndex{2.1}}, 50.0, 0.01}}};
    for (const Coating& coating :
         {Coating(Uncoated{}), Coating(QuarterWave{}), Coating(QuarterWave{480.0, IdealIndex{}}),
          Coating(QuarterWave{550.0, Medium{{}, ConstantIndex{1.38}}, 1.05}), Coating(stack)}) {
        EXPECT_EQ(read_coating(text_of_coating(coating), catalog), coating)
            << text_of_coating(coating).toStdString();
    }
}

TEST(CellText, CoatingsAsPeopleWriteThem) {
    const GlassCatalog& catalog = bundled_glasses();
    EXPECT_EQ(read_coating("", catalog), Coating(Uncoated{}));
    EXPECT_EQ(read_coating("MgF₂ λ/4 550", catalog), Coating(QuarterWave{}));
    EXPECT_EQ(read_coating("mgf2 qw 550 nm", catalog), Coating(QuarterWave{}));
    EXPECT_EQ(read_coating("λ/4 550", catalog), Coating(QuarterWave{}));
    EXPECT_TRUE(std::holds_alternative<LayerStack>(read_coating("1.38:96.4 | 2.1:50", catalog)));
    // A name of the library, as it is typed and as it is shown.
    const Coating v_coat = read_coating("V-Coat", catalog);
    EXPECT_EQ(text_of_coating(v_coat), "v-coat");
    EXPECT_EQ(read_coating("r = 0.05, t=0.9", catalog), Coating(ConstantReflectance{0.05, 0.9}));
    for (const Coating& coating :
         {Coating(ConstantReflectance{0.05, 0.95}), Coating(ConstantReflectance{0.05, 0.9}),
          Coating(LayerStack{{{Medium{{}, ConstantIndex{1.38}}, 96.4, 0.0}}, true})}) {
        EXPECT_EQ(read_coating(text_of_coating(coating), catalog), coating);
    }
    EXPECT_THROW(read_coating("R=0.5, T=0.6", catalog), Error);
}

TEST(CellText, CoatingRefusals) {
    const GlassCatalog& catalog = bundled_glasses();
    for (const char* text : {"shiny", "1.38:96.4 | 2.1", "1.38:-1", "1.38,-1:50", "xyz λ/4 550",
                             "MgF2 λ/4 0", "1.38:"}) {
        EXPECT_FALSE(refusal([&] { read_coating(text, catalog); }).empty()) << text;
    }
}

}  // namespace
}  // namespace ghostlight
