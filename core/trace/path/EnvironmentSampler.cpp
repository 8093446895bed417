#include "core/trace/path/EnvironmentSampler.h"

#include "core/base/Check.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// The entry of running shares that `u` falls into, of those from `first` to `last`, and how far
// into it, 0…1. `count`: of all entries.
std::pair<int, float> chosen(const float* begin, int first, int last, int count, float u) {
    const float* found =
        std::min(std::upper_bound(begin + first, begin + last, u), begin + count - 1);
    const auto index = static_cast<int>(found - begin);
    const float before = index == 0 ? 0.0f : found[-1];
    const float share = *found - before;
    return {index, share > 0.0f ? std::clamp((u - before) / share, 0.0f, 1.0f) : 0.5f};
}

float share(const float* begin, int index) {
    return begin[index] - (index == 0 ? 0.0f : begin[index - 1]);
}

} // namespace

EnvironmentSampler::EnvironmentSampler(const TraceEnvironment& environment)
    : m_image(environment.image)
    , m_scale(environment.scale)
    , m_cos(std::cos(glm::radians(environment.rotationDeg)))
    , m_sin(std::sin(glm::radians(environment.rotationDeg)))
    , m_width(environment.image->width())
    , m_height(environment.image->height()) {
    CHECK(m_image->type() == PixelType::F32 && m_image->channels() >= 3 && m_width <= 0xffff);
    m_texels = m_image->f32().data();
    m_channels = m_image->channels();
    // Of bilinear interpolation a texel's square holds an eighth of each neighbour.
    const auto luminance = [&](int x, int y) {
        return static_cast<double>(shading::luminance(
            m_scale * texel((x + m_width) % m_width, std::clamp(y, 0, m_height - 1))));
    };
    const auto count = static_cast<std::size_t>(m_width);
    const double step = std::numbers::pi / m_height;
    for (int y = 0; y <= m_height; ++y)
        m_cosines.push_back(std::cos(kPi / static_cast<float>(m_height) * static_cast<float>(y)));
    for (int y = 0; y < m_height; ++y)
        m_solidAngles.push_back(2.0 * std::numbers::pi / m_width *
                                (std::cos(step * y) - std::cos(step * (y + 1))));
    std::vector<double> upright(count), sums(count);
    m_rows.resize(static_cast<std::size_t>(m_height));
    m_columns.resize(count * static_cast<std::size_t>(m_height));
    std::vector<double> rows(static_cast<std::size_t>(m_height));
    glm::dvec3 mean(0.0);
    for (int y = 0; y < m_height; ++y) {
        for (int x = 0; x < m_width; ++x)
            upright[static_cast<std::size_t>(x)] =
                0.125 * luminance(x, y - 1) + 0.75 * luminance(x, y) + 0.125 * luminance(x, y + 1);
        double sum = 0.0;
        glm::dvec3 row(0.0);
        for (int x = 0; x < m_width; ++x)
            row += glm::dvec3(m_scale * texel(x, y));
        mean += row * m_solidAngles[static_cast<std::size_t>(y)];
        for (std::size_t x = 0; x < count; ++x) {
            sum += 0.125 * upright[(x + count - 1) % count] + 0.75 * upright[x] +
                   0.125 * upright[(x + 1) % count];
            sums[x] = sum;
        }
        float* columns = m_columns.data() + static_cast<std::size_t>(y) * count;
        for (std::size_t x = 0; x < count; ++x)
            columns[x] = sum > 0.0 ? static_cast<float>(sums[x] / sum) : 0.0f;
        m_power += sum * m_solidAngles[static_cast<std::size_t>(y)];
        rows[static_cast<std::size_t>(y)] = m_power;
    }
    m_mean = glm::vec3(mean / (4.0 * std::numbers::pi));
    for (std::size_t y = 0; y < rows.size(); ++y)
        m_rows[y] = m_power > 0.0 ? static_cast<float>(rows[y] / m_power) : 0.0f;
    makeGuides();
}

void EnvironmentSampler::makeGuides() {
    // Four columns for each: as many as lie in a line of memory or two.
    m_guided = std::max(static_cast<int>(std::bit_ceil(static_cast<unsigned>(m_width))) / 4, 1);
    m_guides.reserve(static_cast<std::size_t>(m_height) * static_cast<std::size_t>(m_guided + 1));
    for (int y = 0; y < m_height; ++y) {
        const float* columns =
            m_columns.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width);
        int x = 0;
        for (int k = 0; k <= m_guided; ++k) {
            while (x < m_width &&
                   columns[x] <= static_cast<float>(k) / static_cast<float>(m_guided))
                ++x;
            m_guides.push_back(static_cast<std::uint16_t>(x));
        }
    }
}

const float* EnvironmentSampler::texelAt(int x, int y) const {
    return m_texels + (static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
                       static_cast<std::size_t>(x)) *
                          static_cast<std::size_t>(m_channels);
}

glm::vec3 EnvironmentSampler::texel(int x, int y) const {
    const float* p = texelAt(x, y);
    return {p[0], p[1], p[2]};
}

glm::vec2 EnvironmentSampler::pixelOf(const glm::vec3& direction) const {
    // The environment is turned counter-clockwise seen from above: what is looked up, back.
    const float x = m_cos * direction.x - m_sin * direction.z;
    const float z = m_sin * direction.x + m_cos * direction.z;
    const float u = 0.5f + std::atan2(x, -z) / (2.0f * kPi);
    const float v = std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kPi;
    return {u * static_cast<float>(m_width), v * static_cast<float>(m_height)};
}

glm::vec3 EnvironmentSampler::radiance(const glm::vec3& direction) const {
    return radianceAt(pixelOf(direction));
}

EnvironmentSampler::Lookup EnvironmentSampler::lookUp(const glm::vec3& direction) const {
    const glm::vec2 pixel = pixelOf(direction);
    return {radianceAt(pixel), pdfAt(pixel)};
}

glm::vec3 EnvironmentSampler::radianceAt(const glm::vec2& pixel) const {
    const glm::vec2 at = pixel - 0.5f;
    // Down to whole texels: from -0.5 on.
    const auto down = [](float value) {
        return value < 0.0f ? -1.0f : static_cast<float>(static_cast<int>(value));
    };
    const glm::vec2 low(down(at.x), down(at.y)), f = at - low;
    const int below = static_cast<int>(low.x) + m_width; // -1 … width before
    const int x = below >= m_width ? below - m_width : below, x1 = x + 1 == m_width ? 0 : x + 1;
    const int y = std::clamp(static_cast<int>(low.y), 0, m_height - 1);
    const int y1 = std::clamp(static_cast<int>(low.y) + 1, 0, m_height - 1);
    return m_scale * glm::mix(glm::mix(texel(x, y), texel(x1, y), f.x),
                              glm::mix(texel(x, y1), texel(x1, y1), f.x), f.y);
}

EnvironmentSampler::Sample EnvironmentSampler::sample(const glm::vec2& u) const {
    Sample result{choose(u), glm::vec3(0.0f)};
    if (result.pdf > 0.0f)
        result.radiance = radiance(result.direction);
    return result;
}

EnvironmentSampler::Search EnvironmentSampler::begin(const glm::vec2& u) const {
    if (!(m_power > 0.0))
        return {};
    const auto [y, fy] = chosen(m_rows.data(), 0, m_height, m_height, u.y);
    // Exact: a power of two.
    const auto guide = static_cast<std::size_t>(u.x * static_cast<float>(m_guided));
    const std::uint16_t* guides =
        m_guides.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(m_guided + 1) +
        guide;
    __builtin_prefetch(guides);
    return {this, u.x, y, fy, guides};
}

void EnvironmentSampler::fetch(const Search& search) {
    if (search.sampler != nullptr)
        __builtin_prefetch(search.sampler->columnsOf(search.row) + search.guide[0]);
}

EnvironmentSampler::Choice EnvironmentSampler::end(const Search& search) {
    return search.sampler != nullptr ? search.sampler->found(search) : Choice{};
}

EnvironmentSampler::Choice EnvironmentSampler::found(const Search& search) const {
    const int y = search.row;
    const auto row = static_cast<std::size_t>(y);
    const float fy = search.inRow;
    const auto [x, fx] = chosen(columnsOf(y), search.guide[0], search.guide[1], m_width, search.u);
    // Wanted a ray later.
    __builtin_prefetch(texelAt(x, y));
    __builtin_prefetch(texelAt(x, std::clamp(fy < 0.5f ? y - 1 : y + 1, 0, m_height - 1)));
    const float up = glm::mix(m_cosines[row], m_cosines[row + 1], fy);
    const float side = std::sqrt(std::max(1.0f - up * up, 0.0f));
    const float phi =
        2.0f * kPi * ((static_cast<float>(x) + fx) / static_cast<float>(m_width) - 0.5f);
    const float px = side * std::sin(phi), pz = -side * std::cos(phi);
    return {{m_cos * px + m_sin * pz, up, m_cos * pz - m_sin * px}, pdfOf(x, y)};
}

const float* EnvironmentSampler::columnsOf(int y) const {
    return m_columns.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width);
}

float EnvironmentSampler::pdf(const glm::vec3& direction) const {
    return pdfAt(pixelOf(direction));
}

float EnvironmentSampler::pdfAt(const glm::vec2& pixel) const {
    if (!(m_power > 0.0))
        return 0.0f;
    return pdfOf(std::clamp(static_cast<int>(pixel.x), 0, m_width - 1),
                 std::clamp(static_cast<int>(pixel.y), 0, m_height - 1));
}

float EnvironmentSampler::pdfOf(int x, int y) const {
    return static_cast<float>(static_cast<double>(share(m_rows.data(), y)) *
                              static_cast<double>(share(columnsOf(y), x)) /
                              m_solidAngles[static_cast<std::size_t>(y)]);
}

} // namespace patina
