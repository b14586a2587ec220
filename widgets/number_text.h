#pragma once

#include <QString>

#include <optional>

namespace ghostlight {

/// Numbers as people read them here, whatever the machine's locale: a decimal point, a true minus.

/// `digits` significant digits, for results: "0.04319", "34.00", "5.371e−05".
QString significant(double value, int digits = 4);

/// What was typed: as few digits as read back exactly, but at least `decimals` after the point.
QString at_least_decimals(double value, int decimals);

/// As few digits as read back exactly, with an ASCII minus: for editors, the clipboard, JSON.
QString shortest(double value);

/// A count with thin spaces between thousands: "61 440".
QString grouped(qulonglong count);

/// Reads one number; accepts a true minus, and a decimal comma when there is no point. Nothing if
/// the text is anything else, or not finite.
std::optional<double> parse_number(const QString& text);

}  // namespace ghostlight
