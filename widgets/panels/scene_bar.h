#pragma once

#include <QToolBar>

namespace ghostlight {

class ChoiceField;
class Document;
class NumberField;
struct Scene;
class TabularLabel;

/// What is looked at, in one row: the lens's name, its configuration and f-number, the light.
class SceneBar : public QToolBar {
    Q_OBJECT
   public:
    explicit SceneBar(Document& document, QWidget* parent = nullptr);

    NumberField& f_number() { return *f_number_; }
    NumberField& field() { return *field_; }
    NumberField& azimuth() { return *azimuth_; }
    NumberField& tolerance() { return *tolerance_; }
    NumberField& flare_tolerance() { return *flare_tolerance_; }
    ChoiceField& spectrum() { return *spectrum_; }
    ChoiceField& configuration() { return *configuration_; }

   Q_SIGNALS:
    /// An entry was not taken, and why; empty when one was.
    void refused(const QString& reason);

   private:
    void connect_fields();
    void connect_tolerance(NumberField& field, double Scene::*share, const QString& what,
                           const QString& key);
    void follow_document();
    void show_title();
    /// Runs an edit that throws Error for a text that cannot be taken.
    template <class Field, class Edit>
    void attempt(Field& field, const Edit& edit);
    void set_field_deg(double field_deg);
    void set_azimuth_deg(double azimuth_deg);
    void set_f_number(double f_number);

    Document& document_;
    TabularLabel* title_;
    ChoiceField* configuration_;
    NumberField* f_number_;
    NumberField* field_;
    NumberField* azimuth_;
    ChoiceField* spectrum_;
    NumberField* tolerance_;
    NumberField* flare_tolerance_;
    double shown_f_number_ = 0.0;
};

}  // namespace ghostlight
