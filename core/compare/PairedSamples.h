// The samples of two images side by side, with grey, colour and alpha brought to one layout.
// Seen by this module only.
#pragma once

#include "core/image/Image.h"

#include <algorithm>

namespace patina::compare {

class PairedSamples {
  public:
    PairedSamples(const Image& image, const Image& reference)
        : m_image(image)
        , m_reference(reference)
        , m_stored(image.encoding() == reference.encoding()) {
        const int most = std::max(image.channels(), reference.channels());
        m_raw = most > 4;
        m_alpha = !m_raw && (hasAlpha(image) || hasAlpha(reference));
        m_colors = m_raw ? most : (most <= 2 ? 1 : 3);
    }

    [[nodiscard]] int channels() const { return m_colors + (m_alpha ? 1 : 0); }
    [[nodiscard]] double image(int x, int y, int channel) const {
        return at(m_image, x, y, channel);
    }
    [[nodiscard]] double reference(int x, int y, int channel) const {
        return at(m_reference, x, y, channel);
    }

  private:
    static bool hasAlpha(const Image& image) {
        return image.channels() == 2 || image.channels() == 4;
    }

    [[nodiscard]] double at(const Image& image, int x, int y, int channel) const {
        if (m_raw)
            return image.sample(x, y, channel);
        const bool alpha = channel == m_colors;
        if (!m_stored)
            return image.linear(x, y)[alpha ? 3 : channel];
        if (alpha)
            return hasAlpha(image) ? image.sample(x, y, image.channels() - 1) : 1.0;
        return image.sample(x, y, image.channels() <= 2 ? 0 : channel);
    }

    const Image& m_image;
    const Image& m_reference;
    bool m_stored, m_raw = false, m_alpha = false;
    int m_colors = 3;
};

} // namespace patina::compare
