#pragma once

#include <QDialog>
#include <QStringList>

class QLabel;
class QListWidget;
class QPushButton;

namespace ghostlight {

/// Hands the folders kept in the settings to the glass library.
void use_glass_folders();

/// Where glasses are looked up besides the bundled catalogues; what was found there, as it is
/// chosen.
class GlassFoldersDialog : public QDialog {
    Q_OBJECT
   public:
    explicit GlassFoldersDialog(QStringList folders, QWidget* parent = nullptr);

    QStringList folders() const;
    void add_folder(const QString& folder);
    /// "2 catalogues, 540 glasses", and what could not be read.
    QString summary() const;

   private:
    void choose_folder();
    void remove_chosen();
    void look();

    QListWidget* list_;
    QLabel* summary_;
    QPushButton* remove_;
};

}  // namespace ghostlight
