#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ghostlight {

/// A buffer on the graphics card. Storage grows and is kept.
class GlBuffer {
   public:
    GlBuffer() = default;
    GlBuffer(GlBuffer&& other) noexcept { *this = std::move(other); }
    GlBuffer& operator=(GlBuffer&& other) noexcept;
    ~GlBuffer();

    unsigned name() const { return name_; }
    /// Room for so many bytes, whatever is in them. Throws Error.
    void reserve(std::size_t bytes);
    /// Throws Error.
    void upload(const void* data, std::size_t bytes);
    template <class T>
    void upload(const std::vector<T>& values) {
        upload(values.data(), values.size() * sizeof(T));
    }
    void bind_uniform(unsigned index) const;
    void bind_storage(unsigned index) const;

   private:
    unsigned name_ = 0;
    std::size_t bytes_ = 0;
};

/// A picture of 4 floats a pixel that can be drawn into and sampled.
class GlFloatTarget {
   public:
    GlFloatTarget() = default;
    GlFloatTarget(GlFloatTarget&& other) noexcept { *this = std::move(other); }
    GlFloatTarget& operator=(GlFloatTarget&& other) noexcept;
    ~GlFloatTarget();

    /// Throws Error.
    void resize(int width_px, int height_px);
    /// Draws go here from now on, to all of it.
    void bind() const;
    unsigned texture() const { return texture_; }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    /// 4 a pixel, row 0 first.
    std::vector<float> read() const;

   private:
    unsigned framebuffer_ = 0, texture_ = 0;
    int width_px_ = 0, height_px_ = 0;
};

}  // namespace ghostlight
