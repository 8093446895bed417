#include "render/gl/Texture.h"

#include "core/base/Check.h"
#include "render/gl/Uploads.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace patina::gl {

namespace {

GLenum target(TextureKind kind) {
    switch (kind) {
    case TextureKind::Flat:
        return GL_TEXTURE_2D;
    case TextureKind::Multisample:
        return GL_TEXTURE_2D_MULTISAMPLE;
    case TextureKind::Line:
        return GL_TEXTURE_1D;
    case TextureKind::Volume:
        return GL_TEXTURE_3D;
    }
    return GL_TEXTURE_2D;
}

GLenum internalFormat(PixelFormat format) {
    switch (format) {
    case PixelFormat::R8:
        return GL_R8;
    case PixelFormat::Rg8:
        return GL_RG8;
    case PixelFormat::Rgba8:
        return GL_RGBA8;
    case PixelFormat::Srgb8Alpha8:
        return GL_SRGB8_ALPHA8;
    case PixelFormat::R16:
        return GL_R16;
    case PixelFormat::Rg16:
        return GL_RG16;
    case PixelFormat::Rgba16:
        return GL_RGBA16;
    case PixelFormat::R32f:
        return GL_R32F;
    case PixelFormat::Rg32f:
        return GL_RG32F;
    case PixelFormat::Rgba32f:
        return GL_RGBA32F;
    case PixelFormat::Rgba16f:
        return GL_RGBA16F;
    case PixelFormat::R32ui:
        return GL_R32UI;
    case PixelFormat::Depth32f:
        return GL_DEPTH_COMPONENT32F;
    }
    return GL_RGBA8;
}

std::size_t sampleBytes(SampleType type) {
    switch (type) {
    case SampleType::U8:
        return 1;
    case SampleType::U16:
    case SampleType::F16:
        return 2;
    case SampleType::F32:
    case SampleType::U32:
        return 4;
    }
    return 4;
}

void countTexels(int width, int height, int depth, int channels, SampleType type) {
    countUpload(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                static_cast<std::size_t>(depth) * static_cast<std::size_t>(channels) *
                sampleBytes(type));
}

GLenum pixelLayout(PixelFormat format, int channels) {
    if (format == PixelFormat::R32ui)
        return GL_RED_INTEGER;
    if (format == PixelFormat::Depth32f)
        return GL_DEPTH_COMPONENT;
    constexpr std::array<GLenum, 4> kLayouts{GL_RED, GL_RG, GL_RGB, GL_RGBA};
    CHECK(channels >= 1 && channels <= 4);
    return kLayouts[static_cast<std::size_t>(channels - 1)];
}

GLenum componentType(SampleType type) {
    switch (type) {
    case SampleType::U8:
        return GL_UNSIGNED_BYTE;
    case SampleType::U16:
        return GL_UNSIGNED_SHORT;
    case SampleType::F16:
        return GL_HALF_FLOAT;
    case SampleType::F32:
        return GL_FLOAT;
    case SampleType::U32:
        return GL_UNSIGNED_INT;
    }
    return GL_UNSIGNED_BYTE;
}

std::size_t bytesPerTexel(PixelFormat format) {
    switch (format) {
    case PixelFormat::R8:
        return 1;
    case PixelFormat::Rg8:
    case PixelFormat::R16:
        return 2;
    case PixelFormat::Rgba8:
    case PixelFormat::Srgb8Alpha8:
    case PixelFormat::Rg16:
    case PixelFormat::R32f:
    case PixelFormat::R32ui:
    case PixelFormat::Depth32f:
        return 4;
    case PixelFormat::Rgba16:
    case PixelFormat::Rgba16f:
    case PixelFormat::Rg32f:
        return 8;
    case PixelFormat::Rgba32f:
        return 16;
    }
    return 16;
}

int fullChain(int width, int height) {
    int levels = 1;
    for (int side = std::max(width, height); side > 1; side /= 2)
        ++levels;
    return levels;
}

} // namespace

void deleteTexture(unsigned id) {
    glDeleteTextures(1, &id);
}

Texture::Texture(Context&, std::string_view label, const TextureSettings& settings)
    : m_settings(settings) {
    CHECK(settings.width > 0 && settings.height > 0);
    if (m_settings.levels == 0)
        m_settings.levels = fullChain(settings.width, settings.height);
    GLuint name = 0;
    glCreateTextures(target(settings.kind), 1, &name);
    m_handle = Handle<deleteTexture>(name);
    if (settings.kind == TextureKind::Multisample)
        glTextureStorage2DMultisample(name, settings.samples, internalFormat(settings.format),
                                      settings.width, settings.height, GL_TRUE);
    else if (settings.kind == TextureKind::Line)
        glTextureStorage1D(name, m_settings.levels, internalFormat(settings.format),
                           settings.width);
    else if (settings.kind == TextureKind::Volume)
        glTextureStorage3D(name, m_settings.levels, internalFormat(settings.format), settings.width,
                           settings.height, settings.depth);
    else
        glTextureStorage2D(name, m_settings.levels, internalFormat(settings.format), settings.width,
                           settings.height);
    m_counted = CountedBytes(GpuUse::Texture, memoryBytes());
    glObjectLabel(GL_TEXTURE, name, static_cast<GLsizei>(label.size()), label.data());
    if (settings.kind != TextureKind::Multisample)
        setSampling(Filter::Nearest, Wrap::Clamp);
}

std::size_t Texture::memoryBytes() const {
    if (empty())
        return 0;
    const std::size_t copies = m_settings.kind == TextureKind::Multisample
                                   ? static_cast<std::size_t>(m_settings.samples)
                                   : 1;
    std::size_t texels = 0;
    for (int level = 0; level < m_settings.levels; ++level) {
        const auto side = [&](int full) {
            return static_cast<std::size_t>(std::max(full >> level, 1));
        };
        texels += side(width()) * side(height()) * side(m_settings.depth);
    }
    return copies * texels * bytesPerTexel(m_settings.format);
}

void Texture::upload(int level, int channels, SampleType type, const void* data) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const GLenum layout = pixelLayout(m_settings.format, channels), sample = componentType(type);
    const int w = std::max(1, width() >> level), h = std::max(1, height() >> level);
    const bool volume = m_settings.kind == TextureKind::Volume;
    const int d = volume ? std::max(1, m_settings.depth >> level) : 1;
    countTexels(w, h, d, channels, type);
    if (m_settings.kind == TextureKind::Line) {
        glTextureSubImage1D(id(), level, 0, w, layout, sample, data);
    } else if (volume) {
        glTextureSubImage3D(id(), level, 0, 0, 0, w, h, d, layout, sample, data);
    } else {
        CHECK(m_settings.kind == TextureKind::Flat);
        glTextureSubImage2D(id(), level, 0, 0, w, h, layout, sample, data);
    }
}

void Texture::uploadRows(int level, int firstRow, int rows, int channels, SampleType type,
                         const void* data) {
    CHECK(m_settings.kind == TextureKind::Flat);
    CHECK(firstRow >= 0 && firstRow + rows <= std::max(1, height() >> level));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    countTexels(std::max(1, width() >> level), rows, 1, channels, type);
    glTextureSubImage2D(id(), level, 0, firstRow, std::max(1, width() >> level), rows,
                        pixelLayout(m_settings.format, channels), componentType(type), data);
}

void Texture::copyFrom(const Buffer& rgba) {
    CHECK(m_settings.kind == TextureKind::Flat);
    CHECK_EQ(rgba.size(), static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()) *
                              4 * sizeof(float));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, rgba.id());
    glTextureSubImage2D(id(), 0, 0, 0, width(), height(), GL_RGBA, GL_FLOAT, nullptr);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void Texture::generateMipmaps() {
    glGenerateTextureMipmap(id());
}

void Texture::setSampling(Filter filter, Wrap wrap) {
    const bool nearest = filter == Filter::Nearest;
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER,
                        nearest                       ? GL_NEAREST
                        : filter == Filter::Trilinear ? GL_LINEAR_MIPMAP_LINEAR
                                                      : GL_LINEAR);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S,
                        wrap == Wrap::Clamp ? GL_CLAMP_TO_EDGE : GL_REPEAT);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T,
                        wrap == Wrap::Repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_R,
                        wrap == Wrap::Repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

void Texture::setAnisotropy(float degree) {
    if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") &&
        !epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic"))
        return;
    float most = 1.0f;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glTextureParameterf(id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, std::clamp(degree, 1.0f, most));
}

void Texture::setSwizzle(const std::array<Swizzle, 4>& swizzle) {
    constexpr std::array<GLint, 6> kSources{GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA, GL_ZERO, GL_ONE};
    std::array<GLint, 4> sources{};
    for (std::size_t i = 0; i < 4; ++i)
        sources[i] = kSources[static_cast<std::size_t>(swizzle[i])];
    glTextureParameteriv(id(), GL_TEXTURE_SWIZZLE_RGBA, sources.data());
}

void Texture::bind(unsigned unit) const {
    glBindTextureUnit(unit, id());
}

std::vector<float> Texture::readFloats(int channels) const {
    CHECK(m_settings.kind == TextureKind::Flat);
    std::vector<float> result(static_cast<std::size_t>(width()) *
                              static_cast<std::size_t>(height()) *
                              static_cast<std::size_t>(channels));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(id(), 0, pixelLayout(m_settings.format, channels), GL_FLOAT,
                      static_cast<GLsizei>(result.size() * sizeof(float)), result.data());
    return result;
}

std::vector<std::uint8_t> Texture::readBytes(int channels) const {
    CHECK(m_settings.kind == TextureKind::Flat);
    std::vector<std::uint8_t> result(static_cast<std::size_t>(width()) *
                                     static_cast<std::size_t>(height()) *
                                     static_cast<std::size_t>(channels));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(id(), 0, pixelLayout(m_settings.format, channels), GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(result.size()), result.data());
    return result;
}

} // namespace patina::gl
