#pragma once

#include <QFrame>

#include <array>

#include "core/flare/layers.h"

class QToolButton;

namespace ghostlight {

class Document;
class NumberField;
struct Scene;

/// Under the flare: each layer of the picture with its switch, its gain in stops and "alone".
class LayersStrip : public QFrame {
    Q_OBJECT
   public:
    explicit LayersStrip(Document& document, QWidget* parent = nullptr);

    QToolButton& on(LayerKind kind) { return *rows_[static_cast<std::size_t>(kind)].on; }
    QToolButton& ringing() { return *ringing_; }
    /// A menu of what has no room; hidden where everything has.
    QToolButton& more() { return *more_; }
    QToolButton& alone(LayerKind kind) { return *rows_[static_cast<std::size_t>(kind)].alone; }
    NumberField& gain(LayerKind kind) { return *rows_[static_cast<std::size_t>(kind)].gain; }

    /// Asks for the backdrop's file, which tests answer without a dialog; empty cancels.
    std::function<QString()> ask_backdrop;

   Q_SIGNALS:
    /// An entry was not taken, and why; empty when one was.
    void refused(const QString& reason);

   protected:
    void resizeEvent(QResizeEvent* event) override;

   private:
    struct Row {
        QToolButton* on = nullptr;
        NumberField* gain = nullptr;
        QToolButton* reset = nullptr;
        QToolButton* alone = nullptr;
    };
    void add_row(LayerKind kind);
    void switch_layer(LayerKind kind, bool on);
    void set_gain(LayerKind kind, double gain_ev);
    void follow_document();
    /// As many parts as there is room for.
    void fit_width();
    void show_more();

    Document& document_;
    std::array<Row, layer_kinds.size()> rows_;
    QToolButton* ringing_ = nullptr;
    QToolButton* more_ = nullptr;
};

}  // namespace ghostlight
