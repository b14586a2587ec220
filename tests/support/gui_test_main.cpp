// main() of the GUI tests: one QApplication for all of them, and settings kept away from the
// user's.

#include <gtest/gtest.h>

#include <QLocale>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>

#include "widgets/blocking_trace.h"
#include "widgets/translation.h"

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (GTEST_FLAG_GET(list_tests)) {
        return RUN_ALL_TESTS();  // needs no display
    }

    const QTemporaryDir settings;
    QStandardPaths::setTestModeEnabled(true);
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());

    ghostlight::TracedApplication application(argc, argv);
    QApplication::setApplicationName("ghostlight-tests");
    QApplication::setOrganizationName("ghostlight-tests");
    // English whatever the machine speaks, with its plurals.
    ghostlight::install_translation(application, QLocale(QLocale::English));
    // A trial of the engines in every window would cost more than all else that is tested.
    QSettings().setValue("flare_engine", "cpu");
    return RUN_ALL_TESTS();
}
