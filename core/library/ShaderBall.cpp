// The shader ball: a hollow ball whose opening shows an inner core, on a stepped stand. Every edge
// is rounded, so that it catches a highlight; grooves, the opening and the stand's overhangs show
// self-shadowing. UV charts meet in the grooves and their poles lie where nobody looks.
#include "core/library/Directions.h"
#include "core/library/Lathe.h"
#include "core/library/Meshes.h"
#include "core/material/Material.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina::library {

namespace {

constexpr double kRadius = 0.55, kShell = 0.048, kCoreRadius = 0.37;
constexpr glm::dvec3 kCenter(0.0, 0.765, 0.0);
constexpr double kFloorTop = 0.04, kFloorRadius = 0.64;
// The opening faces the right-hand side of the default camera (azimuth 30°), tilted up.
constexpr double kOpeningAzimuth = 72.0, kOpeningElevation = 28.0, kOpeningDeg = 35.0;

struct Groove {
    double deg, halfWidthDeg, depth; // from the opening's axis; metres
};
constexpr std::array<Groove, 4> kGrooves = {
    {{44.0, 0.9, 0.008}, {60.0, 1.7, 0.018}, {124.0, 1.7, 0.018}, {140.0, 0.9, 0.008}}};
constexpr double kFrontChartDeg = 60.0, kBackChartDeg = 124.0;

double outerRadius(double deg) {
    double radius = kRadius;
    for (const Groove& g : kGrooves) {
        const double t = std::fabs(deg - g.deg) / g.halfWidthDeg;
        const double wall = std::clamp((1.0 - t) / 0.55, 0.0, 1.0);
        radius -= g.depth * wall * wall * wall * (wall * (wall * 6.0 - 15.0) + 10.0);
    }
    return radius;
}

// Angles at which the outside is sampled: even steps, and fine ones across each groove.
std::vector<double> outerAngles() {
    std::vector<double> result;
    const auto nearGroove = [](double deg) {
        return std::any_of(kGrooves.begin(), kGrooves.end(), [deg](const Groove& g) {
            return std::fabs(deg - g.deg) < g.halfWidthDeg * 1.3;
        });
    };
    for (int i = 0; i <= 54; ++i)
        if (const double deg = 180.0 + (kOpeningDeg - 180.0) * i / 54.0; !nearGroove(deg))
            result.push_back(deg);
    for (const Groove& g : kGrooves)
        for (const double t : {0.0, 0.45, 0.52, 0.58, 0.64, 0.70, 0.76, 0.82, 0.88, 0.95, 1.08})
            for (const double side : {-1.0, 1.0})
                if (t > 0.0 || side > 0.0)
                    result.push_back(g.deg + side * t * g.halfWidthDeg);
    std::sort(result.begin(), result.end(), std::greater<>());
    return result;
}

// From the pole behind along the outside to the rim, around it, and back along the inside.
Profile ballProfile() {
    Profile profile;
    const auto add = [&](double radius, double deg) {
        const double turns = deg / 360.0;
        profile.push_back(
            {deg >= 180.0 ? 0.0 : radius * sinTurns(turns), radius * cosTurns(turns)});
    };
    for (const double deg : outerAngles())
        add(outerRadius(deg), deg);
    constexpr double kRim = 0.5 * kShell;
    const double turns = kOpeningDeg / 360.0;
    const glm::dvec2 radial(sinTurns(turns), cosTurns(turns)), inward(-radial.y, radial.x);
    for (int i = 1; i < 12; ++i) {
        const double a = 0.5 * i / 12.0;
        const glm::dvec2 p =
            radial * (kRadius - kRim) + (radial * cosTurns(a) + inward * sinTurns(a)) * kRim;
        profile.push_back({p.x, p.y});
    }
    for (int i = 0; i <= 24; ++i)
        add(kRadius - kShell, kOpeningDeg + (180.0 - kOpeningDeg) * i / 24.0);
    finishSmoothProfile(profile);
    return profile;
}

std::size_t nearest(const Profile& profile, double radius, double height) {
    const auto distance = [&](const ProfilePoint& p) {
        return (p.radius - radius) * (p.radius - radius) +
               (p.height - height) * (p.height - height);
    };
    return static_cast<std::size_t>(
        std::min_element(profile.begin(), profile.end(),
                         [&](const ProfilePoint& a, const ProfilePoint& b) {
                             return distance(a) < distance(b);
                         }) -
        profile.begin());
}

Chart strip(double u, double v, double width, double height) {
    return {Chart::Kind::Strip, {u, v}, {width, height}, 1.0, 0.0};
}
Chart disc(double u, double v, double scale, double startDistance) {
    return {Chart::Kind::Disc, {u, v}, {1.0, 1.0}, scale, startDistance};
}

// The lathe's Y axis becomes `axis`; its seam (+Z) turns away from the default camera.
Placement placed(const glm::dvec3& axis, const glm::dvec3& offset) {
    const glm::dvec3 x = glm::normalize(glm::cross(-directionFromAngles(30.0, 15.0), axis));
    return {glm::dmat3(-x, axis, glm::cross(-x, axis)), offset};
}

constexpr int kBallSegments = 160;

Placement ballPlacement() {
    return placed(directionFromAngles(kOpeningAzimuth, kOpeningElevation), kCenter);
}

// The innermost point of the rim: outside it is painted, inside it is lined.
std::size_t rimOf(const Profile& profile) {
    const double turns = kOpeningDeg / 360.0, middle = kRadius - 0.5 * kShell;
    return nearest(profile, middle * sinTurns(turns) - 0.5 * kShell * cosTurns(turns),
                   middle * cosTurns(turns) + 0.5 * kShell * sinTurns(turns));
}

Mesh ball() {
    const Profile profile = ballProfile();
    const auto onOutside = [&](double deg) {
        const double r = outerRadius(deg);
        return nearest(profile, r * sinTurns(deg / 360.0), r * cosTurns(deg / 360.0));
    };
    const std::size_t back = onOutside(kBackChartDeg), front = onOutside(kFrontChartDeg);

    // The belt goes once around u; all charts share its texel density.
    const double scale = 1.0 / (2.0 * kPi * kRadius);
    const double beltHeight = (profile[front].length - profile[back].length) * scale;
    Mesh mesh;
    const auto add = [&](std::size_t first, std::size_t last, const Chart& chart) {
        addLathe(mesh, profile, first, last, kBallSegments, chart, ballPlacement());
    };
    add(back, front, strip(0.0, 0.004, 1.0, beltHeight));
    add(front, rimOf(profile), disc(0.185, 0.42, scale, 0.297));
    add(0, back, disc(0.54, 0.42, scale, 0.0));
    return mesh;
}

// The inside of the shell, from the rim to the pole; it closes the ball.
Mesh liner() {
    const Profile profile = ballProfile();
    Mesh mesh;
    addLathe(mesh, profile, rimOf(profile), profile.size() - 1, kBallSegments,
             disc(0.5, 0.5, 0.375, 0.0), ballPlacement());
    return mesh;
}

// What the opening shows, and the ring that carries the ball.
Mesh core() {
    Mesh mesh;
    constexpr int kRings = 48;
    const Profile sphere = sphereProfile(kCoreRadius, kRings);
    // Its poles point sideways, where the shell hides them.
    const glm::dvec3 opening = directionFromAngles(kOpeningAzimuth, kOpeningElevation);
    const glm::dvec3 side = glm::normalize(glm::cross(opening, glm::dvec3(0.0, 1.0, 0.0)));
    addLathe(mesh, sphere, 0, kRings, 2 * kRings, strip(0.0, 0.004, 1.0, 0.5),
             {glm::dmat3(glm::cross(side, -opening), side, -opening), kCenter});

    constexpr double kTube = 0.024;
    constexpr double kContactTurns = 40.0 / 360.0; // from straight down
    const double major = (kRadius + kTube) * sinTurns(kContactTurns);
    const double height = kCenter.y - (kRadius + kTube) * cosTurns(kContactTurns);
    Profile ring;
    constexpr int kRingSteps = 16;
    for (int i = 0; i <= kRingSteps; ++i) {
        const double a = static_cast<double>(i % kRingSteps) / kRingSteps;
        // Upwards on the outside: the seam lies inside.
        const double r = -cosTurns(a), h = -sinTurns(a);
        ring.push_back(
            {major + kTube * r, height + kTube * h, r, h, 2.0 * kPi * kTube * i / kRingSteps});
    }
    addLathe(mesh, ring, 0, kRingSteps, 160, strip(0.0, 0.52, 1.0, 0.07),
             placed({0.0, 1.0, 0.0}, {}));
    return mesh;
}

Mesh stand() {
    constexpr int kSegments = 128;
    const double y = kFloorTop + 0.0005; // stands free of the floor by half a millimetre
    // The collar's seat follows the ball from below at a distance of 12 mm.
    const auto seat = [](double deg, double fillet) {
        const double distance = kRadius + 0.012, turns = deg / 360.0;
        return ProfileCorner{distance * sinTurns(turns), kCenter.y - distance * cosTurns(turns),
                             fillet};
    };
    const std::array<ProfileCorner, 23> corners = {{{0.0, y},
                                                    {0.400, y, 0.006},
                                                    {0.400, 0.062, 0.006},
                                                    {0.380, 0.073, 0.006},
                                                    {0.380, 0.098, 0.010},
                                                    {0.352, 0.112, 0.010},
                                                    {0.262, 0.112, 0.012},
                                                    {0.262, 0.134, 0.008},
                                                    {0.246, 0.144, 0.008},
                                                    {0.170, 0.146, 0.022},
                                                    {0.138, 0.168, 0.016},
                                                    {0.140, 0.192, 0.010},
                                                    {0.230, 0.212, 0.030},
                                                    {0.388, 0.284, 0.012},
                                                    {0.402, 0.292, 0.005},
                                                    {0.402, 0.316, 0.007},
                                                    {0.388, 0.327, 0.007},
                                                    {0.336, 0.327, 0.006},
                                                    seat(34.0, 0.010),
                                                    seat(24.0, 0.100),
                                                    seat(14.0, 0.100),
                                                    seat(5.0, 0.050),
                                                    {0.0, kCenter.y - kRadius - 0.0115}}};
    const Profile profile = roundedProfile(corners, 0.03, 15.0);
    const auto at = [&](double r, double h) { return nearest(profile, r, h); };
    const std::size_t foot = at(0.400, y), tread = at(0.366, 0.105), riser = at(0.262, 0.112);
    const std::size_t top = at(0.254, 0.140), neck = at(0.160, 0.150), cone = at(0.143, 0.194);
    const std::size_t edge = at(0.397, 0.290), dish = at(0.392, 0.323);

    const double scale = 0.39; // UV per metre
    const auto height = [&](std::size_t a, std::size_t b) {
        return (profile[b].length - profile[a].length) * scale;
    };
    const auto around = [&](double radius) { return std::min(1.0, 2.0 * kPi * radius * scale); };
    const Placement placement = placed({0.0, 1.0, 0.0}, {});
    Mesh mesh;
    const auto add = [&](std::size_t a, std::size_t b, const Chart& chart) {
        addLathe(mesh, profile, a, b, kSegments, chart, placement);
    };
    add(0, foot, disc(0.36, 0.70, 0.5 * scale, 0.0));
    add(foot, tread, strip(0.005, 0.01, around(0.400), height(foot, tread)));
    add(tread, riser, disc(0.155, 0.36, scale, 0.262));
    add(riser, top, strip(0.01, 0.125, around(0.262), height(riser, top)));
    add(top, neck, disc(0.12, 0.70, scale, 0.160));
    add(neck, cone, strip(0.66, 0.125, around(0.135), height(neck, cone)));
    add(cone, edge, disc(0.48, 0.36, scale, 0.142));
    add(edge, dish, strip(0.005, 0.075, around(0.402), height(edge, dish)));
    add(dish, profile.size() - 1, disc(0.82, 0.38, 0.95 * scale, 0.0));
    return mesh;
}

Mesh floorDisc() {
    const std::array<ProfileCorner, 5> corners = {{{0.0, 0.0},
                                                   {kFloorRadius, 0.0, 0.006},
                                                   {kFloorRadius, kFloorTop, 0.014},
                                                   {0.30, kFloorTop, 0.0},
                                                   {0.0, kFloorTop}}};
    const Profile profile = roundedProfile(corners, 0.03, 9.0);
    const std::size_t low = nearest(profile, kFloorRadius, 0.008);
    const std::size_t high = nearest(profile, kFloorRadius, kFloorTop - 0.014);
    Mesh mesh;
    const Placement placement = placed({0.0, 1.0, 0.0}, {});
    const double scale = 0.44 / kFloorRadius;
    addLathe(mesh, profile, 0, low, 128, disc(0.945, 0.945, 0.045 / kFloorRadius, 0.0), placement);
    addLathe(mesh, profile, low, high, 128, strip(0.0, 0.004, 1.0, 0.012), placement);
    addLathe(mesh, profile, high, profile.size() - 1, 128, disc(0.47, 0.48, scale, 0.0), placement);
    return mesh;
}

} // namespace

std::vector<ModelPart> shaderBall() {
    Material ground;
    ground.name = "Floor";
    ground.baseColor = glm::vec3(0.055f);
    ground.perceptualRoughness = 0.34f;
    Material coreGold = materialNamed("Core", "gold", {4.0f, 4.0f});
    coreGold.normalStrength = 0.35f; // the core is small: its hammering would look like facets
    return {makePart("Ball", ball(), materialNamed("Ball", "worn-painted-metal", {4.0f, 4.0f})),
            makePart("Core", core(), coreGold),
            makePart("Stand", stand(), materialNamed("Stand", "rough-plastic", {5.0f, 5.0f})),
            makePart("Liner", liner(), materialNamed("Liner", "rough-plastic", {5.0f, 5.0f})),
            makePart("Floor", floorDisc(), ground)};
}

} // namespace patina::library
