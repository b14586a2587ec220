#pragma once

#include <QString>

#include <cstddef>
#include <vector>

#include "core/optics/coating.h"

namespace ghostlight {

/// The kinds that are chosen by themselves; those of the library go by their names.
enum class CoatingKind { none, quarter, ideal, stack, constant, measured };
inline constexpr int coating_kinds = 6;

CoatingKind kind_of(const Coating& coating);

/// A coating of that kind, as near to the one that is there as the kind allows: layers keep a
/// quarter wave's, a constant its reflectance at 550 nm. Throws Error for a measured table, which
/// only a file can give.
Coating as_kind(const Coating& coating, CoatingKind kind, const Medium& before,
                const Medium& after);

/// A coating as layers that can be edited, with the same film at its centre wavelength.
LayerStack as_stack(const Coating& coating, const Medium& before, const Medium& after);

/// One layer's medium as the prescription's cells take it. Throws Error.
Medium read_layer_medium(const QString& text);

/// Surfaces named as "2-5, 8", counted from 1, as rows from 0, each once. Throws Error.
std::vector<std::size_t> read_surfaces(const QString& text, std::size_t count);

}  // namespace ghostlight
