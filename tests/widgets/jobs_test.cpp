#include "widgets/jobs.h"

#include <gtest/gtest.h>

#include <QSignalSpy>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

using namespace std::chrono_literals;

TEST(NewestJob, OnlyTheNewestWaits) {
    std::vector<int> done;
    std::atomic<int> count = 0;
    std::atomic<bool> go = false;
    {
        NewestJob<int> job([&](const int& request, std::stop_token) {
            while (!go) {
                std::this_thread::sleep_for(1ms);
            }
            done.push_back(request);
            ++count;
        });
        job.submit(1);
        std::this_thread::sleep_for(20ms);  // for the first to begin
        for (int k = 2; k <= 9; ++k) {
            job.submit(k);
        }
        go = true;
        EXPECT_TRUE(QTest::qWaitFor([&] { return count == 2; }, 5000));
    }
    EXPECT_EQ(done, (std::vector{1, 9}));
}

TEST(NewestJob, ANewerRequestStopsTheOneInWork) {
    std::atomic<int> stopped = 0;
    NewestJob<int> job([&](const int&, std::stop_token stop) {
        while (!stop.stop_requested()) {
            std::this_thread::sleep_for(1ms);
        }
        ++stopped;
    });
    job.submit(1);
    std::this_thread::sleep_for(20ms);
    job.submit(2);
    EXPECT_TRUE(QTest::qWaitFor([&] { return stopped == 1; }, 5000));
    job.cancel();
    EXPECT_TRUE(QTest::qWaitFor([&] { return stopped == 2; }, 5000));
}

struct JobsTest : testing::Test {
    JobsTest() {
        qRegisterMetaType<FlarePicture>();
        QObject::connect(&jobs, &Jobs::flare_ready, &jobs,
                         [this](const FlarePicture& picture) { pictures.push_back(picture); });
        QObject::connect(&jobs, &Jobs::table_ready, &jobs,
                         [this](const auto& table) { tables.push_back(table); });
    }
    void open() {
        ASSERT_FALSE(document.open(test::tessar()));
        Scene scene = document.scene();
        scene.tolerance = 0.5;
        scene.light().spectrum = Monochromatic{};
        document.edit_scene(scene, "change tolerance");
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

TEST_F(JobsTest, CoarseThenFineThenTheTable) {
    open();
    EXPECT_TRUE(jobs.is_busy());
    ASSERT_TRUE(settle());
    ASSERT_GE(pictures.size(), 2U);
    EXPECT_FALSE(pictures.front().is_final);
    EXPECT_TRUE(pictures.back().is_final);
    EXPECT_EQ(pictures.back().revision, document.revision());
    ASSERT_EQ(tables.size(), 1U);
    EXPECT_EQ(tables.front()->light, document.scene().light().direction);
}

TEST_F(JobsTest, ALensJustOpenedIsSeenToFirstOrderAtOnce) {
    ASSERT_FALSE(document.open(test::tessar()));
    ASSERT_TRUE(settle());
    ASSERT_GE(pictures.size(), 3U);
    EXPECT_TRUE(pictures.front().is_first_look);
    EXPECT_FALSE(pictures.front().is_final);
    EXPECT_GT(pictures.front().image->flux_on_sensor_mm2, 0.0);
    for (std::size_t k = 1; k < pictures.size(); ++k) {
        EXPECT_FALSE(pictures[k].is_first_look);
    }
    pictures.clear();
    Scene scene = document.scene();
    scene.light().direction.field_deg += 1.0;
    document.edit_scene(scene, "move the light", "light");
    ASSERT_TRUE(settle());
    EXPECT_FALSE(pictures.front().is_first_look) << "only of a lens just opened";
}

TEST_F(JobsTest, ManyChangesEndInOnePictureAndOneTable) {
    open();
    for (int k = 0; k < 30; ++k) {
        Scene scene = document.scene();
        scene.light().direction.field_deg = 2.0 + 0.1 * k;
        document.edit_scene(scene, "move the light", "light");
        QTest::qWait(2);
    }
    ASSERT_TRUE(settle());
    const auto finals = std::count_if(pictures.begin(), pictures.end(),
                                      [](const FlarePicture& each) { return each.is_final; });
    EXPECT_LT(finals, 30);
    EXPECT_EQ(pictures.back().revision, document.revision());
    EXPECT_TRUE(pictures.back().is_final);
    ASSERT_FALSE(tables.empty());
    EXPECT_EQ(tables.back()->light, document.scene().light().direction);
    for (std::size_t k = 1; k < pictures.size(); ++k) {
        EXPECT_GE(pictures[k].revision, pictures[k - 1].revision) << "never back in time";
    }
}

TEST_F(JobsTest, AnotherLensDropsPicturesOfTheLast) {
    open();
    ASSERT_FALSE(document.open(test::bundled("cooke_triplet_50_f5.json")));
    ASSERT_TRUE(settle());
    for (const FlarePicture& picture : pictures) {
        EXPECT_GE(picture.revision, document.first_revision());
    }
}

TEST_F(JobsTest, AHighlightNeedsNoCoarsePicture) {
    open();
    ASSERT_TRUE(settle());
    pictures.clear();
    selection.set_ghosts({GhostPath{{4, 2}}});
    ASSERT_TRUE(settle());
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_FALSE(pictures.front().image->highlight.empty());
}

TEST_F(JobsTest, AFailureSaysWhyAndSettles) {
    open();
    ASSERT_TRUE(settle());
    QSignalSpy failed(&jobs, &Jobs::failed);
    Prescription lens = document.lens();
    lens.surfaces[0].medium_after = {"narrow", FormulaGlass{2, {1.2, 0.01}, 500.0, 510.0}};
    document.edit_lens(lens, "change glass of surface 1");
    ASSERT_TRUE(settle());
    ASSERT_FALSE(failed.isEmpty());
    EXPECT_TRUE(failed.front().front().toString().contains("narrow"));
    document.history().undo();
    ASSERT_TRUE(settle());
    EXPECT_EQ(pictures.back().revision, document.revision());
}

TEST_F(JobsTest, TheTableCanBeGivenUp) {
    open();
    jobs.cancel_table();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(tables.empty());
}

TEST_F(JobsTest, GoingWhileBusyIsFine) {
    open();
    QTest::qWait(30);
}

}  // namespace
}  // namespace ghostlight
