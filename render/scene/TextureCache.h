// What materials show as textures: one for each distinct content, alive while anyone holds it.
#pragma once

#include "core/image/Image.h"
#include "render/gl/Texture.h"
#include "render/scene/MapFetches.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace patina::render {

using TexturePtr = std::shared_ptr<const gl::Texture>;

// A 2D texture with mipmaps that reads as linear RGBA: Srgb images are decoded by the sampler, one
// channel is grey, two are grey + alpha. Images larger than the driver's limit are reduced.
[[nodiscard]] gl::Texture makeTexture(gl::Context& context, const Image& image);
// The same of TexelSource::packed: each channel reads as it does in the texture of its own image.
[[nodiscard]] gl::Texture makePackedTexture(gl::Context& context,
                                            const std::vector<ImageChannel>& channels);

class TextureCache {
  public:
    explicit TextureCache(gl::Context& context)
        : m_context(context) {}

    // Uploads unless there is such a texture already. Images are immutable, so their address tells
    // them apart.
    [[nodiscard]] TexturePtr texture(const TexelSource& source);
    [[nodiscard]] TexturePtr texture(const ImagePtr& image) {
        return texture(TexelSource{image, {}});
    }
    [[nodiscard]] std::size_t size() const; // textures that somebody holds

  private:
    // A texture holds the images it was made of: their addresses are not used again before.
    struct Entry {
        TexelSource source;
        gl::Texture texture;
    };
    // Channels of images; -1: all of them.
    using Key = std::vector<std::pair<const Image*, int>>;
    [[nodiscard]] static Key keyOf(const TexelSource& source);

    gl::Context& m_context;
    std::map<Key, std::weak_ptr<const Entry>> m_entries;
};

} // namespace patina::render
