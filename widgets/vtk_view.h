#pragma once

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "widgets/gl_view.h"

class vtkGenericOpenGLRenderWindow;
class vtkRenderer;

namespace ghostlight {

/// A view whose content is a VTK renderer. VTK draws into framebuffers of its own and copies the
/// result into the widget's; Qt's window, context and events stay Qt's. Without OpenGL the same
/// actors are painted by QPainter.
class VtkView : public GlView {
    Q_OBJECT
   public:
    explicit VtkView(QWidget* parent = nullptr);
    ~VtkView() override;

    vtkRenderer* renderer() { return renderer_; }

   protected:
    /// Called before each rendering, with the size in device pixels. Sets up the camera: there may
    /// be no render window.
    virtual void prepare_rendering(int width_px, int height_px) = 0;

    void init_gl() override;
    void paint_gl(unsigned framebuffer, int width_px, int height_px) override;
    void release_gl() override;
    void paint_without_gl(QPainter& painter) override;

   private:
    vtkNew<vtkRenderer> renderer_;
    /// One per context: VTK keeps what it has found out about a context for good.
    vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace ghostlight
