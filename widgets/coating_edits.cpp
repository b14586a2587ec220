#include "widgets/coating_edits.h"

#include <QCoreApplication>

#include <QStringList>

#include <cmath>
#include <set>
#include <string>

#include "core/error.h"
#include "core/io/lens_file.h"
#include "widgets/models/cell_text.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct CoatingEdits {
    Q_DECLARE_TR_FUNCTIONS(CoatingEdits)
};
constexpr double design_nm = 550.0;
}  // namespace

CoatingKind kind_of(const Coating& coating) {
    if (const auto* quarter = std::get_if<QuarterWave>(&coating)) {
        return std::holds_alternative<IdealIndex>(quarter->layer) ? CoatingKind::ideal
                                                                  : CoatingKind::quarter;
    }
    return std::holds_alternative<LayerStack>(coating)            ? CoatingKind::stack
           : std::holds_alternative<ConstantReflectance>(coating) ? CoatingKind::constant
           : std::holds_alternative<MeasuredReflectance>(coating) ? CoatingKind::measured
                                                                  : CoatingKind::none;
}

Coating as_kind(const Coating& coating, CoatingKind kind, const Medium& before,
                const Medium& after) {
    if (kind == kind_of(coating) && kind != CoatingKind::stack) {
        return coating;
    }
    switch (kind) {
        case CoatingKind::none:
            return Uncoated{};
        case CoatingKind::quarter:
            return QuarterWave{};
        case CoatingKind::ideal:
            return QuarterWave{design_nm, IdealIndex{}};
        case CoatingKind::stack:
            return as_stack(coating, before, after);
        case CoatingKind::constant: {
            const double r = reflectances(film_at(coating, before, after, design_nm), 1.0).r();
            const double rounded = std::round(r * 1e4) / 1e4;
            return ConstantReflectance{rounded, 1.0 - rounded};
        }
        case CoatingKind::measured:
            break;
    }
    throw Error(
        CoatingEdits::tr("a measured table comes from a file: docs/formats-catalogues.md says how")
            .toStdString());
}

LayerStack as_stack(const Coating& coating, const Medium& before, const Medium& after) {
    if (const auto* stack = std::get_if<LayerStack>(&coating)) {
        return *stack;
    }
    LayerStack stack;
    if (const auto* quarter = std::get_if<QuarterWave>(&coating)) {
        const Film film = film_at(coating, before, after, quarter->center_nm);
        for (const FilmLayer& layer : film.layers) {
            const auto* medium = std::get_if<Medium>(&quarter->layer);
            stack.layers.push_back(
                {medium != nullptr ? *medium : Medium{{}, ConstantIndex{layer.n}},
                 layer.thickness_nm});
        }
    }
    if (stack.layers.empty()) {
        const Medium layer = magnesium_fluoride();
        stack.layers.push_back({layer, design_nm / (4.0 * refractive_index(layer, design_nm))});
    }
    return stack;
}

Medium read_layer_medium(const QString& text) {
    return std::get<LayerStack>(read_coating(text.trimmed() + ":1", bundled_glasses()))
        .layers.front()
        .medium;
}

std::vector<std::size_t> read_surfaces(const QString& text, std::size_t count) {
    const std::string expected =
        CoatingEdits::tr("surfaces as 2-5, 8, from 1 to %1").arg(count).toStdString();
    std::set<std::size_t> rows;
    for (const QString& part : text.split(QChar(','), Qt::SkipEmptyParts)) {
        const QStringList ends = part.trimmed().split('-');
        std::vector<std::size_t> numbers;
        for (const QString& end : ends) {
            bool is_number = false;
            const auto number = end.trimmed().toULongLong(&is_number);
            if (!is_number || number < 1 || number > count) {
                throw Error({CoatingEdits::tr("not a surface").toStdString(),
                             {},
                             {},
                             part.trimmed().toStdString(),
                             expected});
            }
            numbers.push_back(static_cast<std::size_t>(number));
        }
        if (numbers.size() > 2 || numbers.front() > numbers.back()) {
            throw Error({CoatingEdits::tr("not a range of surfaces").toStdString(),
                         {},
                         {},
                         part.trimmed().toStdString(),
                         expected});
        }
        for (std::size_t number = numbers.front(); number <= numbers.back(); ++number) {
            rows.insert(number - 1);
        }
    }
    if (rows.empty()) {
        throw Error({CoatingEdits::tr("no surface is named").toStdString(),
                     {},
                     {},
                     text.toStdString(),
                     expected});
    }
    return {rows.begin(), rows.end()};
}

}  // namespace ghostlight
