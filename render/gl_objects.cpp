#include "render/gl_objects.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "core/error.h"

namespace ghostlight {

namespace {

std::string log_of(GLuint object, bool is_program) {
    std::array<char, 2048> text{};
    GLsizei length = 0;
    if (is_program) {
        glGetProgramInfoLog(object, static_cast<GLsizei>(text.size()), &length, text.data());
    } else {
        glGetShaderInfoLog(object, static_cast<GLsizei>(text.size()), &length, text.data());
    }
    std::string line(text.data(), static_cast<std::size_t>(length));
    while (!line.empty() && line.back() == '\n') {
        line.pop_back();
    }
    std::ranges::replace(line, '\n', ' ');  // an Error is one line
    return line;
}

GLuint compiled(GLenum kind, const std::string& source) {
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint done = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done != GL_TRUE) {
        const std::string log = log_of(shader, false);
        glDeleteShader(shader);
        throw Error({.problem = "OpenGL refused a shader",
                     .file = {},
                     .where = kind == GL_VERTEX_SHADER    ? "vertex shader"
                              : kind == GL_COMPUTE_SHADER ? "compute shader"
                                                          : "fragment shader",
                     .found = log,
                     .expected = {}});
    }
    return shader;
}

struct Format {
    GLint internal;
    GLenum external;
};

Format format_of(int channels) {
    switch (channels) {
        case 1:
            return {GL_R32F, GL_RED};
        case 3:
            return {GL_RGB32F, GL_RGB};
        default:
            return {GL_RGBA32F, GL_RGBA};
    }
}

}  // namespace

GlTexture& GlTexture::operator=(GlTexture&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(width_px_, other.width_px_);
    std::swap(height_px_, other.height_px_);
    std::swap(channels_, other.channels_);
    return *this;
}

GlTexture::~GlTexture() {
    if (name_ != 0) {
        glDeleteTextures(1, &name_);
    }
}

void GlTexture::upload(int width_px, int height_px, int channels, const float* data) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width_px <= 0 || height_px <= 0 || width_px > largest || height_px > largest) {
        throw Error({.problem = "the picture does not fit into a texture",
                     .file = {},
                     .where = {},
                     .found = std::to_string(width_px) + " x " + std::to_string(height_px) + " px",
                     .expected = "1 to " + std::to_string(largest) + " px a side"});
    }
    const bool same =
        name_ != 0 && width_px == width_px_ && height_px == height_px_ && channels == channels_;
    if (name_ == 0) {
        glGenTextures(1, &name_);
    }
    glBindTexture(GL_TEXTURE_2D, name_);
    // Others use this context too: rows here are tightly packed, whatever was set before.
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    const Format format = format_of(channels);
    if (same) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_px, height_px, format.external, GL_FLOAT,
                        data);
    } else {
        glTexImage2D(GL_TEXTURE_2D, 0, format.internal, width_px, height_px, 0, format.external,
                     GL_FLOAT, data);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    width_px_ = width_px;
    height_px_ = height_px;
    channels_ = channels;
    check_gl("uploading the picture");
}

GlProgram::GlProgram(const std::string& vertex_source, const std::string& fragment_source) {
    const GLuint vertex = compiled(GL_VERTEX_SHADER, vertex_source);
    GLuint fragment = 0;
    try {
        fragment = compiled(GL_FRAGMENT_SHADER, fragment_source);
    } catch (const Error&) {
        glDeleteShader(vertex);
        throw;
    }
    const GLuint shaders[] = {vertex, fragment};
    link(shaders, 2);
}

GlProgram::GlProgram(const std::string& compute_source) {
    const GLuint compute = compiled(GL_COMPUTE_SHADER, compute_source);
    link(&compute, 1);
}

void GlProgram::link(const unsigned* shaders, int count) {
    const GLuint program = glCreateProgram();
    for (int i = 0; i < count; ++i) glAttachShader(program, shaders[i]);
    glLinkProgram(program);
    for (int i = 0; i < count; ++i) glDeleteShader(shaders[i]);
    GLint done = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done != GL_TRUE) {
        const std::string log = log_of(program, true);
        glDeleteProgram(program);
        throw Error({.problem = "OpenGL refused to link a shader program",
                     .file = {},
                     .where = {},
                     .found = log,
                     .expected = {}});
    }
    name_ = program;
}

GlProgram& GlProgram::operator=(GlProgram&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

GlProgram::~GlProgram() {
    if (name_ != 0) {
        glDeleteProgram(name_);
    }
}

int GlProgram::uniform(const char* uniform_name) const {
    return glGetUniformLocation(name_, uniform_name);
}

GlVertexArray& GlVertexArray::operator=(GlVertexArray&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
}

GlVertexArray::~GlVertexArray() {
    if (name_ != 0) {
        glDeleteVertexArrays(1, &name_);
    }
}

void GlVertexArray::create() {
    if (name_ == 0) {
        glGenVertexArrays(1, &name_);
    }
}

void check_gl(const char* doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) {
        return;
    }
    while (glGetError() != GL_NO_ERROR) {
    }
    const char* what = error == GL_OUT_OF_MEMORY       ? "out of memory"
                       : error == GL_INVALID_OPERATION ? "invalid operation"
                       : error == GL_INVALID_VALUE     ? "invalid value"
                       : error == GL_INVALID_ENUM      ? "invalid enum"
                                                       : "error";
    throw Error({.problem = std::string("OpenGL failed while ") + doing,
                 .file = {},
                 .where = {},
                 .found = what,
                 .expected = {}});
}

}  // namespace ghostlight
