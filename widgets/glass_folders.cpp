#include "widgets/glass_folders.h"

#include <QAbstractButton>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

#include <filesystem>
#include <vector>

#include "core/error.h"
#include "core/io/glass_library.h"
#include "widgets/number_text.h"
#include "widgets/settings.h"

namespace ghostlight {

namespace {

std::vector<std::filesystem::path> paths(const QStringList& folders) {
    std::vector<std::filesystem::path> all;
    for (const QString& folder : folders) {
        all.emplace_back(folder.toStdString());
    }
    return all;
}

QString what_is_in(const QStringList& folders) {
    try {
        const std::size_t bundled = read_glass_library({}).catalogs.size();
        const GlassLibrary library = read_glass_library(paths(folders));
        // What is bundled follows the folders.
        const std::size_t found = library.catalogs.size() - bundled;
        std::size_t glasses = 0;
        for (std::size_t k = 0; k < found; ++k) {
            glasses += library.catalogs[k].glasses.size();
        }
        QStringList lines = {
            GlassFoldersDialog::tr(
                "%n catalogue(s) with %1 glasses in these folders; %2 more are bundled.", nullptr,
                static_cast<int>(found))
                .arg(grouped(glasses))
                .arg(bundled)};
        constexpr std::size_t most = 4;
        for (std::size_t k = 0; k < library.notes.size() && k < most; ++k) {
            const Note& note = library.notes[k];
            lines << QString::fromStdString(note.where.empty() ? note.text
                                                               : note.where + ": " + note.text);
        }
        if (library.notes.size() > most) {
            lines << GlassFoldersDialog::tr("… and %1 more").arg(library.notes.size() - most);
        }
        return lines.join('\n');
    } catch (const Error& error) {
        return QString::fromUtf8(error.what());
    }
}

}  // namespace

void use_glass_folders() { set_glass_folders(paths(settings::glass_folders())); }

GlassFoldersDialog::GlassFoldersDialog(QStringList folders, QWidget* parent)
    : QDialog(parent), list_(new QListWidget), summary_(new QLabel), remove_(nullptr) {
    setWindowTitle(tr("Glass folders"));
    auto* what = new QLabel(
        tr("Glasses are looked up in these folders first, in this order: AGF catalogues, and files "
           "of refractiveindex.info. The bundled catalogues follow."));
    what->setWordWrap(true);
    list_->addItems(folders);
    summary_->setWordWrap(true);
    summary_->setForegroundRole(QPalette::PlaceholderText);
    summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* add = new QPushButton(tr("Add folder…"));
    remove_ = new QPushButton(tr("Remove"));
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    for (QAbstractButton* button : buttons->buttons()) {
        button->setIcon({});  // the words say it
    }
    auto* edits = new QHBoxLayout;
    edits->addWidget(add);
    edits->addWidget(remove_);
    edits->addStretch();
    auto* column = new QVBoxLayout(this);
    column->setSpacing(12);
    column->addWidget(what);
    column->addWidget(list_, 1);
    column->addLayout(edits);
    column->addWidget(summary_);
    column->addWidget(buttons);
    resize(560, 360);

    connect(add, &QPushButton::clicked, this, &GlassFoldersDialog::choose_folder);
    connect(remove_, &QPushButton::clicked, this, &GlassFoldersDialog::remove_chosen);
    connect(list_, &QListWidget::currentRowChanged, this,
            [this](int row) { remove_->setEnabled(row >= 0); });
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    remove_->setEnabled(false);
    look();
}

QStringList GlassFoldersDialog::folders() const {
    QStringList all;
    for (int row = 0; row < list_->count(); ++row) {
        all << list_->item(row)->text();
    }
    return all;
}

void GlassFoldersDialog::add_folder(const QString& folder) {
    if (!folder.isEmpty() && !folders().contains(folder)) {
        list_->addItem(folder);
        look();
    }
}

QString GlassFoldersDialog::summary() const { return summary_->text(); }

void GlassFoldersDialog::choose_folder() {
    add_folder(QFileDialog::getExistingDirectory(this, tr("Folder with glass catalogues"),
                                                 settings::folder()));
}

void GlassFoldersDialog::remove_chosen() {
    delete list_->takeItem(list_->currentRow());
    look();
}

void GlassFoldersDialog::look() { summary_->setText(what_is_in(folders())); }

}  // namespace ghostlight
