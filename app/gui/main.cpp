// The window. Its options are few: what it shows is in the lens file.

#include <QApplication>
#include <QCommandLineParser>
#include <QIcon>
#include <QLocale>
#include <QSurfaceFormat>
#include <QTableView>

#include <algorithm>
#include <clocale>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/freed_memory.h"
#include "core/ghosts/ghost_path.h"
#include "core/optics/optical_system.h"
#include "core/units.h"
#include "widgets/blocking_trace.h"
#include "widgets/main_window.h"
#include "widgets/models/prescription_model.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/prescription_panel.h"
#include "widgets/settings.h"
#include "widgets/snapshot.h"
#include "widgets/theme.h"
#include "widgets/translation.h"

namespace {

constexpr int bad_usage = 2;

constexpr const char* usage_text = R"(Usage: ghostlight [OPTIONS] [LENS]

Opens the lens-flare workbench, on a lens file if one is given.

  --snapshot DIR  open LENS, wait until all views are ready, write workbench.png, the tabbed
                  panels (panel_NAME.png), ghosts.csv and flare.exr into DIR, and exit
  --every-panel   with --snapshot: every panel, not the tabbed ones alone
  --theme NAME    dark or light, this time
  --text-scale PERCENT  size of letters, 70 to 200, this time
  --ghost PAIRS   ghosts to select at first, e.g. 5-3 or 5-3,7-2
  --do ACTIONS    what to do at first, one after the other: ids of the menus' entries, e.g.
                  ghosts.as_matrix,flare.false_color; or SURFACE.COLUMN=TEXT for a cell of the
                  prescription, e.g. compare.pin,3.coating=none
  --study NAME    a panel to open and begin: fit (as saved with the lens), accuracy or plan
  --engine NAME   what draws flares, this time: automatic, cpu or opengl
  --language CODE texts in this language, this time: en or de
  --size WxH      size of the window in pixels, e.g. 1366x768
  --trace-blocking  say on stderr which events held up the window for 50 ms or more
  --help          this text
  --version       the version

Exit status: 0, or 2 with one line on stderr.
)";

int fail(const std::string& reason) {
    std::fprintf(stderr, "ghostlight: %s\n", reason.c_str());
    return bad_usage;
}

std::optional<QSize> parse_size(const QString& text) {
    const QStringList parts = text.split('x');
    bool width_ok = false;
    bool height_ok = false;
    const QSize size(parts.value(0).toInt(&width_ok), parts.value(1).toInt(&height_ok));
    constexpr int least = 320;
    constexpr int most = 16384;
    const bool sound = parts.size() == 2 && width_ok && height_ok && size.width() >= least &&
                       size.height() >= least && size.width() <= most && size.height() <= most;
    return sound ? std::optional(size) : std::nullopt;
}

/// For one action's results before the next, at most.
constexpr int settling_ms = 300'000;

struct CellEdit {
    int row, column;
    QString text;
};

/// "3.coating=none": what goes into a cell of the prescription, rows from 1.
std::optional<CellEdit> parse_cell(const QString& item) {
    using Model = ghostlight::PrescriptionModel;
    constexpr std::pair<const char*, int> columns[] = {
        {"radius", Model::radius}, {"thickness", Model::thickness},
        {"glass", Model::medium},  {"semi-diameter", Model::semi_diameter},
        {"conic", Model::conic},   {"coating", Model::coating}};
    const QString where = item.section('=', 0, 0);
    const int row = where.section('.', 0, 0).toInt();
    const auto column = std::ranges::find(columns, where.section('.', 1),
                                          [](const auto& each) { return QString(each.first); });
    if (row < 1 || !item.contains('=') || column == std::end(columns)) {
        return std::nullopt;
    }
    return CellEdit{row - 1, column->second, item.section('=', 1)};
}

void set_surface_format() {
    // VTK needs a core context of 3.2 or later; one format for all, since contexts are shared.
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    format.setStencilBufferSize(8);
    format.setAlphaBufferSize(8);
    format.setSwapInterval(0);  // a picture is shown when it is ready
    QSurfaceFormat::setDefaultFormat(format);
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
}

int run(QApplication& application, const QCommandLineParser& options) {
    const QStringList files = options.positionalArguments();
    const bool snapshot = options.isSet("snapshot");
    if (files.size() > 1) {
        return fail("one lens at a time; found " + std::to_string(files.size()) + " files");
    }
    if (snapshot && files.isEmpty()) {
        return fail("--snapshot needs a lens file");
    }
    std::optional<QSize> size;
    if (options.isSet("size") && !(size = parse_size(options.value("size")))) {
        return fail("--size: found " + options.value("size").toStdString() +
                    ", expected WIDTHxHEIGHT, e.g. 1366x768");
    }
    std::optional<ghostlight::FlareEngine> engine;
    if (options.isSet("engine") &&
        !(engine = ghostlight::parse_engine(options.value("engine").toStdString()))) {
        return fail("--engine: found " + options.value("engine").toStdString() +
                    ", expected automatic, cpu or opengl");
    }
    const QString theme = options.value("theme");
    if (options.isSet("theme") && theme != "dark" && theme != "light") {
        return fail("--theme: found " + theme.toStdString() + ", expected dark or light");
    }
    ghostlight::Look look = snapshot ? ghostlight::Look() : ghostlight::settings::look();
    if (options.isSet("text-scale")) {
        bool is_number = false;
        look.text_scale = 0.01 * options.value("text-scale").toDouble(&is_number);
        if (!is_number || !(look.text_scale >= ghostlight::least_text_scale &&
                            look.text_scale <= ghostlight::most_text_scale)) {
            return fail("--text-scale: found " + options.value("text-scale").toStdString() +
                        ", expected per cent from 70 to 200");
        }
    }
    ghostlight::apply_theme(application,
                            theme == "light"              ? ghostlight::Theme::light
                            : theme == "dark" || snapshot ? ghostlight::Theme::dark
                                                          : ghostlight::settings::theme(),
                            look);
    ghostlight::MainWindow window(!snapshot);
    if (engine) {
        window.set_engine(*engine);
    }
    if (size) {
        window.resize(*size);
        window.arrange_panels();
    }
    const bool opened = files.isEmpty() || window.open(files.front().toStdString());
    if (snapshot && !opened) {
        return fail(window.banner().text().toStdString());
    }
    if (options.isSet("ghost")) {
        const ghostlight::OpticalSystem system =
            ghostlight::compile(window.document().configured_lens(), ghostlight::d_line_nm);
        std::vector<ghostlight::GhostPath> ghosts;
        for (const QString& ghost : options.value("ghost").split(',')) {
            ghosts.push_back(ghostlight::parse_ghost(ghost.toStdString(), system));
        }
        window.selection().set_ghosts(std::move(ghosts));
    }
    window.show();
    if (const QString wanted = options.value("do"); !wanted.isEmpty()) {
        const auto known = ghostlight::action_texts();
        for (const QString& id : wanted.split(',')) {
            if (const auto cell = parse_cell(id)) {
                ghostlight::wait_until_settled(window, settling_ms);
                auto& model = *window.prescription_panel().table().model();
                const QModelIndex index = model.index(cell->row, cell->column);
                if (!index.isValid() || !model.setData(index, cell->text, Qt::EditRole)) {
                    return fail(
                        "--do: found " + id.toStdString() +
                        ", expected what that cell takes: " + window.banner().text().toStdString());
                }
                continue;
            }
            if (std::ranges::none_of(known, [&](const auto& text) { return id == text.id; })) {
                return fail("--do: found " + id.toStdString() +
                            ", expected an action such as ghosts.as_matrix or compare.pin");
            }
            ghostlight::wait_until_settled(window, settling_ms);
            window.actions()[id].trigger();
        }
    }
    if (options.isSet("study") && !window.begin_study(options.value("study"))) {
        return fail("--study: found " + options.value("study").toStdString() +
                    ", expected fit, accuracy or plan");
    }
    if (!snapshot) {
        window.welcome();
        return QApplication::exec();
    }
    ghostlight::write_snapshot(window, options.value("snapshot").toStdString(),
                               options.isSet("every-panel") ? ghostlight::SnapshotPanels::every
                                                            : ghostlight::SnapshotPanels::tabbed);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    for (int k = 1; k < argc; ++k) {  // these need no display
        const std::string argument = argv[k];
        if (argument == "--help" || argument == "-h") {
            std::fputs(usage_text, stdout);
            return 0;
        }
        if (argument == "--version") {
            std::puts("ghostlight " GHOSTLIGHT_VERSION);
            return 0;
        }
    }
    ghostlight::keep_freed_memory();
    // X11, through XWayland where need be: VTK's OpenGL here is GLX.
    if (qEnvironmentVariableIsSet("DISPLAY") && !qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) {
        qputenv("QT_QPA_PLATFORM", "xcb");
    }
    set_surface_format();
    ghostlight::TracedApplication application(argc, argv);
    QCoreApplication::setApplicationName("ghostlight");
    QCoreApplication::setOrganizationName("ghostlight");
    QCoreApplication::setApplicationVersion(GHOSTLIGHT_VERSION);
    QGuiApplication::setApplicationDisplayName("Ghostlight");
    QGuiApplication::setDesktopFileName("io.github.ghostlight.Ghostlight");
    QGuiApplication::setWindowIcon(QIcon(":/ghostlight/icon.svg"));
    const QLocale language = QLocale::system();  // of texts; the machine's settings say which
    // Numbers here have a decimal point, in files and on screen; Qt has just asked the machine.
    QLocale::setDefault(QLocale::c());
    std::setlocale(LC_NUMERIC, "C");

    QCommandLineParser options;
    options.addOptions({{"snapshot", "", "DIR"},
                        {"size", "", "WxH"},
                        {"engine", "", "NAME"},
                        {"language", "", "CODE"},
                        {"every-panel", ""},
                        {"theme", "", "NAME"},
                        {"text-scale", "", "PERCENT"},
                        {"do", "", "ACTIONS"},
                        {"ghost", "", "PAIRS"},
                        {"study", "", "NAME"},
                        {"trace-blocking", ""}});
    options.addPositionalArgument("LENS", "");
    if (!options.parse(QCoreApplication::arguments())) {
        return fail(options.errorText().toStdString() + " (see --help)");
    }
    if (options.isSet("trace-blocking")) {
        application.trace(ghostlight::TracedApplication::default_least_ms,
                          ghostlight::TracedApplication::print);
    }
    const QString wanted = options.value("language");
    if (options.isSet("language") && !ghostlight::languages().contains(wanted)) {
        return fail("--language: found " + wanted.toStdString() + ", expected one of " +
                    ghostlight::languages().join(", ").toStdString());
    }
    // Pictures for the guide are the same on every machine.
    ghostlight::install_translation(application, options.isSet("language") ? QLocale(wanted)
                                                 : options.isSet("snapshot")
                                                     ? QLocale(QLocale::English)
                                                     : language);
    try {
        return run(application, options);
    } catch (const std::exception& error) {
        return fail(error.what());
    }
}
