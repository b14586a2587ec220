#include "widgets/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace ghostlight {

namespace {

constexpr QChar minus_sign(0x2212);
constexpr QChar thin_space(0x2009);

QString with_true_minus(QString text) { return text.replace('-', minus_sign); }

}  // namespace

QString significant(double value, int digits) {
    if (std::isnan(value)) {
        return QString();
    }
    if (std::isinf(value)) {
        return with_true_minus(value < 0 ? QStringLiteral("-∞") : QStringLiteral("∞"));
    }
    const double size = std::abs(value);
    if (size == 0.0) {
        return QStringLiteral("0");
    }
    if (size < 1e-3 || size >= 1e6) {
        return with_true_minus(QString::number(value, 'e', digits - 1));
    }
    // The exponent after rounding: 9.9996 is written with the decimals of 10.00.
    const QString rounded = QString::number(value, 'e', digits - 1);
    const int exponent = rounded.mid(rounded.indexOf('e') + 1).toInt();
    return with_true_minus(QString::number(value, 'f', std::max(0, digits - 1 - exponent)));
}

QString shortest(double value) {
    std::array<char, 64> buffer{};
    const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return QString::fromLatin1(buffer.data(), written.ptr - buffer.data());
}

QString at_least_decimals(double value, int decimals) {
    QString text = shortest(value);
    if (!std::isfinite(value) || text.contains('e')) {
        return with_true_minus(text);
    }
    const auto point = text.indexOf('.');
    const auto given = point < 0 ? 0 : text.size() - point - 1;
    if (given < decimals) {
        text = QString::number(value, 'f', decimals);
    }
    return with_true_minus(text);
}

QString grouped(qulonglong count) {
    QString text = QString::number(count);
    for (auto place = text.size() - 3; place > 0; place -= 3) {
        text.insert(place, thin_space);
    }
    return text;
}

std::optional<double> parse_number(const QString& text) {
    QString plain = text.trimmed();
    plain.replace(minus_sign, '-');
    if (!plain.contains('.') && plain.count(',') == 1) {
        plain.replace(',', '.');
    }
    if (plain.startsWith('+')) {
        plain.remove(0, 1);
    }
    const QByteArray bytes = plain.toLatin1();
    double value = 0.0;
    const auto read = std::from_chars(bytes.data(), bytes.data() + bytes.size(), value);
    if (bytes.isEmpty() || read.ec != std::errc{} || read.ptr != bytes.data() + bytes.size() ||
        !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

}  // namespace ghostlight
