#pragma once

#include <QByteArray>
#include <QStringList>

#include "render/gl_flare/engine_choice.h"
#include "widgets/theme.h"

namespace ghostlight {

/// Taste, kept between runs; nothing here is undone.
namespace settings {

inline constexpr int recent_limit = 10;
QStringList recent_files();
void add_recent_file(const QString& file);
void forget_recent_file(const QString& file);

Theme theme();
void set_theme(Theme theme);

Look look();
void set_look(const Look& look);

/// The tour comes by itself once.
bool tour_is_due();
void set_tour_seen();

/// Remembers a remark on this machine; true if it is another than the one told last.
bool is_news(const QString& remark);

/// What flares are drawn with.
FlareEngine flare_engine();
void set_flare_engine(FlareEngine engine);

QByteArray window_geometry();
QByteArray window_state();
void set_window(const QByteArray& geometry, const QByteArray& state);

/// Ghosts weaker than this share of the strongest are not listed; 0 lists all.
double ghost_threshold();
void set_ghost_threshold(double share);

/// Columns of the prescription that most lenses have no use for.
bool shows_aspheres();
void set_shows_aspheres(bool shown);
bool shows_comments();
void set_shows_comments(bool shown);

/// Where file dialogs open.
QString folder();
void set_folder(const QString& folder);

/// Folders with catalogues of glasses, in the order in which they are searched.
QStringList glass_folders();
void set_glass_folders(const QStringList& folders);

}  // namespace settings

}  // namespace ghostlight
