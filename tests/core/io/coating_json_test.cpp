#include "core/io/coating_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/lens_file.h"
#include "tests/support/error_of.h"
#include "tests/support/optics_kit.h"

namespace ghostlight {
namespace {

Coating read(const std::string& text) {
    const std::string file = "x.json";
    const Json json = parse_json(text, file);
    UnknownFields unknown;
    Coating coating = read_coating(JsonAt(json, file, "coating"), unknown);
    EXPECT_TRUE(unknown.empty()) << text;
    return coating;
}

TEST(CoatingJson, EveryKindComesBack) {
    const MeasuredReflectance lossless{{450.0, 550.0},
                                       {0.0, 45.0},
                                       {{0.01, 0.01, 0.99, 0.99},
                                        {0.02, 0.005, 0.98, 0.995},
                                        {0.004, 0.004, 0.996, 0.996},
                                        {0.012, 0.003, 0.988, 0.997}},
                                       "sheet"};
    MeasuredReflectance lossy = lossless;
    lossy.shares[3].t_p = 0.9;
    LayerStack stack{{{medium(1.38), 99.6, 0.0},
                      {{"Ag", TabulatedGlass{{{450.0, 0.04}, {650.0, 0.06}}, true}},
                       10.0,
                       0.0,
                       {{450.0, 2.6}, {650.0, 4.4}}},
                      {{"S", AgfGlass{1, {2.3, -0.01, 0.011}, 300.0, 2000.0}}, 5.0, 0.01}},
                     true,
                     "mine"};
    for (const Coating& coating :
         {Coating(lossless), Coating(lossy), Coating(stack), Coating(LayerStack{}),
          Coating(ConstantReflectance{0.05, 0.95}), Coating(ConstantReflectance{0.2, 0.5})}) {
        const Json json = write_coating(coating);
        EXPECT_EQ(read(compact_json(json)), coating) << compact_json(json);
    }
}

TEST(CoatingJson, TakesNamesAndPartsOfAWave) {
    EXPECT_EQ(read("\"v-coat\""), read("{\"library\": \"V-Coat\"}"));
    EXPECT_EQ(read("\"uncoated\""), Coating(Uncoated{}));
    const auto stack = std::get<LayerStack>(
        read(R"({"layers": [{"index": 1.375, "waves": 0.25, "at_nm": 550}]})"));
    EXPECT_NEAR(stack.layers[0].thickness_nm, 100.0, 1e-12);
    EXPECT_FALSE(stack.from_air);
    EXPECT_EQ(read(R"({"constant": {"reflectance": 0.04}})"),
              Coating(ConstantReflectance{0.04, 0.96}));
}

struct Fault {
    const char* text;
    const char* where;
    const char* expected;
};
class CoatingJsonFaults : public testing::TestWithParam<Fault> {};

TEST_P(CoatingJsonFaults, AreNamed) {
    const Error::Parts error = error_of([] { read(GetParam().text); });
    EXPECT_EQ(error.where, GetParam().where);
    EXPECT_THAT(error.expected, testing::HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(
    All, CoatingJsonFaults,
    testing::Values(
        Fault{"\"no-such-coating\"", "coating", "v-coat"},
        Fault{"{\"library\": 3}", "coating.library", "name"},
        Fault{R"({"layers": [], "from": "behind"})", "coating.from", "air"},
        Fault{R"({"layers": [], "measured": {}})", "coating", "layers"},
        Fault{R"({"layers": [{"index": 1.4, "waves": 0.25}]})", "coating.layers[1].at_nm", "nm"},
        Fault{R"({"layers": [{"index": 1.4, "waves": 1, "at_nm": 5, "thickness_nm": 1}]})",
              "coating.layers[1]", "one of them"},
        Fault{
            R"({"layers": [{"index": 1.4, "thickness_nm": 1, "k": {"nm": [5, 4], "k": [1, 1]}}]})",
            "coating.layers[1].k.nm", "rising"},
        Fault{
            R"({"measured": {"nm": [500], "angles_deg": [0], "r_s": [[0.1, 0.2]], "r_p": [[0]]}})",
            "coating.measured.r_s[1]", "each angle"},
        Fault{R"({"measured": {"nm": [500], "angles_deg": [0], "r_s": [[0.1]]}})",
              "coating.measured.r_p", "reflectances"},
        Fault{R"({"constant": {}})", "coating.constant.reflectance", "share"}));

TEST(MediumJson, NewKindsComeBack) {
    Prescription lens = lens_of({row(50.0, 5.0, 1.5), row(-50.0, 90.0, 1.0)});
    for (const Medium& glass :
         {Medium{"BK7",
                 AgfGlass{1, {2.27, -0.01, 0.0106}, 330.0, 2300.0},
                 {{365.0, 0.988, 10.0}, {400.0, 0.998, 10.0}}},
          Medium{"", AgfGlass{13, {2.27, -0.01, -1e-4, 0.011}}},
          Medium{"PRV", TabulatedGlass{{{450.0, 1.53}, {650.0, 1.51}}}},
          Medium{"held", TabulatedGlass{{{550.0, 1.5}}, true}},
          Medium{"", FormulaGlass{9, {2.5, 0.024, 0.03, 0.02, 1.52, 0.88}}}}) {
        lens.surfaces[0].medium_after = glass;
        EXPECT_EQ(lens_from_json(lens_to_json(lens), "x").lens, lens) << lens_to_json(lens);
    }
}

}  // namespace
}  // namespace ghostlight
