// Where each layout puts a direction, and how much of the sphere a pixel covers.
#include "core/light/EnvironmentMapping.h"
#include "core/document/Document.h"
#include "core/light/Cubemap.h"

#include <OpenEXR/ImfEnvmap.h>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace patina {
namespace {

using L = EnvironmentLayout;
using C = EnvironmentConvention;

using std::numbers::pi;

struct Kind {
    L layout;
    C convention = C::Common;
};
const Kind kKinds[] = {
    {L::LatLong},         {L::LatLong, C::OpenExr}, {L::AngularMap},
    {L::MirrorBall},      {L::HorizontalCross},     {L::VerticalCross},
    {L::HorizontalStrip}, {L::VerticalStrip},       {L::VerticalStrip, C::OpenExr},
    {L::SixFaces}};

EnvironmentMapping mapping(Kind kind, int size) {
    auto result = EnvironmentMapping::create(
        kind.layout, EnvironmentMapping::imageSize(kind.layout, size), kind.convention);
    EXPECT_TRUE(result.ok());
    return *result;
}

std::string nameOf(Kind kind) {
    return "layout " + std::to_string(static_cast<int>(kind.layout)) +
           (kind.convention == C::OpenExr ? ", OpenEXR" : "");
}

// Position as a share of the picture, v downwards.
glm::vec2 at(L layout, const glm::vec3& d) {
    const EnvironmentMapping map = mapping({layout}, 512);
    return map.position(d) / glm::vec2(map.size().width, map.size().height);
}

const glm::vec3 kA = glm::vec3(0.2672612419124244f, 0.5345224838248488f, 0.8017837257372732f);
const glm::vec3 kB = glm::vec3(-0.6666666666666666f, 0.3333333333333333f, -0.6666666666666666f);

void expectAt(glm::vec2 actual, double u, double v) {
    EXPECT_NEAR(actual.x, u, 1e-6);
    EXPECT_NEAR(actual.y, v, 1e-6);
}

// USC's high-resolution probes: u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi.
TEST(EnvironmentMapping, LatLongHasMinusZInTheMiddle) {
    expectAt(at(L::LatLong, {1, 0, 0}), 0.75, 0.5);
    expectAt(at(L::LatLong, {-1, 0, 0}), 0.25, 0.5);
    expectAt(at(L::LatLong, {0, 1, 0}), 0.5, 0.0);
    expectAt(at(L::LatLong, {0, -1, 0}), 0.5, 1.0);
    expectAt(at(L::LatLong, {0, 0, 1}), 1.0, 0.5);
    expectAt(at(L::LatLong, {0, 0, -1}), 0.5, 0.5);
    expectAt(at(L::LatLong, kA), 0.948791808825, 0.320491482014);
    expectAt(at(L::LatLong, kB), 0.375, 0.391826552031);
    const auto ray = mapping({L::LatLong}, 512).ray({0.75f * 512, 0.25f * 256});
    ASSERT_TRUE(ray);
    EXPECT_NEAR(ray->direction.x, 0.707106781187, 1e-6);
    EXPECT_NEAR(ray->direction.y, 0.707106781187, 1e-6);
    EXPECT_NEAR(ray->direction.z, 0.0, 1e-6);
}

// Debevec's formula with acos(-z), as the photographs are: u = 0.5 + x r, v upwards.
TEST(EnvironmentMapping, AngularMapHasMinusZInTheMiddle) {
    expectAt(at(L::AngularMap, {1, 0, 0}), 0.75, 0.5);
    expectAt(at(L::AngularMap, {-1, 0, 0}), 0.25, 0.5);
    expectAt(at(L::AngularMap, {0, 1, 0}), 0.5, 1.0 - 0.75);
    expectAt(at(L::AngularMap, {0, -1, 0}), 0.5, 1.0 - 0.25);
    expectAt(at(L::AngularMap, {0, 0, -1}), 0.5, 0.5);
    expectAt(at(L::AngularMap, kA), 0.678016818711, 1.0 - 0.856033637422);
    expectAt(at(L::AngularMap, kB), 0.38027176477, 1.0 - 0.559864117615);
    EXPECT_NEAR(glm::length(at(L::AngularMap, {0, 0, 1}) - 0.5f), 0.5, 1e-6);
    // As the formula is published, with acos(z), it is ours of the mirrored direction.
    const auto published = [](const glm::vec3& d) {
        return at(L::AngularMap, d * glm::vec3(1, 1, -1));
    };
    expectAt(published({1, 0, 0}), 0.75, 0.5);
    expectAt(published({-1, 0, 0}), 0.25, 0.5);
    expectAt(published({0, 1, 0}), 0.5, 1.0 - 0.75);
    expectAt(published({0, -1, 0}), 0.5, 1.0 - 0.25);
    expectAt(published({0, 0, 1}), 0.5, 0.5);
    expectAt(published(kA), 0.545589979039, 1.0 - 0.591179958078);
    expectAt(published(kB), 0.17251463973, 1.0 - 0.663742680135);
    EXPECT_NEAR(glm::length(published({0, 0, -1}) - 0.5f), 0.5, 1e-6);
    const EnvironmentMapping map = mapping({L::AngularMap}, 512);
    EXPECT_NEAR(map.ray({0.75f * 512, 256})->direction.x, 1.0, 1e-6);
    EXPECT_NEAR(map.ray({256, 0.0f})->direction.z, 1.0, 1e-6);
}

TEST(EnvironmentMapping, MirrorBallReflectsUnderTwiceTheAngle) {
    expectAt(at(L::MirrorBall, {1, 0, 0}), 0.853553390593, 0.5);
    expectAt(at(L::MirrorBall, {-1, 0, 0}), 0.146446609407, 0.5);
    expectAt(at(L::MirrorBall, {0, 1, 0}), 0.5, 1.0 - 0.853553390593);
    expectAt(at(L::MirrorBall, {0, -1, 0}), 0.5, 1.0 - 0.146446609407);
    expectAt(at(L::MirrorBall, {0, 0, -1}), 0.5, 0.5);
    expectAt(at(L::MirrorBall, kA), 0.712237115377, 1.0 - 0.924474230753);
    expectAt(at(L::MirrorBall, kB), 0.317425814165, 1.0 - 0.591287092918);
    EXPECT_NEAR(glm::length(at(L::MirrorBall, {0, 0, 1}) - 0.5f), 0.5, 1e-6);
}

// Strips and six files hold OpenGL's faces, +X -X +Y -Y +Z -Z (OpenGL 4.6, table 8.19).
TEST(EnvironmentMapping, StripsHoldTheFacesOfACubemap) {
    const auto expectFace = [](const glm::vec3& d, int face, double s, double t) {
        const glm::vec2 row = at(L::HorizontalStrip, d);
        EXPECT_NEAR(row.x * 6.0, face + s, 6e-6);
        EXPECT_NEAR(row.y, t, 1e-6);
        for (const L layout : {L::VerticalStrip, L::SixFaces}) {
            const glm::vec2 column = at(layout, d);
            EXPECT_NEAR(column.x, s, 1e-6);
            EXPECT_NEAR(column.y * 6.0, face + t, 6e-6);
        }
    };
    const glm::vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < 6; ++i)
        expectFace(axes[i], i, 0.5, 0.5);
    expectFace(kA, 4, 0.666666666667, 0.166666666667);
    EXPECT_NEAR(at(L::HorizontalStrip, kB * glm::vec3(1.0f, 1.0f, 0.999f)).x * 6.0, 1.0, 1e-3);
    // inverse at (0.75, 0.5) of each face
    const glm::vec3 inverse[6] = {
        {0.894427191f, 0, -0.4472135955f}, {-0.894427191f, 0, 0.4472135955f},
        {0.4472135955f, 0.894427191f, 0},  {0.4472135955f, -0.894427191f, 0},
        {0.4472135955f, 0, 0.894427191f},  {-0.4472135955f, 0, -0.894427191f}};
    const EnvironmentMapping strip = mapping({L::HorizontalStrip}, 64);
    for (int i = 0; i < 6; ++i) {
        const auto ray = strip.ray({64.0f * (static_cast<float>(i) + 0.75f), 32.0f});
        ASSERT_TRUE(ray);
        EXPECT_LT(glm::length(ray->direction - inverse[i]), 1e-6f) << i;
        const glm::vec3 cube = glm::normalize(cubeDirection(i, 0.3f, 0.9f));
        EXPECT_LT(glm::length(
                      strip.ray({64.0f * (static_cast<float>(i) + 0.3f), 64.0f * 0.9f})->direction -
                      cube),
                  1e-6f);
    }
}

// A cross is a picture: -Z in the middle, +X to its right, and what touches there touches here.
TEST(EnvironmentMapping, CrossesAreSeenFromInside) {
    expectAt(at(L::HorizontalCross, {0, 0, -1}), 1.5 / 4, 0.5);
    expectAt(at(L::HorizontalCross, {1, 0, 0}), 2.5 / 4, 0.5);
    expectAt(at(L::HorizontalCross, {-1, 0, 0}), 0.5 / 4, 0.5);
    expectAt(at(L::HorizontalCross, {0, 0, 1}), 3.5 / 4, 0.5);
    expectAt(at(L::HorizontalCross, {0, 1, 0}), 1.5 / 4, 0.5 / 3);
    expectAt(at(L::HorizontalCross, {0, -1, 0}), 1.5 / 4, 2.5 / 3);
    expectAt(at(L::VerticalCross, {0, 0, -1}), 0.5, 1.5 / 4);
    expectAt(at(L::VerticalCross, {0, 0, 1}), 0.5, 3.5 / 4);
    // Across each fold the picture goes on.
    const auto expectFold = [](L layout, glm::vec2 before, glm::vec2 after) {
        const EnvironmentMapping map = mapping({layout}, 100);
        EXPECT_LT(glm::length(map.ray(before)->direction - map.ray(after)->direction), 1e-3f);
    };
    for (const float along : {120.0f, 150.0f, 185.0f}) {
        for (const float fold : {100.0f, 200.0f, 300.0f})
            expectFold(L::HorizontalCross, {fold - 0.01f, along}, {fold + 0.01f, along});
        for (const float fold : {100.0f, 200.0f}) {
            expectFold(L::HorizontalCross, {along, fold - 0.01f}, {along, fold + 0.01f});
            expectFold(L::VerticalCross, {fold - 0.01f, along}, {fold + 0.01f, along});
        }
        for (const float fold : {100.0f, 200.0f, 300.0f})
            expectFold(L::VerticalCross, {along, fold - 0.01f}, {along, fold + 0.01f});
    }
    EXPECT_FALSE(mapping({L::HorizontalCross}, 100).ray({50.0f, 50.0f}));
}

// OpenEXR's own functions: centres on the border, +Z in the middle, faces turned.
TEST(EnvironmentMapping, OpenExrConventionIsOpenExrs) {
    const EnvironmentMapping latLong = mapping({L::LatLong, C::OpenExr}, 64);
    const Imath::Box2i window({0, 0}, {63, 31});
    const EnvironmentMapping cube = mapping({L::VerticalStrip, C::OpenExr}, 16);
    const Imath::Box2i column({0, 0}, {15, 95});
    // u = x / (W - 1): +Z in the middle, seen from the middle of the outer pixels.
    const auto expectLatLong = [&](const glm::vec3& d, double u, double v) {
        const glm::vec2 p = (latLong.position(d) - 0.5f) / glm::vec2(63.0f, 31.0f);
        EXPECT_NEAR(p.x, u, 1e-6);
        EXPECT_NEAR(p.y, v, 1e-6);
    };
    expectLatLong({1, 0, 0}, 0.25, 0.5);
    expectLatLong({-1, 0, 0}, 0.75, 0.5);
    EXPECT_NEAR(latLong.position({0, 1, 0}).y - 0.5f, 0.0, 1e-5);
    EXPECT_NEAR(latLong.position({0, -1, 0}).y - 0.5f, 31.0, 1e-5);
    expectLatLong({0, 0, 1}, 0.5, 0.5);
    expectLatLong(kA, 0.448791808825, 0.320491482014);
    expectLatLong(kB, 0.875, 0.391826552031);
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const auto pick = [&] { return static_cast<float>(random() % 2001) / 1000.0f - 1.0f; };
        const glm::vec3 d = glm::normalize(glm::vec3(pick(), pick(), pick()) + 1e-4f);
        const Imath::V2f p = Imf::LatLongMap::pixelPosition(window, Imath::V3f(d.x, d.y, d.z));
        EXPECT_NEAR(latLong.position(d).x - 0.5f, p.x, 1e-3f);
        EXPECT_NEAR(latLong.position(d).y - 0.5f, p.y, 1e-3f);
        Imf::CubeMapFace face{};
        Imath::V2f inFace;
        Imf::CubeMap::faceAndPixelPosition(Imath::V3f(d.x, d.y, d.z), column, face, inFace);
        const Imath::V2f q = Imf::CubeMap::pixelPosition(face, column, inFace);
        EXPECT_NEAR(cube.position(d).x - 0.5f, q.x, 1e-3f);
        EXPECT_NEAR(cube.position(d).y - 0.5f, q.y, 1e-3f);
    }
}

TEST(EnvironmentMapping, DirectionToPixelToDirectionIsIdentity) {
    std::mt19937 random(2);
    for (const Kind kind : kKinds) {
        SCOPED_TRACE(nameOf(kind));
        const EnvironmentMapping map = mapping(kind, 256);
        for (int i = 0; i < 2000; ++i) {
            const auto pick = [&] {
                return static_cast<float>(random() % 20001) / 10000.0f - 1.0f;
            };
            const glm::vec3 d = glm::normalize(glm::vec3(pick(), pick(), pick()) + 1e-5f);
            const glm::vec2 p = map.position(d);
            const auto ray = map.ray(p);
            ASSERT_TRUE(ray) << p.x << " " << p.y;
            // a float at pixel 1000 resolves 6e-5 pixels
            ASSERT_LT(glm::length(ray->direction - d), 2e-5f) << d.x << " " << d.y << " " << d.z;
            ASSERT_NEAR(glm::length(ray->direction), 1.0f, 1e-6f);
        }
    }
}

TEST(EnvironmentMapping, SolidAnglesSumToTheSphere) {
    for (const Kind kind : kKinds)
        for (const int size : {1, 2, 3, 8, 64}) {
            if (kind.layout == L::LatLong && size == 1)
                continue; // it has no height
            SCOPED_TRACE(nameOf(kind) + " " + std::to_string(size));
            const EnvironmentMapping map = mapping(kind, size);
            double sum = 0.0;
            for (int y = 0; y < map.size().height; ++y)
                for (int x = 0; x < map.size().width; ++x)
                    sum += map.solidAngle(x, y);
            EXPECT_NEAR(sum, 4.0 * pi, 1e-9);
        }
}

// Closed forms: A(x,y) = atan2(xy, sqrt(x²+y²+1)) at a texel's corners (Driscoll 2012) and
// (2pi / W)(cos theta_j - cos theta_j+1).
TEST(EnvironmentMapping, SolidAnglesAreExact) {
    const struct {
        int size;
        double corner, centre;
        double approximate; // relative error of the total of 4/N² (1 + u² + v²)^-3/2 at the centres
    } cube[] = {{1, 2.09439510239, 2.09439510239, 0.909859317103},
                {2, 0.523598775598, 0.523598775598, 0.0395957349782},
                {4, 0.0814555875953, 0.20135792079, 0.0152660136901},
                {8, 0.0155686078666, 0.0588575059471, 0.00382948555355},
                {16, 0.00341458592363, 0.0153852223374, 0.000957239329347},
                {64, 0.000193931510235, 0.000975609910864, 5.98233164453e-05},
                {128, 4.77264025671e-05, 0.000244081037327, 1.49557724409e-05}};
    for (const auto& c : cube) {
        const EnvironmentMapping map = mapping({L::HorizontalStrip}, c.size);
        double usual = 0.0, total = 0.0;
        for (int y = 0; y < c.size; ++y)
            for (int x = 0; x < c.size; ++x) {
                const double u = (2.0 * x + 1.0) / c.size - 1.0, v = (2.0 * y + 1.0) / c.size - 1.0;
                usual += 4.0 / (c.size * c.size) * std::pow(1.0 + u * u + v * v, -1.5);
                total += map.solidAngle(x, y);
            }
        EXPECT_NEAR(total, 2.09439510239, 1e-9) << "a face";
        EXPECT_NEAR(std::abs(usual / total - 1.0), c.approximate, 1e-9);
        EXPECT_NEAR(map.solidAngle(0, 0), c.corner, 1e-9);
        EXPECT_NEAR(map.solidAngle(c.size / 2, c.size / 2), c.centre, 1e-9);
    }
    // by height, each the share of a full row
    const struct {
        int height;
        double row0, middle;
        double usual; // relative error of the total of the weight sin theta at the centres
    } latLong[] = {{4, 0.230037796128, 0.55536036727, 0.026172152977},
                   {64, 5.91279052618e-05, 0.00240860383118, 0.000100405864184},
                   {512, 1.15507019309e-07, 3.76493166739e-05, 1.56873309409e-06}};
    for (const auto& c : latLong) {
        const EnvironmentMapping map = mapping({L::LatLong}, 2 * c.height);
        double usual = 0.0, total = 0.0;
        for (int y = 0; y < c.height; ++y) {
            usual += 2.0 * pi * pi / c.height * std::sin(pi * (y + 0.5) / c.height);
            total += 2.0 * c.height * map.solidAngle(0, y);
        }
        EXPECT_NEAR(usual / total - 1.0, c.usual, 1e-9);
        EXPECT_NEAR(map.solidAngle(0, 0), c.row0, 1e-9);
        EXPECT_NEAR(map.solidAngle(1, c.height / 2), c.middle, 1e-9);
    }
}

// Jacobian: 4 pi² sinc(phi) / W² (angular), 16 / W² (ball, equal areas).
TEST(EnvironmentMapping, DensityIsTheJacobian) {
    const EnvironmentMapping map = mapping({L::AngularMap}, 1000);
    const double omega[] = {3.94784176044e-05, 3.55430635053e-05, 2.51327412287e-05,
                            1.18476878351e-05};
    for (int i = 0; i < 4; ++i) {
        const auto ray = map.ray({500.0f + 125.0f * static_cast<float>(i), 500.0f});
        EXPECT_NEAR(ray->density / omega[i], 1.0, 1e-4);
    }
    for (const Kind kind : kKinds) {
        SCOPED_TRACE(nameOf(kind));
        const EnvironmentMapping fine = mapping(kind, 256);
        int compared = 0;
        for (int y = 3; y < fine.size().height - 3; y += 37)
            for (int x = 3; x < fine.size().width - 3; x += 41)
                if (const auto ray = fine.ray({x + 0.5f, y + 0.5f}); ray && ray->density > 1e-5f) {
                    EXPECT_NEAR(fine.solidAngle(x, y) / ray->density, 1.0, 2e-2);
                    ++compared;
                }
        EXPECT_GT(compared, 10);
    }
}

TEST(EnvironmentMapping, CornersOfADiscHaveNoSolidAngle) {
    for (const L layout : {L::AngularMap, L::MirrorBall}) {
        const EnvironmentMapping map = mapping({layout}, 64);
        for (int i = 0; i < 8; ++i)
            EXPECT_EQ(map.solidAngle(i, 9 - i), 0.0);
        EXPECT_GT(map.solidAngle(10, 10), 0.0);
    }
}

TEST(EnvironmentMapping, WrongProportionsAreNamed) {
    for (const L layout : {L::AngularMap, L::MirrorBall, L::HorizontalCross, L::VerticalCross,
                           L::HorizontalStrip, L::VerticalStrip, L::SixFaces}) {
        const auto map = EnvironmentMapping::create(layout, {100, 37});
        ASSERT_FALSE(map.ok());
        EXPECT_EQ(map.error().kind, ErrorKind::Usage);
        EXPECT_NE(map.error().message.find("100 × 37"), std::string::npos);
    }
}

} // namespace
} // namespace patina
