// Text in images: captions of contact sheets. The only file that sees FreeType and fontconfig.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"

#include <glm/vec3.hpp>
#include <memory>
#include <string_view>

namespace patina {

class TextRaster {
  public:
    // The system's sans-serif font. Error InputMissing when there is none, saying what to install.
    static Result<TextRaster> create();
    TextRaster(TextRaster&&) noexcept;
    TextRaster& operator=(TextRaster&&) noexcept;
    ~TextRaster();

    // Width in pixels of a line of UTF-8 at this size (pixels per em). Characters that the font
    // lacks take the width of its replacement.
    [[nodiscard]] int width(std::string_view text, int size) const;
    // Blends a line into 8-bit RGB(A), beginning at `x` with its baseline at `y`; what lies outside
    // is cut off. `color`: display values 0…1.
    void draw(Image& image, int x, int y, int size, const glm::vec3& color,
              std::string_view text) const;

  private:
    struct Face;
    explicit TextRaster(std::unique_ptr<Face> face);
    std::unique_ptr<Face> m_face;
};

} // namespace patina
