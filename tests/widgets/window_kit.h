#pragma once

#include <QTest>

#include <filesystem>
#include <string>

#include "core/io/lens_file.h"
#include "tests/support/test_paths.h"
#include "widgets/main_window.h"
#include "widgets/snapshot.h"

namespace ghostlight::test {

/// The largest bundled lens on a busy machine.
inline constexpr int patience_ms = 240'000;

inline std::filesystem::path bundled(const std::string& file) { return lens_folder() / file; }

inline std::filesystem::path tessar() { return bundled("tessar_brendel_100_f2.8.json"); }

/// A shown window that keeps nothing, with a ghost table of one wavelength and a loose tolerance:
/// these tests are about the window.
struct OpenWindow {
    explicit OpenWindow(const std::filesystem::path& lens = {},
                        MakeGlEngine make_gl = offscreen_gl_engine)
        : window(false, std::move(make_gl)) {
        window.resize(1400, 860);
        window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
        if (!lens.empty()) {
            EXPECT_TRUE(window.open(lens));
            loosen();
        }
    }
    void loosen() {
        Scene scene = window.document().scene();
        scene.tolerance = 0.5;
        scene.light().spectrum = Monochromatic{};
        window.document().edit_scene(scene, "make the table cheap", "tolerance");
    }
    bool settle() { return wait_until_settled(window, patience_ms); }

    MainWindow window;
};

}  // namespace ghostlight::test
