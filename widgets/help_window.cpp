#include "widgets/help_window.h"

#include <QAbstractTextDocumentLayout>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QImageReader>
#include <QScrollBar>
#include <QShortcut>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTextList>
#include <QTextTable>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

#include "widgets/help_pages.h"
#include "widgets/palette.h"
#include "widgets/panels/quiet_button.h"

namespace ghostlight {

namespace {

constexpr int width_px = 860, height_px = 820;
constexpr int above_heading_px = 12;
constexpr int layout_ms = 50, layout_tries = 40;
constexpr int widest_image_px = 780;  // of the window's width, less margins and scroll bar

}  // namespace

namespace {

/// Room between paragraphs, which Markdown's blocks come without, and quiet tables.
void space_out(QTextDocument& page) {
    QTextCursor edit(&page);
    edit.beginEditBlock();
    for (QTextBlock block = page.begin(); block.isValid(); block = block.next()) {
        const bool is_in_table = QTextCursor(block).currentTable() != nullptr;
        const bool is_heading = block.blockFormat().headingLevel() > 0;
        const bool is_listed = block.textList() != nullptr;
        QTextBlockFormat format;
        format.setTopMargin(is_heading ? 20 : is_in_table ? 2 : 0);
        format.setBottomMargin(is_in_table || is_listed ? 3 : 9);
        if (!block.text().contains(QChar::ObjectReplacementCharacter)) {  // no picture
            format.setLineHeight(120, QTextBlockFormat::ProportionalHeight);
        }
        edit.setPosition(block.position());
        edit.mergeBlockFormat(format);
    }
    const auto frames = page.rootFrame()->childFrames();
    for (QTextFrame* frame : frames) {
        if (auto* table = qobject_cast<QTextTable*>(frame)) {
            QTextTableFormat format = table->format();
            format.setBorder(0.5);
            format.setBorderCollapse(true);
            format.setBorderBrush(current_palette().line);
            format.setCellPadding(5);
            format.setCellSpacing(0);
            format.setBottomMargin(12);
            table->setFormat(format);
        }
    }
    edit.endEditBlock();
}

}  // namespace

/// Pictures no wider than the window, and headings that can be gone to.
class HelpWindow::Browser : public QTextBrowser {
   public:
    Browser() {
        setOpenExternalLinks(true);
        setFrameShape(QFrame::NoFrame);
        document()->setDocumentMargin(20);
        const Palette& colors = current_palette();
        document()->setDefaultStyleSheet(
            QStringLiteral("a { color: %1; } td, th { padding: 3px 10px; }")
                .arg(colors.teal.name()));
    }

   protected:
    QVariant loadResource(int type, const QUrl& name) override {
        if (type != QTextDocument::ImageResource) {
            return QTextBrowser::loadResource(type, name);
        }
        const QUrl url = name.isRelative() ? source().resolved(name) : name;
        QImageReader reader(url.toLocalFile());
        const QSize size = reader.size();
        const double ratio = devicePixelRatioF();
        const int widest = static_cast<int>(widest_image_px * ratio);
        if (size.width() > widest) {
            reader.setScaledSize(size.scaled(widest, size.height(), Qt::KeepAspectRatio));
        }
        QImage image = reader.read();
        image.setDevicePixelRatio(ratio);
        return image;
    }
};

HelpWindow::HelpWindow(QWidget* parent)
    : QWidget(parent, Qt::Window), pages_(new Browser), browser_(pages_) {
    setObjectName("help");
    setWindowTitle(tr("Help"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(8, 6, 8, 6);
    const auto add = [&](const QString& text, const QString& tip, const QKeySequence& key,
                         auto run) {
        auto* button = new QToolButton;
        button->setProperty("quiet", true);
        button->setText(text);
        button->setToolTip(QStringLiteral("%1 (%2)").arg(tip, key.toString()));
        button->setAccessibleName(tip);
        connect(button, &QToolButton::clicked, this, run);
        connect(new QShortcut(key, this), &QShortcut::activated, this, run);
        bar->addWidget(button);
        return button;
    };
    QToolButton* back =
        add("←", tr("Back"), QKeySequence("Alt+Left"), [this] { browser_->backward(); });
    QToolButton* forth =
        add("→", tr("Forth"), QKeySequence("Alt+Right"), [this] { browser_->forward(); });
    add(tr("User guide"), tr("The guide's beginning"), QKeySequence("Alt+Home"),
        [this] { show_guide(); });
    bar->addStretch();
    connect(browser_, &QTextBrowser::backwardAvailable, back, &QWidget::setEnabled);
    connect(browser_, &QTextBrowser::forwardAvailable, forth, &QWidget::setEnabled);
    back->setEnabled(false);
    forth->setEnabled(false);
    column->addLayout(bar);
    column->addWidget(browser_, 1);
    new QShortcut(Qt::Key_Escape, this, [this] { close(); });
    resize(width_px, height_px);
}

void HelpWindow::come() {
    show();
    raise();
    activateWindow();
    browser_->setFocus();
}

bool HelpWindow::show_guide(const QString& panel_title) {
    const auto folder = docs_folder();
    if (!folder) {
        return false;
    }
    const QString path = QDir(*folder).filePath("user-guide.md");
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) {
        return false;
    }
    const QStringList all = headings(QString::fromUtf8(file.readAll()));
    setWindowTitle(tr("User guide"));
    const QUrl guide = QUrl::fromLocalFile(path);
    const bool is_covered = shows_page_ && browser_->source() == guide;
    browser_->setSource(guide, QTextDocument::MarkdownResource);
    if (is_covered) {  // a page without a source stands over it
        browser_->reload();
    }
    shows_page_ = false;
    space_out(*browser_->document());
    come();
    const QString heading = panel_title.isEmpty() ? QString() : heading_about(panel_title, all);
    if (!heading.isEmpty()) {
        // When a window that has just come has its size.
        QTimer::singleShot(0, this, [this, heading] { go_to_heading(heading, layout_tries); });
    }
    return true;
}

void HelpWindow::show_page(const QString& title, const QString& html) {
    setWindowTitle(title);
    browser_->setHtml(html);
    shows_page_ = true;
    come();
}

void HelpWindow::go_to_heading(const QString& heading, int tries) {
    QString wanted = heading;
    wanted.remove('*').remove('`');
    for (QTextBlock block = browser_->document()->begin(); block.isValid(); block = block.next()) {
        if (block.blockFormat().headingLevel() > 0 && block.text() == wanted) {
            browser_->setTextCursor(QTextCursor(block));
            const auto& layout = *browser_->document()->documentLayout();
            QScrollBar& bar = *browser_->verticalScrollBar();
            bar.setValue(static_cast<int>(layout.blockBoundingRect(block).top()) -
                         above_heading_px);
            // A long page is laid out bit by bit, and can be scrolled only so far until then.
            if (bar.value() == bar.maximum() && tries > 0) {
                QTimer::singleShot(layout_ms, this,
                                   [this, heading, tries] { go_to_heading(heading, tries - 1); });
            }
            return;
        }
    }
}

QString HelpWindow::heading_in_view() const {
    const QTextCursor top = browser_->cursorForPosition(QPoint(30, 20));
    for (QTextBlock block = top.block(); block.isValid(); block = block.previous()) {
        if (block.blockFormat().headingLevel() > 0) {
            return block.text();
        }
    }
    return {};
}

}  // namespace ghostlight
