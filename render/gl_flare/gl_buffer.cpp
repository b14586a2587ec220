#include "render/gl_flare/gl_buffer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "core/error.h"
#include "render/gl_objects.h"

namespace ghostlight {

GlBuffer& GlBuffer::operator=(GlBuffer&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

GlBuffer::~GlBuffer() {
    if (name_ != 0) glDeleteBuffers(1, &name_);
}

void GlBuffer::reserve(std::size_t bytes) {
    constexpr std::size_t least = 256;  // an empty buffer cannot be bound
    if (name_ == 0) glGenBuffers(1, &name_);
    if (bytes_ != 0 && bytes <= bytes_) return;
    bytes_ = std::max(least, bytes + bytes / 4);
    glBindBuffer(GL_COPY_WRITE_BUFFER, name_);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes_), nullptr, GL_STREAM_DRAW);
    check_gl("making room on the graphics card");
}

void GlBuffer::upload(const void* data, std::size_t bytes) {
    reserve(bytes);
    if (bytes == 0) return;
    glBindBuffer(GL_COPY_WRITE_BUFFER, name_);
    glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
}

void GlBuffer::bind_uniform(unsigned index) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, index, name_);
}
void GlBuffer::bind_storage(unsigned index) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, index, name_);
}

GlFloatTarget& GlFloatTarget::operator=(GlFloatTarget&& other) noexcept {
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(texture_, other.texture_);
    std::swap(width_px_, other.width_px_);
    std::swap(height_px_, other.height_px_);
    return *this;
}

GlFloatTarget::~GlFloatTarget() {
    if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
    if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void GlFloatTarget::resize(int width_px, int height_px) {
    if (texture_ != 0 && width_px == width_px_ && height_px == height_px_) return;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width_px <= 0 || height_px <= 0 || width_px > largest || height_px > largest)
        throw Error({.problem = "the picture does not fit into a texture",
                     .file = {},
                     .where = {},
                     .found = std::to_string(width_px) + " x " + std::to_string(height_px) + " px",
                     .expected = "1 to " + std::to_string(largest) + " px a side"});
    if (texture_ == 0) glGenTextures(1, &texture_);
    if (framebuffer_ == 0) glGenFramebuffers(1, &framebuffer_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width_px, height_px, 0, GL_RGBA, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("OpenGL cannot draw into pictures of floats here");
    check_gl("making a picture of floats");
    width_px_ = width_px;
    height_px_ = height_px;
}

void GlFloatTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, width_px_, height_px_);
}

std::vector<float> GlFloatTarget::read() const {
    std::vector<float> values(4 * static_cast<std::size_t>(width_px_) *
                              static_cast<std::size_t>(height_px_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glPixelStorei(GL_PACK_SKIP_ROWS, 0);
    glPixelStorei(GL_PACK_SKIP_PIXELS, 0);
    glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_FLOAT, values.data());
    check_gl("reading a picture of floats");
    return values;
}

}  // namespace ghostlight
