#pragma once

#include <QWidget>

#include <functional>
#include <vector>

#include "core/flare/scene.h"

class QFormLayout;
class QListWidget;
class QToolButton;
class QVBoxLayout;

namespace ghostlight {

class ChoiceField;
class Document;
class NumberField;
class Selection;

/// The scene's lights, its veil, and what an artist changes. Every value has its unit, its range
/// and a reset, and is undone with the document.
class LightPanel : public QWidget {
    Q_OBJECT
   public:
    LightPanel(Document& document, Selection& selection, QWidget* parent = nullptr);

    QListWidget& list() { return *list_; }
    QToolButton& add() { return *add_; }
    QToolButton& remove() { return *remove_; }
    /// By its name in the panel: "intensity", "size", …
    NumberField& number(const QString& id) const;
    ChoiceField& choice(const QString& id) const;
    QToolButton& reset(const QString& id) const;

   Q_SIGNALS:
    /// An entry was not taken, and why; empty when one was.
    void refused(const QString& reason);

   private:
    using Get = std::function<double(const Scene&)>;
    using Set = std::function<void(Scene&, double)>;
    struct Number {
        QString id, label, unit, tip;
        double low, high, step, normal;  ///< `normal` is what a reset sets
        Get get;
        Set set;
        NumberField* field = nullptr;
        QToolButton* reset = nullptr;
    };
    struct Choice {
        QString id;
        std::function<QString(const Scene&)> get;
        std::function<void(Scene&, const QString&)> set;  ///< throws Error
        QString normal;
        ChoiceField* field = nullptr;
        QToolButton* reset = nullptr;
    };
    void build_lights(QVBoxLayout& column);
    void build_veil(QVBoxLayout& column);
    void build_artistic(QVBoxLayout& column);
    QFormLayout* add_section(QVBoxLayout& column, const QString& title);
    void add_number(QFormLayout& form, Number number);
    void add_choice(QFormLayout& form, const QString& label, const QString& tip, bool editable,
                    const QStringList& choices, Choice choice);
    void enter(std::size_t number, double value);
    void add_light();
    void remove_light();
    void follow_document();
    /// Style of the selected ghost, made if it is asked to be changed; null without a selection.
    const GhostStyle* style(const Scene& scene) const;
    void change_style(Scene& scene, const std::function<void(GhostStyle&)>& change) const;

    Document& document_;
    Selection& selection_;
    QListWidget* list_;
    QToolButton* add_;
    QToolButton* remove_;
    QToolButton* ghost_on_ = nullptr;
    QToolButton* neutral_ = nullptr;
    QWidget* ghost_rows_ = nullptr;
    std::vector<Number> numbers_;
    std::vector<Choice> choices_;
    bool follows_ = false;  ///< while the list is filled it reports no edits
};

}  // namespace ghostlight
