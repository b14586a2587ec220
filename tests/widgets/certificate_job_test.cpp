#include "widgets/certificate_job.h"

#include <gtest/gtest.h>

#include <QSignalSpy>

#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

struct CertificateJobTest : testing::Test {
    CertificateJobTest() {
        certificate.set_delay_ms(1);
        QObject::connect(&certificate, &CertificateJob::certified, &certificate,
                         [this](const auto& proof) { proofs.push_back(proof); });
    }
    void open(const char* file) {
        ASSERT_FALSE(document.open(test::bundled(file)));
        Scene scene = document.scene();
        scene.tolerance = 0.5;
        scene.light().spectrum = Monochromatic{};
        document.edit_scene(scene, "make it cheap", "tolerance");
    }
    bool wait_for_proofs(std::size_t count) {
        return QTest::qWaitFor([&] { return proofs.size() >= count; }, test::patience_ms);
    }

    Document document;
    Selection selection;
    Jobs jobs{document, selection};
    CertificateJob certificate{document, jobs};
    std::vector<std::shared_ptr<const PlanProof>> proofs;
};

TEST_F(CertificateJobTest, AtRestThePlanIsProven) {
    open("cooke_triplet_50_f5.json");
    ASSERT_TRUE(wait_for_proofs(1));
    const PlanProof& proof = *proofs.front();
    EXPECT_EQ(proof.ghosts.size(), 15U);
    EXPECT_GT(proof.certified, 0U);
    EXPECT_GE(proof.missed_share(), 0.0);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !certificate.is_busy(); }, test::patience_ms));
    EXPECT_GE(proofs.back()->certified, proof.certified) << "more work proves no less";
    EXPECT_LE(proofs.back()->missed_share(), proof.missed_share());
}

TEST_F(CertificateJobTest, AnEditEndsTheProofAndTheNextIsOfTheNewPicture) {
    open("double_gauss_tronnier_100_f2.json");
    QSignalSpy progressed(&certificate, &CertificateJob::progressed);
    QSignalSpy withdrawn(&certificate, &CertificateJob::withdrawn);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !progressed.isEmpty(); }, test::patience_ms));
    ASSERT_TRUE(proofs.empty());
    const auto withdrawals = withdrawn.count();
    Scene scene = document.scene();
    scene.light().direction.field_deg = 1.0;
    document.edit_scene(scene, "move the light", "light");
    EXPECT_GT(withdrawn.count(), withdrawals);
    EXPECT_FALSE(certificate.is_busy());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !jobs.is_busy(); }, test::patience_ms));
    EXPECT_TRUE(proofs.empty()) << "of the picture that is gone";
}

TEST_F(CertificateJobTest, GoingWhileProvingIsFine) {
    open("double_gauss_tronnier_100_f2.json");
    ASSERT_TRUE(QTest::qWaitFor([&] { return certificate.is_busy(); }, test::patience_ms));
    QTest::qWait(20);
}

}  // namespace
}  // namespace ghostlight
