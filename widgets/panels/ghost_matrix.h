#pragma once

#include <QWidget>

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/ghosts/ghost_table.h"

namespace ghostlight {

/// Surfaces by surfaces: each cell is the ghost that turns first at the surface of its row, then at
/// that of its column, coloured by the logarithm of its flux, with a scale. A click selects, with
/// Ctrl more of them; arrow keys walk.
class GhostMatrix : public QWidget {
    Q_OBJECT
   public:
    explicit GhostMatrix(QWidget* parent = nullptr);

    void show_table(std::shared_ptr<const GhostTable> table);
    void set_selected(const std::vector<GhostPath>& ghosts);
    void set_stale(bool stale);
    /// Where a ghost's cell is; nothing for one that has none.
    std::optional<QRectF> cell_of(const GhostPath& path) const;
    /// The colour that a flux has.
    QColor color_of(double flux_mm2) const;

    QSize minimumSizeHint() const override { return {160, 120}; }

   Q_SIGNALS:
    void selected(std::vector<ghostlight::GhostPath> ghosts);

   protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;
    void changeEvent(QEvent* event) override;

   private:
    struct Grid {
        double left = 0.0, top = 0.0, cell = 1.0;
        QRectF at(std::size_t first, std::size_t second, std::size_t lowest) const;
    };
    Grid grid() const;
    const GhostRow* ghost_at(QPointF position) const;
    void paint_scale(QPainter& painter, const QRectF& place) const;

    std::shared_ptr<const GhostTable> table_;
    std::map<GhostPath, const GhostRow*> rows_;
    std::size_t lowest_ = 0, highest_ = 0;  ///< surfaces that any ghost turns at
    std::vector<GhostPath> selected_;
    bool stale_ = false;
};

}  // namespace ghostlight
