#include "widgets/help_pages.h"

#include <QCoreApplication>

#include <vtkVersion.h>

#include <QApplication>
#include <QDir>
#include <QMainWindow>
#include <QMenuBar>
#include <QRegularExpression>

#include "core/error.h"
#include "core/instruction_set.h"
#include "core/io/lens_file.h"
#include "core/parallel.h"
#include "widgets/command_palette.h"
#include "widgets/gl_view.h"

// By the build: name and version of each library, separated by '|'.
#ifndef GHOSTLIGHT_LIBRARIES
#define GHOSTLIGHT_LIBRARIES ""
#endif

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct HelpPages {
    Q_DECLARE_TR_FUNCTIONS(HelpPages)
};

QString stem(QString words) {
    words = words.toCaseFolded().replace('-', ' ').remove(QRegularExpression("^(the|a) "));
    return words.endsWith('s') ? words.chopped(1) : words;
}

QString table_row(const QString& left, const QString& right) {
    return QStringLiteral("<tr><td style='padding: 2px 24px 2px 0'>%1</td><td>%2</td></tr>")
        .arg(left.toHtmlEscaped(), right.toHtmlEscaped());
}

}  // namespace

std::optional<QString> docs_folder() {
    try {
        const QDir docs(QString::fromStdString(
            (data_directory().parent_path() / "docs").lexically_normal().string()));
        if (docs.exists("user-guide.md")) {
            return docs.absolutePath();
        }
    } catch (const Error&) {
        // no bundled data at all
    }
    return std::nullopt;
}

QStringList headings(const QString& markdown) {
    QStringList found;
    bool in_code = false;
    static const QRegularExpression heading("^#+ +(.+?) *$");
    for (const QString& line : markdown.split('\n')) {
        if (line.startsWith("```")) {
            in_code = !in_code;
        } else if (const auto match = heading.match(line); !in_code && match.hasMatch()) {
            found << match.captured(1);
        }
    }
    return found;
}

QString guide_title(QString panel_name) { return panel_name.replace('_', ' '); }

QString heading_about(const QString& title, const QStringList& headings) {
    const QString wanted = stem(title);
    QString holds;
    for (const QString& heading : headings) {
        const QString words = stem(heading);
        if (words.startsWith(wanted)) {
            return heading;
        }
        if (holds.isEmpty() && (' ' + words + ' ').contains(' ' + wanted)) {
            holds = heading;
        }
    }
    return holds;
}

QString shortcuts_page(QWidget& window) {
    QString page = QStringLiteral("<h1>%1</h1><table>").arg(HelpPages::tr("Keyboard shortcuts"));
    auto* main_window = qobject_cast<QMainWindow*>(&window);
    QString menu;
    for (const Command& command :
         all_commands(*main_window->menuBar(), window.actions(), Include::disabled)) {
        if (command.keys.isEmpty()) {
            continue;
        }
        const QString of = command.text.section(QStringLiteral(" ▸ "), 0, 0);
        if (of != menu && command.text.contains(QStringLiteral(" ▸ "))) {
            menu = of;
            page += QStringLiteral("<tr><td colspan='2'><h3>%1</h3></td></tr>")
                        .arg(menu.toHtmlEscaped());
        }
        page += table_row(command.keys, command.text.section(QStringLiteral(" ▸ "), 1) +
                                            QStringLiteral(" – ") + command.plain_tip());
    }
    page += QStringLiteral("<tr><td colspan='2'><h3>%1</h3></td></tr>")
                .arg(HelpPages::tr("In a panel"));
    const std::pair<QString, QString> in_panels[] = {
        {HelpPages::tr("F2, or typing"), HelpPages::tr("edit the cell")},
        {"Tab, Shift+Tab", HelpPages::tr("next, previous field")},
        {HelpPages::tr("Up, Down"), HelpPages::tr("a step more, a step less in a number")},
        {"F", HelpPages::tr("the whole lens, the whole picture")},
        {"Ctrl+C", HelpPages::tr("copy the chosen rows with every digit")},
        {"Alt", HelpPages::tr("the menus, by their underlined letters")}};
    for (const auto& [keys, what] : in_panels) {
        page += table_row(keys, what);
    }
    return page + QStringLiteral("</table>");
}

QStringList library_versions() {
    QStringList lines{QStringLiteral("Qt %1").arg(qVersion()),
                      QStringLiteral("VTK %1").arg(vtkVersion::GetVTKVersion())};
    return lines + QString(GHOSTLIGHT_LIBRARIES).split('|', Qt::SkipEmptyParts);
}

QString about_page(const GlSupport& gl) {
    QString page = QStringLiteral("<h1>Ghostlight %1</h1><p>%2</p><table>")
                       .arg(QCoreApplication::applicationVersion(),
                            HelpPages::tr("Lens-flare analysis workbench. BSD 3-clause licence."));
    page += table_row("OpenGL", gl.renderer.isEmpty() ? gl.reason
                                                      : gl.renderer + ", " + gl.version +
                                                            (gl.is_usable ? "" : ": " + gl.reason));
    page += table_row(
        HelpPages::tr("Processor"),
        HelpPages::tr("%1, %2 threads").arg(instruction_set_name()).arg(default_thread_count()));
    for (const QString& line : library_versions()) {
        page += table_row(line.section(' ', 0, -2), line.section(' ', -1));
    }
    return page + QStringLiteral("</table>");
}

}  // namespace ghostlight
