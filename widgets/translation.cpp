#include "widgets/translation.h"

#include <QCoreApplication>
#include <QDir>
#include <QLibraryInfo>
#include <QTranslator>

#include <utility>

// In a static library, resources have to be asked for; outside of any namespace.
static void load_resources() { Q_INIT_RESOURCE(ghostlight_translations); }

namespace ghostlight {

namespace {

constexpr const char* folder = ":/ghostlight/translations";
constexpr const char* file_stem = "ghostlight_";

/// A translator that is known by its name, so that the next language replaces it.
QTranslator& renewed(QCoreApplication& application, const QString& name) {
    delete application.findChild<QTranslator*>(name, Qt::FindDirectChildrenOnly);
    auto* translator = new QTranslator(&application);
    translator->setObjectName(name);
    return *translator;
}

}  // namespace

QStringList languages() {
    load_resources();
    QStringList found;
    for (QString name : QDir(folder).entryList({QString(file_stem) + "*.qm"}, QDir::Files)) {
        found << name.remove(file_stem).remove(".qm");
    }
    found.sort();
    return found;
}

void install_translation(QCoreApplication& application, const QLocale& locale) {
    load_resources();
    // The last installed is asked first: English has the plurals of what the language lacks.
    QTranslator& english = renewed(application, "translation_english");
    if (english.load(QString(file_stem) + "en", folder)) {
        QCoreApplication::installTranslator(&english);
    }
    QTranslator& of_qt = renewed(application, "translation_qt");
    if (of_qt.load(locale, "qtbase", "_", QLibraryInfo::path(QLibraryInfo::TranslationsPath))) {
        QCoreApplication::installTranslator(&of_qt);
    }
    QTranslator& ours = renewed(application, "translation_ghostlight");
    if (locale.language() != QLocale::English && ours.load(locale, file_stem, QString(), folder)) {
        QCoreApplication::installTranslator(&ours);
    }
}

}  // namespace ghostlight
