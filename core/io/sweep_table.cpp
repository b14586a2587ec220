#include "core/io/sweep_table.h"

#include <map>
#include <string>

namespace ghostlight {

Table sweep_table(const SweepParameter& parameter, const std::vector<SweepPoint>& points) {
    const std::string column = column_of(parameter);
    Table table;
    table.columns = {column,        "ghost",          "flux_mm2",      "relative_flux",
                     "peak_per_e0", "centroid_x_mm",  "centroid_y_mm", "rms_radius_mm",
                     "on_sensor",   "worst_" + column};
    std::map<GhostPath, double> worst;
    for (const GhostCurve& curve : curves_of(points, SweepQuantity::flux))
        worst[curve.path] = points[curve.worst].value;
    for (const SweepPoint& point : points) {
        if (!point.table) continue;
        for (const GhostRow& row : point.table->ghosts)
            table.rows.push_back({point.value, name(row.path, point.table->surface_count),
                                  row.flux_mm2, row.relative_flux, row.peak_per_e0,
                                  row.centroid_x_mm, row.centroid_y_mm, row.rms_radius_mm,
                                  row.on_sensor, worst[row.path]});
    }
    return table;
}

}  // namespace ghostlight
