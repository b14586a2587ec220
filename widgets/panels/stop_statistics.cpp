#include "widgets/panels/stop_statistics.h"

#include <QCoreApplication>
#include <QStringList>

#include <cmath>

#include "core/flare/dirt_statistics.h"
#include "widgets/number_text.h"

namespace ghostlight {

namespace {

/// Texts for people, as translators know them.
struct StopStatistics {
    Q_DECLARE_TR_FUNCTIONS(StopStatistics)
};

QString percent(double share) { return significant(100.0 * share, 3); }

}  // namespace

QString stop_statistics(const Stop& stop, const OpticalSystem& system) {
    QStringList lines;
    const int arms = starburst_arms(stop);
    lines << (arms > 0 ? StopStatistics::tr("%n arm(s) of the starburst", nullptr, arms)
                       : StopStatistics::tr("round: rings instead of arms"));
    if (stop.image) {
        lines << StopStatistics::tr(
            "with an image, ghosts are drawn by the uniform method, whose error is not estimated");
    }
    if (stop.dirt.is_clean()) {
        return lines.join('\n');
    }
    const DirtStatistics found = dirt_statistics(system.stop_mask, stop.dirt);
    if (found.specks > 0.0) {
        lines << StopStatistics::tr("%1 specks of dust take %2 % of the light")
                     .arg(grouped(static_cast<qulonglong>(std::llround(found.specks))),
                          percent(found.dust_share));
    }
    if (found.scratches > 0) {
        lines << StopStatistics::tr("%n scratch(es) take %1 %", nullptr, found.scratches)
                     .arg(percent(found.scratch_share));
    }
    if (found.print_share > 0.0) {
        lines << StopStatistics::tr("the fingerprint takes %1 %").arg(percent(found.print_share));
    }
    lines << StopStatistics::tr("%1 % of the light passes").arg(percent(found.clear_share));
    return lines.join('\n');
}

}  // namespace ghostlight
