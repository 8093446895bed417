#include "core/light/Softboxes.h"
#include "core/job/Parallel.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/LatLongGrid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

using namespace patina;

namespace {

using std::numbers::pi;

Softbox box(float azimuthDeg, float elevationDeg, float widthDeg, float heightDeg,
            float rollDeg = 0.0f, float softness = 0.0f) {
    Softbox softbox;
    softbox.azimuthDeg = azimuthDeg;
    softbox.elevationDeg = elevationDeg;
    softbox.widthDeg = widthDeg;
    softbox.heightDeg = heightDeg;
    softbox.rollDeg = rollDeg;
    softbox.softness = softness;
    softbox.intensity = 1.0f;
    return softbox;
}

Image imageOf(const Softbox& softbox, int height) {
    return softboxImage({&softbox, 1}, glm::vec3(0.0f), height);
}

double flux(const Image& image) {
    const LatLongGrid grid(image.height());
    double sum = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += image.linear(x, y).g * grid.solidAngle(y);
    return sum;
}

// The radiance in a direction, nearest texel.
float lookUp(const Image& image, const glm::dvec3& d) {
    const double u = 0.5 + std::atan2(d.x, -d.z) / (2.0 * pi), v = std::acos(d.y) / pi;
    return image
        .linear(static_cast<int>(u * image.width()) % image.width(),
                std::min(static_cast<int>(v * image.height()), image.height() - 1))
        .g;
}

} // namespace

TEST(LatLongGrid, TexelsCoverTheSphere) {
    for (const int height : {2, 6, 64}) {
        const LatLongGrid grid(height);
        double sphere = 0.0, upper = 0.0;
        for (int y = 0; y < height; ++y) {
            sphere += grid.width() * grid.solidAngle(y);
            if (y < height / 2)
                upper += grid.width() * grid.projectedSolidAngle(y);
        }
        EXPECT_NEAR(sphere, 4.0 * pi, 1e-12);
        EXPECT_NEAR(upper, pi, 1e-12);
        EXPECT_NEAR(glm::length(grid.directionAt(1.5, 0.5) - grid.direction(1, 0)), 0.0, 1e-15);
    }
}

TEST(LatLongGrid, AnglesAndDirectionsAreInverse) {
    for (const double azimuth : {-179.0, -90.0, 0.0, 33.0, 180.0})
        for (const double elevation : {-89.0, -10.0, 0.0, 60.0}) {
            const glm::dvec2 angles = anglesFromDirection(directionFromAngles(azimuth, elevation));
            EXPECT_NEAR(angles.x, azimuth, 1e-9);
            EXPECT_NEAR(angles.y, elevation, 1e-9);
        }
    EXPECT_NEAR(directionFromAngles(90.0, 0.0).x, 1.0, 1e-15); // +X
    EXPECT_NEAR(directionFromAngles(0.0, 0.0).z, 1.0, 1e-15);  // +Z
}

TEST(Softboxes, SolidAngleIsThatOfAPyramid) {
    EXPECT_NEAR(solidAngle(box(0, 0, 90, 90)), 4.0 * pi / 6.0, 1e-12); // a cube's face
    EXPECT_NEAR(solidAngle(box(0, 0, 0.5f, 1)), glm::radians(0.5) * glm::radians(1.0), 1e-8);
    EXPECT_NEAR(luminousSolidAngle(box(20, 70, 60, 30)), solidAngle(box(0, 0, 60, 30)), 1e-12);
}

// Summed over directions all over the sphere, apart from the quadrature.
TEST(Softboxes, LuminousSolidAngleIsTheSumOfItsWeights) {
    for (const Softbox& softbox : {box(10, 20, 50, 30, 25, 0.3f), box(0, 0, 170, 170, 0, 1.0f),
                                   box(-100, -60, 8, 120, 0, 0.5f)}) {
        const SoftboxShape shape(softbox);
        const LatLongGrid grid(512);
        double sum = 0.0;
        for (int y = 0; y < grid.height(); ++y)
            for (int x = 0; x < grid.width(); ++x)
                if (const auto p = shape.local(grid.direction(x, y)))
                    sum += shape.weight(*p) * grid.solidAngle(y);
        EXPECT_NEAR(luminousSolidAngle(softbox), sum, 2e-3 * sum);
    }
    // A small square that fades from its middle: each side keeps ∫ 3t² - 2t³ = 1/2.
    EXPECT_NEAR(luminousSolidAngle(box(0, 0, 1, 1, 0, 1.0f)) / solidAngle(box(0, 0, 1, 1)), 0.25,
                1e-4);
}

TEST(Softboxes, FluxIsExactAtEveryPlaceAndSize) {
    for (const int height : {32, 256})
        for (const auto& [azimuth, elevation] : {std::pair{180.0f, 0.0f},
                                                 {0.0f, 10.0f},
                                                 {-179.9f, 40.0f},
                                                 {40.0f, 90.0f},
                                                 {0.0f, -90.0f},
                                                 {77.0f, -84.0f}})
            for (const Softbox& softbox :
                 {box(azimuth, elevation, 40, 30), box(azimuth, elevation, 0.5f, 0.5f, 45),
                  box(azimuth, elevation, 5, 160, 30, 0.4f), box(azimuth, elevation, 170, 90)}) {
                const double exact = luminousSolidAngle(softbox);
                EXPECT_NEAR(flux(imageOf(softbox, height)), exact, 1e-4 * exact)
                    << height << " " << azimuth << " " << elevation << " " << softbox.widthDeg;
            }
}

TEST(Softboxes, EveryTexelHoldsItsMean) {
    for (const Softbox& softbox :
         {box(180, 0, 40, 30), box(3, 75, 50, 20, 40), box(-60, -20, 12, 90, -70, 0.2f)}) {
        const Image image = imageOf(softbox, 64);
        const SoftboxShape shape(softbox);
        const LatLongGrid grid(64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 128; ++x) {
                double mean = 0.0;
                for (int j = 0; j < 48; ++j)
                    for (int i = 0; i < 48; ++i)
                        if (const auto p = shape.local(
                                grid.directionAt(x + (i + 0.5) / 48, y + (j + 0.5) / 48)))
                            mean += shape.weight(*p) / (48.0 * 48.0);
                ASSERT_NEAR(image.linear(x, y).g, mean, 0.05) << x << " " << y;
            }
    }
}

TEST(Softboxes, StandWhereTheirAnglesSay) {
    // A wide box behind the model (azimuth 180, the middle of the picture).
    const Image wide = imageOf(box(180, 0, 60, 10), 128);
    for (const double azimuth : {152.0, 180.0, 208.0})
        EXPECT_NEAR(lookUp(wide, directionFromAngles(azimuth, 2)), 1.0f, 0.01f) << azimuth;
    for (const auto& [azimuth, elevation] :
         {std::pair{148.0, 0.0}, {212.0, 0.0}, {180.0, 8.0}, {180.0, -8.0}, {0.0, 0.0}})
        EXPECT_EQ(lookUp(wide, directionFromAngles(azimuth, elevation)), 0.0f) << azimuth;
    const Image tall = imageOf(box(180, 0, 60, 10, 90), 128);
    EXPECT_NEAR(lookUp(tall, directionFromAngles(180, 28)), 1.0f, 0.01f);
    EXPECT_EQ(lookUp(tall, directionFromAngles(200, 0)), 0.0f);
    // Rolled by 30° counter-clockwise its right end, at smaller azimuths, goes up.
    const Image rolled = imageOf(box(180, 0, 60, 10, 30), 128);
    EXPECT_NEAR(lookUp(rolled, directionFromAngles(180 - 20, 11)), 1.0f, 0.01f);
    EXPECT_NEAR(lookUp(rolled, directionFromAngles(180 + 20, -11)), 1.0f, 0.01f);
    EXPECT_EQ(lookUp(rolled, directionFromAngles(180 - 20, -11)), 0.0f);
}

TEST(Softboxes, DoNotNoticeTheSeam) {
    const Image middle = imageOf(box(180, 25, 70, 20, 15, 0.3f), 64);
    const Image seam = imageOf(box(0, 25, 70, 20, 15, 0.3f), 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            ASSERT_NEAR(middle.linear(x, y).g, seam.linear((x + 64) % 128, y).g, 1e-5f);
}

TEST(Softboxes, LocalAndDirectionAreInverse) {
    for (const Softbox& softbox :
         {box(40, 10, 30, 20, 33), box(0, 90, 30, 20), box(9, -90, 5, 5)}) {
        const SoftboxShape shape(softbox);
        for (const glm::dvec2& p : {glm::dvec2(0, 0), glm::dvec2(0.4, -1.2), glm::dvec2(-3, 0.1)}) {
            const auto back = shape.local(shape.direction(p));
            ASSERT_TRUE(back.has_value());
            EXPECT_NEAR(glm::length(*back - p), 0.0, 1e-12);
        }
        EXPECT_FALSE(shape.local(-shape.axis()).has_value());
    }
}

TEST(Softboxes, AddToTheRoomAndToEachOther) {
    Softbox red = box(180, 0, 40, 40), blue = box(170, 0, 40, 40), off = box(180, 0, 90, 90);
    red.color = {1, 0, 0};
    blue.color = {0, 0, 1};
    red.intensity = 4.0f;
    off.enabled = false;
    const Image image = softboxImage(std::array{red, blue, off}, {0.5f, 0.25f, 0.125f}, 64);
    const glm::vec4 both = image.linear(66, 31), none = image.linear(0, 0);
    EXPECT_NEAR(both.r, 4.5f, 0.01f);
    EXPECT_NEAR(both.g, 0.25f, 1e-6f);
    EXPECT_NEAR(both.b, 1.125f, 0.01f);
    EXPECT_EQ(none, glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
}

TEST(Softboxes, AreTheSameOnAnyNumberOfThreads) {
    const std::array boxes{box(0, 20, 50, 20, 30, 0.2f), box(90, 80, 30, 60)};
    const Image many = softboxImage(boxes, glm::vec3(0.1f), 128);
    const ThreadLimit one(1);
    EXPECT_EQ(many, softboxImage(boxes, glm::vec3(0.1f), 128));
}

TEST(GeneratedEnvironment, RecipeIsWhatThePictureDependsOn) {
    Environment environment;
    environment.kind = EnvironmentKind::Softboxes;
    environment.softboxes = {box(0, 0, 10, 10), box(9, 9, 9, 9)};
    const EnvironmentRecipe recipe = environmentRecipe(environment);
    Environment same = environment;
    same.rotationDeg = 50.0f;
    same.exposureEv = 2.0f;
    same.sky.turbidity = 9.0f;
    same.softboxes[0].name = "Key";
    same.softboxes[1].id = 77;
    same.softboxes.push_back(box(1, 1, 1, 1));
    same.softboxes.back().enabled = false;
    EXPECT_EQ(environmentRecipe(same), recipe);
    for (const auto& change : std::initializer_list<void (*)(Environment&)>{
             [](Environment& e) { e.softboxes[1].rollDeg = 1.0f; },
             [](Environment& e) { e.softboxes[0].enabled = false; },
             [](Environment& e) { e.softboxAmbient.b = 0.5f; },
             [](Environment& e) { e.kind = EnvironmentKind::Sky; },
             [](Environment& e) { e.kind = EnvironmentKind::Image; }}) {
        Environment other = environment;
        change(other);
        EXPECT_NE(environmentRecipe(other), recipe);
    }
    environment.kind = EnvironmentKind::Sky;
    Environment higher = environment;
    higher.sky.sunElevationDeg += 1.0f;
    EXPECT_NE(environmentRecipe(higher), environmentRecipe(environment));
}

TEST(GeneratedEnvironment, ImageFollowsTheKindAndTheFileIsKept) {
    Environment environment;
    environment.fileImage =
        std::make_shared<const Image>(Image(4, 2, 3, PixelType::F32, ColorEncoding::Linear));
    environment.softboxes = {box(0, 0, 30, 30)};
    resolveEnvironment(environment);
    EXPECT_EQ(environment.image, environment.fileImage);
    environment.kind = EnvironmentKind::Softboxes;
    resolveEnvironment(environment);
    ASSERT_NE(environment.image, environment.fileImage);
    EXPECT_EQ(environment.image->width(), 2 * kEnvironmentHeight);
    EXPECT_EQ(*environment.image,
              softboxImage(environment.softboxes, environment.softboxAmbient, kEnvironmentHeight));
    environment.kind = EnvironmentKind::Image;
    resolveEnvironment(environment);
    EXPECT_EQ(environment.image, environment.fileImage);
}
