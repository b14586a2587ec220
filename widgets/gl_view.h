#pragma once

#include <QImage>
#include <QSurfaceFormat>
#include <QWidget>

class QPainter;

namespace ghostlight {

/// The format of every OpenGL view of the window: core profile, four samples.
QSurfaceFormat gl_view_format();

/// What OpenGL this machine and platform plug-in give.
struct GlSupport {
    bool is_usable = false;  ///< a context of that format can be had
    QString reason;          ///< why not
    QString renderer, version;
};

/// Tried once.
const GlSupport& gl_support();

/// A widget that draws with OpenGL and, over it, with a QPainter. It takes its own mouse and key
/// events (the OpenGL surface inside is transparent to them). Where no OpenGL can be had, or a
/// derived class gives up with fail_gl(), paint_without_gl() draws instead.
class GlView : public QWidget {
    Q_OBJECT
   public:
    explicit GlView(QWidget* parent = nullptr);
    ~GlView() override;

    bool has_gl() const { return surface_ != nullptr && !failed_; }
    /// What the view shows, in device pixels.
    QImage grab_view();
    /// Asks for a repaint.
    void refresh();

   protected:
    /// With the context current. May be called again after release_gl(), when the view has moved
    /// to another window.
    virtual void init_gl() = 0;
    /// Draws into `framebuffer`, which is bound, width × height in device pixels.
    virtual void paint_gl(unsigned framebuffer, int width_px, int height_px) = 0;
    /// With the context current, before it goes.
    virtual void release_gl() = 0;
    /// Drawn over that; in logical pixels.
    virtual void paint_overlay(QPainter& painter) = 0;
    /// In place of both.
    virtual void paint_without_gl(QPainter& painter) = 0;

    /// Stops using OpenGL for good. To be called from init_gl() or paint_gl().
    void fail_gl(const QString& reason);
    QString gl_failure() const { return failure_; }
    /// Derived classes call this first in their destructors, while release_gl() is still theirs.
    void close_gl();
    /// Makes the context current between paints; false when there is none.
    bool make_current();
    void done_current();

    void resizeEvent(QResizeEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

   private:
    class Surface;
    Surface* surface_ = nullptr;
    bool failed_ = false;
    QString failure_;
};

}  // namespace ghostlight
