#include "widgets/document.h"

#include <utility>

#include "core/io/fit_setup_json.h"
#include "core/io/lens_file.h"
#include "core/io/read_text.h"
#include "core/io/scene_json.h"
#include "widgets/edit_command.h"

namespace ghostlight {

bool may_be_saved_over(const std::filesystem::path& file) {
    std::error_code unreadable;
    if (file.empty() || !std::filesystem::exists(file, unreadable)) {
        return true;
    }
    try {
        return read_text(file).find("\"ghostlight_lens\"") != std::string::npos;
    } catch (const Error&) {
        return false;  // whatever it is, it is not ours
    }
}

std::string document_to_json(const DocumentState& state, const std::filesystem::path& folder) {
    Prescription lens = state.lens;
    lens.unknown[std::string(scene_field)] = scene_to_json(state.scene);
    if (!state.fit.empty()) {
        lens.unknown[std::string(fit_field)] =
            fit_setup_to_json(fit_setup_from_json(state.fit), folder);
    }
    return lens_to_json(lens, folder);
}

DocumentState document_from_lens(Prescription lens) {
    DocumentState state;
    const auto scene = lens.unknown.extract(std::string(scene_field));
    state.scene = default_scene(lens);
    if (scene) {
        state.scene = scene_from_json(scene.mapped(), lens, state.scene);
    }
    if (const auto fit = lens.unknown.extract(std::string(fit_field))) {
        state.fit = fit.mapped();
    }
    state.lens = std::move(lens);
    return state;
}

Document::Document(QObject* parent) : QObject(parent) {
    connect(&history_, &QUndoStack::indexChanged, this, &Document::file_changed);
}

// A history that goes empties itself and says so; whoever listens may be gone already.
Document::~Document() { history_.disconnect(); }

Prescription Document::configured_lens() const {
    return configured(state_.lens, state_.scene.configuration);
}

void Document::edit(DocumentState after, const QString& text, const QString& field) {
    if (after == state_) {
        return;
    }
    history_.push(new EditCommand(*this, state_, std::move(after), text, field));
}

void Document::edit_lens(Prescription after, const QString& text, const QString& field) {
    edit({std::move(after), state_.scene, state_.fit}, text, field);
}

void Document::edit_scene(Scene after, const QString& text, const QString& field) {
    edit({state_.lens, std::move(after), state_.fit}, text, field);
}

void Document::edit_fit(std::string after, const QString& text, const QString& field) {
    edit({state_.lens, state_.scene, std::move(after)}, text, field);
}

void Document::apply(const DocumentState& state) {
    const bool lens_changed = state.lens != state_.lens;
    const bool fit_is_another = state.fit != state_.fit;
    const bool is_seen = lens_changed || state.scene != state_.scene || !fit_is_another;
    state_ = state;
    if (!is_seen) {
        Q_EMIT fit_changed();
        return;
    }
    ++revision_;
    changed_at_ = std::chrono::steady_clock::now();
    Q_EMIT changed(lens_changed);
    if (fit_is_another) {
        Q_EMIT fit_changed();
    }
}

std::optional<Error> Document::open(const std::filesystem::path& file) {
    try {
        LensFile read = read_lens(file);
        std::error_code unreadable;
        const auto absolute = std::filesystem::absolute(file, unreadable);
        DocumentState state = document_from_lens(std::move(read.lens));
        if (!state.fit.empty()) {  // photographs are named from the lens's folder
            state.fit = fit_setup_to_json(fit_setup_from_json(state.fit, absolute.parent_path()));
        }
        begin(state, unreadable ? file : absolute, std::move(read.notes));
        saved_lens_ = state_.lens;
        Q_EMIT file_changed();
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

std::optional<Error> Document::save_as(const std::filesystem::path& file) {
    try {
        write_file_safely(file, document_to_json(state_, file.parent_path()));
    } catch (const Error& error) {
        return error;
    }
    file_ = file;
    is_own_file_ = true;
    saved_lens_ = state_.lens;
    saved_at_ = QDateTime::currentDateTime();
    history_.setClean();
    Q_EMIT file_changed();
    return std::nullopt;
}

std::optional<Error> Document::reload() {
    try {
        LensFile read = read_lens(file_);
        DocumentState state = document_from_lens(std::move(read.lens));
        try {
            static_cast<void>(configured(state.lens, state_.scene.configuration));
            state.scene = state_.scene;  // still looked at in the same way
        } catch (const Error&) {
            // That configuration is gone: the file's own scene.
        }
        notes_ = std::move(read.notes);
        is_own_file_ = may_be_saved_over(file_);
        saved_lens_ = state.lens;
        saved_at_ = {};
        edit(std::move(state), tr("reload from disk"));
        Q_EMIT file_changed();
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

void Document::lose_saved() {
    saved_lens_ = {};
    Q_EMIT file_changed();
}

void Document::adopt(DocumentState state, const std::filesystem::path& file) {
    begin(std::move(state), file, {});
    saved_lens_ = {};
    Q_EMIT file_changed();
}

void Document::begin(DocumentState state, const std::filesystem::path& file, Notes notes) {
    history_.clear();
    file_ = file;
    is_own_file_ = may_be_saved_over(file);
    notes_ = std::move(notes);
    saved_at_ = {};
    first_revision_ = revision_ + 1;
    state_ = {};
    Q_EMIT opened();
    apply(state);
}

QString Document::title() const {
    if (!state_.lens.name.empty()) {
        return QString::fromStdString(state_.lens.name);
    }
    return file_.empty() ? QString() : QString::fromStdString(file_.stem().string());
}

}  // namespace ghostlight
