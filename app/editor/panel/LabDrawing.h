// The Light lab's pictures: radiance by direction under the document's exposure and tone curve, and
// the channels of the DFG table as colours.
#pragma once

#include "app/editor/panel/LabLight.h"
#include "core/document/ToneResponse.h"
#include "core/document/View.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/material/ShadingModel.h"

#include <QImage>
#include <QSize>
#include <array>
#include <vector>

namespace patina::editor {

// How radiance becomes pixels: the document's exposure and tone curve.
class LabTone {
  public:
    // OpenColorIO, which only graphics cards run, is replaced by the default curve.
    LabTone(const View& view, const Luminance& luminance, float offsetEv);
    [[nodiscard]] QRgb pixel(const glm::vec3& radiance) const; // negative parts are magenta

  private:
    View m_view;
    Luminance m_luminance;
    float m_scale;
    std::vector<unsigned char> m_encoded; // by the square root of display-linear light
};

// A picture of `view`, `size` device pixels; null while there is nothing to show or after a cancel.
// Irradiance is shown over pi: as the radiance of a white surface.
[[nodiscard]] QImage labPicture(const LabLight& light, LabView view, const QSize& size,
                                const LabTone& tone, const JobContext& job);

// The DFG table of a model with its channels as pictures, roughness growing upwards.
struct LabDfg {
    Image table;                    // looked up with lookUpDfg()
    std::array<glm::vec2, 3> range; // of each channel's colours
    std::array<QImage, 3> pictures;
};
[[nodiscard]] LabDfg computeLabDfg(Distribution distribution, Visibility visibility);

} // namespace patina::editor
