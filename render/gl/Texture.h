// A texture of fixed format and size, with its sampling settings.
#pragma once

#include "render/gl/Buffer.h"
#include "render/gl/Context.h"
#include "render/gl/GpuMemory.h"
#include "render/gl/Handle.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace patina::gl {

enum class PixelFormat {
    R8,
    Rg8,
    Rgba8,
    Srgb8Alpha8,
    R16,
    Rg16,
    Rgba16,
    R32f,
    Rg32f,
    Rgba32f,
    Rgba16f,
    R32ui,
    Depth32f
};

enum class TextureKind { Flat, Multisample, Line, Volume };

// How the numbers handed to upload() are laid out: interleaved, rows without padding.
enum class SampleType { U8, U16, F16, F32, U32 };

struct TextureSettings {
    TextureKind kind = TextureKind::Flat;
    PixelFormat format = PixelFormat::Rgba8;
    int width = 0, height = 0; // Line: the height is 1
    int depth = 1;             // Volume
    int levels = 1;            // 0: a full mipmap chain
    int samples = 1;           // Multisample
};

enum class Filter { Nearest, Linear, Trilinear };
enum class Wrap { Repeat, Clamp, RepeatU }; // RepeatU: u repeats, v is clamped (lat-long)

// What shader components r, g, b, a read: a source channel or a constant.
enum class Swizzle { Red, Green, Blue, Alpha, Zero, One };

void deleteTexture(unsigned id);

class Texture {
  public:
    Texture() = default; // empty: id 0, no context needed
    Texture(Context& context, std::string_view label, const TextureSettings& settings);

    [[nodiscard]] unsigned id() const { return m_handle.id(); }
    [[nodiscard]] bool empty() const { return id() == 0; }
    [[nodiscard]] int width() const { return m_settings.width; }
    [[nodiscard]] int height() const { return m_settings.height; }
    [[nodiscard]] int levels() const { return m_settings.levels; } // never 0 once created
    [[nodiscard]] const TextureSettings& settings() const { return m_settings; }
    [[nodiscard]] std::size_t memoryBytes() const; // of all texels; drivers may round up

    // Fills a level; `data` holds width × height × channels samples. Volume: slice by slice.
    void upload(int level, int channels, SampleType type, const void* data);
    // Rows of a level, `data` as above. Flat only.
    void uploadRows(int level, int firstRow, int rows, int channels, SampleType type,
                    const void* data);
    // All of level 0 from a buffer of RGBA floats, rows as above; nothing leaves the GPU. Flat
    // only.
    void copyFrom(const Buffer& rgba);
    void generateMipmaps();

    void setSampling(Filter filter, Wrap wrap);
    void setAnisotropy(float degree); // ignored where the driver has none
    void setSwizzle(const std::array<Swizzle, 4>& swizzle);

    void bind(unsigned unit) const;

    // Level 0 as interleaved samples, rows bottom to top as OpenGL stores them. Flat only.
    [[nodiscard]] std::vector<float> readFloats(int channels) const;
    [[nodiscard]] std::vector<std::uint8_t> readBytes(int channels) const;

  private:
    Handle<deleteTexture> m_handle;
    TextureSettings m_settings;
    CountedBytes m_counted;
};

} // namespace patina::gl
