#include "core/library/Lathe.h"

#include "core/base/Check.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina::library {

namespace {

void fillLengths(Profile& profile) {
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const double dr = profile[i].radius - profile[i - 1].radius;
        const double dh = profile[i].height - profile[i - 1].height;
        profile[i].length = profile[i - 1].length + std::sqrt(dr * dr + dh * dh);
    }
}

void addStraight(Profile& profile, glm::dvec2 from, glm::dvec2 to, double maxStep) {
    const glm::dvec2 d = to - from;
    const double length = glm::length(d);
    if (length < 1e-9)
        return;
    const int steps = std::max(1, static_cast<int>(length / maxStep + 0.999));
    const glm::dvec2 t = d / length;
    for (int i = 0; i <= steps; ++i) {
        const glm::dvec2 p = from + d * (static_cast<double>(i) / steps);
        if (!profile.empty() &&
            glm::length(p - glm::dvec2(profile.back().radius, profile.back().height)) < 1e-9)
            continue; // the arc before ended here, with the same normal
        profile.push_back({p.x, p.y, t.y, -t.x});
    }
}

} // namespace

Profile roundedProfile(std::span<const ProfileCorner> corners, double maxStep, double arcStepDeg) {
    Profile profile;
    glm::dvec2 previous(corners[0].radius, corners[0].height);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::dvec2 p(corners[i].radius, corners[i].height);
        const glm::dvec2 in =
            glm::normalize(p - glm::dvec2(corners[i - 1].radius, corners[i - 1].height));
        const glm::dvec2 out =
            glm::normalize(glm::dvec2(corners[i + 1].radius, corners[i + 1].height) - p);

        // The arc touches both sides at distance r tan(turn / 2) from the corner.
        const double cosTurn = std::clamp(glm::dot(in, out), -1.0, 1.0);
        const double turn = acosPortable(cosTurn);
        const double reach = corners[i].fillet * std::sqrt((1.0 - cosTurn) / (1.0 + cosTurn));
        CHECK(glm::dot(p - previous, in) >= reach); // the fillets of neighbours must not meet
        const glm::dvec2 start = p - in * reach, end = p + out * reach;
        addStraight(profile, previous, start, maxStep);
        const double side = in.x * out.y - in.y * out.x > 0.0 ? 1.0 : -1.0; // left or right turn
        const glm::dvec2 toCenter = glm::dvec2(-in.y, in.x) * side;
        const glm::dvec2 center = start + toCenter * corners[i].fillet;
        const int steps = std::max(1, static_cast<int>(turn * 180.0 / kPi / arcStepDeg + 0.999));
        for (int k = 1; k < steps; ++k) {
            const double a = turn * k / steps;
            const double c = cosRad(a), s = sinRad(a);
            const glm::dvec2 tangent = in * c + toCenter * s;
            const glm::dvec2 q =
                center - toCenter * (corners[i].fillet * c) + in * (corners[i].fillet * s);
            profile.push_back({q.x, q.y, tangent.y, -tangent.x});
        }
        if (corners[i].fillet > 0.0)
            profile.push_back({end.x, end.y, out.y, -out.x});
        previous = end;
    }
    addStraight(profile, previous, {corners.back().radius, corners.back().height}, maxStep);
    fillLengths(profile);
    return profile;
}

Profile sphereProfile(double radius, int rings) {
    Profile profile;
    for (int i = 0; i <= rings; ++i) {
        const double turns = 0.5 * i / rings;
        const double r = i == 0 || i == rings ? 0.0 : sinTurns(turns), h = -cosTurns(turns);
        profile.push_back({radius * r, radius * h, r, h, radius * kPi * i / rings});
    }
    return profile;
}

void finishSmoothProfile(Profile& profile) {
    fillLengths(profile);
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const ProfilePoint& a = profile[i == 0 ? 0 : i - 1];
        const ProfilePoint& b = profile[std::min(i + 1, profile.size() - 1)];
        // The tangent of the parabola through three unevenly spaced points.
        const double before = profile[i].length - a.length, after = b.length - profile[i].length;
        const bool inside = before > 0.0 && after > 0.0;
        const double scaleA = inside ? after / before : 1.0;
        const double scaleB = inside ? before / after : 1.0;
        const double dr =
            (profile[i].radius - a.radius) * scaleA + (b.radius - profile[i].radius) * scaleB;
        const double dh =
            (profile[i].height - a.height) * scaleA + (b.height - profile[i].height) * scaleB;
        const double length = std::sqrt(dr * dr + dh * dh);
        profile[i].normalRadius = dh / length;
        profile[i].normalHeight = -dr / length;
        if (profile[i].radius < 1e-9) { // on the axis the surface is level
            profile[i].normalRadius = 0.0;
            profile[i].normalHeight = profile[i].normalHeight < 0.0 ? -1.0 : 1.0;
        }
    }
}

void addLathe(Mesh& mesh, const Profile& profile, std::size_t first, std::size_t last, int segments,
              const Chart& chart, const Placement& placement) {
    CHECK_LT(first, last);
    CHECK_LT(last, profile.size());
    const bool disc = chart.kind == Chart::Kind::Disc;
    const bool innerIsFirst = profile[first].radius < profile[last].radius;
    const double range = profile[last].length - profile[first].length;
    // A disc seen from outside is not mirrored: on surfaces that face down v grows the other way.
    const ProfilePoint& inner = profile[innerIsFirst ? first : last];
    const double facing = inner.normalHeight >= 0.0 ? 1.0 : -1.0;

    struct Row {
        std::uint32_t start = 0;
        // 1: the axis of a disc; segments: the axis of a strip, or no seam; segments + 1: a seam
        std::uint32_t count = 0;
        bool axis = false;
        [[nodiscard]] std::uint32_t at(int i) const {
            return start + (count == 1 ? 0 : static_cast<std::uint32_t>(i) % count);
        }
    };
    std::vector<Row> rows;
    for (std::size_t j = first; j <= last; ++j) {
        const ProfilePoint& p = profile[j];
        Row row;
        row.start = static_cast<std::uint32_t>(mesh.positions.size());
        row.axis = p.radius < 1e-9;
        row.count = disc ? (row.axis ? 1u : static_cast<std::uint32_t>(segments))
                         : static_cast<std::uint32_t>(segments) + (row.axis ? 0u : 1u);
        for (std::uint32_t i = 0; i < row.count; ++i) {
            // The seam's two columns share one angle, so that they share positions exactly.
            const double turns =
                static_cast<double>(i % static_cast<std::uint32_t>(segments)) / segments;
            const double s = sinTurns(turns), c = cosTurns(turns);
            const double radius = row.axis ? 0.0 : p.radius;
            const glm::dvec3 position(radius * s, p.height, radius * c);
            const glm::dvec3 normal(p.normalRadius * s, p.normalHeight, p.normalRadius * c);
            mesh.positions.push_back(glm::vec3(placement.rotation * position + placement.offset));
            mesh.normals.push_back(glm::vec3(glm::normalize(placement.rotation * normal)));
            glm::dvec2 uv;
            if (disc) {
                const double distance =
                    chart.startDistance + (innerIsFirst ? p.length - profile[first].length
                                                        : profile[last].length - p.length);
                uv = chart.origin +
                     glm::dvec2(s, facing * c) * ((row.axis ? 0.0 : distance) * chart.scale);
            } else {
                const double column = (row.axis ? i + 0.5 : i) / static_cast<double>(segments);
                const double t = (p.length - profile[first].length) / range;
                uv = chart.origin + chart.size * glm::dvec2(std::min(column, 1.0), 1.0 - t);
            }
            mesh.uvs.push_back(glm::vec2(uv));
        }
        rows.push_back(row);
    }
    for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
        const Row& a = rows[j];
        const Row& b = rows[j + 1];
        for (int i = 0; i < segments; ++i) {
            if (!a.axis)
                mesh.indices.insert(mesh.indices.end(),
                                    {a.at(i), a.at(i + 1), b.at(b.axis ? i : i + 1)});
            if (!b.axis)
                mesh.indices.insert(mesh.indices.end(), {a.at(i), b.at(i + 1), b.at(i)});
        }
    }
}

} // namespace patina::library
