#include "widgets/actor_painter.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <QColor>
#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>

#include <algorithm>
#include <vector>

namespace ghostlight {

namespace {

struct Piece {
    double depth = 0.0;  ///< larger is nearer
    QColor color;
    double width_px = 0.0;  ///< of a line; 0 for filled areas
    QPainterPath path;
};

/// World to view for a parallel camera along z.
class Projection {
   public:
    Projection(vtkCamera& camera, QSizeF size_px) : size_px_(size_px) {
        camera.GetFocalPoint(center_);
        px_per_unit_ = size_px.height() / (2.0 * camera.GetParallelScale());
    }
    QPointF operator()(const double point[3]) const {
        return {size_px_.width() / 2.0 + (point[0] - center_[0]) * px_per_unit_,
                size_px_.height() / 2.0 - (point[1] - center_[1]) * px_per_unit_};
    }

   private:
    QSizeF size_px_;
    double center_[3] = {};
    double px_per_unit_ = 1.0;
};

QColor color_of(vtkPolyData& data, vtkProperty& property, vtkIdType point) {
    vtkDataArray* colors = data.GetPointData()->GetScalars();
    if (colors == nullptr || colors->GetNumberOfComponents() < 3) {
        double rgb[3];
        property.GetColor(rgb);
        return QColor::fromRgbF(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                                static_cast<float>(rgb[2]));
    }
    const auto channel = [&](int c) { return static_cast<int>(colors->GetComponent(point, c)); };
    return {channel(0), channel(1), channel(2)};
}

/// Neighbouring triangles of one path leave no seam if all run the same way round.
QPolygonF turned_alike(QPolygonF area) {
    double twice_area = 0.0;
    for (qsizetype i = 0; i < area.size(); ++i) {
        const QPointF a = area[i], b = area[(i + 1) % area.size()];
        twice_area += a.x() * b.y() - b.x() * a.y();
    }
    if (twice_area < 0.0) {
        std::reverse(area.begin(), area.end());
    }
    area << area.front();
    return area;
}

void add_cells(std::vector<Piece>& pieces, vtkCellArray* cells, vtkPolyData& data,
               vtkProperty& property, const Projection& to_view, bool filled) {
    if (cells == nullptr) {
        return;
    }
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    for (cells->InitTraversal(); cells->GetNextCell(count, ids) != 0;) {
        QPolygonF line;
        double point[3] = {};
        for (vtkIdType i = 0; i < count; ++i) {
            data.GetPoint(ids[i], point);
            line << to_view(point);
        }
        if (line.size() < 2) {
            continue;
        }
        const QColor color = color_of(data, property, ids[0]);
        const double width_px = filled ? 0.0 : static_cast<double>(property.GetLineWidth());
        const bool same = !pieces.empty() && pieces.back().depth == point[2] &&
                          pieces.back().color == color && pieces.back().width_px == width_px;
        if (!same) {
            pieces.push_back({point[2], color, width_px, {}});
            pieces.back().path.setFillRule(Qt::WindingFill);
        }
        pieces.back().path.addPolygon(filled ? turned_alike(std::move(line)) : line);
    }
}

}  // namespace

bool paint_actors(QPainter& painter, vtkRenderer& renderer, QSizeF size_px) {
    const Projection to_view(*renderer.GetActiveCamera(), size_px);
    std::vector<Piece> pieces;
    vtkActorCollection* actors = renderer.GetActors();
    actors->InitTraversal();
    while (vtkActor* actor = actors->GetNextActor()) {
        auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
        vtkPolyData* data = mapper == nullptr ? nullptr : mapper->GetInput();
        if (data == nullptr || actor->GetVisibility() == 0) {
            continue;
        }
        vtkProperty& property = *actor->GetProperty();
        add_cells(pieces, data->GetPolys(), *data, property, to_view, true);
        add_cells(pieces, data->GetLines(), *data, property, to_view, false);
    }
    std::ranges::stable_sort(pieces, {}, &Piece::depth);
    painter.save();
    for (const Piece& piece : pieces) {
        if (piece.width_px > 0.0) {
            painter.strokePath(piece.path, QPen(piece.color, piece.width_px));
        } else {
            painter.fillPath(piece.path, piece.color);
        }
    }
    painter.restore();
    return !pieces.empty();
}

}  // namespace ghostlight
