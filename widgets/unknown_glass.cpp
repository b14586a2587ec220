#include "widgets/unknown_glass.h"

#include <QCoreApplication>

#include <algorithm>

#include "core/error.h"
#include "core/io/glass_library.h"
#include "core/io/imported_glass.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct UnknownGlassText {
    Q_DECLARE_TR_FUNCTIONS(UnknownGlassText)
};

constexpr std::size_t offered = 6;

const UnknownGlass* unknown(const Medium& medium) {
    return std::get_if<UnknownGlass>(&medium.dispersion);
}

}  // namespace

std::optional<std::size_t> first_unknown_glass(const Prescription& lens) {
    const auto found = std::ranges::find_if(
        lens.surfaces, [](const Surface& surface) { return unknown(surface.medium_after); });
    if (found == lens.surfaces.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - lens.surfaces.begin());
}

QString why_unknown(const Prescription& lens, std::size_t row) {
    const Medium& medium = lens.surfaces[row].medium_after;
    const UnknownGlass* glass = unknown(medium);
    const QString name =
        medium.name.empty()
            ? UnknownGlassText::tr("The glass")
            : UnknownGlassText::tr("Glass %1").arg(QString::fromStdString(medium.name));
    return UnknownGlassText::tr("%1 after surface %2 is not known: %3.")
        .arg(name)
        .arg(row + 1)
        .arg(glass != nullptr ? QString::fromStdString(glass->why) : QString());
}

QStringList offered_glasses(const Medium& medium) {
    QStringList names;
    const auto add = [&names](const std::string& each) {
        const QString name = QString::fromStdString(each);
        if (names.size() < static_cast<qsizetype>(offered) && !names.contains(name)) {
            names << name;
        }
    };
    try {
        if (unknown(medium) != nullptr) {
            for (const std::string& name : similar_glasses(medium.name)) {
                add(name);
            }
            for (const std::string& name : nearest_names(medium.name, offered)) {
                add(name);
            }
        } else if (const auto* model = std::get_if<ModelGlass>(&medium.dispersion)) {
            for (const GlassNeighbour& near : nearest_glasses(model->nd, model->vd, offered)) {
                add(near.glass.medium.name);
            }
        }
    } catch (const Error&) {
        // No catalogue: nothing to offer.
    }
    return names;
}

Prescription with_known_glasses(Prescription lens) {
    for (Surface& surface : lens.surfaces) {
        if (unknown(surface.medium_after) == nullptr || surface.medium_after.name.empty()) {
            continue;
        }
        if (const auto known = find_glass(surface.medium_after.name, {})) {
            surface.medium_after = known->glass.medium;
        }
    }
    return lens;
}

}  // namespace ghostlight
