#include "core/light/EnvironmentResample.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace patina {

namespace {

// What is this many times brighter than the mean of the picture is moved by area.
constexpr float kResampledContrast = 16.0f;
constexpr int kMaxSamples = 32; // along one side of a pixel

glm::vec3 pixelAt(const Image& picture, int x, int y) {
    const float* p = picture.f32().data() + 3 * (static_cast<std::size_t>(y) * picture.width() +
                                                 static_cast<std::size_t>(x));
    return {p[0], p[1], p[2]};
}

void addTo(Image& picture, int x, int y, const glm::vec3& value) {
    float* p = picture.f32().data() +
               3 * (static_cast<std::size_t>(y) * picture.width() + static_cast<std::size_t>(x));
    for (int c = 0; c < 3; ++c)
        p[c] += value[c];
}

float brightest(const glm::vec3& c) {
    return std::max({c.x, c.y, c.z});
}

// Mean over the sphere; the density at pixel centres is weight enough.
float meanBrightness(const Image& picture, const EnvironmentMapping& mapping) {
    double sum = 0.0, weights = 0.0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (const auto ray = mapping.ray({x + 0.5f, y + 0.5f})) {
                sum += static_cast<double>(ray->density) * brightest(pixelAt(picture, x, y));
                weights += ray->density;
            }
    return weights > 0.0 ? static_cast<float>(sum / weights) : 0.0f;
}

// The arc that a pixel spans along x and along y.
glm::vec2 extent(const EnvironmentMapping& mapping, glm::vec2 centre, const glm::vec3& direction) {
    const auto towards = [&](glm::vec2 step) {
        float longest = 0.0f;
        for (const float sign : {-0.5f, 0.5f})
            if (const auto ray = mapping.ray(centre + sign * step))
                longest = std::max(longest, length(ray->direction - direction));
        return 2.0f * longest;
    };
    return {towards({1.0f, 0.0f}), towards({0.0f, 1.0f})};
}

struct Resampling {
    const EnvironmentMapping& from;
    const EnvironmentMapping& to;
    bool rotated;
    glm::mat3 matrix; // from the source to the target

    [[nodiscard]] glm::vec3 toSource(const glm::vec3& d) const { return rotated ? d * matrix : d; }
    [[nodiscard]] glm::vec3 toTarget(const glm::vec3& d) const { return rotated ? matrix * d : d; }

    // Cuts the pixel into patches, finer than the pixels of the result, and drops the flux of each
    // where it lies. The patches' shares add up to the pixel's exact solid angle.
    void move(const glm::vec3& radiance, int x, int y, Image& result) const {
        const glm::vec2 corner(x, y);
        const auto centre = from.ray(corner + 0.5f);
        const double solidAngle = from.solidAngle(x, y);
        if (solidAngle <= 0.0)
            return;
        int nx = 8, ny = 8;
        if (centre) {
            const auto seen = to.ray(to.position(toTarget(centre->direction)));
            const float pitch = seen ? std::sqrt(seen->density) : 0.0f;
            const glm::vec2 arc = extent(from, corner + 0.5f, centre->direction);
            const auto patches = [&](float length) {
                return std::clamp(static_cast<int>(4.0f * length / std::max(pitch, 1e-6f)), 4, 64);
            };
            nx = patches(arc.x);
            ny = patches(arc.y);
        }
        double weights = 0.0;
        for (const bool deposit : {false, true})
            for (int j = 0; j < ny; ++j)
                for (int i = 0; i < nx; ++i) {
                    const auto ray =
                        from.ray(corner + (glm::vec2(i, j) + 0.5f) / glm::vec2(nx, ny));
                    if (!ray)
                        continue;
                    if (!deposit) {
                        weights += ray->density;
                        continue;
                    }
                    const glm::vec2 p = to.position(toTarget(ray->direction));
                    const int tx = std::clamp(static_cast<int>(p.x), 0, result.width() - 1);
                    const int ty = std::clamp(static_cast<int>(p.y), 0, result.height() - 1);
                    const double receiver = to.solidAngle(tx, ty);
                    if (receiver > 0.0)
                        addTo(result, tx, ty,
                              radiance * static_cast<float>(solidAngle * ray->density /
                                                            (weights * receiver)));
                }
    }

    // The mean over the pixel.
    [[nodiscard]] glm::vec3 average(const Image& source, int x, int y) const {
        const glm::vec2 corner(x, y);
        int nx = 4, ny = 4; // a pixel on the rim of a disc
        if (const auto centre = to.ray(corner + 0.5f)) {
            const glm::vec3 d = toSource(centre->direction);
            const auto seen = from.ray(from.position(d));
            const float pitch = seen ? std::sqrt(seen->density) : 1.0f;
            const glm::vec2 arc = extent(to, corner + 0.5f, centre->direction);
            const auto samples = [&](float length) {
                return std::clamp(
                    static_cast<int>(std::ceil(2.0f * length / std::max(pitch, 1e-6f))), 2,
                    kMaxSamples);
            };
            nx = samples(arc.x);
            ny = samples(arc.y);
        }
        glm::vec3 sum(0.0f);
        float weights = 0.0f;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                if (const auto ray =
                        to.ray(corner + (glm::vec2(i, j) + 0.5f) / glm::vec2(nx, ny))) {
                    // The density may be 0 at a pole or rim without the pixel being empty.
                    const float weight = std::max(ray->density, 1e-20f);
                    sum += weight * from.lookup(source, toSource(ray->direction));
                    weights += weight;
                }
        if (weights > 0.0f)
            return sum / weights;
        // All samples may miss the sliver that a disc covers of a pixel on its rim: its nearest
        // point.
        const glm::vec2 middle = 0.5f * glm::vec2(to.size().width, to.size().height);
        const glm::vec2 nearest = glm::clamp(middle, corner + 1e-3f, corner + 1.0f - 1e-3f);
        if (to.solidAngle(x, y) <= 0.0)
            return glm::vec3(0.0f);
        const auto ray = to.ray(nearest);
        return from.lookup(source, toSource(ray ? ray->direction : glm::vec3(0.0f, 0.0f, 1.0f)));
    }
};

} // namespace

Image shrinkLatLong(const Image& picture, int maxWidth) {
    if (picture.width() <= maxWidth && picture.height() <= std::max(1, maxWidth / 2))
        return picture;
    const int width = std::min(picture.width(), maxWidth);
    const int height = std::min(picture.height(), std::max(1, maxWidth / 2));
    // Rows count by the difference of cos(theta) at their borders, also where they are cut.
    std::vector<Footprint> rows = footprints(picture.height(), height);
    const double scale = static_cast<double>(picture.height()) / height;
    const auto cosine = [&](double y) { return std::cos(std::numbers::pi * y / picture.height()); };
    for (int y = 0; y < height; ++y) {
        Footprint& row = rows[static_cast<std::size_t>(y)];
        const double begin = y * scale;
        const double end = std::min((y + 1) * scale, static_cast<double>(picture.height()));
        for (std::size_t k = 0; k < row.weights.size(); ++k) {
            const double at = row.first + static_cast<double>(k);
            row.weights[k] =
                static_cast<float>((cosine(std::max(begin, at)) - cosine(std::min(end, at + 1.0))) /
                                   (cosine(begin) - cosine(end)));
        }
    }
    const std::vector<Footprint> columns = footprints(picture.width(), width);

    Image result(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    parallelFor({}, static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
        std::vector<glm::vec3> sums(static_cast<std::size_t>(picture.width()));
        for (std::size_t y = begin; y < end; ++y) {
            std::fill(sums.begin(), sums.end(), glm::vec3(0.0f));
            for (std::size_t k = 0; k < rows[y].weights.size(); ++k)
                for (int x = 0; x < picture.width(); ++x)
                    sums[static_cast<std::size_t>(x)] +=
                        rows[y].weights[k] *
                        pixelAt(picture, x, rows[y].first + static_cast<int>(k));
            for (std::size_t x = 0; x < columns.size(); ++x) {
                glm::vec3 mean(0.0f);
                for (std::size_t k = 0; k < columns[x].weights.size(); ++k)
                    mean += columns[x].weights[k] *
                            sums[static_cast<std::size_t>(columns[x].first) + k];
                addTo(result, static_cast<int>(x), static_cast<int>(y), mean);
            }
        }
    });
    return result;
}

Image resampleEnvironment(const Image& picture, const EnvironmentMapping& from,
                          const EnvironmentMapping& to, const EnvironmentView& view,
                          const JobContext& job) {
    CHECK(picture.type() == PixelType::F32 && picture.channels() == 3);
    CHECK(from.size() == (ImageSize{picture.width(), picture.height()}));
    const bool turned = !view.orientation.isIdentity();
    const Resampling resampling{from, to, turned, glm::mat3(view.orientation.matrix())};

    Image result;
    if (!turned && from == to) {
        result = picture;
    } else if (!turned && from.isCommonLatLong() && to.isCommonLatLong() &&
               to.size().width <= picture.width() &&
               to.size().height == std::max(1, to.size().width / 2) &&
               picture.height() >= to.size().height) {
        result = shrinkLatLong(picture, to.size().width);
    } else {
        // Bright texels leave the picture first.
        result = Image(to.size().width, to.size().height, 3, PixelType::F32, ColorEncoding::Linear);
        Image smooth = picture;
        const float limit = kResampledContrast * meanBrightness(picture, from);
        for (int y = 0; y < picture.height() && !job.cancelled(); ++y)
            for (int x = 0; x < picture.width(); ++x) {
                const glm::vec3 radiance = pixelAt(picture, x, y);
                if (brightest(radiance) <= limit)
                    continue;
                const glm::vec3 excess = radiance * (1.0f - limit / brightest(radiance));
                addTo(smooth, x, y, -excess);
                resampling.move(excess, x, y, result);
            }
        const auto height = static_cast<std::size_t>(result.height());
        std::atomic<std::size_t> done{0};
        parallelFor(job, height, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y)
                for (int x = 0; x < result.width(); ++x)
                    addTo(result, x, static_cast<int>(y),
                          resampling.average(smooth, x, static_cast<int>(y)));
            done += end - begin;
            job.setProgress(static_cast<double>(done) / static_cast<double>(height));
        });
    }
    if (view.scale != 1.0f)
        for (float& sample : result.f32())
            sample *= view.scale;
    job.setProgress(1.0);
    return result;
}

glm::dvec3 environmentFlux(const Image& picture, const EnvironmentMapping& mapping) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            sum += mapping.solidAngle(x, y) * glm::dvec3(pixelAt(picture, x, y));
    return sum;
}

} // namespace patina
