#include "app/editor/panel/LabLight.h"

#include "core/base/Check.h"
#include "core/image/ColorMap.h"
#include "core/job/Parallel.h"
#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentMapping.h"
#include "core/light/EnvironmentResample.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace patina::editor {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kSumHeight = 64; // eight bands have nothing finer
constexpr int kReducedWidths[] = {1024, 512, 256};
constexpr int kToneSteps = 4096; // over the square root of light: even to the eye
// Light below zero is none: shown in a colour that no light around has.
const glm::vec3 kNegative(1.0f, 0.0f, 0.75f);

EnvironmentMapping mapping(EnvironmentLayout layout, int width, int height) {
    return EnvironmentMapping::create(layout, {width, height}).value();
}

glm::vec3 lookUp(const Image& latLong, const glm::vec3& direction) {
    return mapping(EnvironmentLayout::LatLong, latLong.width(), latLong.height())
        .lookup(latLong, direction);
}

LevelPair levelsOf(LabView view, const IblMaps& maps) {
    return view.kind == LabKind::Faces ? LevelPair()
                                       : patina::levelsOf(maps, labRoughness(view.index));
}

glm::vec3 samplePair(const CubeLevel& first, const CubeLevel& second, float share,
                     const glm::vec3& direction) {
    const glm::vec3 value = sampleCube(first, direction);
    return share > 0.0f ? glm::mix(value, sampleCube(second, direction), share) : value;
}

// As many texels as a picture of this width can show.
CubeLevel fittingLevel(const CubeLevel& level, int width) {
    CubeLevel fitting = level;
    while (fitting.size >= 2 * std::max(1, width / 4))
        fitting = halveCube(fitting);
    return fitting;
}

} // namespace

const LabFace& labFace(int index) {
    static constexpr LabFace kFaces[] = {{"+X", 2, 1}, {"−X", 0, 1}, {"+Y", 1, 0},
                                         {"−Y", 1, 2}, {"+Z", 3, 1}, {"−Z", 1, 1}};
    CHECK(index >= 1 && index <= 6);
    return kFaces[index - 1];
}

LabAnalysisPtr analyseLight(const ImagePtr& environment, const JobContext& job) {
    auto analysis = std::make_shared<LabAnalysis>();
    analysis->environment = environment;
    const std::span<const float> samples = environment->f32();
    if (std::any_of(samples.begin(), samples.end(),
                    [](float v) { return !(v >= 0.0f) || !std::isfinite(v); })) {
        auto repaired = std::make_shared<Image>(*environment);
        analysis->invalidSamples = sanitizeHdr(*repaired);
        analysis->environment = std::move(repaired);
    }
    for (const int width : kReducedWidths) {
        const ImagePtr& from =
            analysis->reduced.empty() ? analysis->environment : analysis->reduced.back();
        if (job.cancelled())
            return nullptr;
        analysis->reduced.push_back(std::make_shared<const Image>(shrinkLatLong(*from, width)));
    }
    analysis->bands = computeShBands(*analysis->environment, job);
    for (int n = 1; n <= kMaxShOrder; ++n)
        analysis->sums[static_cast<std::size_t>(n - 1)] = std::make_shared<const Image>(
            shLatLong(analysis->bands.coefficients, n, kSumHeight, job));
    if (job.cancelled())
        return nullptr;
    return analysis;
}

void LabLight::setScale(const glm::vec3& all) {
    scale = std::max({all.x, all.y, all.z});
    tint = scale > 0.0f ? all / scale : glm::vec3(1.0f);
}

std::optional<glm::vec3> LabLight::value(LabView view, const glm::vec3& world) const {
    const glm::vec3 d = shading::rotateY(world, -glm::radians(rotationDeg));
    switch (view.kind) {
    case LabKind::Environment:
        if (!analysis)
            return std::nullopt;
        return tint * scale * lookUp(*analysis->environment, d);
    case LabKind::Harmonics:
        if (!analysis)
            return std::nullopt;
        return tint * scale * shSum(analysis->bands.coefficients, view.index, d);
    case LabKind::Irradiance:
        if (!maps)
            return std::nullopt;
        return tint * scale * shading::irradianceFromSh9(maps->irradianceSh.data(), d);
    case LabKind::IrradianceExact:
        if (!maps)
            return std::nullopt;
        return tint * scale * kPi * sampleCube(maps->prefiltered.back(), d);
    case LabKind::Faces:
    case LabKind::Prefiltered: {
        if (!maps)
            return std::nullopt;
        const LevelPair levels = levelsOf(view, *maps);
        return tint * scale *
               samplePair(maps->prefiltered[levels.first], maps->prefiltered[levels.second],
                          levels.share, d);
    }
    case LabKind::Dfg:
        break;
    }
    return std::nullopt;
}

double LabLight::irradianceError(const IblMaps& maps) {
    const CubeLevel& exact = maps.prefiltered.back();
    const std::vector<float> solidAngles = cubeSolidAngles(exact.size);
    double difference = 0.0, all = 0.0;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < exact.size; ++y)
            for (int x = 0; x < exact.size; ++x) {
                const auto n = static_cast<float>(exact.size);
                const glm::vec3 d = glm::normalize(cubeDirection(
                    face, (static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n));
                const glm::dvec3 e(kPi * cubeTexel(exact, face, x, y));
                const glm::dvec3 nine(shading::irradianceFromSh9(maps.irradianceSh.data(), d));
                const double weight =
                    static_cast<double>(solidAngles[static_cast<std::size_t>(y * exact.size + x)]);
                difference += weight * glm::dot(nine - e, nine - e);
                all += weight * glm::dot(e, e);
            }
    return all > 0.0 ? std::sqrt(difference / all) : 0.0;
}

// --- Pictures ------------------------------------------------------------------------------------

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

// Many texels become one pixel: something of about the picture's size stands in for them.
PixelRadiance pixelRadiance(const LabLight& light, LabView view, const QSize& size) {
    if (view.kind == LabKind::Harmonics)
        return latLongRadiance(light.analysis->sums[static_cast<std::size_t>(view.index - 1)], size,
                               light.rotationDeg);
    if (view.kind == LabKind::Environment) {
        ImagePtr image = light.analysis->environment;
        for (const ImagePtr& reduced : light.analysis->reduced)
            if (reduced->width() >= size.width())
                image = reduced;
        return latLongRadiance(image, size, light.rotationDeg);
    }
    if (view.kind == LabKind::Irradiance)
        return [maps = light.maps](int, int, const glm::vec3& d) {
            return shading::irradianceFromSh9(maps->irradianceSh.data(), d) / kPi;
        };
    const int around = (view.isFace() ? 4 : 1) * size.width();
    // Irradiance over pi is the last level as it is.
    const std::size_t count = light.maps->prefiltered.size();
    const LevelPair levels = view.kind == LabKind::IrradianceExact
                                 ? LevelPair{count - 1, count - 1, 0.0f}
                                 : levelsOf(view, *light.maps);
    return
        [share = levels.share, first = fittingLevel(light.maps->prefiltered[levels.first], around),
         second = fittingLevel(light.maps->prefiltered[levels.second], around)](
            int, int, const glm::vec3& d) { return samplePair(first, second, share, d); };
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
    const LatLongDirections directions(size, light.rotationDeg);
    const float back = -glm::radians(light.rotationDeg);
    // A face alone is a piece of a cross.
    std::optional<EnvironmentMapping> cross;
    glm::vec2 corner(0.5f);
    if (view.isCross())
        cross = mapping(EnvironmentLayout::HorizontalCross, size.width(), size.height());
    if (view.isFace()) {
        const int side = size.width();
        cross = mapping(EnvironmentLayout::HorizontalCross, 4 * side, 3 * side);
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
            if (cross) {
                const auto ray = cross->ray(corner + glm::vec2(x, y));
                if (!ray)
                    continue; // beside a face
                direction = shading::rotateY(ray->direction, back);
            }
            pixels[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)] =
                tone.pixel(light.tint * light.scale * radiance(x, y, direction));
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

glm::vec3 LabDfg::value(float NoV, float perceptualRoughness) const {
    const auto axis = [](float at, int size) {
        const float texel =
            std::clamp(at * static_cast<float>(size) - 0.5f, 0.0f, static_cast<float>(size - 1));
        const int first = std::min(static_cast<int>(texel), std::max(0, size - 2));
        return std::pair(first, texel - static_cast<float>(first));
    };
    const auto [x, fx] = axis(NoV, table.width());
    const auto [y, fy] = axis(perceptualRoughness, table.height());
    const auto at = [&, x = x, y = y](int i, int j) {
        return glm::vec3(table.sample(x + i, y + j, 0), table.sample(x + i, y + j, 1),
                         table.sample(x + i, y + j, 2));
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
}

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
