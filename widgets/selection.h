#pragma once

#include <QObject>

#include <vector>

#include "core/ghosts/ghost_path.h"

namespace ghostlight {

/// What is picked out in all views at once. Not undone and not saved.
class Selection : public QObject {
    Q_OBJECT
   public:
    using QObject::QObject;

    const std::vector<GhostPath>& ghosts() const { return ghosts_; }
    void set_ghosts(std::vector<GhostPath> ghosts) {
        if (ghosts != ghosts_) {
            ghosts_ = std::move(ghosts);
            Q_EMIT ghosts_changed();
        }
    }

   Q_SIGNALS:
    void ghosts_changed();

   private:
    std::vector<GhostPath> ghosts_;
};

}  // namespace ghostlight
