#include "core/trace/path/EnvironmentSampler.h"

#include "core/base/Check.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <tuple>
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

// Luminance that light is searched by: what is below zero in an image, as where bands of spherical
// harmonics leave it, is found by the surfaces' own rays alone.
float searched(const glm::vec3& radiance) {
    return std::max(shading::luminance(radiance), 0.0f);
}

// A place in 0…1 as likely as a line from `a` to `b` is high there, both >= 0. Pharr, Jakob &
// Humphreys 2023, section A.5.1.
float onLine(float u, float a, float b) {
    if (!(a + b > 0.0f))
        return u;
    return std::min(u * (a + b) / (a + std::sqrt(glm::mix(a * a, b * b, u))), 1.0f);
}

} // namespace

EnvironmentSampler::EnvironmentSampler(const TraceEnvironment& environment)
    : m_image(environment.image)
    , m_scale(environment.scale)
    , m_cos(std::cos(glm::radians(environment.orientation.rotationDeg)))
    , m_sin(std::sin(glm::radians(environment.orientation.rotationDeg)))
    , m_level(environment.orientation.isLevel())
    , m_toPicture(glm::transpose(glm::mat3(environment.orientation.matrix())))
    , m_width(environment.image->width())
    , m_height(environment.image->height()) {
    CHECK(m_image->type() == PixelType::F32 && m_image->channels() >= 3 && m_width <= 0xffff);
    m_texels = m_image->f32().data();
    m_channels = m_image->channels();
    const auto luminance = [&](int x, int y) {
        return static_cast<double>(searched(m_scale * texel(x == m_width ? 0 : x, y)));
    };
    // Rows of squares: a half one from the upper pole to the first texels' centres, then whole
    // ones, and again a half.
    const auto count = static_cast<std::size_t>(m_width);
    const auto edge = [&](int row) {
        return row == 0              ? 0.0
               : row == m_height + 1 ? std::numbers::pi
                                     : std::numbers::pi / m_height * (row - 0.5);
    };
    for (int row = 0; row <= m_height + 1; ++row)
        m_cosines.push_back(static_cast<float>(std::cos(edge(row))));
    m_columns.resize(count * static_cast<std::size_t>(m_height + 1));
    std::vector<double> rows, sums(count);
    for (int row = 0; row <= m_height; ++row) {
        const int above = rowAbove(row), below = rowBelow(row);
        double sum = 0.0;
        for (int x = 0; x < m_width; ++x) {
            sum += 0.25 * (luminance(x, above) + luminance(x + 1, above) + luminance(x, below) +
                           luminance(x + 1, below));
            sums[static_cast<std::size_t>(x)] = sum;
        }
        float* columns = m_columns.data() + static_cast<std::size_t>(row) * count;
        for (std::size_t x = 0; x < count; ++x)
            columns[x] = sum > 0.0 ? static_cast<float>(sums[x] / sum) : 0.0f;
        m_power += sum * 2.0 * std::numbers::pi / m_width *
                   (std::cos(edge(row)) - std::cos(edge(row + 1)));
        rows.push_back(m_power);
    }
    glm::dvec3 mean(0.0);
    const double step = std::numbers::pi / m_height;
    for (int y = 0; y < m_height; ++y) {
        glm::dvec3 row(0.0);
        for (int x = 0; x < m_width; ++x)
            row += glm::dvec3(m_scale * texel(x, y));
        mean += row * (std::cos(step * y) - std::cos(step * (y + 1))) / (2.0 * m_width);
    }
    m_mean = glm::vec3(mean);
    if (m_power > 0.0)
        m_perPower = static_cast<float>(1.0 / m_power);
    for (const double power : rows)
        m_rows.push_back(m_power > 0.0 ? static_cast<float>(power / m_power) : 0.0f);
    makeGuides();
}

void EnvironmentSampler::makeGuides() {
    // Four columns for each: as many as lie in a line of memory or two.
    m_guided = std::max(static_cast<int>(std::bit_ceil(static_cast<unsigned>(m_width))) / 4, 1);
    m_guides.reserve(static_cast<std::size_t>(m_height + 1) *
                     static_cast<std::size_t>(m_guided + 1));
    for (int y = 0; y <= m_height; ++y) {
        const float* columns = columnsOf(y);
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

glm::vec3 EnvironmentSampler::toPicture(const glm::vec3& direction) const {
    if (!m_level)
        return m_toPicture * direction;
    // The environment is rotated counter-clockwise seen from above: what is looked up, back.
    return {m_cos * direction.x - m_sin * direction.z, direction.y,
            m_sin * direction.x + m_cos * direction.z};
}

EnvironmentSampler::Place EnvironmentSampler::placeOf(const glm::vec3& inPicture) const {
    const float u = 0.5f + std::atan2(inPicture.x, -inPicture.z) / (2.0f * kPi);
    const float v = std::acos(std::clamp(inPicture.y, -1.0f, 1.0f)) / kPi;
    // In texels, from half a texel before the first centre on: whole numbers are centres.
    const float x = u * static_cast<float>(m_width) + 0.5f;
    const float y = v * static_cast<float>(m_height) + 0.5f;
    const int column = static_cast<int>(x), row = std::min(static_cast<int>(y), m_height);
    return {column == 0 ? m_width - 1 : std::min(column, m_width) - 1, row,
            std::min(x - static_cast<float>(column), 1.0f),
            std::min(y - static_cast<float>(row), 1.0f)};
}

EnvironmentSampler::Square EnvironmentSampler::squareAt(const Place& place) const {
    const int right = place.column + 1 == m_width ? 0 : place.column + 1;
    const int above = rowAbove(place.row), below = rowBelow(place.row);
    return {m_scale * glm::mix(texel(place.column, above), texel(right, above), place.x),
            m_scale * glm::mix(texel(place.column, below), texel(right, below), place.x)};
}

glm::vec3 EnvironmentSampler::radiance(const glm::vec3& direction) const {
    const Place place = placeOf(toPicture(direction));
    const Square square = squareAt(place);
    return glm::mix(square.above, square.below, place.y);
}

EnvironmentSampler::Lookup EnvironmentSampler::lookUp(const glm::vec3& direction) const {
    const glm::vec3 inPicture = toPicture(direction);
    const Place place = placeOf(inPicture);
    const Square square = squareAt(place);
    return {glm::mix(square.above, square.below, place.y), pdfOf(square, place.row, inPicture.y)};
}

// Within a square density goes linearly with the cosine to the pole, by which solid angle goes;
// radiance does with the angle.
float EnvironmentSampler::pdfOf(const Square& square, int row, float up) const {
    const auto at = static_cast<std::size_t>(row);
    const float down =
        std::clamp((m_cosines[at] - up) / (m_cosines[at] - m_cosines[at + 1]), 0.0f, 1.0f);
    return glm::mix(searched(square.above), searched(square.below), down) * m_perPower;
}

EnvironmentSampler::Search EnvironmentSampler::begin(const glm::vec2& u) const {
    if (!(m_power > 0.0))
        return {};
    const int rows = m_height + 1;
    const auto [y, fy] = chosen(m_rows.data(), 0, rows, rows, u.y);
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

EnvironmentSampler::Search EnvironmentSampler::find(const Search& search) {
    if (search.sampler == nullptr)
        return search;
    const EnvironmentSampler& sampler = *search.sampler;
    Search found = search;
    std::tie(found.column, found.inColumn) = chosen(sampler.columnsOf(search.row), search.guide[0],
                                                    search.guide[1], sampler.m_width, search.u);
    __builtin_prefetch(sampler.texelAt(found.column, sampler.rowAbove(search.row)));
    __builtin_prefetch(sampler.texelAt(found.column, sampler.rowBelow(search.row)));
    return found;
}

EnvironmentSampler::Sample EnvironmentSampler::end(const Search& search) {
    return search.sampler != nullptr ? search.sampler->found(search) : Sample{};
}

EnvironmentSampler::Sample EnvironmentSampler::found(const Search& search) const {
    const int x = search.column, right = x + 1 == m_width ? 0 : x + 1;
    const int above = rowAbove(search.row), below = rowBelow(search.row);
    const auto row = static_cast<std::size_t>(search.row);
    const glm::vec3 aboveLeft = m_scale * texel(x, above),
                    aboveRight = m_scale * texel(right, above);
    const glm::vec3 belowLeft = m_scale * texel(x, below),
                    belowRight = m_scale * texel(right, below);
    const glm::vec2 left(searched(aboveLeft), searched(belowLeft));
    const glm::vec2 other(searched(aboveRight), searched(belowRight));
    const float down = onLine(search.inRow, left.x + other.x, left.y + other.y);
    const float across =
        onLine(search.inColumn, glm::mix(left.x, left.y, down), glm::mix(other.x, other.y, down));

    const float up = glm::mix(m_cosines[row], m_cosines[row + 1], down);
    const float side = std::sqrt(std::max(1.0f - up * up, 0.0f));
    const float phi =
        2.0f * kPi * ((static_cast<float>(x) + 0.5f + across) / static_cast<float>(m_width) - 0.5f);
    const float px = side * std::sin(phi), pz = -side * std::cos(phi);
    const Square square{glm::mix(aboveLeft, aboveRight, across),
                        glm::mix(belowLeft, belowRight, across)};
    // By the angle, as radiance() has it.
    const float y = std::acos(std::clamp(up, -1.0f, 1.0f)) / kPi * static_cast<float>(m_height) +
                    0.5f - static_cast<float>(search.row);
    const glm::vec3 direction =
        m_level ? glm::vec3(m_cos * px + m_sin * pz, up, m_cos * pz - m_sin * px)
                : glm::vec3(px, up, pz) * m_toPicture; // by its transpose
    return {direction, pdfOf(square, search.row, up),
            glm::mix(square.above, square.below, std::clamp(y, 0.0f, 1.0f))};
}

const float* EnvironmentSampler::columnsOf(int y) const {
    return m_columns.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width);
}

float EnvironmentSampler::pdf(const glm::vec3& direction) const {
    const glm::vec3 inPicture = toPicture(direction);
    const Place place = placeOf(inPicture);
    return pdfOf(squareAt(place), place.row, inPicture.y);
}

} // namespace patina
