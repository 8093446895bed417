// What the Light lab shows: the environment and everything computed from it for shading, as
// functions of the direction in the world. A value; what is heavy is shared.
#pragma once

#include "core/document/ToneResponse.h"
#include "core/light/Ibl.h"
#include "core/light/ShBands.h"

#include <QImage>
#include <QSize>
#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

enum class LabKind {
    Environment,
    Faces,           // of the cubemap that reflections start from; `index` 1…6: one of them alone
    Irradiance,      // from nine coefficients, as surfaces take it
    IrradianceExact, // the last prefiltered level is irradiance / pi
    Harmonics,       // the sum of `index` bands, 1…8
    Prefiltered,     // roughness `index` of kLabLevels, from 0
    Dfg              // channel `index` of the table: scale, bias, mean direction
};

// Roughnesses that are shown, in equal steps from 0 to 1: looked up between the levels of the maps,
// as by the shader.
inline constexpr int kLabLevels = 7;
[[nodiscard]] inline float labRoughness(int level) { // perceptual
    return static_cast<float>(level) / static_cast<float>(kLabLevels - 1);
}

struct LabView {
    LabKind kind = LabKind::Environment;
    int index = 0;
    friend bool operator==(const LabView&, const LabView&) = default;

    [[nodiscard]] bool isCross() const { return kind == LabKind::Faces && index == 0; }
    [[nodiscard]] bool isFace() const { return kind == LabKind::Faces && index > 0; }
    [[nodiscard]] bool isTable() const { return kind == LabKind::Dfg; }
    [[nodiscard]] bool isIrradiance() const {
        return kind == LabKind::Irradiance || kind == LabKind::IrradianceExact;
    }
};

// One of the faces +X -X +Y -Y +Z -Z, 1…6: its name, and its column and row in a cross.
struct LabFace {
    const char* name; // UTF-8
    int column, row;
};
[[nodiscard]] const LabFace& labFace(int index);

// Derived from one environment image.
struct LabAnalysis {
    ImagePtr environment;           // finite
    std::size_t invalidSamples = 0; // samples of the image that were not, or were negative
    std::vector<ImagePtr> reduced;  // finest first, for pictures of any size
    ShBands bands;
    std::array<ImagePtr, kMaxShOrder> sums; // of 1…8 bands, small lat-longs
};
using LabAnalysisPtr = std::shared_ptr<const LabAnalysis>;

// `environment`: of a document. Null after a cancel.
[[nodiscard]] LabAnalysisPtr analyseLight(const ImagePtr& environment, const JobContext& job);

struct LabLight {
    LabAnalysisPtr analysis;             // null: not there yet
    std::shared_ptr<const IblMaps> maps; // null: not there yet
    float rotationDeg = 0.0f;            // of the environment
    float scale = 1.0f;                  // of all radiance: the environment's exposure
    glm::vec3 tint{1.0f};                // and its colour in the mix

    void setScale(const glm::vec3& all);

    // Radiance (irradiance for the irradiance maps) that the scene gets from a direction of the
    // world; nothing while it is not computed. Not of the DFG table.
    [[nodiscard]] std::optional<glm::vec3> value(LabView view, const glm::vec3& direction) const;

    // Root mean square over the sphere of the difference between both irradiances, as a share of
    // the exact one's root mean square.
    [[nodiscard]] static double irradianceError(const IblMaps& maps);
};

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
    Image table;
    std::array<glm::vec2, 3> range; // of each channel's colours
    std::array<QImage, 3> pictures;

    // Bilinear, as the shader looks it up; N·V and perceptual roughness 0…1.
    [[nodiscard]] glm::vec3 value(float NoV, float perceptualRoughness) const;
};
[[nodiscard]] LabDfg computeLabDfg(Distribution distribution, Visibility visibility);

} // namespace patina::editor
