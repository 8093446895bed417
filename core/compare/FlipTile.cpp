#include "core/compare/FlipTile.h"

#include <algorithm>
#include <cmath>

namespace patina::compare {

FlipTile::FlipTile(const Image& image, const Image& reference, const FlipKernels& kernels)
    : m_image(image)
    , m_reference(reference)
    , m_kernels(kernels)
    , m_radius(kernels.radius()) {
    const auto side = static_cast<std::size_t>(kSide);
    const auto wide = static_cast<std::size_t>(kSide + 2 * m_radius);
    for (Picture& picture : m_pictures) {
        for (Plane& plane : picture.light)
            plane.resize(wide * wide);
        for (Plane* plane : {&picture.achromatic, &picture.redGreen, &picture.blueYellow[0],
                             &picture.blueYellow[1], &picture.gaussian, &picture.derivative,
                             &picture.secondDerivative})
            plane->resize(wide * side);
        for (Plane* plane : {&picture.color[0], &picture.color[1], &picture.color[2], &picture.edge,
                             &picture.point})
            plane->resize(side);
    }
    for (Plane& row : m_row)
        row.resize(wide);
    for (Plane* row : {&m_color, &m_edge, &m_point})
        row->resize(side);
}

void FlipTile::read(const TileRect& rect) {
    m_rect = rect;
    readPicture(m_image, m_pictures[0]);
    readPicture(m_reference, m_pictures[1]);
}

void FlipTile::readPicture(const Image& image, Picture& picture) const {
    std::size_t i = 0;
    for (int y = -m_radius; y < m_rect.height + m_radius; ++y) {
        const int row = std::clamp(m_rect.y + y, 0, image.height() - 1);
        for (int x = -m_radius; x < m_rect.width + m_radius; ++x, ++i) {
            const glm::vec4 light =
                image.linear(std::clamp(m_rect.x + x, 0, image.width() - 1), row);
            for (int c = 0; c < 3; ++c)
                picture.light[static_cast<std::size_t>(c)][i] = light[c];
        }
    }
}

void FlipTile::filterAlongX(Picture& picture, const float* exposure) {
    const FlipToneCurve toneCurve;
    const float gain = exposure ? std::exp2(*exposure) : 1.0f;
    const auto displayed = [&](float light) {
        return exposure ? toneCurve(light * gain) : std::clamp(light, 0.0f, 1.0f);
    };
    const auto wide = static_cast<std::size_t>(m_rect.width + 2 * m_radius);
    for (int y = 0; y < m_rect.height + 2 * m_radius; ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * wide;
        for (std::size_t x = 0; x < wide; ++x) {
            const glm::vec3 v = ycxczFromRgb({displayed(picture.light[0][first + x]),
                                              displayed(picture.light[1][first + x]),
                                              displayed(picture.light[2][first + x])});
            m_row[0][x] = v.x;
            m_row[1][x] = v.y;
            m_row[2][x] = v.z;
            m_row[3][x] = (v.x + 16.0f) / 116.0f;
        }
        const auto row = [&](std::size_t plane) {
            return [centre = m_row[plane].data() + m_radius](int i) { return centre + i; };
        };
        const std::size_t to = static_cast<std::size_t>(y) * kSide;
        const int width = m_rect.width;
        filterEven(m_kernels.achromatic, row(0), picture.achromatic.data() + to, width);
        filterEven(m_kernels.redGreen, row(1), picture.redGreen.data() + to, width);
        for (std::size_t i = 0; i < 2; ++i)
            filterEven(m_kernels.blueYellow[i], row(2), picture.blueYellow[i].data() + to, width);
        filterEven(m_kernels.gaussian, row(3), picture.gaussian.data() + to, width);
        filterOdd(m_kernels.derivative, row(3), picture.derivative.data() + to, width);
        filterZeroSum(m_kernels.secondDerivative, row(3), picture.secondDerivative.data() + to,
                      width);
    }
}

// Along y, for row `y` of the tile: its colours and the magnitudes of its features.
void FlipTile::filterRow(Picture& picture, int y) {
    const int width = m_rect.width;
    const auto row = [&](const Plane& plane) {
        return [centre = plane.data() + static_cast<std::ptrdiff_t>(y + m_radius) * kSide](int i) {
            return centre + static_cast<std::ptrdiff_t>(i) * kSide;
        };
    };
    const auto columns = static_cast<std::size_t>(width);

    Plane &achromatic = m_row[0], &redGreen = m_row[1], &blue = m_row[2], &yellow = m_row[3];
    filterEven(m_kernels.achromatic, row(picture.achromatic), achromatic.data(), width);
    filterEven(m_kernels.redGreen, row(picture.redGreen), redGreen.data(), width);
    filterEven(m_kernels.blueYellow[0], row(picture.blueYellow[0]), blue.data(), width);
    filterEven(m_kernels.blueYellow[1], row(picture.blueYellow[1]), yellow.data(), width);
    const auto [share, rest] = m_kernels.blueYellowWeight;
    for (std::size_t x = 0; x < columns; ++x) {
        const glm::vec3 rgb =
            rgbFromYcxcz({achromatic[x], redGreen[x], share * blue[x] + rest * yellow[x]});
        const glm::vec3 lab = huntLabFromRgb(glm::clamp(rgb, 0.0f, 1.0f));
        for (int c = 0; c < 3; ++c)
            picture.color[static_cast<std::size_t>(c)][x] = lab[c];
    }

    const auto magnitude = [&](Plane& result, const Plane& alongX, const Plane& alongY) {
        for (std::size_t x = 0; x < columns; ++x)
            result[x] = std::sqrt(alongX[x] * alongX[x] + alongY[x] * alongY[x]);
    };
    filterEven(m_kernels.gaussian, row(picture.derivative), m_row[0].data(), width);
    filterOdd(m_kernels.derivative, row(picture.gaussian), m_row[1].data(), width);
    magnitude(picture.edge, m_row[0], m_row[1]);
    filterEven(m_kernels.gaussian, row(picture.secondDerivative), m_row[0].data(), width);
    filterZeroSum(m_kernels.secondDerivative, row(picture.gaussian), m_row[1].data(), width);
    magnitude(picture.point, m_row[0], m_row[1]);
}

void FlipTile::evaluate(const float* exposure,
                        const std::function<void(int, const FlipRow&)>& take) {
    for (Picture& picture : m_pictures)
        filterAlongX(picture, exposure);
    const auto columns = static_cast<std::size_t>(m_rect.width);
    const auto& [a, b] = m_pictures;
    for (int y = 0; y < m_rect.height; ++y) {
        for (Picture& picture : m_pictures)
            filterRow(picture, y);
        for (std::size_t x = 0; x < columns; ++x) {
            m_color[x] = m_colorDifference({a.color[0][x], a.color[1][x], a.color[2][x]},
                                           {b.color[0][x], b.color[1][x], b.color[2][x]});
            m_edge[x] = std::abs(a.edge[x] - b.edge[x]);
            m_point[x] = std::abs(a.point[x] - b.point[x]);
        }
        take(y, {std::span(m_color).first(columns), std::span(m_edge).first(columns),
                 std::span(m_point).first(columns)});
    }
}

FlipFeatures FlipTile::features(const Image& image, const TileRect& rect) {
    m_rect = rect;
    Picture& picture = m_pictures[0];
    readPicture(image, picture);
    filterAlongX(picture, nullptr);
    FlipFeatures features;
    const auto append = [&](std::vector<float>& all, const Plane& row) {
        all.insert(all.end(), row.begin(), row.begin() + rect.width);
    };
    for (int y = 0; y < rect.height; ++y) {
        filterRow(picture, y);
        for (std::size_t c = 0; c < 3; ++c)
            append(features.color[c], picture.color[c]);
        append(features.edge, picture.edge);
        append(features.point, picture.point);
    }
    return features;
}

void FlipTile::evaluateAgainst(const FlipFeatures& reference, const Image& image,
                               const TileRect& rect,
                               const std::function<void(int, const FlipRow&)>& take) {
    m_rect = rect;
    Picture& a = m_pictures[0];
    readPicture(image, a);
    filterAlongX(a, nullptr);
    const auto columns = static_cast<std::size_t>(rect.width);
    for (int y = 0; y < rect.height; ++y) {
        filterRow(a, y);
        const std::size_t first = static_cast<std::size_t>(y) * columns;
        for (std::size_t x = 0; x < columns; ++x) {
            const glm::vec3 mine(a.color[0][x], a.color[1][x], a.color[2][x]);
            const glm::vec3 other(reference.color[0][first + x], reference.color[1][first + x],
                                  reference.color[2][first + x]);
            m_color[x] = mine == other ? 0.0f : m_colorDifference(mine, other);
            m_edge[x] = std::abs(a.edge[x] - reference.edge[first + x]);
            m_point[x] = std::abs(a.point[x] - reference.point[first + x]);
        }
        take(y, {std::span(m_color).first(columns), std::span(m_edge).first(columns),
                 std::span(m_point).first(columns)});
    }
}

} // namespace patina::compare
