#include "widgets/panels/light_panel.h"

#include <gtest/gtest.h>

#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QSignalSpy>
#include <QToolButton>

#include "tests/widgets/window_kit.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/layers_strip.h"
#include "widgets/panels/scene_field.h"

namespace ghostlight {
namespace {

struct LightPanelTest : testing::Test {
    LightPanelTest() { EXPECT_FALSE(document.open(test::tessar())); }
    const Scene& scene() const { return document.scene(); }
    void type(const char* id, const QString& text) { Q_EMIT panel.number(id).entered(text); }

    Document document;
    Selection selection;
    LightPanel panel{document, selection};
};

TEST_F(LightPanelTest, LightsComeAndGo) {
    EXPECT_EQ(panel.list().count(), 1);
    EXPECT_FALSE(panel.remove().isEnabled());
    panel.add().click();
    ASSERT_EQ(scene().lights.size(), 2U);
    EXPECT_EQ(scene().active_light, 1U);
    EXPECT_EQ(panel.list().count(), 2);
    EXPECT_EQ(panel.list().currentRow(), 1);
    type("field", "4");
    EXPECT_EQ(scene().lights[1].direction.field_deg, 4.0);
    EXPECT_NE(scene().lights[0].direction.field_deg, 4.0);
    panel.list().setCurrentRow(0);
    EXPECT_EQ(scene().active_light, 0U);
    panel.list().item(1)->setCheckState(Qt::Unchecked);
    EXPECT_FALSE(scene().lights[1].on);
    panel.remove().click();
    ASSERT_EQ(scene().lights.size(), 1U);
    EXPECT_EQ(scene().light().direction.field_deg, 4.0);
    document.history().undo();
    EXPECT_EQ(scene().lights.size(), 2U);
}

TEST_F(LightPanelTest, ValuesHaveARangeAndAReset) {
    QSignalSpy refused(&panel, &LightPanel::refused);
    type("intensity", "-3.5");
    EXPECT_EQ(scene().light().intensity_ev, -3.5);
    EXPECT_TRUE(panel.reset("intensity").isEnabled());
    type("intensity", "41");
    EXPECT_EQ(scene().light().intensity_ev, -3.5);
    ASSERT_FALSE(refused.isEmpty());
    EXPECT_TRUE(refused.back().front().toString().contains("41"));
    panel.reset("intensity").click();
    EXPECT_EQ(scene().light().intensity_ev, 0.0);
    EXPECT_FALSE(panel.reset("intensity").isEnabled());
    Q_EMIT panel.number("folded").stepped(5);
    EXPECT_NEAR(scene().veil.folded_share, 0.05, 1e-12);
    Q_EMIT panel.number("folded").stepped(100);
    EXPECT_EQ(scene().veil.folded_share, most_folded_share);
}

TEST_F(LightPanelTest, SpectrumAndSizeAreTyped) {
    Q_EMIT panel.choice("spectrum").entered("sodium");
    EXPECT_EQ(scene().light().spectrum, Spectrum(SodiumLight{}));
    Q_EMIT panel.choice("size").entered("sun");
    EXPECT_EQ(scene().light().size, LightSize(DiscSize{}));
    QSignalSpy refused(&panel, &LightPanel::refused);
    Q_EMIT panel.choice("size").entered("moon");
    EXPECT_EQ(scene().light().size, LightSize(DiscSize{}));
    EXPECT_TRUE(refused.back().front().toString().contains("moon"));
    Q_EMIT panel.choice("spectrum").entered("no_such_lamp.csv");
    EXPECT_EQ(scene().light().spectrum, Spectrum(SodiumLight{}));
    panel.reset("spectrum").click();
    EXPECT_EQ(scene().light().spectrum, Spectrum(StandardLight{}));
}

TEST_F(LightPanelTest, ArtisticChangesAreOfTheChosenGhosts) {
    EXPECT_TRUE(scene().artistic.is_neutral());
    selection.set_ghosts({GhostPath{{4, 2}}, GhostPath{{6, 2}}});
    type("ghost_gain", "2");
    type("ghost_blue", "0.5");
    ASSERT_EQ(scene().artistic.ghosts.size(), 2U);
    EXPECT_EQ(scene().artistic.ghosts[1].gain_ev, 2.0);
    EXPECT_EQ(scene().artistic.ghosts[1].tint[2], 0.5);
    panel.reset("ghost_gain").click();
    panel.reset("ghost_blue").click();
    EXPECT_TRUE(scene().artistic.ghosts.empty()) << "neutral ones are not kept";
    type("exaggeration", "3");
    EXPECT_EQ(scene().artistic.exaggeration_ev, 3.0);
}

struct LayersStripTest : testing::Test {
    LayersStripTest() { EXPECT_FALSE(document.open(test::tessar())); }
    const LayerSettings& layers() const { return document.scene().layers; }
    Document document;
    LayersStrip strip{document};
};

TEST_F(LayersStripTest, SwitchesGainsAndAlone) {
    EXPECT_TRUE(strip.on(LayerKind::ghosts).isChecked());
    strip.on(LayerKind::veil).click();
    EXPECT_TRUE(layers().of(LayerKind::veil).on);
    Q_EMIT strip.gain(LayerKind::veil).entered("-1.5");
    EXPECT_EQ(layers().of(LayerKind::veil).gain_ev, -1.5);
    QSignalSpy refused(&strip, &LayersStrip::refused);
    Q_EMIT strip.gain(LayerKind::veil).entered("loud");
    EXPECT_TRUE(refused.back().front().toString().contains("loud"));
    strip.alone(LayerKind::veil).click();
    EXPECT_EQ(layers().alone, LayerKind::veil);
    EXPECT_FALSE(layers().shows(LayerKind::ghosts));
    strip.alone(LayerKind::veil).click();
    EXPECT_FALSE(layers().alone);
    document.history().undo();
    EXPECT_EQ(layers().alone, LayerKind::veil);
}

TEST_F(LayersStripTest, NamesStayWholeHoweverNarrowAndAMenuHasTheRest) {
    strip.on(LayerKind::veil).click();
    strip.on(LayerKind::starburst).click();
    strip.resize(1600, 40);
    strip.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&strip));
    EXPECT_TRUE(strip.gain(LayerKind::veil).isVisible());
    EXPECT_FALSE(strip.more().isVisible());
    int names_px = 0;
    for (const LayerKind kind : layer_kinds) {
        names_px += strip.on(kind).sizeHint().width();
    }
    for (int width = 1600; width > names_px + 120; width -= 40) {
        strip.resize(width, 40);
        QCoreApplication::processEvents();
        for (const LayerKind kind : layer_kinds) {
            EXPECT_TRUE(strip.on(kind).isVisible());
            EXPECT_GE(strip.on(kind).width(), strip.on(kind).sizeHint().width()) << width;
            EXPECT_LE(strip.on(kind).geometry().right(), width);
        }
    }
    ASSERT_TRUE(strip.more().isVisible());
    EXPECT_FALSE(strip.gain(LayerKind::veil).isVisible());
    QTest::mouseClick(&strip.more(), Qt::LeftButton);
    auto* menu = strip.findChild<QMenu*>("more_of_layers");
    ASSERT_NE(menu, nullptr);
    const double before_ev = layers().of(LayerKind::ghosts).gain_ev;
    ASSERT_FALSE(menu->actions().isEmpty());
    for (QAction* action : menu->actions()) {
        if (action->text() == "Half a Stop Brighter") {
            action->trigger();  // the first is the ghosts'
            break;
        }
    }
    EXPECT_EQ(layers().of(LayerKind::ghosts).gain_ev, before_ev + 0.5);
    menu->close();
}

TEST_F(LayersStripTest, ABackdropAsksForItsFile) {
    strip.ask_backdrop = [] { return QString(); };
    strip.on(LayerKind::backdrop).click();
    EXPECT_FALSE(layers().of(LayerKind::backdrop).on);
    EXPECT_FALSE(strip.on(LayerKind::backdrop).isChecked());
    strip.ask_backdrop = [] { return QString("street.exr"); };
    strip.on(LayerKind::backdrop).click();
    EXPECT_TRUE(layers().of(LayerKind::backdrop).on);
    EXPECT_EQ(document.scene().backdrop.file, "street.exr");
}

struct LayersInJobs : testing::Test {
    void open() {
        ASSERT_FALSE(document.open(test::tessar()));
        Scene scene = document.scene();
        scene.tolerance = 0.5;
        scene.light().spectrum = Monochromatic{};
        document.edit_scene(scene, "change tolerance");
        QObject::connect(&jobs, &Jobs::flare_ready, &jobs,
                         [this](const FlarePicture& picture) { pictures.push_back(picture); });
        QObject::connect(&jobs, &Jobs::table_ready, &jobs,
                         [this](const auto& table) { tables.push_back(table); });
        ASSERT_TRUE(settle());
        pictures.clear();
    }
    bool settle() {
        return QTest::qWaitFor([&] { return !jobs.is_busy(); }, test::patience_ms);
    }
    Document document;
    Selection selection;
    Jobs jobs{document, selection};
    std::vector<FlarePicture> pictures;
    std::vector<std::shared_ptr<const GhostTable>> tables;
};

TEST_F(LayersInJobs, AGainAddsUpWhatIsThere) {
    open();
    const auto tables_before = tables.size();
    Scene scene = document.scene();
    scene.layers.of(LayerKind::ghosts).gain_ev = 2.0;
    document.edit_scene(scene, "gain");
    ASSERT_TRUE(settle());
    ASSERT_EQ(pictures.size(), 1U) << "no coarse picture before";
    const FlarePicture& picture = pictures.front();
    ASSERT_EQ(picture.layers.size(), 1U);
    EXPECT_EQ(picture.image->rgb[300], 4.0F * picture.layers.front().image->rgb[300]);
    EXPECT_EQ(tables.size(), tables_before) << "the table is not about gains";
}

TEST_F(LayersInJobs, ArtisticChangesNeverTouchTheTable) {
    open();
    const auto table = tables.back();
    Scene scene = document.scene();
    scene.artistic.exaggeration_ev = 5.0;
    scene.artistic.ghosts = {GhostStyle{.path = {{4, 2}}, .on = false}};
    document.edit_scene(scene, "exaggerate");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(pictures.back().is_final);
    EXPECT_EQ(tables.back(), table);
    // Also where the table is made anew.
    scene.tolerance = 0.4;
    document.edit_scene(scene, "change tolerance");
    ASSERT_TRUE(settle());
    ASSERT_NE(tables.back(), table);
    ASSERT_EQ(tables.back()->ghosts.size(), table->ghosts.size());
    for (std::size_t k = 0; k < table->ghosts.size(); ++k)
        EXPECT_NEAR(tables.back()->ghosts[k].flux_mm2 / table->ghosts[k].flux_mm2, 1.0, 0.5);
}

TEST_F(LayersInJobs, AMissingPictureIsSaid) {
    open();
    QSignalSpy failed(&jobs, &Jobs::failed);
    Scene scene = document.scene();
    scene.light().size = PictureSize{"no_such_lamp.exr", 2.0};
    document.edit_scene(scene, "size");
    ASSERT_TRUE(settle());
    ASSERT_FALSE(failed.isEmpty());
    EXPECT_TRUE(failed.front().front().toString().contains("no_such_lamp.exr"));
}

}  // namespace
}  // namespace ghostlight
