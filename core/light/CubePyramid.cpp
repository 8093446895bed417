#include "core/light/CubePyramid.h"

#include "core/base/Check.h"
#include "core/light/Cubemap.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

namespace patina {

namespace {

constexpr int kFacePlusZ = 4;
constexpr std::size_t kMostBrightTexels = 1024;
constexpr float kPyramidContrast = 1.0f; // times the mean
constexpr int kBlock = 8;                // texels on a side

// The matrix that takes cubeDirection(+Z, s, t) to cubeDirection(face, s, t).
glm::mat3 faceMatrix(int face) {
    // cubeDirection(+Z, s, t) = (u, -v, 1)
    const glm::vec3 middle = cubeDirection(face, 0.5f, 0.5f);
    return {cubeDirection(face, 1.0f, 0.5f) - middle, middle - cubeDirection(face, 0.5f, 1.0f),
            middle};
}

CubeSymmetry makeSymmetry(int face, bool mirrorX, bool mirrorY, bool transposed) {
    CubeSymmetry result;
    result.face = face;
    result.transposed = transposed;
    result.mirrorX = mirrorX;
    result.mirrorY = mirrorY;
    result.matrix = faceMatrix(face);
    if (mirrorX)
        result.matrix[0] = -result.matrix[0];
    if (mirrorY)
        result.matrix[1] = -result.matrix[1];
    if (transposed) // rows of texels run along -Y
        result.matrix = {-result.matrix[1], -result.matrix[0], result.matrix[2]};
    for (int from = 0; from < 6; ++from) {
        // Three points tell where the axes of the face go.
        const auto image = [&](float s, float t) {
            return cubePosition(result.matrix * cubeDirection(from, s, t));
        };
        const CubePosition p = image(0.25f, 0.25f), x = image(0.75f, 0.25f),
                           y = image(0.25f, 0.75f);
        const auto step = [](float a, float b) {
            return static_cast<int>(std::lround(2.0f * (b - a)));
        };
        result.faces[from] = {p.face, step(p.s, x.s), step(p.s, y.s), step(p.t, x.t),
                              step(p.t, y.t)};
    }
    return result;
}

std::array<CubeSymmetry, 48> makeSymmetries() {
    std::array<CubeSymmetry, 48> result;
    for (int i = 0; i < 48; ++i)
        result[i] = makeSymmetry(i % 6, i / 6 % 2 == 1, i / 12 % 2 == 1, i / 24 == 1);
    return result;
}

float brightestOf(const glm::vec4& c) {
    return std::max({c.x, c.y, c.z});
}

} // namespace

const std::array<CubeSymmetry, 48>& cubeSymmetries() {
    static const std::array<CubeSymmetry, 48> kSymmetries = makeSymmetries();
    return kSymmetries;
}

CubePyramid::CubePyramid(const CubeLevel& base) {
    CHECK(std::has_single_bit(static_cast<unsigned>(base.size)));
    std::size_t texels = 0, cells = 0;
    for (int n = base.size; n >= 1; n /= 2) {
        const std::size_t face = static_cast<std::size_t>(n) * n;
        m_levels.push_back({n, texels, nullptr});
        texels += 6 * face;
        cells += face;
    }
    m_radiance.resize(texels);
    m_cells.resize(cells);

    // Geometry: a cell's centroid is the mean of its children's, weighted by their solid angles.
    glm::vec4* level = m_cells.data();
    for (std::size_t i = 0; i < m_levels.size(); ++i) {
        const int n = m_levels[i].size;
        m_levels[i].cells = level;
        const std::vector<float> omega = cubeSolidAngles(n);
        const glm::vec4* finer = i > 0 ? m_levels[i - 1].cells : nullptr;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const std::size_t at = static_cast<std::size_t>(y) * n + x;
                glm::vec3 direction(0.0f);
                if (i == 0)
                    direction = cubeDirection(
                        kFacePlusZ, (static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(n));
                else
                    for (int k = 0; k < 4; ++k) {
                        const glm::vec4& child =
                            finer[static_cast<std::size_t>(2 * y + k / 2) * 2 * n + 2 * x + k % 2];
                        direction += glm::vec3(child) * child.w;
                    }
                level[at] = glm::vec4(glm::normalize(direction), omega[at]);
            }
        level += static_cast<std::size_t>(n) * n;
    }

    // Radiance
    for (std::size_t i = 0; i < base.texels.size(); ++i)
        m_radiance[i] = glm::vec4(base.texels[i], 0.0f);
    separateBrightTexels(cubeSolidAngles(base.size));
    for (std::size_t i = 1; i < m_levels.size(); ++i) {
        const Level &fine = m_levels[i - 1], &coarse = m_levels[i];
        const int n = coarse.size;
        glm::vec4* out = m_radiance.data() + coarse.first;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < n; ++y) {
                const std::size_t row = static_cast<std::size_t>(2 * y) * fine.size;
                const glm::vec4* top = m_radiance.data() + fine.first +
                                       static_cast<std::size_t>(face) * fine.size * fine.size + row;
                const glm::vec4* bottom = top + fine.size;
                const glm::vec4 *upper = fine.cells + row, *lower = upper + fine.size;
                for (int x = 0; x < n; ++x, ++out) {
                    const int a = 2 * x, b = a + 1;
                    const float total = upper[a].w + upper[b].w + lower[a].w + lower[b].w;
                    *out = (top[a] * upper[a].w + top[b] * upper[b].w + bottom[a] * lower[a].w +
                            bottom[b] * lower[b].w) /
                           total;
                }
            }
    }
}

// Bright and dark in one cell far from the lobe's peak would be smeared over it: a sun, a lamp, the
// edge of a window. What stands out of its neighbourhood, a block of texels, is taken apart and
// summed where it is; what is left is nearly even, which is what cells are weighed for.
void CubePyramid::separateBrightTexels(const std::vector<float>& solidAngles) {
    const std::size_t face = solidAngles.size(), count = 6 * face;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
        sum += static_cast<double>(brightestOf(m_radiance[i])) * solidAngles[i % face];
    const float limit = kPyramidContrast * static_cast<float>(sum / (4.0 * std::numbers::pi));
    if (!std::isfinite(limit))
        return;

    std::vector<Outlier> outliers = findOutliers(limit);
    if (outliers.size() > kMostBrightTexels) {
        std::ranges::stable_sort(outliers, std::greater(), &Outlier::contrast);
        outliers.resize(kMostBrightTexels);
        std::ranges::sort(outliers, {}, &Outlier::texel);
    }
    std::vector<BrightTexel> bright;
    for (const Outlier& outlier : outliers) {
        const std::size_t inFace = outlier.texel % face;
        glm::vec4& radiance = m_radiance[outlier.texel];
        bright.push_back(
            {cubeSymmetries()[outlier.texel / face].matrix * glm::vec3(m_levels[0].cells[inFace]),
             glm::vec3(radiance - outlier.neighbourhood) * solidAngles[inFace],
             solidAngles[inFace]});
        radiance = outlier.neighbourhood;
    }
    groupBrightTexels(outliers, std::move(bright));
}

// By texel.
std::vector<CubePyramid::Outlier> CubePyramid::findOutliers(float limit) const {
    const int n = m_levels[0].size, side = std::min(kBlock, n);
    std::vector<Outlier> outliers;
    std::vector<std::size_t> block;
    const auto value = [&](std::size_t i) {
        const float v = brightestOf(m_radiance[i]);
        return v > 0.0f ? v : 0.0f; // also of what is no number
    };
    for (int top = 0; top < 6 * n; top += side)
        for (int left = 0; left < n; left += side) {
            block.clear();
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    block.push_back(static_cast<std::size_t>(top + y) * n + left + x);
            const auto [least, most] = std::ranges::minmax(block, {}, value);
            if (!(value(most) - value(least) > limit))
                continue;
            const auto middle = block.begin() + static_cast<std::ptrdiff_t>(block.size() / 2);
            std::ranges::nth_element(block, middle, {}, value);
            const std::size_t median = *middle;
            for (const std::size_t i : block) {
                const float contrast = std::abs(value(i) - value(median));
                if (contrast > limit)
                    outliers.push_back({i, m_radiance[median], contrast});
            }
        }
    std::ranges::sort(outliers, {}, &Outlier::texel);
    return outliers;
}

void CubePyramid::groupBrightTexels(const std::vector<Outlier>& outliers,
                                    std::vector<BrightTexel> bright) {
    const auto n = static_cast<std::size_t>(m_levels[0].size);
    const auto cell = [&](std::size_t texel) { // two by two texels
        return (texel / (n * n) * n + texel / n % n / 2) * n + texel % n / 2;
    };
    std::vector<std::size_t> order(bright.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return cell(outliers[i].texel); });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const BrightTexel& texel = bright[order[k]];
        if (k == 0 || cell(outliers[order[k]].texel) != cell(outliers[order[k - 1]].texel))
            m_brightGroups.push_back({{glm::vec3(0.0f), glm::vec3(0.0f), 0.0f}, k, 0});
        BrightGroup& group = m_brightGroups.back();
        const glm::vec3 size = glm::abs(texel.flux);
        group.all.direction += texel.direction * (size.x + size.y + size.z);
        group.all.flux += texel.flux;
        group.all.solidAngle += texel.solidAngle;
        ++group.count;
        m_brightTexels.push_back(texel);
    }
    for (BrightGroup& group : m_brightGroups)
        group.all.direction = glm::normalize(group.all.direction);
}

} // namespace patina
