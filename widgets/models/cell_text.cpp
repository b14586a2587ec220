#include "widgets/models/cell_text.h"

#include <QCoreApplication>

#include <QRegularExpression>
#include <QStringList>

#include <optional>
#include <utility>

#include "core/error.h"
#include "core/io/coating_library.h"
#include "core/io/glass_library.h"
#include "core/units.h"
#include "widgets/number_text.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct CellWords {
    Q_DECLARE_TR_FUNCTIONS(CellWords)
};

[[noreturn]] void refuse(const QString& problem, const QString& found, const QString& expected) {
    throw Error(
        {problem.toStdString(), {}, {}, found.trimmed().toStdString(), expected.toStdString()});
}

QString subscripts_plain(QString text) { return text.replace(QChar(0x2082), '2'); }

double fixed_index(const Medium& medium) {
    const auto* constant = std::get_if<ConstantIndex>(&medium.dispersion);
    return constant != nullptr ? constant->n : refractive_index(medium, d_line_nm);
}

QString text_of_layer_medium(const Medium& medium) {
    return medium.name.empty() ? shortest(fixed_index(medium))
                               : QString::fromStdString(medium.name);
}

/// A named material, or an index at every wavelength.
Medium read_layer_medium(const QString& text, const GlassCatalog& catalog) {
    const QString plain = subscripts_plain(text.trimmed());
    if (plain.compare("MgF2", Qt::CaseInsensitive) == 0) {
        return magnesium_fluoride();
    }
    if (const Medium* known = catalog.find(plain.toStdString())) {
        return *known;
    }
    const auto n = parse_number(plain);
    if (!n || *n <= 0.0) {
        refuse(CellWords::tr("unknown layer material"), text,
               CellWords::tr("MgF2, a catalogue name or an index above 0"));
    }
    return Medium{{}, ConstantIndex{*n}};
}

QString text_of_quarter_wave(const QuarterWave& coating) {
    const auto* medium = std::get_if<Medium>(&coating.layer);
    QString text = QStringLiteral("%1 λ/4 %2")
                       .arg(medium != nullptr ? text_of_layer_medium(*medium) : "ideal",
                            shortest(coating.center_nm));
    if (coating.thickness_factor != 1.0) {
        text += QStringLiteral(" ×") + shortest(coating.thickness_factor);
    }
    return text;
}

Layer read_layer(const QString& text, const GlassCatalog& catalog) {
    const QStringList parts = text.split(':');
    const QString expected =
        CellWords::tr("layers as index[,k]:thickness in nm, e.g. 1.38:96.4 | 2.1:50");
    if (parts.size() != 2) {
        refuse(CellWords::tr("cannot read the layer"), text, expected);
    }
    const QStringList index = parts[0].split(',');
    const auto thickness = parse_number(parts[1]);
    const auto extinction = index.size() == 2 ? parse_number(index[1]) : 0.0;
    if (index.size() > 2 || !thickness || !extinction || *thickness < 0.0 || *extinction < 0.0) {
        refuse(CellWords::tr("cannot read the layer"), text, expected);
    }
    return {read_layer_medium(index[0], catalog), *thickness, *extinction};
}

/// The library's name of a coating, where it has that very coating; else nothing.
QString library_name(const std::string& name, const Coating& coating) {
    const Coating* known = name.empty() ? nullptr : find_coating(name);
    return known != nullptr && *known == coating ? QString::fromStdString(name) : QString();
}

QString text_of_stack(const LayerStack& stack) {
    if (const QString name = library_name(stack.name, stack); !name.isEmpty()) {
        return name;
    }
    if (stack.layers.empty()) {
        return "none";
    }
    QStringList parts;
    if (stack.from_air) {
        parts << "air";
    }
    for (const Layer& layer : stack.layers) {
        QString part = text_of_layer_medium(layer.medium);
        if (layer.extinction != 0.0) {
            part += ',' + shortest(layer.extinction);
        }
        parts << part + ':' + shortest(layer.thickness_nm);
    }
    return parts.join(" | ");
}

struct CoatingText {
    QString operator()(const Uncoated&) const { return "none"; }
    QString operator()(const QuarterWave& quarter) const { return text_of_quarter_wave(quarter); }
    QString operator()(const LayerStack& stack) const { return text_of_stack(stack); }
    QString operator()(const MeasuredReflectance& table) const {
        return QString::fromStdString(table.name.empty() ? "measured" : table.name);
    }
    QString operator()(const ConstantReflectance& fixed) const {
        QString text = "R=" + shortest(fixed.reflectance);
        if (fixed.transmittance != 1.0 - fixed.reflectance) {
            text += ", T=" + shortest(fixed.transmittance);
        }
        return text;
    }
};

/// "R=0.05" or "R=0.05, T=0.9": shares, the same at every wavelength and angle.
std::optional<ConstantReflectance> read_constant(const QString& plain) {
    static const QRegularExpression form("^R\\s*=\\s*([^,]+?)\\s*(?:,\\s*T\\s*=\\s*(.+))?$",
                                         QRegularExpression::CaseInsensitiveOption);
    const auto match = form.match(plain);
    if (!match.hasMatch()) {
        return std::nullopt;
    }
    const auto r = parse_number(match.captured(1));
    const auto t = match.captured(2).isEmpty() ? std::optional(1.0 - r.value_or(0.0))
                                               : parse_number(match.captured(2));
    if (!r || !t || *r < 0.0 || *t < 0.0 || *r + *t > 1.0) {
        refuse(CellWords::tr("not a usable reflectance"), plain,
               CellWords::tr("shares R=0.05, T=0.9 with R + T up to 1"));
    }
    return ConstantReflectance{*r, *t};
}

}  // namespace

double read_number(const QString& text, const QString& expected, CellUnit unit) {
    if (const auto number = parse_number(text)) {
        return *number;
    }
    return read_cell_expression(text.toStdString(), unit, expected.toStdString());
}

double read_positive(const QString& text, const QString& expected, CellUnit unit) {
    const double number = read_number(text, expected, unit);
    if (number <= 0.0) {
        refuse(CellWords::tr("must be above 0"), text, expected);
    }
    return number;
}

QString text_of_curve(const BaseCurve& curve) {
    if (const auto* radius = std::get_if<Radius>(&curve)) {
        return shortest(radius->mm);
    }
    if (const auto* curvature = std::get_if<Curvature>(&curve)) {
        return "c=" + shortest(curvature->per_mm);
    }
    return "plane";
}

BaseCurve read_curve(const QString& text) {
    const QString plain = text.trimmed().toLower();
    static const QStringList planes = {"", "plane", "flat", "inf", "infinity", "∞", "stop"};
    if (planes.contains(plain)) {
        return Plane{};
    }
    const QString expected = CellWords::tr("a radius in mm, or 'plane'");
    if (plain.startsWith("c=")) {
        return Curvature{
            read_number(plain.mid(2), CellWords::tr("a curvature in 1/mm"), CellUnit::per_mm)};
    }
    const double mm = read_number(plain, expected, CellUnit::mm);
    if (mm == 0.0) {
        refuse(CellWords::tr("a radius cannot be 0"), text, expected);
    }
    return Radius{mm};
}

QString text_of_medium(const Medium& medium) {
    if (is_air(medium)) {
        return {};
    }
    if (!medium.name.empty()) {
        return QString::fromStdString(medium.name);
    }
    if (std::holds_alternative<UnknownGlass>(medium.dispersion)) {
        return QStringLiteral("?");
    }
    if (std::holds_alternative<ConstantIndex>(medium.dispersion)) {
        return shortest(fixed_index(medium));
    }
    const auto* model = std::get_if<ModelGlass>(&medium.dispersion);
    const double nd = model != nullptr ? model->nd : refractive_index(medium, d_line_nm);
    const double vd = model != nullptr ? model->vd : abbe_number(medium);
    return QStringLiteral("%1 / %2").arg(at_least_decimals(nd, 4), at_least_decimals(vd, 1));
}

Medium read_medium(const QString& text, const GlassCatalog& catalog) {
    const QString plain = text.trimmed();
    if (plain.isEmpty() || plain.compare("air", Qt::CaseInsensitive) == 0) {
        return {};
    }
    if (const Medium* known = catalog.find(plain.toStdString())) {
        return *known;
    }
    if (const auto known = find_glass(plain.toStdString(), {})) {
        return known->glass.medium;
    }
    const QString expected =
        CellWords::tr("a catalogue name, 'nd / Vd' or an index; empty for air");
    const QStringList parts = plain.split('/');
    const auto nd = parse_number(parts[0]);
    if (!nd) {
        refuse(CellWords::tr("no such glass in the catalogue"), text, expected);
    }
    if (*nd < 1.0) {
        refuse(CellWords::tr("an index is at least 1"), text, expected);
    }
    if (parts.size() == 1) {
        return *nd == 1.0 ? Medium{} : Medium{{}, ConstantIndex{*nd}};
    }
    const auto vd = parse_number(parts[1]);
    if (parts.size() != 2 || !vd || *vd <= 0.0) {
        refuse(CellWords::tr("the Abbe number is not a number above 0"), text, expected);
    }
    return {{}, ModelGlass{*nd, *vd}};
}

QString text_of_aspheric(const std::vector<double>& terms) {
    QStringList parts;
    for (std::size_t k = 0; k < terms.size(); ++k) {
        parts << QStringLiteral("A%1=%2").arg(2 * k + 4).arg(shortest(terms[k]));
    }
    return parts.join(", ");
}

std::vector<double> read_aspheric(const QString& text) {
    static const QRegularExpression separators("[,;\\s]+");
    static const QRegularExpression named("^[aA](\\d+)=(.+)$");
    const QString expected = CellWords::tr("A4=1.2e-5, A6=-3e-8, … or a list that starts at A4");
    std::vector<double> terms;
    std::size_t place = 0;
    // "A4 = 1e-5" is as good as "A4=1e-5".
    const QString joined = QString(text).replace(QRegularExpression("\\s*=\\s*"), "=");
    for (const QString& part : joined.split(separators, Qt::SkipEmptyParts)) {
        QString value = part;
        const auto match = named.match(part);
        if (match.hasMatch()) {
            const int power = match.captured(1).toInt();
            if (power < 4 || power % 2 != 0 || power > 40) {
                refuse(CellWords::tr("powers are even, from 4 on"), part, expected);
            }
            place = static_cast<std::size_t>(power - 4) / 2;
            value = match.captured(2);
        }
        const auto number = parse_number(value);
        if (!number) {
            refuse(CellWords::tr("cannot read the aspheric term"), part, expected);
        }
        if (place >= terms.size()) {
            terms.resize(place + 1, 0.0);
        }
        terms[place++] = *number;
    }
    while (!terms.empty() && terms.back() == 0.0) {
        terms.pop_back();
    }
    return terms;
}

QString text_of_coating(const Coating& coating) { return std::visit(CoatingText{}, coating); }

Coating read_coating(const QString& text, const GlassCatalog& catalog) {
    const QString plain = subscripts_plain(text.trimmed());
    if (plain.isEmpty() || plain.compare("none", Qt::CaseInsensitive) == 0) {
        return Uncoated{};
    }
    if (const Coating* known = find_coating(plain.toStdString())) {
        return *known;
    }
    if (const auto constant = read_constant(plain)) {
        return *constant;
    }
    static const QRegularExpression quarter_wave(
        "^(.*?)\\s*(?:λ/4|l/4|qw|quarter[ -]?wave)\\s*([^\\s×x*]+)\\s*(?:nm)?"
        "\\s*(?:[×x*]\\s*(\\S+))?$",
        QRegularExpression::CaseInsensitiveOption | QRegularExpression::UseUnicodePropertiesOption);
    const auto match = quarter_wave.match(plain);
    if (!match.hasMatch()) {
        if (!plain.contains(':')) {
            refuse(
                CellWords::tr("cannot read the coating"), text,
                CellWords::tr(
                    "none, MgF2 λ/4 550, 1.38 λ/4 550, ideal λ/4 550, a stack 1.38:96.4 | 2.1:50, "
                    "R=0.05, or a name of the coating library"));
        }
        LayerStack stack;
        for (const QString& part : plain.split('|')) {
            // A stack listed from the air, whichever side of the surface that is.
            if (stack.layers.empty() && part.trimmed().compare("air", Qt::CaseInsensitive) == 0) {
                stack.from_air = true;
                continue;
            }
            stack.layers.push_back(read_layer(part, catalog));
        }
        return stack;
    }
    QuarterWave coating;
    const QString layer = match.captured(1).trimmed();
    if (layer.compare("ideal", Qt::CaseInsensitive) == 0) {
        coating.layer = IdealIndex{};
    } else if (!layer.isEmpty()) {
        coating.layer = read_layer_medium(layer, catalog);
    }
    coating.center_nm =
        read_positive(match.captured(2), CellWords::tr("a centre wavelength in nm"), CellUnit::nm);
    if (match.lastCapturedIndex() >= 3) {
        coating.thickness_factor =
            read_positive(match.captured(3), CellWords::tr("a thickness factor"));
    }
    return coating;
}

}  // namespace ghostlight
