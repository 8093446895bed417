#include "core/io/SpecularGlossiness.h"

#include "core/image/Image.h"
#include "core/image/Srgb.h"
#include "core/io/ImageIO.h"
#include "core/io/PngEncoder.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace patina {

namespace {

constexpr float kDielectric = 0.04f; // what a non-metal reflects: of index 1.5

// The converter's measure: how bright a colour seems (HSP, D. R. Finley 2006).
float perceivedBrightness(const glm::vec3& color) {
    return std::sqrt(glm::dot(glm::vec3(0.299f, 0.587f, 0.114f), color * color));
}

// Both colours follow from base colour b and metalness m as
//   diffuse = b (1 - 0.04) (1 - m) / (1 - max specular),   specular = 0.04 (1 - m) + b m.
// Without b that is 0.04 m² + (diffuse (1 - max specular) / 0.96 + specular - 0.08) m
//   + 0.04 - specular = 0, solved for m.
float solveMetallic(float diffuse, float specular, float oneMinusSpecular) {
    if (specular < kDielectric)
        return 0.0f;
    const float a = kDielectric;
    const float b =
        diffuse * oneMinusSpecular / (1.0f - kDielectric) + specular - 2.0f * kDielectric;
    const float c = kDielectric - specular;
    const float discriminant = std::max(b * b - 4.0f * a * c, 0.0f);
    return glm::clamp((std::sqrt(discriminant) - b) / (2.0f * a), 0.0f, 1.0f);
}

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(glm::clamp(value, 0.0f, 1.0f) * 255.0f));
}

bool liesLike(const ImportedTexture& a, const ImportedTexture& b) {
    return a.uvScale == b.uvScale && a.uvOffset == b.uvOffset && a.uvRotationDeg == b.uvRotationDeg;
}

struct ConvertedMaps {
    int baseColor = -1, metallicRoughness = -1; // embedded images
};

class GlossinessConverter {
  public:
    GlossinessConverter(WorkerClient& worker, ImportedModel& model,
                        const std::function<bool(const ImportedTexture&)>& readable)
        : m_worker(worker)
        , m_model(model)
        , m_readable(readable) {}

    void convert(ImportedMaterial& material);

  private:
    [[nodiscard]] std::optional<Image> load(const std::optional<ImportedTexture>& texture,
                                            const ImportedMaterial& material);
    [[nodiscard]] ConvertedMaps convertMaps(const ImportedMaterial& material, const Image* diffuse,
                                            const Image* specular);
    [[nodiscard]] int embed(const Image& image);
    void warn(const ImportedMaterial& material, const char* what) {
        m_model.warnings.push_back(fmt::format("Material \"{}\": {}.", material.name, what));
    }

    WorkerClient& m_worker;
    ImportedModel& m_model;
    const std::function<bool(const ImportedTexture&)>& m_readable;
    // Materials often share maps and numbers: those of a key have been converted already.
    using Key = std::tuple<std::string, int, std::string, int, bool, std::array<float, 7>>;
    std::map<Key, ConvertedMaps> m_known;
    std::size_t m_texels = 0; // that have been converted, and what each pair costs beside them
};

std::optional<Image> GlossinessConverter::load(const std::optional<ImportedTexture>& texture,
                                               const ImportedMaterial& material) {
    // Thousands of materials may name few images: real files stay far below.
    constexpr std::size_t kMostTexels = std::size_t{1} << 28;
    constexpr int kMaxSide = 8192;
    if (!texture || !m_readable(*texture)) // what is missing has been named
        return std::nullopt;
    if (m_texels > kMostTexels) {
        warn(material, "the model has too many maps of the specular-glossiness model to convert; "
                       "these were left out");
        return std::nullopt;
    }
    ImageLoadOptions options;
    options.integerEncoding = ColorEncoding::Srgb;
    auto loaded =
        texture->embedded >= 0
            ? loadImageFromMemory(
                  m_worker, m_model.embeddedImages[static_cast<std::size_t>(texture->embedded)],
                  fmt::format("embedded image {}", texture->embedded + 1), options)
            : loadImage(m_worker, texture->file, options);
    if (!loaded) {
        warn(material, "a map of the specular-glossiness model cannot be read and was left out");
        return std::nullopt;
    }
    Image image = std::move(loaded->parts.front().image);
    if (std::max(image.width(), image.height()) <= kMaxSide)
        return image;
    warn(material, "a map of the specular-glossiness model was reduced to 8192 texels a side");
    return shrinkImage(image, kMaxSide);
}

int GlossinessConverter::embed(const Image& image) {
    auto bytes = encodePng(image);
    if (!bytes) // which has one reason for pixels of our own
        throw std::bad_alloc();
    m_model.embeddedImages.push_back(std::move(*bytes));
    return static_cast<int>(m_model.embeddedImages.size()) - 1;
}

// Texel by texel, at the size of the larger one.
ConvertedMaps GlossinessConverter::convertMaps(const ImportedMaterial& material,
                                               const Image* diffuse, const Image* specular) {
    constexpr std::size_t kTexelsPerPair = 65536; // in time
    const ImportedGlossiness& source = *material.glossiness;
    int width = 1, height = 1;
    for (const Image* image : {diffuse, specular})
        if (image != nullptr) {
            width = std::max(width, image->width());
            height = std::max(height, image->height());
        }
    m_texels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + kTexelsPerPair;
    const auto texel = [&](const Image* image, int x, int y) {
        if (image == nullptr)
            return glm::vec4(1.0f);
        if (image->width() == width && image->height() == height)
            return image->linear(x, y);
        return sampleBilinear(*image, (static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                              (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
    };
    Image color(width, height, 4, PixelType::U8, ColorEncoding::Srgb);
    Image surface(width, height, 3, PixelType::U8, ColorEncoding::Data);
    const auto rows = static_cast<std::size_t>(height), columns = static_cast<std::size_t>(width);
    parallelFor({}, rows, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * columns; i < end * columns; ++i) {
            const int x = static_cast<int>(i % columns), y = static_cast<int>(i / columns);
            const glm::vec4 d = texel(diffuse, x, y), s = texel(specular, x, y);
            const MetallicColor converted =
                metallicOf(glm::vec3(material.baseColor * d), source.specular * glm::vec3(s));
            std::uint8_t* const out = color.u8().data() + 4 * i;
            for (int c = 0; c < 3; ++c)
                out[c] = linearToSrgb8(converted.baseColor[c]);
            out[3] = toByte(d.a);
            std::uint8_t* const packed = surface.u8().data() + 3 * i; // occlusion: none
            packed[0] = 255;
            packed[1] = toByte(1.0f - source.glossiness * s.a);
            packed[2] = toByte(converted.metallic);
        }
    });
    const int first = embed(color);
    return {first, embed(surface)};
}

void GlossinessConverter::convert(ImportedMaterial& material) {
    const ImportedGlossiness& source = *material.glossiness;
    std::optional<ImportedTexture>& colorMap = material.maps[MaterialInput::BaseColor];
    const bool apart = colorMap && source.map && !liesLike(*colorMap, *source.map);
    const auto file = [](const std::optional<ImportedTexture>& map) {
        return map ? map->file.string() : std::string();
    };
    const auto embedded = [](const std::optional<ImportedTexture>& map) {
        return map ? map->embedded : -1;
    };
    const glm::vec3 diffuse(material.baseColor), &specular = source.specular;
    const Key key{
        file(colorMap),
        embedded(colorMap),
        file(source.map),
        embedded(source.map),
        apart,
        {diffuse.r, diffuse.g, diffuse.b, specular.r, specular.g, specular.b, source.glossiness}};
    auto known = m_known.find(key);
    if (known == m_known.end()) {
        std::optional<Image> specularMap = load(source.map, material);
        if (specularMap && apart) {
            warn(material, "its specular-glossiness map lies on the surface in another way than "
                           "its diffuse map; its mean was used");
            specularMap = shrinkImage(*specularMap, 1);
        }
        // Without metal the base colour is a multiple of the diffuse colour, and so of its map.
        constexpr float kNoMetal = kDielectric + 1e-4f;
        std::optional<Image> colors;
        if (specularMap || (!source.map && perceivedBrightness(specular) > kNoMetal))
            colors = load(colorMap, material);
        known = m_known
                    .emplace(key, colors || specularMap
                                      ? convertMaps(material, colors ? &*colors : nullptr,
                                                    specularMap ? &*specularMap : nullptr)
                                      : ConvertedMaps{})
                    .first;
    }
    const ConvertedMaps& maps = known->second;
    if (maps.baseColor < 0) {
        // The factor alone is mostly white: a mirror of metal.
        if (source.map)
            warn(material, "without its specular-glossiness map it is taken as a non-metal");
        const MetallicColor converted =
            metallicOf(diffuse, source.map ? glm::vec3(kDielectric) : specular);
        material.baseColor = glm::vec4(converted.baseColor, material.baseColor.a);
        material.numbers[MaterialInput::Metallic] = converted.metallic;
        material.numbers[MaterialInput::PerceptualRoughness] = 1.0f - source.glossiness;
        return;
    }
    material.baseColor = glm::vec4(glm::vec3(1.0f), material.baseColor.a);
    ImportedTexture placed = colorMap ? *colorMap : *source.map;
    placed.file.clear();
    const auto use = [&](MaterialInput input, int image, char channel) {
        placed.embedded = image;
        placed.channel = channel;
        material.maps[input] = placed;
    };
    use(MaterialInput::BaseColor, maps.baseColor, 0);
    use(MaterialInput::PerceptualRoughness, maps.metallicRoughness, 'g');
    use(MaterialInput::Metallic, maps.metallicRoughness, 'b');
    material.numbers[MaterialInput::Metallic] = 1.0f;
    material.numbers[MaterialInput::PerceptualRoughness] = 1.0f;
}

} // namespace

MetallicColor metallicOf(const glm::vec3& diffuse, const glm::vec3& specular) {
    constexpr float kEpsilon = 1e-6f; // of the converter: neither quotient counts where it is 0 / 0
    const float oneMinusSpecular = 1.0f - std::max({specular.r, specular.g, specular.b});
    MetallicColor result;
    result.metallic = solveMetallic(perceivedBrightness(diffuse), perceivedBrightness(specular),
                                    oneMinusSpecular);
    const float m = result.metallic;
    const glm::vec3 fromDiffuse =
        diffuse * (oneMinusSpecular / (1.0f - kDielectric) / std::max(1.0f - m, kEpsilon));
    const glm::vec3 fromSpecular =
        (specular - kDielectric * (1.0f - m)) * (1.0f / std::max(m, kEpsilon));
    result.baseColor = glm::clamp(glm::mix(fromDiffuse, fromSpecular, m * m), 0.0f, 1.0f);
    return result;
}

void convertSpecularGlossiness(WorkerClient& worker, ImportedModel& model,
                               const std::function<bool(const ImportedTexture&)>& readable) {
    GlossinessConverter converter(worker, model, readable);
    std::size_t count = 0;
    for (ImportedMaterial& material : model.materials)
        if (material.glossiness) {
            converter.convert(material);
            material.glossiness.reset();
            ++count;
        }
    if (count > 0)
        model.warnings.push_back(fmt::format("{} materials of the outdated specular-glossiness "
                                             "model were converted to metallic-roughness.",
                                             count));
}

} // namespace patina
