#pragma once

#include <QLocale>
#include <QStringList>

class QCoreApplication;

namespace ghostlight {

/// Texts of the window in the language of `locale`, and Qt's own (buttons of dialogs, menus of text
/// fields), for all that is made from now on; they replace those installed before. English is what
/// the source has, with its plurals; what a language lacks is English too. What files, errors of
/// the core and numbers say is the same in all languages.
void install_translation(QCoreApplication& application, const QLocale& locale);

/// The languages at hand, by their codes ("de", "en"), in alphabetical order.
QStringList languages();

}  // namespace ghostlight
