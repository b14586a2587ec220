#include "widgets/panels/status_line.h"

#include <QHBoxLayout>

#include <algorithm>

#include "core/instruction_set.h"
#include "core/parallel.h"
#include "widgets/document.h"
#include "widgets/number_text.h"
#include "widgets/tabular_text.h"

namespace ghostlight {

namespace {

QString milliseconds(double ms) { return QString::number(ms, 'f', ms < 9.95 ? 1 : 0); }

}  // namespace

StatusLine::StatusLine(Document& document, QWidget* parent)
    : QWidget(parent),
      document_(document),
      table_(new TabularLabel),
      timing_(new TabularLabel),
      picture_(new TabularLabel),
      proof_(new TabularLabel),
      message_(new TabularLabel),
      engine_(new TabularLabel),
      saved_(new TabularLabel) {
    setObjectName("status_line");
    setAttribute(Qt::WA_StyledBackground);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 6, 12, 6);
    row->setSpacing(32);
    row->addWidget(table_);
    row->addWidget(timing_);
    row->addWidget(picture_);
    row->addWidget(proof_);
    row->addWidget(message_);
    row->addStretch();
    row->addWidget(engine_);
    row->addWidget(saved_);
    timing_->setToolTip(tr(
        "From the last change to its first picture on screen: finding where ghosts enter and what "
        "may be\n"
        "left out, tracing, rasterising, adding up, bringing to the screen; the rest is waiting"));
    show_engine({});
    connect(&document_, &Document::changed, this, &StatusLine::follow_document);
    connect(&document_, &Document::opened, this, [this] {
        table_->set_text({});
        timing_->set_text({});
        picture_->set_text({});
        clear_proof();
    });
    connect(&document_, &Document::file_changed, this, &StatusLine::show_saved);
    show_saved();
}

void StatusLine::show_table(const GhostTable& table) {
    const auto refined = std::count_if(table.ghosts.begin(), table.ghosts.end(),
                                       [](const GhostRow& row) { return row.converged; });
    QString text =
        tr("*%n ghost(s)* · %1 rays · %2 s", nullptr, static_cast<int>(table.ghosts.size()))
            .arg(grouped(table.rays), significant(table.seconds, 2));
    const auto open = static_cast<std::ptrdiff_t>(table.ghosts.size()) - refined;
    text += open == 0 ? tr(" · all within %1 %").arg(shortest(document_.scene().tolerance * 100.0))
                      : tr(" · %1 above the tolerance").arg(open);
    table_->set_text(text);
}

void StatusLine::show_progress(double share) {
    table_->set_text(tr("ghost table *%1 %*").arg(qRound(share * 100.0)));
}

void StatusLine::show_picture(const FlarePicture& picture, double upload_ms) {
    if (picture.is_first_look) {
        const FlarePlan& plan = picture.image->plan;
        picture_->set_text(tr("first look, off by about *%1 %*")
                               .arg(significant(100.0 * plan.estimated_error(), 1)));
        picture_->setToolTip(
            tr("Each ghost from a few rays about its own centre ray, to see something at once. The "
               "error is estimated from those rays; light that enters elsewhere is not in it."));
    } else if (picture.image->plan.ghosts.empty()) {
        show_without_plan(picture.image->ghosts);
    } else {
        show_plan(picture.image->plan);
    }
    if (picture.revision == timed_revision_) {
        return;  // the finer picture of the same change
    }
    timed_revision_ = picture.revision;
    const double total_ms = std::chrono::duration<double, std::milli>(
                                std::chrono::steady_clock::now() - picture.changed_at)
                                .count();
    const FlareTimes& times = picture.image->times;
    // What took no time worth telling is not told.
    constexpr double least_ms = 0.05;
    QStringList parts;
    const auto add = [&](const QString& what, double ms) {
        if (ms >= least_ms) {
            parts << what.arg(milliseconds(ms));
        }
    };
    add(tr("bounds %1"), times.bounds_ms);
    add(tr("trace %1"), times.trace_ms);
    add(tr("raster %1"), times.raster_ms);
    add(tr("ringing %1"), times.ringing_ms);
    add(tr("compose %1"), times.composite_ms);
    add(tr("show %1"), upload_ms);
    timing_->set_text(tr("*%1 ms* ").arg(milliseconds(total_ms)) + parts.join(" · "));
}

void StatusLine::show_plan(const FlarePlan& plan) {
    QString text = tr("flare within *%1 %* · %2 of %3 ghosts drawn")
                       .arg(significant(100.0 * plan.estimated_error(), 2))
                       .arg(plan.count(GhostFate::drawn))
                       .arg(plan.ghosts.size());
    if (const std::size_t folded = plan.count(GhostFate::folded); folded > 0) {
        text += tr(" · %n in the veil", nullptr, static_cast<int>(folded));
    }
    if (plan.left_out_mm2 > 0.0) {
        text +=
            tr(" · %n left out ≤ %1 %", nullptr, static_cast<int>(plan.count(GhostFate::left_out)))
                .arg(significant(100.0 * plan.left_out_share(), 2));
    }
    picture_->set_text(text);
    picture_->setToolTip(
        tr("Estimated error of the ghost layer, L1 over its light on the sensor "
           "(%1 % allowed).\n%2 ghosts land beside the sensor, through %3 no ray was "
           "found to pass; %4 are left out, at most %5 % of the light.\nNot modelled: "
           "light of four and more reflections, about %6 % of that of two (the surfaces "
           "taken as plane).")
            .arg(significant(100.0 * plan.tolerance, 2))
            .arg(plan.count(GhostFate::off_sensor))
            .arg(plan.count(GhostFate::nothing_passes))
            .arg(plan.count(GhostFate::left_out))
            .arg(significant(100.0 * plan.left_out_share(), 2),
                 significant(100.0 * plan.not_modelled, 2)));
}

void StatusLine::show_without_plan(std::size_t ghosts) {
    if (ghosts == 0) {  // the layer is off
        picture_->set_text({});
        picture_->setToolTip({});
        return;
    }
    const QString reason =
        document_.lens().stop.image
            ? tr("the stop has an image")
            : tr("the sensor reflects, and the light is not above or below the axis");
    picture_->set_text(tr("*uniform* method, error not estimated: %1").arg(reason));
    picture_->setToolTip(
        tr("Every ghost on an even grid, as fine as its map asks for. Only the planned method "
           "estimates the picture's error."));
}

void StatusLine::show_engine(const EngineState& state) {
    const unsigned threads = default_thread_count();
    const QString cpu =
        tr("CPU %1 · %n thread(s)", nullptr, static_cast<int>(threads)).arg(instruction_set_name());
    const bool gl = state.choice.engine == FlareEngine::gl;
    engine_->set_text(gl ? QStringLiteral("OpenGL · ") + QString::fromStdString(state.gl_renderer)
                         : cpu);
    const QString reason = QString::fromStdString(state.choice.reason);
    engine_->setToolTip(reason.isEmpty() ? tr("What draws the flare")
                                         : tr("What draws the flare. %1").arg(reason));
    if (state.gave_up) {
        show_message(tr("OpenGL gave up, the CPU goes on: %1").arg(reason));
    }
}

void StatusLine::show_proving(double share) {
    const QString percent = QStringLiteral(" %1 %").arg(qRound(100.0 * share));
    proof_->set_text((proven_.isEmpty() ? tr("proving bounds") : proven_ + tr(" · proving on")) +
                     percent);
    proof_->setToolTip(
        tr("Whether the search for where ghosts enter has missed light; stops when "
           "something changes"));
}

void StatusLine::show_proof(const std::shared_ptr<const PlanProof>& proof) {
    const double missed = proof->missed_share();
    const bool certified = proof->certified == proof->ghosts.size();
    // A bound above all of the light says nothing about what was missed.
    proven_ = certified      ? tr("*bounds certified*")
              : missed < 1.0 ? tr("missed light ≤ *%1 %*").arg(significant(100.0 * missed, 2))
                             : tr("bounds of %1 of %2 ghosts certified")
                                   .arg(proof->certified)
                                   .arg(proof->ghosts.size());
    proof_->set_text(proven_);
    proof_->setToolTip(
        tr("Proven by interval arithmetic in %1 s: outside of where ghosts are drawn, "
           "light on the sensor comes to at most %2 % of theirs.\nThe bound of %3 of "
           "%4 ghosts is within their share of 0.1 %; for the others more cells would "
           "be needed, which is no sign that anything was missed.")
            .arg(significant(proof->seconds, 2), significant(100.0 * missed, 2))
            .arg(proof->certified)
            .arg(proof->ghosts.size()));
}

void StatusLine::clear_proof() {
    proven_.clear();
    proof_->set_text({});
    proof_->setToolTip({});
}

void StatusLine::show_message(const QString& message) { message_->set_text(message); }

QString StatusLine::timing_text() const { return timing_->text().remove('*'); }

QString StatusLine::table_text() const { return table_->text().remove('*'); }

QString StatusLine::picture_text() const { return picture_->text().remove('*'); }

QString StatusLine::engine_text() const { return engine_->text().remove('*'); }

QString StatusLine::proof_text() const { return proof_->text().remove('*'); }

QString StatusLine::message_text() const { return message_->text(); }

void StatusLine::follow_document() {
    message_->set_text({});
    show_saved();
}

void StatusLine::show_saved() {
    if (document_.is_empty()) {
        saved_->set_text({});
    } else if (document_.is_modified()) {
        saved_->set_text(tr("*unsaved edits*"));
    } else if (document_.saved_at().isValid()) {
        saved_->set_text(tr("saved %1").arg(document_.saved_at().toString("HH:mm")));
    } else {
        saved_->set_text(tr("as on file"));
    }
}

}  // namespace ghostlight
