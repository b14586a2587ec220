#pragma once

#include <cstdint>
#include <vector>

namespace ghostlight {

/// An OpenGL context without a window or a display server, current on the thread that made it for
/// as long as it lives. For tests, benchmarks and pictures made by programs without a window.
/// Throws Error where there is none.
class OffscreenContext {
   public:
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

   private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

/// An 8-bit framebuffer to draw into and read back.
class OffscreenTarget {
   public:
    OffscreenTarget(int width_px, int height_px);
    ~OffscreenTarget();
    OffscreenTarget(const OffscreenTarget&) = delete;
    OffscreenTarget& operator=(const OffscreenTarget&) = delete;

    void bind() const;
    /// RGBA, row 0 at the top.
    std::vector<std::uint8_t> read() const;

   private:
    int width_px_, height_px_;
    unsigned framebuffer_ = 0, color_ = 0;
};

}  // namespace ghostlight
