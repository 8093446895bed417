// Images as textures: one for each distinct image, kept while anyone in the document uses it.
#pragma once

#include "core/image/Image.h"
#include "render/gl/Texture.h"

#include <map>
#include <set>

namespace patina::render {

// A 2D texture with mipmaps that reads as linear RGBA: Srgb images are decoded by the sampler, one
// channel is grey, two are grey + alpha. Images larger than the driver's limit are reduced.
[[nodiscard]] gl::Texture makeTexture(gl::Context& context, const Image& image);

class TextureCache {
  public:
    explicit TextureCache(gl::Context& context)
        : m_context(context) {}

    // Uploads on first use. Images are immutable, so their address tells them apart.
    [[nodiscard]] const gl::Texture* texture(const ImagePtr& image);
    // Drops every texture whose image is not in `used`.
    void keepOnly(const std::set<ImagePtr>& used);
    [[nodiscard]] std::size_t size() const { return m_textures.size(); }

  private:
    gl::Context& m_context;
    std::map<ImagePtr, gl::Texture> m_textures; // holds the image: an address is never reused
};

} // namespace patina::render
