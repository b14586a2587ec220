#pragma once

#include <QString>
#include <QStringList>

#include <optional>

#include "core/optics/prescription.h"

namespace ghostlight {

/// Row, from 0, of the first surface followed by a glass that nobody knows.
std::optional<std::size_t> first_unknown_glass(const Prescription& lens);

/// "glass MYSTERY1 after surface 1 is not known: not in the catalogues…"
QString why_unknown(const Prescription& lens, std::size_t row);

/// Glasses that may be meant, best first: of a name that nobody knows those spelt alike, of an
/// index and Abbe number those nearest to them. Nothing for what the catalogue knows, or air.
QStringList offered_glasses(const Medium& medium);

/// The lens with each unknown glass that the catalogues know by now put in its place.
Prescription with_known_glasses(Prescription lens);

}  // namespace ghostlight
