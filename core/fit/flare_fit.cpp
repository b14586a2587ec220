#include "core/fit/flare_fit.h"

#include "core/error.h"
#include "core/fit/fit_run.h"

namespace ghostlight {

std::optional<FitReport> fit_flare(const Prescription& lens, const std::vector<FitPhoto>& photos,
                                   const FitRequest& request, std::stop_token stop,
                                   const FitProgress& progress) {
    if (photos.empty()) throw Error("a fit needs at least one photograph");
    if (request.vary.empty()) throw Error("a fit needs something to vary");
    try {
        return FitRun(lens, photos, request, std::move(stop), progress).run();
    } catch (const FitStopped&) {
        return std::nullopt;
    }
}

}  // namespace ghostlight
