#include "core/light/EnvironmentTexels.h"

#include "core/base/Check.h"
#include "core/image/AreaFilter.h"
#include "core/image/FloatTexture.h"
#include "core/job/Parallel.h"
#include "core/light/CubeAtlas.h"

#include <algorithm>

namespace patina {
namespace {

constexpr std::size_t kRows = 16;    // per piece of parallel work
constexpr float kLargest = 65504.0f; // half float

// A level between its source and its half floats.
struct Samples {
    int width = 0, height = 0;
    std::size_t channels = 3; // of which the first three are colour
    std::span<const float> values;

    [[nodiscard]] const float* row(std::size_t y) const {
        return values.data() + y * static_cast<std::size_t>(width) * channels;
    }
};

HalfPicture halves(const Samples& from, const JobContext& job) {
    const auto width = static_cast<std::size_t>(from.width);
    const auto height = static_cast<std::size_t>(from.height);
    const std::uint16_t one = halfFromFloat(1.0f);
    HalfPicture picture{from.width, from.height, std::vector<std::uint16_t>(4 * width * height)};
    parallelFor(job, height, kRows, [&](std::size_t begin, std::size_t end) {
        const float* source = from.row(begin);
        std::uint16_t* target = picture.texels.data() + 4 * begin * width;
        for (std::size_t i = 0; i < (end - begin) * width; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                target[4 * i + c] = halfFromFloat(source[i * from.channels + c]);
            target[4 * i + 3] = one;
        }
    });
    return picture;
}

// Half the size, rounded down. What half floats cannot hold is cut off before it is averaged: a sun
// keeps its size in the mipmaps.
std::vector<float> reduced(const Samples& from, const JobContext& job) {
    const std::vector<Footprint> columns = footprints(from.width, std::max(1, from.width / 2));
    const std::vector<Footprint> rows = footprints(from.height, std::max(1, from.height / 2));
    std::vector<float> result(rows.size() * columns.size() * 3);
    parallelFor(job, rows.size(), kRows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < columns.size(); ++x) {
                glm::vec3 sum(0.0f);
                for (std::size_t j = 0; j < rows[y].weights.size(); ++j) {
                    const float* source =
                        from.row(static_cast<std::size_t>(rows[y].first) + j) +
                        static_cast<std::size_t>(columns[x].first) * from.channels;
                    for (const float weight : columns[x].weights) {
                        sum += rows[y].weights[j] * weight *
                               glm::min(glm::vec3(source[0], source[1], source[2]), kLargest);
                        source += from.channels;
                    }
                }
                std::copy_n(&sum.x, 3, result.data() + 3 * (y * columns.size() + x));
            }
    });
    return result;
}

} // namespace

Result<HalfMipmapsPtr> makeBackground(const Image& image, const JobContext& job) {
    CHECK(image.type() == PixelType::F32);
    CHECK_LE(3, image.channels());
    auto levels = std::make_shared<HalfMipmaps>();
    Samples level{image.width(), image.height(), static_cast<std::size_t>(image.channels()),
                  image.f32()};
    std::vector<float> values;
    for (;;) {
        levels->push_back(halves(level, job));
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "The background was cancelled.", {}, {}};
        if (level.width == 1 && level.height == 1)
            return HalfMipmapsPtr(std::move(levels));
        values = reduced(level, job);
        level = {std::max(1, level.width / 2), std::max(1, level.height / 2), 3, values};
    }
}

EnvironmentTexels makeEnvironmentTexels(ImagePtr image, const IblMaps& maps,
                                        HalfMipmapsPtr background) {
    CHECK(maps.spacing == LevelSpacing::Lobes);
    const CubeAtlas atlas = makeCubeAtlas(maps.prefiltered, maps.irradiance);
    EnvironmentTexels texels;
    texels.image = std::move(image);
    texels.background = std::move(background);
    texels.prefiltered = halves(
        {atlas.width, atlas.height, 3, std::span(&atlas.texels[0].x, 3 * atlas.texels.size())},
        JobContext());
    texels.side = atlas.side;
    texels.levels = atlas.levels;
    texels.irradianceSide = atlas.irradianceSide;
    texels.irradianceTop = atlas.irradianceTop;
    for (const CubeLevel& level : maps.prefiltered)
        texels.clamped += static_cast<std::size_t>(
            std::ranges::count_if(level.texels, [](const glm::vec3& texel) {
                return std::max({texel.x, texel.y, texel.z}) > kLargest;
            }));
    texels.irradianceSh = maps.irradianceSh;
    texels.radianceSh = maps.radianceSh;
    return texels;
}

} // namespace patina
