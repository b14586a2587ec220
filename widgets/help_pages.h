#pragma once

#include <QString>
#include <QStringList>

#include <optional>

class QWidget;

namespace ghostlight {

struct GlSupport;

/// The folder of the guide's pages, beside the bundled lenses in the installed place and in the
/// source tree; nothing if it is not there.
std::optional<QString> docs_folder();

/// The headings of a Markdown page, without those in its code blocks.
QStringList headings(const QString& markdown);

/// What the guide, which is in English, calls the panel of that object name ("first_order").
QString guide_title(QString panel_name);

/// The heading that is about a panel of that title ("Ghosts": "The ghost table"), or an empty text:
/// the first that begins with it, else the first that has it as a word; an article in front and
/// a plural are not counted.
QString heading_about(const QString& title, const QStringList& headings);

/// Every key that a window answers to, as HTML, by menu.
QString shortcuts_page(QWidget& window);

/// What the program is made of, one library and its version a line.
QStringList library_versions();

/// Version, licence, OpenGL, processor and libraries, as HTML.
QString about_page(const GlSupport& gl);

}  // namespace ghostlight
