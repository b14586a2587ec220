#include "widgets/prescription_edits.h"

#include <QCoreApplication>

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct PrescriptionEdits {
    Q_DECLARE_TR_FUNCTIONS(PrescriptionEdits)
};

/// Renumbers what refers to rows; `place` says where a row went.
template <class Place>
void renumber(Prescription& lens, const Place& place) {
    lens.stop.surface = place(lens.stop.surface);
    for (Configuration& configuration : lens.configurations) {
        std::map<std::size_t, double> moved;
        for (const auto& [row, thickness] : configuration.thickness_mm) {
            moved[place(row)] = thickness;
        }
        configuration.thickness_mm = std::move(moved);
    }
}

Configuration* find_configuration(Prescription& lens, const std::string& name) {
    const auto found = std::find_if(lens.configurations.begin(), lens.configurations.end(),
                                    [&](const Configuration& known) { return known.name == name; });
    return found == lens.configurations.end() ? nullptr : &*found;
}

std::ptrdiff_t offset(std::size_t row) { return static_cast<std::ptrdiff_t>(row); }

}  // namespace

Prescription with_row_inserted_after(Prescription lens, std::size_t row) {
    if (lens.surfaces.empty()) {
        lens.surfaces.push_back(Surface{});
        return lens;
    }
    Surface& above = lens.surfaces.at(row);
    Surface added;
    added.thickness_mm = above.thickness_mm *= 0.5;
    added.medium_after = above.medium_after;
    added.semi_diameter_mm = above.semi_diameter_mm;
    lens.surfaces.insert(lens.surfaces.begin() + offset(row) + 1, std::move(added));
    renumber(lens, [row](std::size_t old) { return old > row ? old + 1 : old; });
    for (Configuration& configuration : lens.configurations) {
        const auto gap = configuration.thickness_mm.find(row);
        if (gap != configuration.thickness_mm.end()) {
            configuration.thickness_mm[row + 1] = gap->second *= 0.5;
        }
    }
    return lens;
}

Prescription with_row_removed(Prescription lens, std::size_t row) {
    if (lens.surfaces.size() <= 1) {
        throw Error(PrescriptionEdits::tr("a lens keeps at least one surface").toStdString());
    }
    if (lens.stop.surface == row) {
        throw Error(PrescriptionEdits::tr("surface %1 is the stop: make another one the stop first")
                        .arg(row + 1)
                        .toStdString());
    }
    lens.surfaces.erase(lens.surfaces.begin() + offset(row));
    for (Configuration& configuration : lens.configurations) {
        configuration.thickness_mm.erase(row);
    }
    renumber(lens, [row](std::size_t old) { return old > row ? old - 1 : old; });
    return lens;
}

Prescription with_row_moved(Prescription lens, std::size_t from, std::size_t to) {
    if (from >= lens.surfaces.size() || to >= lens.surfaces.size()) {
        throw Error(PrescriptionEdits::tr("there is no row to move to").toStdString());
    }
    const auto first = lens.surfaces.begin();
    if (from < to) {
        std::rotate(first + offset(from), first + offset(from) + 1, first + offset(to) + 1);
    } else {
        std::rotate(first + offset(to), first + offset(from), first + offset(from) + 1);
    }
    renumber(lens, [from, to](std::size_t old) {
        if (old == from) {
            return to;
        }
        if (from < to) {
            return old > from && old <= to ? old - 1 : old;
        }
        return old >= to && old < from ? old + 1 : old;
    });
    return lens;
}

Prescription with_stop_at(Prescription lens, std::size_t row) {
    if (row >= lens.surfaces.size()) {
        throw Error(PrescriptionEdits::tr("there is no row %1").arg(row + 1).toStdString());
    }
    lens.stop.surface = row;
    return lens;
}

bool overrides_thickness(const Prescription& lens, const std::string& configuration,
                         std::size_t row) {
    return std::any_of(lens.configurations.begin(), lens.configurations.end(),
                       [&](const Configuration& known) {
                           return known.name == configuration && known.thickness_mm.contains(row);
                       });
}

double thickness_mm(const Prescription& lens, const std::string& configuration, std::size_t row) {
    for (const Configuration& known : lens.configurations) {
        const auto found = known.thickness_mm.find(row);
        if (known.name == configuration && found != known.thickness_mm.end()) {
            return found->second;
        }
    }
    return lens.surfaces.at(row).thickness_mm;
}

Prescription with_thickness(Prescription lens, const std::string& configuration, std::size_t row,
                            double thickness_mm) {
    Configuration* known = find_configuration(lens, configuration);
    if (known != nullptr && known->thickness_mm.contains(row)) {
        known->thickness_mm[row] = thickness_mm;
    } else {
        lens.surfaces.at(row).thickness_mm = thickness_mm;
    }
    return lens;
}

Prescription with_own_thickness(Prescription lens, const std::string& configuration,
                                std::size_t row, bool own) {
    Configuration* known = find_configuration(lens, configuration);
    if (known == nullptr) {
        throw Error(PrescriptionEdits::tr(
                        "choose a configuration first: the lens as listed has no other values")
                        .toStdString());
    }
    if (own) {
        known->thickness_mm.emplace(row, lens.surfaces.at(row).thickness_mm);
    } else {
        known->thickness_mm.erase(row);
    }
    return lens;
}

Prescription with_f_number(Prescription lens, const std::string& configuration, double f_number) {
    Configuration* known = find_configuration(lens, configuration);
    if (known != nullptr && known->f_number) {
        known->f_number = f_number;
    } else {
        lens.stop.f_number = f_number;
    }
    return lens;
}

}  // namespace ghostlight
