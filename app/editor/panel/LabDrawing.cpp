#include "app/editor/panel/LabDrawing.h"

#include "core/document/ViewChoices.h"
#include "core/image/ColorMap.h"
#include "core/job/Parallel.h"
#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/DfgTable.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentMapping.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <numbers>

namespace patina::editor {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kToneSteps = 4096; // over the square root of light: even to the eye
// Light below zero is none: shown in a colour that no light around has.
const glm::vec3 kNegative(1.0f, 0.0f, 0.75f);

EnvironmentMapping crossOf(int width, int height) {
    return EnvironmentMapping::create(EnvironmentLayout::HorizontalCross, {width, height}).value();
}

// As many texels as a picture of this width can show.
CubeLevel fittingLevel(const CubeLevel& level, int width) {
    CubeLevel fitting = level;
    while (fitting.size >= 2 * std::max(1, width / 4))
        fitting = halveCube(fitting);
    return fitting;
}

} // namespace

// --- Exposure and tone curve ---------------------------------------------------------------------

LabTone::LabTone(const View& view, const Luminance& luminance, float offsetEv)
    : m_view(view)
    , m_luminance(luminance)
    , m_encoded(kToneSteps) {
    if (m_view.toneMap == ToneMap::OpenColorIo)
        m_view.toneMap = View().toneMap;
    m_scale = exposureScale(m_view, luminance) * std::exp2(offsetEv);
    for (int i = 0; i < kToneSteps; ++i) {
        const float root = static_cast<float>(i) / (kToneSteps - 1);
        const float shown =
            shading::displayEncode(glm::vec3(root * root), static_cast<int>(m_view.displayTransfer),
                                   m_view.displayGamma)
                .x;
        m_encoded[static_cast<std::size_t>(i)] =
            static_cast<unsigned char>(std::lround(255.0f * std::clamp(shown, 0.0f, 1.0f)));
    }
}

QRgb LabTone::pixel(const glm::vec3& radiance) const {
    glm::vec3 c = m_scale * radiance;
    const float below = -std::min({c.x, c.y, c.z, 0.0f});
    c = glm::max(c, 0.0f) + below * kNegative;
    const glm::vec3 shown = shading::toneMap(c, toneCurve(m_view, m_luminance));
    const auto encoded = [&](float value) {
        return m_encoded[static_cast<std::size_t>(
            std::sqrt(std::clamp(value, 0.0f, 1.0f)) * (kToneSteps - 1) + 0.5f)];
    };
    return qRgb(encoded(shown.x), encoded(shown.y), encoded(shown.z));
}

// --- Pictures ------------------------------------------------------------------------------------

namespace {

// Lights a picture row by row; x and y are its pixels. Directions are those of the environment.
using PixelRadiance = std::function<glm::vec3(int x, int y, const glm::vec3& direction)>;

// From one lat-long to another that is turned: straight from pixel to pixel, without angles.
PixelRadiance latLongRadiance(const ImagePtr& image, const QSize& size, float rotationDeg) {
    struct Tap {
        int first, second;
        float share;
    };
    const auto tap = [](float at, int count, bool wraps) {
        const float texel = at * static_cast<float>(count) - 0.5f;
        const auto first = static_cast<int>(std::floor(texel));
        const float share = texel - static_cast<float>(first);
        const auto index = [&](int i) {
            return wraps ? (i % count + count) % count : std::clamp(i, 0, count - 1);
        };
        return Tap{index(first), index(first + 1), share};
    };
    std::vector<Tap> columns, rows;
    for (int x = 0; x < size.width(); ++x)
        columns.push_back(tap((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width()) +
                                  rotationDeg / 360.0f,
                              image->width(), true));
    for (int y = 0; y < size.height(); ++y)
        rows.push_back(tap((static_cast<float>(y) + 0.5f) / static_cast<float>(size.height()),
                           image->height(), false));
    return [image, columns, rows](int x, int y, const glm::vec3&) {
        const Tap &c = columns[static_cast<std::size_t>(x)], &r = rows[static_cast<std::size_t>(y)];
        const auto at = [&](int column, int row) {
            const float* texel =
                image->f32().data() +
                static_cast<std::ptrdiff_t>(row * image->width() + column) * image->channels();
            return glm::vec3(texel[0], texel[1], texel[2]);
        };
        return glm::mix(glm::mix(at(c.first, r.first), at(c.second, r.first), c.share),
                        glm::mix(at(c.first, r.second), at(c.second, r.second), c.share), r.share);
    };
}

// The same of one that is tilted or rolled: by direction.
PixelRadiance lookedUp(const ImagePtr& image) {
    const EnvironmentMapping mapping =
        EnvironmentMapping::create(EnvironmentLayout::LatLong, {image->width(), image->height()})
            .value();
    return [image, mapping](int, int, const glm::vec3& d) { return mapping.lookup(*image, d); };
}

// Many texels become one pixel: something of about the picture's size stands in for them.
PixelRadiance pixelRadiance(const LabLight& light, LabView view, const QSize& size) {
    const EnvironmentLookup& lookup = light.lookup;
    const auto latLong = [&](const ImagePtr& image) {
        return lookup.orientation.isLevel()
                   ? latLongRadiance(image, size, lookup.orientation.rotationDeg)
                   : lookedUp(image);
    };
    if (view.kind == LabKind::Harmonics)
        return latLong(light.reductions->sums[static_cast<std::size_t>(view.index - 1)]);
    if (view.kind == LabKind::Environment) {
        ImagePtr image = lookup.analysis->environment;
        for (const ImagePtr& reduced : light.reductions->environment)
            if (reduced->width() >= size.width())
                image = reduced;
        return latLong(image);
    }
    if (view.kind == LabKind::Irradiance)
        return [maps = lookup.maps](int, int, const glm::vec3& d) {
            return shading::irradianceFromSh9(maps->irradianceSh.data(), d) / kPi;
        };
    const int around = (view.isFace() ? 4 : 1) * size.width();
    const std::vector<CubeLevel>& prefiltered = lookup.maps->prefiltered;
    LevelPair levels;                          // the first, of faces
    if (view.kind == LabKind::IrradianceExact) // over pi it is the last level as it is
        levels = {prefiltered.size() - 1, prefiltered.size() - 1, 0.0f};
    else if (view.kind == LabKind::Prefiltered)
        levels = levelsOf(*lookup.maps, roughnessStep(view.index));
    return [share = levels.share, first = fittingLevel(prefiltered[levels.first], around),
            second = fittingLevel(prefiltered[levels.second], around)](
               int, int, const glm::vec3& d) { return sampleCubes(first, second, share, d); };
}

// Unit vectors to the pixels of a lat-long that is turned.
class LatLongDirections {
  public:
    LatLongDirections(const QSize& size, float rotationDeg) {
        for (int x = 0; x < size.width(); ++x) {
            const float phi =
                2.0f * kPi *
                    ((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width()) - 0.5f) +
                glm::radians(rotationDeg);
            m_columns.emplace_back(std::sin(phi), std::cos(phi));
        }
        for (int y = 0; y < size.height(); ++y) {
            const float theta =
                kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height());
            m_rows.emplace_back(std::sin(theta), std::cos(theta));
        }
    }
    [[nodiscard]] glm::vec3 at(int x, int y) const {
        const glm::vec2 &c = m_columns[static_cast<std::size_t>(x)],
                        &r = m_rows[static_cast<std::size_t>(y)];
        return {r.x * c.x, r.y, -r.x * c.y};
    }

  private:
    std::vector<glm::vec2> m_columns, m_rows; // sine and cosine
};

} // namespace

QImage labPicture(const LabLight& light, LabView view, const QSize& size, const LabTone& tone,
                  const JobContext& job) {
    if (view.isTable() || size.isEmpty() || !light.value(view, {0.0f, 1.0f, 0.0f}))
        return {};
    const PixelRadiance radiance = pixelRadiance(light, view, size);
    const Orientation& stands = light.lookup.orientation;
    const LatLongDirections directions(size, stands.isLevel() ? stands.rotationDeg : 0.0f);
    const glm::mat3 toPicture = glm::transpose(glm::mat3(stands.matrix()));
    const glm::vec3 scale = light.lookup.tint * light.lookup.scale;
    // A face alone is a piece of a cross.
    std::optional<EnvironmentMapping> cross;
    glm::vec2 corner(0.5f);
    if (view.isCross())
        cross = crossOf(size.width(), size.height());
    if (view.isFace()) {
        const int side = size.width();
        cross = crossOf(4 * side, 3 * side);
        corner += static_cast<float>(side) *
                  glm::vec2(labFace(view.index).column, labFace(view.index).row);
    }

    QImage picture(size, QImage::Format_ARGB32_Premultiplied);
    picture.fill(Qt::transparent);
    // Through the bits: scanLine() would detach on several threads.
    auto* pixels = reinterpret_cast<QRgb*>(picture.bits());
    const auto stride = static_cast<std::size_t>(picture.bytesPerLine()) / sizeof(QRgb);
    const auto paintRow = [&](int y) {
        for (int x = 0; x < size.width(); ++x) {
            glm::vec3 direction = directions.at(x, y);
            if (!stands.isLevel())
                direction = toPicture * direction;
            if (cross) {
                const auto ray = cross->ray(corner + glm::vec2(x, y));
                if (!ray)
                    continue; // beside a face
                direction = toPicture * ray->direction;
            }
            pixels[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] =
                tone.pixel(scale * radiance(x, y, direction));
        }
    };
    parallelFor(job, static_cast<std::size_t>(size.height()), 16,
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t y = begin; y < end; ++y)
                        paintRow(static_cast<int>(y));
                });
    return job.cancelled() ? QImage() : picture;
}

// --- DFG table -----------------------------------------------------------------------------------

LabDfg computeLabDfg(Distribution distribution, Visibility visibility) {
    LabDfg dfg;
    dfg.table = computeDfgTable(128, distribution, iblVisibility(visibility));
    const int size = dfg.table.width();
    for (int channel = 0; channel < 3; ++channel) {
        float largest = 0.0f;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                largest = std::max(largest, dfg.table.sample(x, y, channel));
        // Shares of light are seen against all of it; a tilt above 1 leads beyond the mirror.
        const float top = std::max(1.0f, largest);
        dfg.range[static_cast<std::size_t>(channel)] = {0.0f, top};
        QImage picture(size, size, QImage::Format_RGB32);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const glm::vec3 color =
                    255.0f * mapColor(ColorMap::Sequential, dfg.table.sample(x, y, channel) / top);
                picture.setPixel(x, size - 1 - y,
                                 qRgb(static_cast<int>(std::lround(color.x)),
                                      static_cast<int>(std::lround(color.y)),
                                      static_cast<int>(std::lround(color.z))));
            }
        dfg.pictures[static_cast<std::size_t>(channel)] = picture;
    }
    return dfg;
}

} // namespace patina::editor
