#include "widgets/command_palette.h"

#include <gtest/gtest.h>

#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QSignalSpy>

#include <set>

#include "tests/widgets/window_kit.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

TEST(CommandPalette, EveryActionOfTheWindowIsInAMenu) {
    OpenWindow shown;
    std::set<QString> found;
    for (const Command& command : all_commands(*shown.window.menuBar(), {}, Include::disabled)) {
        found.insert(command.action->objectName());
    }
    for (const ActionText& text : action_texts()) {
        EXPECT_TRUE(found.contains(text.id)) << text.id << " is in no menu";
        const QAction& action = shown.window.actions()[text.id];
        EXPECT_FALSE(action.toolTip().isEmpty()) << text.id;
        if (*text.keys != '\0' && action.isEnabled()) {
            EXPECT_TRUE(
                action.toolTip().contains(action.shortcut().toString(QKeySequence::NativeText)))
                << text.id;
        }
    }
}

TEST(CommandPalette, TypingFindsAndReturnRuns) {
    OpenWindow shown(test::tessar());
    MainWindow& window = shown.window;
    QSignalSpy ran(&window.actions()["view.expose"], &QAction::triggered);
    window.activateWindow();
    window.actions()["help.commands"].trigger();
    auto* palette = window.findChild<CommandPalette*>();
    ASSERT_NE(palette, nullptr);
    EXPECT_GT(palette->list().count(), 30);
    QTest::keyClicks(&palette->line(), "auto exp");
    ASSERT_GT(palette->list().count(), 0);
    EXPECT_TRUE(palette->list().item(0)->text().contains("Auto Exposure"));
    QTest::keyClick(&palette->line(), Qt::Key_Return);
    EXPECT_TRUE(QTest::qWaitFor([&] { return ran.size() == 1; }, 5000));
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return window.findChild<CommandPalette*>() == nullptr; }, 5000));
}

TEST(CommandPalette, BundledLensesAreCommandsToo) {
    OpenWindow shown;
    shown.window.actions()["help.commands"].trigger();
    auto* palette = shown.window.findChild<CommandPalette*>();
    ASSERT_NE(palette, nullptr);
    QTest::keyClicks(&palette->line(), "noct");
    ASSERT_GT(palette->list().count(), 0);
    QTest::keyClick(&palette->line(), Qt::Key_Return);
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return shown.window.document().title().contains("Noct"); }, 20'000));
}

TEST(CommandPalette, WhatCannotBeDoneIsLeftOut) {
    OpenWindow shown(test::tessar());
    shown.window.document().history().clear();
    for (const Command& command : all_commands(*shown.window.menuBar(), {})) {
        EXPECT_NE(command.action->objectName(), "edit.redo");
    }
}

}  // namespace
}  // namespace ghostlight
