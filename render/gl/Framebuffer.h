// What is drawn into: colour and depth textures. The textures must outlive it.
#pragma once

#include "core/base/Result.h"
#include "render/gl/Texture.h"

#include <initializer_list>

namespace patina::gl {

void deleteFramebuffer(unsigned id);

class Framebuffer {
  public:
    Framebuffer() = default; // empty: id 0 (the window's), no context needed
    // `depth` may be null. Error Internal when the driver refuses the combination.
    static Result<Framebuffer> create(Context& context, std::string_view label,
                                      std::initializer_list<const Texture*> colors,
                                      const Texture* depth);

    [[nodiscard]] unsigned id() const { return m_handle.id(); }
    [[nodiscard]] bool empty() const { return id() == 0; }

    void bind() const; // for drawing, with the viewport set to the whole of it
    void clearColor(float r, float g, float b, float a) const;
    void clearIds(unsigned value) const; // colour attachment of format R32ui
    void clearDepth(float depth) const;
    // Resolves or copies colour and depth into a framebuffer of the same size.
    void resolveTo(const Framebuffer& target, bool withDepth) const;

  private:
    Handle<deleteFramebuffer> m_handle;
    int m_width = 0, m_height = 0;
};

} // namespace patina::gl
