#include <QComboBox>
#include <QLineEdit>
#include <QStandardItemModel>
#include <QTableView>

#include <algorithm>

#include "core/error.h"
#include "core/io/coating_library.h"
#include "core/units.h"
#include "widgets/coating_edits.h"
#include "widgets/document.h"
#include "widgets/models/cell_text.h"
#include "widgets/panels/coating_panel.h"

// The coating panel's edits: each is one step, refused in words where no film can be so.

namespace ghostlight {

template <class Edit>
bool CoatingPanel::attempt(const QString& text, const Edit& edit, const QString& field) {
    if (!has_surface()) {
        return false;
    }
    try {
        Prescription lens = document_.lens();
        edit(lens);
        for (std::size_t row = 0; row < lens.surfaces.size(); ++row) {
            const Surface& surface = lens.surfaces[row];
            if (surface.coating != document_.lens().surfaces[row].coating) {
                // Throws for what no film can be.
                film_at(surface.coating, medium_before(lens, row), surface.medium_after, d_line_nm);
            }
        }
        document_.edit_lens(std::move(lens), text, field);
        Q_EMIT refused({});
        return true;
    } catch (const Error& error) {
        Q_EMIT refused(error.what());
        update_.start();  // what was refused gives way to what is
        return false;
    }
}

void CoatingPanel::choose_kind(int at) {
    if (!has_surface()) {
        return;
    }
    const auto row = static_cast<std::size_t>(row_);
    const Medium& before = medium_before(document_.lens(), row);
    const Medium& after = document_.lens().surfaces[row].medium_after;
    attempt(tr("change coating of surface %1").arg(row_ + 1), [&](Prescription& lens) {
        Coating& chosen = lens.surfaces[row].coating;
        if (at < coating_kinds) {
            chosen = as_kind(chosen, static_cast<CoatingKind>(at), before, after);
        } else if (const Coating* known = find_coating(kind_->itemText(at).toStdString())) {
            chosen = *known;
        }
    });
    update_.start();
}

void CoatingPanel::change_stack(const QString& what, void (*change)(LayerStack&, std::size_t)) {
    const int at = std::max(0, table_->currentIndex().row());
    attempt(what, [&](Prescription& lens) {
        const auto row = static_cast<std::size_t>(row_);
        LayerStack stack =
            as_stack(coating(), medium_before(lens, row), lens.surfaces[row].medium_after);
        change(stack, static_cast<std::size_t>(at));
        stack.name.clear();  // no longer the library's
        lens.surfaces[row].coating = stack.layers.empty() ? Coating(Uncoated{}) : Coating(stack);
    });
}

void CoatingPanel::change_layer(QStandardItem* item) {
    if (is_filling_) {
        return;
    }
    const auto at = static_cast<std::size_t>(item->row());
    const int column = item->column();
    const QString text = item->text();
    attempt(
        tr("change coating of surface %1").arg(row_ + 1),
        [&](Prescription& lens) {
            Coating& changed = lens.surfaces[static_cast<std::size_t>(row_)].coating;
            if (auto* stack = std::get_if<LayerStack>(&changed)) {
                Layer& layer = stack->layers.at(at);
                if (column == material_column) {
                    layer.medium = read_layer_medium(text);
                } else if (column == thickness_column) {
                    layer.thickness_nm = read_number(text, tr("a thickness in nm"), CellUnit::nm);
                } else {
                    layer.extinction = read_number(text, tr("an extinction, 0 or more"));
                    layer.extinction_table = {};
                }
                stack->name.clear();
            } else if (auto* quarter = std::get_if<QuarterWave>(&changed)) {
                if (column == material_column) {
                    quarter->layer =
                        text.trimmed().compare("ideal", Qt::CaseInsensitive) == 0
                            ? std::variant<IdealIndex, Medium>(IdealIndex{})
                            : std::variant<IdealIndex, Medium>(read_layer_medium(text));
                } else {
                    quarter->center_nm =
                        read_positive(text, tr("a centre wavelength in nm"), CellUnit::nm);
                }
            } else if (auto* fixed = std::get_if<ConstantReflectance>(&changed)) {
                const double share = read_number(text, tr("per cent, from 0 to 100")) / 100.0;
                *fixed = ConstantReflectance{share, 1.0 - share};
            }
        },
        QStringLiteral("layer/%1/%2/%3").arg(row_).arg(item->row()).arg(column));
}

void CoatingPanel::copy_to(const std::vector<std::size_t>& rows) {
    if (!has_surface()) {
        return;
    }
    attempt(tr("copy the coating of surface %1 to %2 surfaces").arg(row_ + 1).arg(rows.size()),
            [&](Prescription& lens) {
                const Coating copied = coating();
                for (const std::size_t row : rows) {
                    lens.surfaces[row].coating = copied;
                }
            });
}

void CoatingPanel::copy_to_targets() {
    try {
        copy_to(read_surfaces(targets_->text(), document_.lens().surfaces.size()));
    } catch (const Error& error) {
        Q_EMIT refused(error.what());
    }
}

}  // namespace ghostlight
