#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ghostlight {

/// Names of OpenGL objects, deleted with their owner: the context they were made in (or one that
/// shares with it) must be current then. No OpenGL header here, so that it gets in nobody's way.

class GlTexture {
   public:
    GlTexture() = default;
    GlTexture(GlTexture&& other) noexcept { *this = std::move(other); }
    GlTexture& operator=(GlTexture&& other) noexcept;
    ~GlTexture();

    unsigned name() const { return name_; }
    int width_px() const { return width_px_; }
    int height_px() const { return height_px_; }
    /// Fills it with floats, `channels` (1, 3 or 4) per pixel, first row at texture coordinate
    /// t = 0. Storage is kept while the size stays. Throws Error.
    void upload(int width_px, int height_px, int channels, const float* data);

   private:
    unsigned name_ = 0;
    int width_px_ = 0, height_px_ = 0, channels_ = 0;
};

class GlProgram {
   public:
    GlProgram() = default;
    /// Throws Error with the compiler's own words.
    GlProgram(const std::string& vertex_source, const std::string& fragment_source);
    /// A compute program. Throws Error like the other.
    explicit GlProgram(const std::string& compute_source);
    GlProgram(GlProgram&& other) noexcept { *this = std::move(other); }
    GlProgram& operator=(GlProgram&& other) noexcept;
    ~GlProgram();

    unsigned name() const { return name_; }
    int uniform(const char* uniform_name) const;

   private:
    void link(const unsigned* shaders, int count);

    unsigned name_ = 0;
};

class GlVertexArray {
   public:
    GlVertexArray() = default;
    GlVertexArray(GlVertexArray&& other) noexcept { *this = std::move(other); }
    GlVertexArray& operator=(GlVertexArray&& other) noexcept;
    ~GlVertexArray();

    void create();
    unsigned name() const { return name_; }

   private:
    unsigned name_ = 0;
};

/// Throws Error naming `doing` if OpenGL has an error pending.
void check_gl(const char* doing);

}  // namespace ghostlight
