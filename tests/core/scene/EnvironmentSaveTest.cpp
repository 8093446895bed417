// Environments written to files come back, in every layout and both formats.
#include "core/scene/EnvironmentSave.h"
#include "core/library/Library.h"
#include "core/light/EnvironmentResample.h"
#include "core/scene/EnvironmentFile.h"
#include "tests/core/scene/SceneFixture.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace patina {
namespace {

using L = EnvironmentLayout;

class EnvironmentSave : public SceneFixture {
  protected:
    EnvironmentSave() {
        m_environment.image =
            std::make_shared<const Image>(shrinkLatLong(**library::environment("studio"), 128));
    }
    // The relative difference of light over the sphere, looked at with the blur of 8 pixels.
    static double difference(const Image& a, const Image& b) {
        const Image x = shrinkLatLong(a, 16), y = shrinkLatLong(b, 16);
        double squares = 0.0, sum = 0.0;
        for (std::size_t i = 0; i < x.f32().size(); ++i) {
            squares += std::pow(x.f32()[i] - y.f32()[i], 2.0);
            sum += y.f32()[i];
        }
        const auto count = static_cast<double>(x.f32().size());
        return std::sqrt(squares / count) / (sum / count);
    }
    std::vector<std::string> filesInFolder() {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder.path()))
            names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }
    EnvironmentSaveSettings to(const char* name, L layout = L::LatLong, int size = 0) {
        return {m_folder / name, layout, size, false};
    }
    Environment m_environment;
};

TEST_F(EnvironmentSave, EveryLayoutComesBackAsItself) {
    for (int i = static_cast<int>(L::LatLong); i <= static_cast<int>(L::SixFaces); ++i)
        for (const char* ending : {"exr", "hdr"})
            for (const bool envmap : {false, true}) {
                const auto layout = static_cast<L>(i);
                EnvironmentSaveSettings settings =
                    to(fmt::format("sky{}.{}", i, ending).c_str(), layout);
                settings.openExrEnvmap = envmap;
                const bool possible =
                    !envmap || (ending == std::string("exr") &&
                                (layout == L::LatLong || layout == L::VerticalStrip));
                SCOPED_TRACE(settings.output.string() + (envmap ? ", envmap" : ""));
                const auto written = saveEnvironment(m_worker, m_environment, settings);
                ASSERT_EQ(written.ok(), possible);
                if (!possible) {
                    EXPECT_EQ(written.error().kind, ErrorKind::Usage);
                    continue;
                }
                EXPECT_EQ(written->size(), layout == L::SixFaces ? 6u : 1u);
                std::vector<Notice> notices;
                // A ball cannot be told from an angular map.
                const auto image =
                    loadEnvironmentImage(m_worker, written->front().string(), notices,
                                         layout == L::MirrorBall ? layout : L::Automatic);
                ASSERT_TRUE(image.ok()) << image.error().text();
                // pixels of 2.8° blur the edges of lamps; a mirrored picture differs by more than 1
                EXPECT_LT(difference(**image, *m_environment.image),
                          layout == L::MirrorBall ? 0.1 : 0.05); // its back is a thin rim
                if (layout != L::AngularMap) {
                    EXPECT_TRUE(notices.empty());
                }
            }
}

TEST_F(EnvironmentSave, ALatLongOfItsOwnSizeIsWrittenBitByBit) {
    const auto written = saveEnvironment(m_worker, m_environment, to("same.exr"));
    ASSERT_TRUE(written.ok()) << written.error().text();
    std::vector<Notice> notices;
    const auto image = loadEnvironmentImage(m_worker, written->front().string(), notices);
    ASSERT_TRUE(image.ok());
    EXPECT_TRUE(std::ranges::equal((*image)->f32(), m_environment.image->f32()));
}

TEST_F(EnvironmentSave, RotationAndBrightnessAreApplied) {
    m_environment.exposureEv = 1.0f;
    ASSERT_TRUE(saveEnvironment(m_worker, m_environment, to("bright.exr")).ok());
    m_environment.exposureEv = 0.0f;
    m_environment.rotationDeg = 180.0f;
    ASSERT_TRUE(saveEnvironment(m_worker, m_environment, to("turned.exr")).ok());
    const auto load = [&](const char* name) {
        std::vector<Notice> notices;
        return *loadEnvironmentImage(m_worker, (m_folder / name).string(), notices);
    };
    const Image& original = *m_environment.image;
    EXPECT_NEAR(load("bright.exr")->linear(20, 30).g, 2.0f * original.linear(20, 30).g, 1e-5f);
    const ImagePtr turned = load("turned.exr");
    Image back(128, 64, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            for (int c = 0; c < 3; ++c)
                back.f32()[static_cast<std::size_t>((y * 128 + x) * 3 + c)] =
                    turned->linear((x + 64) % 128, y)[c];
    EXPECT_LT(difference(back, original), 0.03);
    EXPECT_GT(difference(*turned, original), 0.5);
}

TEST_F(EnvironmentSave, WhatMakesNoSenseIsRefusedBeforeAnythingIsWritten) {
    for (const EnvironmentSaveSettings& settings :
         {to("sky.png"), to("sky"), to("sky.exr", L::LatLong, 33),
          to("sky.exr", L::VerticalStrip, 6000), to("sky.hdr", L::AngularMap, 40000)}) {
        const auto refused = saveEnvironment(m_worker, m_environment, settings);
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().kind, ErrorKind::Usage) << refused.error().text();
    }
    EXPECT_EQ(saveEnvironment(m_worker, m_environment, to("none/sky.exr")).error().kind,
              ErrorKind::CannotCreate);
    EXPECT_TRUE(filesInFolder().empty());
}

TEST_F(EnvironmentSave, ACancelOrAFailureLeavesNothingBehind) {
    JobControl control;
    control.cancel();
    const auto cancelled =
        saveEnvironment(m_worker, m_environment, to("sky.exr", L::SixFaces, 16), control.context());
    ASSERT_FALSE(cancelled.ok());
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(filesInFolder().empty());
    // The fourth of six cannot be written: a folder has its name.
    std::filesystem::create_directory(m_folder / "sky_ny.exr");
    const auto failed = saveEnvironment(m_worker, m_environment, to("sky.exr", L::SixFaces, 16));
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().kind, ErrorKind::CannotCreate);
    EXPECT_EQ(filesInFolder(), std::vector<std::string>{"sky_ny.exr"});
}

TEST_F(EnvironmentSave, ProbesThatWentThroughFilesLightAsBefore) {
    // Default sizes keep the detail: the mean over 16 × 8 patches stays within half a percent.
    for (const L layout : {L::AngularMap, L::HorizontalCross, L::VerticalStrip}) {
        const auto written = saveEnvironment(
            m_worker, m_environment,
            to(fmt::format("probe{}.exr", static_cast<int>(layout)).c_str(), layout));
        ASSERT_TRUE(written.ok());
        std::vector<Notice> notices;
        const auto image = loadEnvironmentImage(m_worker, written->front().string(), notices);
        ASSERT_TRUE(image.ok());
        const auto flux = [](const Image& picture) {
            return environmentFlux(picture, *EnvironmentMapping::create(
                                                L::LatLong, {picture.width(), picture.height()}))
                .g;
        };
        EXPECT_NEAR(flux(**image) / flux(*m_environment.image), 1.0, 0.005);
    }
}

} // namespace
} // namespace patina
