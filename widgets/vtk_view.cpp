#include "widgets/vtk_view.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPainter>

#include "widgets/actor_painter.h"
#include "widgets/palette.h"

namespace ghostlight {

VtkView::VtkView(QWidget* parent) : GlView(parent) {}

VtkView::~VtkView() { close_gl(); }

void VtkView::init_gl() {
    window_ = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
    window_->SetMapped(true);
    window_->SetIsCurrent(true);
    window_->SetReadyForRendering(true);
    window_->SetOwnContext(0);
    window_->SetMultiSamples(gl_view_format().samples());
    // Core profiles may refuse wide lines: VTK then draws them as rectangles.
    window_->SetForceMaximumHardwareLineWidth(1);
    window_->SetFrameBlitModeToBlitToCurrent();
    window_->AddRenderer(renderer_);
    window_->OpenGLInitContext();
}

void VtkView::paint_gl(unsigned framebuffer, int width_px, int height_px) {
    // Qt has used the context since: forget what VTK believes of its state, and leave it as found.
    vtkOpenGLState* state = window_->GetState();
    state->Reset();
    state->Push();
    // QPainter leaves these behind, and VTK does not set them.
    QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
    gl->glDisable(GL_STENCIL_TEST);
    state->vtkglDepthFunc(GL_LEQUAL);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    window_->SetSize(width_px, height_px);
    prepare_rendering(width_px, height_px);
    window_->Render();
    state->Pop();
}

void VtkView::release_gl() {
    if (window_ == nullptr) {
        return;
    }
    window_->Finalize();  // also the actors' own resources
    window_->RemoveRenderer(renderer_);
    window_ = nullptr;
}

void VtkView::paint_without_gl(QPainter& painter) {
    const Palette& colors = current_palette();
    painter.fillRect(rect(), colors.panel);
    prepare_rendering(width(), height());
    painter.setPen(colors.dim);
    if (paint_actors(painter, *renderer_, size())) {
        painter.drawText(rect().adjusted(8, 6, -8, -6), Qt::AlignLeft | Qt::AlignBottom,
                         tr("drawn without OpenGL: %1").arg(gl_failure()));
    } else {
        painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                         tr("There is no picture here: %1.").arg(gl_failure()));
    }
    paint_overlay(painter);
}

}  // namespace ghostlight
