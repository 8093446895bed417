// OpenColorIO's displays on the GPU against OpenColorIO's own CPU processor, and configurations
// that are missing, broken or different from what the user thinks.
#include "core/base/AtomicFile.h"
#include "core/document/ViewChoices.h"
#include "core/io/DisplayTransform.h"
#include "core/worker/WorkerClient.h"
#include "tests/render/RenderTest.h"
#include "tests/render/ToneMapFixture.h"
#include "tests/support/TemporaryFolder.h"

#include <OpenColorIO/OpenColorIO.h>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace patina::render {
namespace {

namespace OCIO = OCIO_NAMESPACE;
using testing::ElementsAre;
using testing::HasSubstr;

// ACES, the plain sRGB curve, and a film look made of a 1D and a 3D table.
constexpr const char* kConfig = R"(ocio_profile_version: 2
search_path: luts
roles:
  aces_interchange: ACES2065-1
  cie_xyz_d65_interchange: CIE-XYZ-D65
  default: ACES2065-1
  scene_linear: ACES2065-1
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  sRGB:
    - !<View> {name: ACES, view_transform: SDR Video, display_colorspace: sRGB}
    - !<View> {name: Plain, view_transform: Plain, display_colorspace: sRGB}
    - !<View> {name: Film, colorspace: film}
  Rec.1886:
    - !<View> {name: Plain, view_transform: Plain, display_colorspace: Rec.1886}
default_view_transform: Plain
view_transforms:
  - !<ViewTransform>
    name: Plain
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}
  - !<ViewTransform>
    name: SDR Video
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}
display_colorspaces:
  - !<ColorSpace>
    name: CIE-XYZ-D65
  - !<ColorSpace>
    name: sRGB
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
  - !<ColorSpace>
    name: Rec.1886
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709}
colorspaces:
  - !<ColorSpace>
    name: ACES2065-1
  - !<ColorSpace>
    name: Rec.709 light
    to_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD, direction: inverse}
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
  - !<ColorSpace>
    name: film
    from_scene_reference: !<GroupTransform>
      children:
        - !<LogAffineTransform> {base: 2, log_side_slope: 0.06, log_side_offset: 0.65, lin_side_offset: 0.001}
        - !<FileTransform> {src: film.spi1d, interpolation: linear}
        - !<FileTransform> {src: film.cube, interpolation: INTERPOLATION}
)";

// A configuration of the first version, with nothing but scene_linear to hold on to.
constexpr const char* kOldConfig = R"(ocio_profile_version: 1
strictparsing: false
roles:
  scene_linear: light
  default: light
displays:
  screen:
    - !<View> {name: Film, colorspace: monitor}
    - !<View> {name: Raw, colorspace: light}
colorspaces:
  - !<ColorSpace>
    name: light
  - !<ColorSpace>
    name: monitor
    from_reference: !<ExponentTransform> {value: [0.5, 0.5, 0.5, 1]}
)";

std::string curveTable() {
    std::string text = "Version 1\nFrom 0.0 1.0\nLength 1024\nComponents 1\n{\n";
    for (int i = 0; i < 1024; ++i)
        text += fmt::format("  {:.7f}\n", std::pow(static_cast<double>(i) / 1023.0, 1.4));
    return text + "}\n";
}

std::string colorTable() {
    constexpr int kEdge = 17;
    std::string text = fmt::format("LUT_3D_SIZE {}\n", kEdge);
    for (int b = 0; b < kEdge; ++b)
        for (int g = 0; g < kEdge; ++g)
            for (int r = 0; r < kEdge; ++r) {
                const double x = r / 16.0, y = g / 16.0, z = b / 16.0;
                text += fmt::format("{:.6f} {:.6f} {:.6f}\n", x * (1.0 - 0.2 * y), y * y,
                                    0.8 * z + 0.2 * x * y);
            }
    return text;
}

class OpenColorIo : public ToneMapFixture {
  protected:
    std::string write(const std::string& interpolation = "linear") {
        std::string text = kConfig;
        const std::string mark = "INTERPOLATION";
        text.replace(text.find(mark), mark.size(), interpolation);
        m_folder.write("luts/film.spi1d", curveTable());
        m_folder.write("luts/film.cube", colorTable());
        return m_folder.write("config.ocio", text).string();
    }
    DisplayTransform load(const std::string& config, const std::string& display = {},
                          const std::string& view = {}) {
        auto loaded = loadDisplayTransform(worker(), config, display, view);
        EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? std::string() : loaded.error().text());
        return loaded.ok() ? *loaded : DisplayTransform{};
    }
    // The display's picture of a grid of colours, black to far above white, with exposure.
    void expectAgreement(const std::string& config, const std::string& source,
                         const std::string& display, const std::string& view);

    WorkerClient& worker() { return m_worker; }
    test::TemporaryFolder& folder() { return m_folder; }

  private:
    WorkerClient m_worker;
    test::TemporaryFolder m_folder;
};

void OpenColorIo::expectAgreement(const std::string& config, const std::string& source,
                                  const std::string& display, const std::string& view) {
    SCOPED_TRACE(display + ", " + view);
    constexpr std::array kValues = {0.0f, 0.001f, 0.01f, 0.05f, 0.18f, 0.4f,
                                    0.9f, 1.0f,   2.5f,  12.0f, 60.0f, 500.0f};
    std::vector<glm::vec4> pixels;
    for (const float r : kValues)
        for (const float g : kValues)
            for (const float b : kValues)
                pixels.emplace_back(r, g, b, 1.0f);
    setPicture(static_cast<int>(kValues.size()), pixels);
    const std::vector<float> linear = targets().linear().readFloats(4);

    auto program = DisplayProgram::create(context(), load(config, display, view));
    ASSERT_TRUE(program.ok()) << program.error().text();
    screen().setDisplay(std::move(*program));
    View settings;
    settings.toneMap = ToneMap::OpenColorIo;
    settings.exposureEv = 0.25f;
    settings.displayTransfer = DisplayTransfer::Gamma; // has no say here
    settings.displayGamma = 4.0f;
    const auto shown = toneMapped(settings);

    const auto reference = OCIO::Config::CreateFromFile(config.c_str());
    auto transform = OCIO::DisplayViewTransform::Create();
    transform->setSrc(source.c_str());
    transform->setDisplay(display.c_str());
    transform->setView(view.c_str());
    const auto cpu = reference->getProcessor(transform)->getDefaultCPUProcessor();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        float pixel[3];
        for (std::size_t c = 0; c < 3; ++c)
            pixel[c] = linear[4 * i + c] * std::exp2(0.25f);
        cpu->applyRGB(pixel);
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(shown[4 * i + c], 255.0f * glm::clamp(pixel[c], 0.0f, 1.0f), 1.5f)
                << "channel " << c << " of " << pixels[i].x << ", " << pixels[i].y << ", "
                << pixels[i].z;
    }
}

TEST_F(OpenColorIo, TheGpuShowsWhatOpenColorIoComputes) {
    const std::string config = write();
    for (const auto& [display, view] :
         {std::pair{"sRGB", "ACES"}, {"sRGB", "Plain"}, {"sRGB", "Film"}, {"Rec.1886", "Plain"}})
        expectAgreement(config, "Rec.709 light", display, view);
    expectAgreement(write("tetrahedral"), "Rec.709 light", "sRGB", "Film");
    EXPECT_THAT(load(config).space, HasSubstr("aces_interchange"));
}

TEST_F(OpenColorIo, OldConfigurationsEnterAtSceneLinear) {
    const std::string config = folder().write("old.ocio", kOldConfig).string();
    expectAgreement(config, "light", "screen", "Film");
    EXPECT_EQ(load(config).space, "scene_linear (light), taken to have Rec.709 primaries");

    // Where the configuration knows linear Rec.709 by a usual name, that is it.
    std::string named = kOldConfig;
    named += "  - !<ColorSpace>\n    name: lin_srgb\n    to_reference: !<MatrixTransform> {matrix: "
             "[0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1]}\n";
    const std::string other = folder().write("named.ocio", named).string();
    expectAgreement(other, "lin_srgb", "screen", "Raw");
    EXPECT_EQ(load(other).space, "colour space lin_srgb");
}

TEST_F(OpenColorIo, TheMenuListsDisplaysAndViews) {
    const auto menu = loadDisplayMenu(worker(), write());
    ASSERT_TRUE(menu.ok()) << menu.error().text();
    ASSERT_EQ(menu->displays.size(), 2u);
    EXPECT_EQ(menu->defaultDisplay, "sRGB");
    EXPECT_EQ(menu->find({}), menu->find("sRGB"));
    EXPECT_THAT(menu->find("sRGB")->views, ElementsAre("ACES", "Plain", "Film"));
    EXPECT_EQ(menu->find("sRGB")->defaultView, "ACES");
    EXPECT_EQ(menu->find("Rec.1886")->defaultView, "Plain");
    EXPECT_EQ(menu->find("none"), nullptr);

    const DisplayTransform defaults = load(write());
    EXPECT_EQ(defaults.display, "sRGB");
    EXPECT_EQ(defaults.view, "ACES");
    ASSERT_EQ(defaults.curve.size(), 257u);
    EXPECT_NEAR(defaults.curve.front(), 0.0f, 0.02f);
    EXPECT_GT(defaults.curve.back(), 0.97f);
    EXPECT_NEAR(defaults.curve[128], 0.35f, 0.03f); // ACES shows 18 % grey at 10 % of white
    EXPECT_NEAR(load(write(), "sRGB", "Plain").curve[128], 0.4613561f, 1e-3f);
}

TEST_F(OpenColorIo, WhatCannotBeUsedIsNamedAndExplained) {
    const auto refusal = [&](const std::string& config, const std::string& display = {},
                             const std::string& view = {}) {
        const auto loaded = loadDisplayTransform(worker(), config, display, view);
        EXPECT_FALSE(loaded.ok()) << config;
        return loaded.ok() ? Error{} : loaded.error();
    };
    const std::string good = write();
    EXPECT_EQ(refusal((folder() / "none.ocio").string()).kind, ErrorKind::InputMissing);
    EXPECT_EQ(refusal(folder().path().string()).kind, ErrorKind::InputMissing) << "a folder";
    for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
             {"text.ocio", "this is a shopping list"},
             {"cut.ocio", std::string(kConfig).substr(0, 900)},
             {"binary.ocio", std::string("\0\xff\x17garbage\0\0", 12)},
             {"future.ocio", "ocio_profile_version: 99\n"},
             {"nodisplay.ocio", "ocio_profile_version: 1\nroles: {default: a}\ncolorspaces:\n  - "
                                "!<ColorSpace> {name: a}\n"}}) {
        const std::string file = folder().write(name, text).string();
        const Error error = refusal(file);
        EXPECT_EQ(error.kind, ErrorKind::InputBroken) << name;
        EXPECT_EQ(error.file, file);
        EXPECT_THAT(error.message, HasSubstr("OpenColorIO")) << name;
        EXPECT_FALSE(loadDisplayMenu(worker(), file).ok()) << name;
    }
    EXPECT_THAT(refusal(good, "Projector").message, HasSubstr("it has sRGB, Rec.1886"));
    EXPECT_THAT(refusal(good, "sRGB", "Noir").message, HasSubstr("it has ACES, Plain, Film"));
    std::filesystem::remove(folder() / "luts/film.cube");
    const Error missing = refusal(good, "sRGB", "Film");
    EXPECT_THAT(missing.message, HasSubstr("Film"));
    EXPECT_THAT(missing.detail, HasSubstr("film.cube"));
    EXPECT_TRUE(loadDisplayTransform(worker(), good, "sRGB", "Plain").ok()) << "the rest works";
}

// A configuration may come with somebody else's project: of the disk it sees its own folder.
TEST_F(OpenColorIo, TablesLieInTheFolderOfTheConfiguration) {
    const test::TemporaryFolder elsewhere;
    const std::string good = write();
    const auto link = folder() / "luts/film.cube";
    const auto toTable = [&](const std::filesystem::path& table) {
        std::filesystem::remove(link);
        std::filesystem::create_symlink(table, link);
        return loadDisplayTransform(worker(), good, "sRGB", "Film");
    };
    const auto outside = toTable(elsewhere.write("film.cube", colorTable()));
    ASSERT_FALSE(outside.ok());
    EXPECT_THAT(outside.error().detail, HasSubstr("film.cube"));
    EXPECT_TRUE(toTable(folder().write("more/film.cube", colorTable())).ok());
    // The configuration itself may be a link, as studios have them for the current one.
    const auto name = folder() / "current.ocio";
    std::filesystem::create_symlink(elsewhere.write("v2.ocio", *readTextFile(good, 1 << 20)), name);
    EXPECT_TRUE(loadDisplayTransform(worker(), name.string(), "sRGB", "Film").ok());
}

TEST(OpenColorIoConfig, IsTheChosenOneOrThatOfTheEnvironment) {
    ::unsetenv("OCIO");
    EXPECT_EQ(openColorIoConfig(""), "");
    EXPECT_EQ(openColorIoConfig("/studio/config.ocio"), "/studio/config.ocio");
    ::setenv("OCIO", "/site/config.ocio", 1);
    EXPECT_EQ(openColorIoConfig(""), "/site/config.ocio");
    EXPECT_EQ(openColorIoConfig("/studio/config.ocio"), "/studio/config.ocio");
    ::unsetenv("OCIO");
    EXPECT_EQ(openColorIoConfig("near.ocio"),
              (std::filesystem::current_path() / "near.ocio").string());
}

class OpenColorIoInFrames : public RenderTest {};

// Until the view is there, and when the driver refuses it, the default curve is shown.
TEST_F(OpenColorIoInFrames, TheDefaultStandsIn) {
    Document document = makeScene(makeSphere(8));
    document.view.background = BackgroundMode::Color;
    document.view.backgroundColor = glm::vec3(0.5f, 0.3f, 0.1f);
    document.meshes[0].visible = false;
    draw(document);
    const glm::vec4 neutral = centerPixel(renderer().readDisplayed());
    document.view.toneMap = ToneMap::OpenColorIo;
    draw(document);
    EXPECT_EQ(centerPixel(renderer().readDisplayed()), neutral);

    DisplayTransform transform;
    transform.view = "Swap";
    transform.shader = "vec4 ocioDisplay(vec4 c) { return vec4(c.b, c.g, c.r, c.a); }\n";
    ASSERT_TRUE(
        sceneRenderer().setDisplay(std::make_shared<const DisplayTransform>(transform)).ok());
    draw(document);
    EXPECT_NEAR(centerPixel(renderer().readDisplayed()).x, 0.1f, 0.01f);
    EXPECT_NEAR(centerPixel(renderer().readDisplayed()).z, 0.5f, 0.01f);

    transform.shader = "vec4 ocioDisplay(vec4 c) { return nonsense; }\n";
    const auto refused =
        sceneRenderer().setDisplay(std::make_shared<const DisplayTransform>(transform));
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, HasSubstr("Swap"));
    EXPECT_THAT(refused.error().detail, HasSubstr("nonsense"));
    draw(document);
    EXPECT_EQ(centerPixel(renderer().readDisplayed()), neutral);
}

} // namespace
} // namespace patina::render
