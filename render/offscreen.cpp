#include "render/offscreen.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "render/gl_objects.h"

namespace ghostlight {

namespace {

[[noreturn]] void refuse(const char* step) {
    throw Error({.problem = "no OpenGL without a window here",
                 .file = {},
                 .where = step,
                 .found = "EGL error " + std::to_string(eglGetError()),
                 .expected = "EGL with surfaceless contexts"});
}

EGLDisplay initialized_display() {
    // Without a display server first; where that is not offered, whatever there is.
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        const EGLDisplay display =
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) {
            return display;
        }
    }
    const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        refuse("display");
    }
    return display;
}

}  // namespace

OffscreenContext::OffscreenContext() {
    if (!epoxy_has_egl()) {
        throw Error("no OpenGL without a window here: the system has no EGL library");
    }
    display_ = initialized_display();
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
        refuse("OpenGL");
    }
    constexpr std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                           EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) {
        refuse("configuration");
    }
    constexpr std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            2,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT) {
        refuse("context");
    }
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
        eglDestroyContext(display_, context_);
        refuse("make current");
    }
}

OffscreenContext::~OffscreenContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    // The display is the process's, and others may use it: it is not terminated.
}

OffscreenTarget::OffscreenTarget(int width_px, int height_px)
    : width_px_(width_px), height_px_(height_px) {
    glGenRenderbuffers(1, &color_);
    glBindRenderbuffer(GL_RENDERBUFFER, color_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_px, height_px);
    glGenFramebuffers(1, &framebuffer_);
    bind();
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    check_gl("making a framebuffer");
}

OffscreenTarget::~OffscreenTarget() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &color_);
}

void OffscreenTarget::bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

std::vector<std::uint8_t> OffscreenTarget::read() const {
    const std::size_t line = static_cast<std::size_t>(width_px_) * 4;
    std::vector<std::uint8_t> pixels(line * static_cast<std::size_t>(height_px_));
    bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    check_gl("reading a framebuffer");
    // OpenGL's first row is the lowest.
    for (std::size_t top = 0, bottom = static_cast<std::size_t>(height_px_) - 1; top < bottom;
         ++top, --bottom) {
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(top * line),
                         pixels.begin() + static_cast<std::ptrdiff_t>((top + 1) * line),
                         pixels.begin() + static_cast<std::ptrdiff_t>(bottom * line));
    }
    return pixels;
}

}  // namespace ghostlight
