#include "widgets/lens_filters.h"

#include <QCoreApplication>

#include <QStringList>

#include "core/io/formats.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct LensFilters {
    Q_DECLARE_TR_FUNCTIONS(LensFilters)
};

QString text_of(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

/// "*.zmx *.ZMX": a dialog may tell letters' cases apart.
QStringList patterns(const LensFormat& format) {
    QStringList all;
    for (const QString& extension : text_of(format.extensions).split(' ', Qt::SkipEmptyParts)) {
        all << '*' + extension << '*' + extension.toUpper();
    }
    return all;
}

QString filter_of(const LensFormat& format) {
    return QStringLiteral("%1 (%2)").arg(text_of(format.name), patterns(format).join(' '));
}

}  // namespace

QString lens_open_filter() {
    QStringList every;
    QStringList filters;
    for (const LensFormat& format : lens_formats()) {
        every << patterns(format);
        filters << filter_of(format);
    }
    every.removeDuplicates();
    filters.prepend(LensFilters::tr("All lens files (%1)").arg(every.join(' ')));
    filters << LensFilters::tr("All files (*)");
    return filters.join(";;");
}

QString lens_export_filter() {
    QStringList filters;
    for (const LensFormat& format : lens_formats()) {
        if (format.write != nullptr) {
            // The one in hand first: a dialog starts with it.
            format.extensions == ".zmx" ? filters.prepend(filter_of(format))
                                        : filters.append(filter_of(format));
        }
    }
    return filters.join(";;");
}

bool has_own_extension(const std::filesystem::path& file) {
    const auto extension = QString::fromStdString(file.extension().string());
    return extension.compare(".json", Qt::CaseInsensitive) == 0;
}

}  // namespace ghostlight
