#include "widgets/translation.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QFile>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QTableView>
#include <QXmlStreamReader>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/io/lens_file.h"
#include "core/io/lens_quantities.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "tests/kits/plain_texts.h"
#include "tests/widgets/window_kit.h"
#include "widgets/models/ghost_table_model.h"
#include "widgets/panels/ghost_panel.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/panels/status_line.h"

namespace ghostlight {
namespace {

using test::OpenWindow;

/// The window's language while it lives; English afterwards.
struct Speaking {
    explicit Speaking(const char* language) { install_translation(*qApp, QLocale(language)); }
    ~Speaking() { install_translation(*qApp, QLocale(QLocale::English)); }
};

std::filesystem::path source_folder() { return lens_folder().parent_path(); }

QStringList menu_titles(const MainWindow& window) {
    QStringList titles;
    for (const QAction* menu : window.menuBar()->actions()) {
        titles << menu->text();
    }
    return titles;
}

TEST(Translation, AGermanCatalogueChangesMenusTablesAndTheStatusLine) {
    const Speaking german("de");
    OpenWindow shown(test::tessar());
    ASSERT_TRUE(shown.settle());
    MainWindow& window = shown.window;
    EXPECT_EQ(menu_titles(window), (QStringList{"&Datei", "&Bearbeiten", "&Reflexe", "&Vergleichen",
                                                "&Ansicht", "&Hilfe"}));
    EXPECT_EQ(window.actions()["file.open"].text(), QStringLiteral("Ö&ffnen …"));
    EXPECT_EQ(
        window.actions()["file.save"].toolTip(),
        QStringLiteral("Das Objektiv in seiner Datei sichern (%1)")
            .arg(window.actions()["file.save"].shortcut().toString(QKeySequence::NativeText)));
    const QTableView& ghosts = window.ghost_panel().table();
    EXPECT_EQ(ghosts.model()->headerData(0, Qt::Horizontal).toString(), "Reflex");
    EXPECT_TRUE(window.status_line().table_text().contains(" Reflexe · "))
        << qPrintable(window.status_line().table_text());

    // A step of the history is named in the language in which it was done.
    auto* table = window.findChild<QTableView*>("prescription_table");
    ASSERT_NE(table, nullptr);
    ASSERT_TRUE(table->model()->setData(table->model()->index(0, 1), "40.5", Qt::EditRole));
    EXPECT_TRUE(
        window.actions()["edit.undo"].text().contains(QStringLiteral("Radius von Fläche 1 ändern")))
        << qPrintable(window.actions()["edit.undo"].text());
}

TEST(Translation, EnglishHasItsPlurals) {
    const auto ghosts = [](int count) {
        return QCoreApplication::translate("ghostlight::StatusLine",
                                           "*%n ghost(s)* · %1 rays · %2 s", nullptr, count);
    };
    EXPECT_EQ(ghosts(1), QStringLiteral("*1 ghost* · %1 rays · %2 s"));
    EXPECT_EQ(ghosts(2), QStringLiteral("*2 ghosts* · %1 rays · %2 s"));
}

TEST(Translation, WhatALanguageLacksIsEnglish) {
    const Speaking german("de");
    EXPECT_EQ(QCoreApplication::translate("nowhere", "what nobody translated"),
              "what nobody translated");
    EXPECT_EQ(languages(), (QStringList{"de", "en"}));
}

/// One message of a catalogue: its text and its translations (several where it has plurals).
struct Message {
    QString context;
    QString source;
    QStringList translations;
    bool unfinished = false;
};

std::vector<Message> messages_of(const std::filesystem::path& catalogue) {
    QFile file(QString::fromStdString(catalogue.string()));
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << catalogue;
    QXmlStreamReader xml(&file);
    std::vector<Message> messages;
    QString context;
    while (!xml.atEnd()) {
        if (xml.readNext() != QXmlStreamReader::StartElement) {
            continue;
        }
        if (xml.name() == QLatin1String("name")) {
            context = xml.readElementText();
        } else if (xml.name() == QLatin1String("source")) {
            messages.push_back({context, xml.readElementText(), {}, false});
        } else if (xml.name() == QLatin1String("translation")) {
            messages.back().unfinished =
                xml.attributes().value("type") == QLatin1String("unfinished");
            const QString text = xml.readElementText(QXmlStreamReader::IncludeChildElements);
            messages.back().translations << text;
        }
    }
    EXPECT_FALSE(xml.hasError()) << qPrintable(xml.errorString());
    return messages;
}

std::multiset<QString> marks_in(const QString& text, bool once) {
    static const QRegularExpression mark("%(?:L?[0-9]+|n)");
    std::multiset<QString> found;
    for (auto at = mark.globalMatch(text); at.hasNext();) {
        const QString each = at.next().captured();
        if (!once || !found.contains(each)) {
            found.insert(each);
        }
    }
    return found;
}

TEST(Translation, TranslationsKeepThePlacesOfWhatIsPutIn) {
    std::size_t compared = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(source_folder() / "widgets/translations")) {
        if (entry.path().extension() != ".ts") {
            continue;
        }
        for (const Message& message : messages_of(entry.path())) {
            for (const QString& text : message.translations) {
                if (message.unfinished || text.trimmed().isEmpty()) {
                    continue;
                }
                ++compared;
                // Both forms of a plural stand in one text here.
                EXPECT_EQ(marks_in(text, true), marks_in(message.source, true))
                    << entry.path().filename() << ": " << qPrintable(message.source);
            }
        }
    }
    EXPECT_GT(compared, 300U);
}

TEST(Translation, NoTextWaitsForItsTranslation) {
    std::size_t texts = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(source_folder() / "widgets/translations")) {
        if (entry.path().extension() != ".ts") {
            continue;
        }
        for (const Message& message : messages_of(entry.path())) {
            ++texts;
            EXPECT_FALSE(message.unfinished)
                << entry.path().filename() << ", " << qPrintable(message.context) << ": "
                << qPrintable(message.source) << " (./dev translate, then translate it there)";
        }
    }
    EXPECT_GT(texts, 1000U);
}

TEST(Translation, FirstOrderDataHaveGermanNames) {
    const Speaking german("de");
    const auto quantities = lens_quantities(compile(read_lens(test::tessar()).lens, d_line_nm));
    ASSERT_GT(quantities.size(), 20U);
    for (const LensQuantity& quantity : quantities) {
        EXPECT_NE(QCoreApplication::translate("LensQuantities", quantity.label.c_str()),
                  QString::fromStdString(quantity.label));
    }
}

/// Where words in a source are not for people who use the window, and why.
const std::map<std::string, std::set<std::string>>& words_of_no_language() {
    static const std::map<std::string, std::set<std::string>> words = {
        {"widgets/configuration_edits.cpp", {"as listed"}},  // in files: part of a name
        {"widgets/help_pages.cpp",
         {"Tab, Shift+Tab", "Qt %1",
          "<h1>Ghostlight %1</h1><p>%2</p><table>"}},  // keys; a library's name
        {"widgets/help_window.cpp", {"a { color: %1; } td, th { padding: 3px 10px; }"}},
        {"widgets/log_chart_view.cpp", {"as asked"}},              // a key of VTK's
        {"widgets/main_window_guidance.cpp", {"Flare", "Scene"}},  // headings of the guide
        {"widgets/main_window.cpp", {"yyyy-MM-dd HH:mm", "[*] – Ghostlight"}},
        // In the report, which is the command line's.
        {"widgets/panels/accuracy_panel.cpp",
         {"ghostlight-cli accuracy ", " (measured in the window, OpenGL beside the CPU)",
          ", OpenGL by "}},
        {"widgets/panels/ghost_panel.cpp", {"touches sensor"}},  // words of the filter
        {"widgets/panels/light_panel.cpp",
         {"light panel ", "active light", "seed"}},             // keys as well
        {"widgets/panels/scene_bar.cpp", {"flare tolerance"}},  // a key by which edits merge
        // What the field takes is the same in every language, as on the command line.
        {"widgets/panels/sweep_panel.cpp",
         {"field", "azimuth", "f-number", "position", "radius 1", "curvature 1", "thickness 1",
          "semi-diameter 1", "coating 1"}}};
    return words;
}

/// Sources whose words are not shown in the window.
bool is_exempt(const std::string& file) {
    static const std::set<std::string> files = {"app/gui/main.cpp", "widgets/snapshot.cpp",
                                                "widgets/blocking_trace.cpp",  // the command line's
                                                "widgets/theme.cpp"};
    return files.contains(file);
}

TEST(Translation, NoSourceHasWordsThatNoTranslatorIsShown) {
    std::size_t sources = 0;
    for (const char* folder : {"widgets", "app/gui"}) {
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(source_folder() / folder)) {
            const std::string extension = entry.path().extension().string();
            const std::string file =
                std::filesystem::relative(entry.path(), source_folder()).generic_string();
            if ((extension != ".cpp" && extension != ".h") || is_exempt(file)) {
                continue;
            }
            ++sources;
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            const auto known = words_of_no_language().find(file);
            for (const test::SourceText& each : test::plain_texts(text.str())) {
                EXPECT_TRUE(known != words_of_no_language().end() &&
                            known->second.contains(each.text))
                    << file << ':' << each.line << ": \"" << each.text
                    << "\" is not for translators; use tr() or QT_TRANSLATE_NOOP()";
            }
        }
    }
    EXPECT_GT(sources, 100U);
}

std::vector<std::string> texts(std::string_view source) {
    std::vector<std::string> found;
    for (const test::SourceText& each : test::plain_texts(source)) {
        found.push_back(each.text);
    }
    return found;
}

TEST(PlainTexts, AreFoundWhereverTheyStand) {
    using Found = std::vector<std::string>;
    EXPECT_EQ(texts(R"(button->setText("Open");)"), Found{"Open"});
    EXPECT_EQ(texts(R"(menu.addAction("open");)"), Found{"open"});
    EXPECT_EQ(texts(R"(auto* l = new QLabel("to");)"), Found{});  // too short to be told
    EXPECT_EQ(texts(R"(set(QStringLiteral("%1 of the ghosts"));)"), Found{"%1 of the ghosts"});
    EXPECT_EQ(texts("show(\"Two \"\n     \"parts\");"), Found{"Two parts"});
    EXPECT_EQ(texts(R"(box->addItems({tr("one"), "two"});)"), Found{"two"});
    EXPECT_EQ(texts(R"(f(tr("ab cd"), "ef gh").arg("Ij");)"), (Found{"ef gh", "Ij"}));
    EXPECT_EQ(texts("// setText(\"Open\")\n/* \"Open it\" */ #include \"Open it\"\n"), Found{});
    EXPECT_EQ(texts(R"(w->setToolTip(tr("A \"word\" more")); x = 1'000; c = '"';)"), Found{});
    EXPECT_EQ(texts(R"(w->setObjectName("Ghost table");)"), Found{});
}

TEST(PlainTexts, AreFoundInARealSourceOnceTheirTranslationIsTakenAway) {
    std::ostringstream text;
    text << std::ifstream(source_folder() / "widgets/tour.cpp").rdbuf();
    ASSERT_TRUE(texts(text.str()).empty());
    std::string broken = text.str();
    const std::string wrapped = "tr(\"Skip\")";
    ASSERT_NE(broken.find(wrapped), std::string::npos);
    broken.replace(broken.find(wrapped), wrapped.size(), "\"Skip\"");
    EXPECT_EQ(texts(broken), std::vector<std::string>{"Skip"});
}

}  // namespace
}  // namespace ghostlight
