#include "core/light/EnvironmentMapping.h"

#include "core/base/Check.h"
#include "core/base/Limits.h"
#include "core/light/Environment.h"
#include "core/math/Quadrature.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace patina {

namespace {

struct FaceAxes {
    glm::vec3 centre, right, down;
};

// OpenGL 4.6, table 8.19: what a graphics card, and a file named "px", "nx" …, means. In a
// right-handed world these faces are mirrored when they are looked at as pictures.
constexpr std::array<FaceAxes, 6> kOpenGlFaces{{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                                {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                                {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                                {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                                {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                                {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

// As seen from inside, not mirrored: around -Z, +X is on the right. The faces of crosses and of
// OpenEXR (ImfEnvmap.cpp, CubeMap::pixelPosition).
constexpr std::array<FaceAxes, 6> kSeenFaces{{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                              {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                              {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                                              {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                              {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
                                              {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}}};

// Where the faces lie, in faces from the top left.
constexpr std::array<glm::ivec2, 6> kHorizontalCross{
    {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {3, 1}, {1, 1}}};
constexpr std::array<glm::ivec2, 6> kVerticalCross{
    {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 3}, {1, 1}}};

// Columns and rows of faces; 0 × 0 for what has none.
ImageSize facesOf(EnvironmentLayout layout) {
    switch (layout) {
    case EnvironmentLayout::HorizontalCross:
        return {4, 3};
    case EnvironmentLayout::VerticalCross:
        return {3, 4};
    case EnvironmentLayout::HorizontalStrip:
        return {6, 1};
    case EnvironmentLayout::VerticalStrip:
    case EnvironmentLayout::SixFaces:
        return {1, 6};
    case EnvironmentLayout::Automatic:
    case EnvironmentLayout::LatLong:
    case EnvironmentLayout::AngularMap:
    case EnvironmentLayout::MirrorBall:
        break;
    }
    return {0, 0};
}

Error wrongSize(const char* what, const char* proportions, ImageSize size) {
    return {ErrorKind::Usage,
            fmt::format("{} is {}; this picture has {} × {} pixels. Choose another layout", what,
                        proportions, size.width, size.height),
            {},
            {}};
}

// The antiderivative, from a to b, of the solid angle of a disc along the line at distance c from
// its centre: c ∫ F(r) / r² dt, where F = 1 - cos(phi) is the solid angle within radius r, over
// 2pi. By Green's theorem the four edges of a pixel sum to its solid angle, also where the disc
// ends inside of it: there F stays 2.
template <class F>
double edge(double c, double a, double b, const F& inside) {
    if (c == 0.0)
        return 0.0;
    const auto outside = [&](double from, double to) {
        return 2.0 * (std::atan(to / c) - std::atan(from / c));
    };
    if (std::abs(c) >= 1.0)
        return outside(a, b);
    const double rim = std::sqrt(1.0 - c * c);
    const double low = std::clamp(-rim, a, b), high = std::clamp(rim, a, b);
    return outside(a, low) + inside(low, high) + outside(high, b);
}

// Cells of a grid over 0…1: n pixels side by side, or with the outer centres on the border.
std::pair<double, double> cell(int i, int n, bool centresOnBorder) {
    if (!centresOnBorder)
        return {static_cast<double>(i) / n, static_cast<double>(i + 1) / n};
    if (n == 1)
        return {0.0, 1.0};
    return {std::max(0.0, (i - 0.5) / (n - 1)), std::min(1.0, (i + 0.5) / (n - 1))};
}

glm::vec3 read(const Image& picture, int x, int y) {
    const float* sample =
        picture.f32().data() +
        3 * (static_cast<std::size_t>(y) * picture.width() + static_cast<std::size_t>(x));
    return {sample[0], sample[1], sample[2]};
}

} // namespace

Result<EnvironmentMapping> EnvironmentMapping::create(EnvironmentLayout layout, ImageSize size,
                                                      EnvironmentConvention convention) {
    CHECK(layout != EnvironmentLayout::Automatic);
    EnvironmentMapping mapping;
    mapping.m_size = size;
    mapping.m_centresOnBorder = convention == EnvironmentConvention::OpenExr;
    if (layout == EnvironmentLayout::LatLong) {
        mapping.m_halfTurn = mapping.m_centresOnBorder;
        return mapping;
    }
    if (layout == EnvironmentLayout::AngularMap || layout == EnvironmentLayout::MirrorBall) {
        const bool angular = layout == EnvironmentLayout::AngularMap;
        mapping.m_projection = angular ? Projection::Angular : Projection::Ball;
        mapping.m_centresOnBorder = false;
        if (size.width != size.height)
            return wrongSize(angular ? "an angular map" : "a mirror ball", "square", size);
        return mapping;
    }

    mapping.m_projection = Projection::Cube;
    const ImageSize faces = facesOf(layout);
    mapping.m_faceSize = size.width / faces.width;
    if (mapping.m_faceSize * faces.width != size.width ||
        mapping.m_faceSize * faces.height != size.height)
        return wrongSize(layout == EnvironmentLayout::HorizontalCross   ? "a horizontal cross"
                         : layout == EnvironmentLayout::VerticalCross   ? "a vertical cross"
                         : layout == EnvironmentLayout::HorizontalStrip ? "a horizontal strip"
                                                                        : "a vertical strip",
                         faces.width == 4   ? "four faces wide and three high"
                         : faces.width == 3 ? "three faces wide and four high"
                         : faces.width == 6 ? "six times as wide as high"
                                            : "six times as high as wide",
                         size);
    const bool cross = faces.width == 4 || faces.width == 3;
    const auto& axes = cross || mapping.m_centresOnBorder ? kSeenFaces : kOpenGlFaces;
    for (int i = 0; i < 6; ++i) {
        Face& face = mapping.m_faces[i];
        face.centre = axes[i].centre;
        face.right = axes[i].right;
        face.down = axes[i].down;
        const glm::ivec2 place = faces.width == 4   ? kHorizontalCross[i]
                                 : faces.width == 3 ? kVerticalCross[i]
                                 : faces.width == 6 ? glm::ivec2(i, 0)
                                                    : glm::ivec2(0, i);
        face.x = place.x * mapping.m_faceSize;
        face.y = place.y * mapping.m_faceSize;
    }
    if (layout == EnvironmentLayout::VerticalCross) { // the back hangs below the floor, upside down
        mapping.m_faces[4].right = -mapping.m_faces[4].right;
        mapping.m_faces[4].down = -mapping.m_faces[4].down;
    }
    return mapping;
}

ImageSize EnvironmentMapping::imageSize(EnvironmentLayout layout, int size) {
    if (layout == EnvironmentLayout::LatLong)
        return {size, size / 2};
    const ImageSize faces = facesOf(layout);
    return faces.width == 0 ? ImageSize{size, size}
                            : ImageSize{faces.width * size, faces.height * size};
}

ImageSize EnvironmentMapping::latLongSize() const {
    const int width = m_projection == Projection::LatLong ? m_size.width
                      : m_projection == Projection::Cube  ? 4 * m_faceSize
                                                          : 2 * m_size.width;
    return {std::max(2, width / 2 * 2), std::max(1, width / 2)};
}

glm::vec2 EnvironmentMapping::chart(glm::vec2 p) const {
    const bool cube = m_projection == Projection::Cube;
    const glm::vec2 n(cube ? m_faceSize : m_size.width, cube ? m_faceSize : m_size.height);
    if (!m_centresOnBorder)
        return p / n;
    return {n.x > 1.0f ? std::clamp((p.x - 0.5f) / (n.x - 1.0f), 0.0f, 1.0f) : 0.5f,
            n.y > 1.0f ? std::clamp((p.y - 0.5f) / (n.y - 1.0f), 0.0f, 1.0f) : 0.5f};
}

glm::vec2 EnvironmentMapping::pixels(glm::vec2 c) const {
    const bool cube = m_projection == Projection::Cube;
    const glm::vec2 n(cube ? m_faceSize : m_size.width, cube ? m_faceSize : m_size.height);
    return m_centresOnBorder ? c * (n - 1.0f) + 0.5f : c * n;
}

std::optional<EnvironmentMapping::Ray> EnvironmentMapping::ray(glm::vec2 p) const {
    using shading::kPi;
    const auto side = [&](int n) {
        return static_cast<float>(m_centresOnBorder ? std::max(1, n - 1) : n);
    };
    switch (m_projection) {
    case Projection::LatLong: {
        const glm::vec2 uv = chart(p);
        const glm::vec3 d =
            shading::directionFromLatLong({uv.x + (m_halfTurn ? 0.5f : 0.0f), uv.y});
        return Ray{d, 2.0f * kPi * kPi * std::sin(kPi * uv.y) /
                          (side(m_size.width) * side(m_size.height))};
    }
    case Projection::Angular:
    case Projection::Ball: {
        // Debevec: the angle from the front, -Z, grows with the radius. A mirrored ball reflects
        // under twice the angle of its normal, which makes its picture an equal-area map.
        const glm::vec2 uv = chart(p);
        const glm::vec2 rho(2.0f * uv.x - 1.0f, 1.0f - 2.0f * uv.y);
        const float r2 = dot(rho, rho);
        if (r2 > 1.0f)
            return std::nullopt;
        const float area = side(m_size.width) * side(m_size.width);
        if (m_projection == Projection::Ball)
            return Ray{{2.0f * std::sqrt(1.0f - r2) * rho.x, 2.0f * std::sqrt(1.0f - r2) * rho.y,
                        2.0f * r2 - 1.0f},
                       16.0f / area};
        const float phi = kPi * std::sqrt(r2);
        const float sinc = phi < 1e-4f ? 1.0f : std::sin(phi) / phi; // 1 - phi²/6
        return Ray{{kPi * sinc * rho.x, kPi * sinc * rho.y, -std::cos(phi)},
                   4.0f * kPi * kPi * std::max(0.0f, sinc) / area};
    }
    case Projection::Cube:
        break;
    }
    for (const Face& face : m_faces) {
        const glm::vec2 local = p - glm::vec2(face.x, face.y);
        const auto n = static_cast<float>(m_faceSize);
        if (local.x < 0.0f || local.y < 0.0f || local.x > n || local.y > n)
            continue;
        const glm::vec2 ab = 2.0f * chart(local) - 1.0f;
        const glm::vec3 d = face.centre + ab.x * face.right + ab.y * face.down;
        const float r = length(d);
        return Ray{d / r, 4.0f / (side(m_faceSize) * side(m_faceSize) * r * r * r)};
    }
    return std::nullopt; // the corners of a cross
}

glm::vec2 EnvironmentMapping::position(const glm::vec3& d) const {
    switch (m_projection) {
    case Projection::LatLong: {
        const glm::vec2 uv = shading::latLongFromDirection(d);
        if (!m_halfTurn)
            return pixels(uv);
        return pixels({uv.x < 0.5f ? uv.x + 0.5f : uv.x - 0.5f, uv.y});
    }
    case Projection::Angular:
    case Projection::Ball: {
        const float across = std::sqrt(d.x * d.x + d.y * d.y);
        if (across < 1e-12f) // straight ahead is the centre, straight back the whole rim
            return pixels({d.z <= 0.0f ? 0.5f : 1.0f, 0.5f});
        // Radius 0…0.5 over the sine of the angle. |d - z| = 2 sin of half the angle from the back.
        const float scale = m_projection == Projection::Angular
                                ? std::atan2(across, -d.z) / (shading::kTwoPi * across)
                                : 0.5f / length(d - glm::vec3(0.0f, 0.0f, 1.0f));
        return pixels({0.5f + scale * d.x, 0.5f - scale * d.y});
    }
    case Projection::Cube:
        break;
    }
    const int face = faceTowards(d);
    return glm::vec2(m_faces[face].x, m_faces[face].y) + pixels(onFace(face, d));
}

int EnvironmentMapping::faceTowards(const glm::vec3& d) const {
    const glm::vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z)
        return d.x >= 0.0f ? 0 : 1;
    if (a.y >= a.z)
        return d.y >= 0.0f ? 2 : 3;
    return d.z >= 0.0f ? 4 : 5;
}

glm::vec2 EnvironmentMapping::onFace(int index, const glm::vec3& d) const {
    const Face& face = m_faces[index];
    const float scale = 0.5f / dot(d, face.centre);
    return {0.5f + scale * dot(d, face.right), 0.5f + scale * dot(d, face.down)};
}

double EnvironmentMapping::solidAngle(int x, int y) const {
    switch (m_projection) {
    case Projection::LatLong: {
        const auto [u0, u1] = cell(x, m_size.width, m_centresOnBorder);
        const auto [v0, v1] = cell(y, m_size.height, m_centresOnBorder);
        // cos(theta0) - cos(theta1) without cancellation
        return 2.0 * std::numbers::pi * (u1 - u0) * 2.0 *
               std::sin(0.5 * std::numbers::pi * (v0 + v1)) *
               std::sin(0.5 * std::numbers::pi * (v1 - v0));
    }
    case Projection::Angular:
    case Projection::Ball: {
        const double n = m_size.width;
        const double x0 = 2.0 * x / n - 1.0, x1 = 2.0 * (x + 1) / n - 1.0;
        const double y0 = 2.0 * y / n - 1.0, y1 = 2.0 * (y + 1) / n - 1.0;
        // Rounding must not give pixels a share that lie wholly outside.
        const double nearX = std::clamp(0.0, x0, x1), nearY = std::clamp(0.0, y0, y1);
        if (nearX * nearX + nearY * nearY >= 1.0)
            return 0.0;
        static const GaussLegendre quadrature(8);
        const auto line = [&](double c, double a, double b) {
            return edge(c, a, b, [&](double from, double to) {
                if (m_projection == Projection::Ball) // F = 2 r²
                    return 2.0 * c * (to - from);
                double sum = 0.0; // F = 1 - cos(pi r) = 2 sin²(pi r / 2)
                for (int i = 0; i < quadrature.size(); ++i) {
                    const double t = from + (to - from) * quadrature.node01(i);
                    const double r = std::sqrt(c * c + t * t);
                    const double s = std::sin(0.5 * std::numbers::pi * r) / r;
                    sum += quadrature.weight01(i) * 2.0 * s * s;
                }
                return c * (to - from) * sum;
            });
        };
        return std::max(0.0,
                        line(y1, x0, x1) - line(y0, x0, x1) + line(x1, y0, y1) - line(x0, y0, y1));
    }
    case Projection::Cube:
        break;
    }
    for (const Face& face : m_faces) {
        const int i = x - face.x, j = y - face.y;
        if (i < 0 || j < 0 || i >= m_faceSize || j >= m_faceSize)
            continue;
        // Driscoll 2012, "Cubemap Texel Solid Angle": differences at the corners
        const auto [s0, s1] = cell(i, m_faceSize, m_centresOnBorder);
        const auto [t0, t1] = cell(j, m_faceSize, m_centresOnBorder);
        const auto corner = [](double s, double t) {
            const double a = 2.0 * s - 1.0, b = 2.0 * t - 1.0;
            return std::atan2(a * b, std::sqrt(a * a + b * b + 1.0));
        };
        return corner(s0, t0) - corner(s0, t1) - corner(s1, t0) + corner(s1, t1);
    }
    return 0.0;
}

glm::vec3 EnvironmentMapping::lookup(const Image& picture, const glm::vec3& d) const {
    if (m_projection == Projection::Cube)
        return lookupCube(picture, d);
    if (m_projection != Projection::LatLong)
        return lookupDisc(picture, d);
    const int width = m_size.width, height = m_size.height;
    const glm::vec2 p = position(d) - 0.5f;
    const float left = std::floor(p.x), top = std::floor(p.y);
    const float fx = p.x - left, fy = p.y - top;
    const auto row = [&](int y) {
        // Beyond a pole lies the same row, half a turn away.
        const bool beyond = y < 0 || y >= height;
        const int shift = beyond && !m_centresOnBorder ? width / 2 : 0;
        y = std::clamp(y, 0, height - 1);
        const int x = (static_cast<int>(left) + shift + 2 * width) % width;
        return read(picture, x, y) * (1.0f - fx) + read(picture, (x + 1) % width, y) * fx;
    };
    return row(static_cast<int>(top)) * (1.0f - fy) + row(static_cast<int>(top) + 1) * fy;
}

// Pixels whose centre is outside the disc hold nothing that can be relied on.
glm::vec3 EnvironmentMapping::lookupDisc(const Image& picture, const glm::vec3& d) const {
    const float radius = 0.5f * static_cast<float>(m_size.width);
    const glm::vec2 p = position(d) - 0.5f;
    const glm::vec2 base = floor(p), f = p - base;
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    for (int k = 0; k < 4; ++k) {
        const int i = k % 2, j = k / 2;
        const int x = static_cast<int>(base.x) + i, y = static_cast<int>(base.y) + j;
        const glm::vec2 fromCentre = glm::vec2(x, y) + 0.5f - radius;
        if (x < 0 || y < 0 || x >= m_size.width || y >= m_size.height ||
            dot(fromCentre, fromCentre) > radius * radius)
            continue;
        const float weight = (i == 0 ? 1.0f - f.x : f.x) * (j == 0 ? 1.0f - f.y : f.y);
        sum += weight * read(picture, x, y);
        weights += weight;
    }
    if (weights > 1e-4f)
        return sum / weights;
    // On the very rim: the nearest pixel inwards.
    const glm::vec2 inwards = radius + (p + 0.5f - radius) * std::max(0.0f, 1.0f - 1.5f / radius);
    return read(picture, std::clamp(static_cast<int>(inwards.x), 0, m_size.width - 1),
                std::clamp(static_cast<int>(inwards.y), 0, m_size.height - 1));
}

// Beyond the edge of a face its neighbour goes on.
glm::vec3 EnvironmentMapping::texel(const Image& picture, int face, int x, int y) const {
    if (x < 0 || y < 0 || x >= m_faceSize || y >= m_faceSize) {
        const glm::vec2 ab = 2.0f * chart(glm::vec2(x, y) + 0.5f) - 1.0f;
        const glm::vec3 d =
            m_faces[face].centre + ab.x * m_faces[face].right + ab.y * m_faces[face].down;
        face = faceTowards(d);
        const glm::vec2 p = pixels(onFace(face, d));
        x = std::clamp(static_cast<int>(p.x), 0, m_faceSize - 1);
        y = std::clamp(static_cast<int>(p.y), 0, m_faceSize - 1);
    }
    return read(picture, m_faces[face].x + x, m_faces[face].y + y);
}

glm::vec3 EnvironmentMapping::lookupCube(const Image& picture, const glm::vec3& d) const {
    const int face = faceTowards(d);
    const glm::vec2 p = pixels(onFace(face, d)) - 0.5f;
    const glm::vec2 base = floor(p), f = p - base;
    const int x = static_cast<int>(base.x), y = static_cast<int>(base.y);
    return (texel(picture, face, x, y) * (1.0f - f.x) + texel(picture, face, x + 1, y) * f.x) *
               (1.0f - f.y) +
           (texel(picture, face, x, y + 1) * (1.0f - f.x) +
            texel(picture, face, x + 1, y + 1) * f.x) *
               f.y;
}

} // namespace patina
