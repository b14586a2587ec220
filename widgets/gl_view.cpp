#include "widgets/gl_view.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLPaintDevice>
#include <QOpenGLWidget>
#include <QPainter>
#include <QTimer>

#include <cmath>

namespace ghostlight {

QSurfaceFormat gl_view_format() {
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(3, 2);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    format.setStencilBufferSize(8);  // for QPainter's clipping
    format.setAlphaBufferSize(8);
    format.setSamples(4);
    return format;
}

namespace {

GlSupport try_gl() {
    GlSupport support;
    QOpenGLContext context;
    context.setFormat(gl_view_format());
    if (!context.create()) {
        support.reason = GlView::tr("no OpenGL can be had here");
        return support;
    }
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!surface.isValid() || !context.makeCurrent(&surface)) {
        support.reason = GlView::tr("OpenGL cannot be started here");
        return support;
    }
    const auto text = [&](GLenum name) {
        const GLubyte* found = context.functions()->glGetString(name);
        return found == nullptr ? QString()
                                : QString::fromUtf8(reinterpret_cast<const char*>(found));
    };
    support.renderer = text(GL_RENDERER);
    support.version = text(GL_VERSION);
    const auto [major, minor] = context.format().version();
    support.is_usable = context.format().version() >= qMakePair(3, 2);
    if (!support.is_usable) {
        support.reason = GlView::tr("OpenGL is too old here: found %1.%2, expected 3.2 or newer")
                             .arg(major)
                             .arg(minor);
    }
    context.doneCurrent();
    return support;
}

}  // namespace

const GlSupport& gl_support() {
    static const GlSupport support = try_gl();
    return support;
}

class GlView::Surface : public QOpenGLWidget {
   public:
    explicit Surface(GlView* view) : QOpenGLWidget(view), view_(view) {
        setFormat(gl_view_format());
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setFocusPolicy(Qt::NoFocus);
    }
    ~Surface() override { close(); }

    void close() {
        if (!initialized_) {
            return;
        }
        disconnect(about_to_be_destroyed_);
        makeCurrent();
        release();
        doneCurrent();
    }

   protected:
    void initializeGL() override {
        // A dock that floats brings its own window, and with it a new context.
        about_to_be_destroyed_ =
            connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
                makeCurrent();
                release();
                doneCurrent();
            });
        initialized_ = true;
        view_->init_gl();
    }

    void paintGL() override {
        QOpenGLFunctions* gl = context()->functions();
        if (view_->failed_) {
            gl->glClearColor(0, 0, 0, 1);
            gl->glClear(GL_COLOR_BUFFER_BIT);
            return;
        }
        const qreal ratio = devicePixelRatio();
        const QSize size_px(static_cast<int>(std::lround(width() * ratio)),
                            static_cast<int>(std::lround(height() * ratio)));
        view_->paint_gl(defaultFramebufferObject(), size_px.width(), size_px.height());
        // The window blends this surface by its alpha, which must not depend on what was drawn.
        gl->glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
        gl->glDisable(GL_SCISSOR_TEST);
        gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
        gl->glClearColor(0, 0, 0, 1);
        gl->glClear(GL_COLOR_BUFFER_BIT);
        gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl->glViewport(0, 0, size_px.width(), size_px.height());
        // Not QPainter(this): QWidget::grab() redirects that away from the framebuffer.
        QOpenGLPaintDevice device(size_px);
        device.setDevicePixelRatio(ratio);
        QPainter painter(&device);
        painter.setFont(view_->font());
        painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
        view_->paint_overlay(painter);
    }

   private:
    void release() {
        if (initialized_) {
            view_->release_gl();
            initialized_ = false;
        }
    }

    GlView* view_;
    bool initialized_ = false;
    QMetaObject::Connection about_to_be_destroyed_;
};

GlView::GlView(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setFocusPolicy(Qt::ClickFocus);
    setMinimumSize(80, 60);
    if (gl_support().is_usable) {
        surface_ = new Surface(this);
    } else {
        failure_ = gl_support().reason;
    }
}

GlView::~GlView() = default;

void GlView::close_gl() {
    if (surface_ != nullptr) {
        surface_->close();
        delete surface_;
        surface_ = nullptr;
    }
}

bool GlView::make_current() {
    if (!has_gl() || surface_->context() == nullptr) {
        return false;
    }
    surface_->makeCurrent();
    return true;
}

void GlView::done_current() { surface_->doneCurrent(); }

void GlView::fail_gl(const QString& reason) {
    failed_ = true;
    failure_ = reason;
    qWarning("%s: %s", metaObject()->className(), qPrintable(reason));
    // Not from within its own paint.
    QTimer::singleShot(0, this, [this] {
        if (surface_ != nullptr) {
            surface_->hide();
        }
        update();
    });
}

QImage GlView::grab_view() {
    if (has_gl()) {
        return surface_->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
    }
    return grab().toImage();
}

void GlView::refresh() {
    if (has_gl()) {
        surface_->update();
    } else {
        update();
    }
}

void GlView::resizeEvent(QResizeEvent*) {
    if (surface_ != nullptr) {
        surface_->setGeometry(rect());
    }
}

void GlView::paintEvent(QPaintEvent*) {
    if (has_gl()) {
        return;
    }
    QPainter painter(this);
    painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    paint_without_gl(painter);
}

}  // namespace ghostlight
