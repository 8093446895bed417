#include "app/editor/widget/LobePicture.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PlotStyle.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

namespace patina::editor {
namespace {

constexpr int kOversampling = 2; // edges are smooth after shrinking

struct Projection {
    glm::vec3 right, up, toCamera;
    float scale;
    glm::vec2 origin;

    Projection(const LobeCamera& camera, const QSizeF& pixels) {
        const auto yaw = static_cast<float>(glm::radians(camera.yawDeg));
        const auto elevation = static_cast<float>(glm::radians(camera.elevationDeg));
        toCamera = {std::sin(yaw) * std::cos(elevation), -std::cos(yaw) * std::cos(elevation),
                    std::sin(elevation)};
        right = {std::cos(yaw), std::sin(yaw), 0.0f};
        up = glm::cross(toCamera, right);
        // The disc and all that can stand on it: from its near rim to the farthest of the lobe.
        const float below = std::sin(elevation), above = 1.0f;
        const auto w = static_cast<float>(pixels.width()), h = static_cast<float>(pixels.height());
        scale = 0.92f * std::min(0.5f * w, h / (below + above));
        origin = {0.5f * w, 0.5f * h + 0.5f * scale * (above - below)};
    }
    // Pixels from the top left, and the distance towards the camera.
    [[nodiscard]] glm::vec3 operator()(const glm::vec3& p) const {
        return {origin.x + scale * glm::dot(p, right), origin.y - scale * glm::dot(p, up),
                glm::dot(p, toCamera)};
    }
    [[nodiscard]] QPointF point(const glm::vec3& p) const {
        const glm::vec3 at = (*this)(p);
        return {static_cast<double>(at.x), static_cast<double>(at.y)};
    }
};

// A light from the upper left of the camera, a little of it from everywhere, and a gleam.
glm::vec3 shade(const glm::vec3& color, const glm::vec3& normal, float radius,
                const Projection& view) {
    const glm::vec3 toLight = glm::normalize(view.toCamera + 0.6f * view.up - 0.7f * view.right);
    const glm::vec3 half = glm::normalize(toLight + view.toCamera);
    const float lit = std::max(glm::dot(normal, toLight), 0.0f);
    const float gleam = std::pow(std::max(glm::dot(normal, half), 0.0f), 24.0f);
    // Lines of equal value at every quarter of the radius.
    const float ring = std::abs(radius * 4.0f - std::round(radius * 4.0f)) / 4.0f;
    const float dark =
        radius > 0.06f && radius < 0.985f ? 0.42f * std::exp(-ring * ring * 3e4f) : 0.0f;
    return (color * (0.22f + 0.72f * lit) + glm::vec3(0.16f * gleam)) * (1.0f - dark);
}

void rasterize(QImage& image, const LobeMesh& mesh, const Projection& view) {
    const int width = image.width(), height = image.height();
    std::vector<float> depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                             -std::numeric_limits<float>::infinity());
    std::vector<glm::vec3> points, colors;
    points.reserve(mesh.positions.size());
    colors.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        points.push_back(view(mesh.positions[i]));
        // Towards white: a lobe of deep red must keep its shape.
        colors.push_back(glm::mix(mesh.colors[i], glm::vec3(1.0f), 0.18f) * 0.8f);
    }
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const std::uint32_t corner[3] = {mesh.triangles[i], mesh.triangles[i + 1],
                                         mesh.triangles[i + 2]};
        const glm::vec3 a = points[corner[0]], b = points[corner[1]], c = points[corner[2]];
        const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (std::abs(area) < 1e-9f)
            continue;
        const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
        const int right =
            std::min(width - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
        const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
        const int bottom =
            std::min(height - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
        for (int y = top; y <= bottom; ++y) {
            auto* row = reinterpret_cast<QRgb*>(image.scanLine(y));
            for (int x = left; x <= right; ++x) {
                const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
                const float wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
                const float wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
                const float wa = 1.0f - wb - wc;
                if (wa < 0.0f || wb < 0.0f || wc < 0.0f)
                    continue;
                float& nearest =
                    depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x)];
                const float z = wa * a.z + wb * b.z + wc * c.z;
                if (z <= nearest)
                    continue;
                nearest = z;
                const auto between = [&](const std::vector<glm::vec3>& v) {
                    return wa * v[corner[0]] + wb * v[corner[1]] + wc * v[corner[2]];
                };
                glm::vec3 normal = between(mesh.normals);
                normal = normal / std::max(glm::length(normal), 1e-12f);
                const glm::vec3 color =
                    shading::srgbEncode(shade(between(colors), normal,
                                              glm::length(between(mesh.positions)), view)) *
                        255.0f +
                    0.5f;
                row[x] = qRgb(std::clamp(static_cast<int>(color.r), 0, 255),
                              std::clamp(static_cast<int>(color.g), 0, 255),
                              std::clamp(static_cast<int>(color.b), 0, 255));
            }
        }
    }
}

void paintDisc(QPainter& painter, const Projection& view, QColor ring, double stroke) {
    const auto circle = [&](float radius) {
        QPainterPath path;
        for (int i = 0; i <= 96; ++i) {
            const float a = shading::kTwoPi * static_cast<float>(i) / 96.0f;
            const QPointF at = view.point({radius * std::cos(a), radius * std::sin(a), 0.0f});
            if (i == 0)
                path.moveTo(at);
            else
                path.lineTo(at);
        }
        return path;
    };
    QColor fill(tokens::kRaised);
    fill.setAlpha(150);
    painter.fillPath(circle(1.0f), fill);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(tokens::kHover), stroke));
    for (const float radius : {0.25f, 0.5f, 0.75f})
        painter.drawPath(circle(radius));
    painter.drawLine(view.point({-1, 0, 0}), view.point({1, 0, 0}));
    painter.drawLine(view.point({0, -1, 0}), view.point({0, 1, 0}));
    painter.setPen(QPen(ring, 1.6 * stroke));
    painter.drawPath(circle(1.0f));
    painter.setPen(QPen(QColor(tokens::kTextOff), stroke, Qt::DashLine));
    painter.drawLine(view.point({0, 0, 0}), view.point({0, 0, 1}));
}

void paintLight(QPainter& painter, const Projection& view, const glm::vec3& light, double stroke) {
    const QPointF from = view.point(light), to = view.point(glm::vec3(0.0f));
    const QColor sun(kPlotSun);
    painter.setPen(QPen(sun, 1.6 * stroke));
    painter.drawLine(from, to);
    const QPointF way = to - from;
    const double length = std::hypot(way.x(), way.y());
    if (length > 20.0 * stroke) {
        const QPointF along = way / length, across(-along.y(), along.x());
        const QPointF tip = to - along * 5.0 * stroke;
        QPainterPath head(tip);
        head.lineTo(tip - along * 9.0 * stroke + across * 4.0 * stroke);
        head.lineTo(tip - along * 9.0 * stroke - across * 4.0 * stroke);
        head.closeSubpath();
        painter.fillPath(head, sun);
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(sun);
    painter.drawEllipse(from, 4.5 * stroke, 4.5 * stroke);
}

} // namespace

QImage lobePicture(const LobeMesh& mesh, const LobeCamera& camera, float incidenceRad, QSize pixels,
                   QColor ring, double ratio) {
    const QSize size = pixels * kOversampling;
    if (size.width() < 8 || size.height() < 8)
        return {};
    const Projection view(camera, size);
    QImage lobe(size, QImage::Format_ARGB32_Premultiplied);
    lobe.fill(Qt::transparent);
    rasterize(lobe, mesh, view);

    QImage picture(size, QImage::Format_ARGB32_Premultiplied);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    const double stroke = kOversampling * ratio;
    paintDisc(painter, view, ring, stroke);
    const glm::vec3 light = lensDirection(-incidenceRad), mirror = lensDirection(incidenceRad);
    const bool behind = glm::dot(light, view.toCamera) < glm::dot(mirror, view.toCamera) - 1e-4f;
    if (behind)
        paintLight(painter, view, light, stroke);
    painter.drawImage(0, 0, lobe);
    if (!behind)
        paintLight(painter, view, light, stroke);
    painter.end();
    return picture.scaled(pixels, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

QPointF lobePoint(const LobeCamera& camera, const QSizeF& size, const glm::vec3& p) {
    return Projection(camera, size).point(p);
}

std::optional<glm::vec3> lobeHit(const LobeMesh& mesh, const LobeCamera& camera, const QSizeF& size,
                                 const QPointF& point) {
    const Projection view(camera, size);
    const glm::vec2 at(static_cast<float>(point.x()), static_cast<float>(point.y()));
    std::optional<glm::vec3> nearest;
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        const glm::vec3 &p = mesh.positions[mesh.triangles[i]],
                        &q = mesh.positions[mesh.triangles[i + 1]],
                        &r = mesh.positions[mesh.triangles[i + 2]];
        const glm::vec2 a(view(p)), ab = glm::vec2(view(q)) - a, ac = glm::vec2(view(r)) - a;
        const float twiceArea = ab.x * ac.y - ab.y * ac.x;
        if (std::abs(twiceArea) < 1e-9f)
            continue;
        const glm::vec2 way = at - a;
        const float u = (way.x * ac.y - way.y * ac.x) / twiceArea;
        const float v = (ab.x * way.y - ab.y * way.x) / twiceArea;
        if (u < 0.0f || v < 0.0f || u + v > 1.0f)
            continue;
        const glm::vec3 hit = p + u * (q - p) + v * (r - p);
        if (!nearest || glm::dot(hit, view.toCamera) > glm::dot(*nearest, view.toCamera))
            nearest = hit;
    }
    return nearest;
}

} // namespace patina::editor
