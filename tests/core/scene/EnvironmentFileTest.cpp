// Environments from files: the guess of the layout, and what each kind of file becomes.
#include "core/scene/EnvironmentFile.h"
#include "core/light/EnvironmentResample.h"
#include "tests/core/scene/SceneFixture.h"

#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <cmath>
#include <fmt/format.h>

namespace patina {
namespace {

using L = EnvironmentLayout;
using C = EnvironmentConvention;

// A colour for each octant of directions.
glm::vec3 octant(const glm::vec3& d) {
    return {d.x > 0 ? 1.0f : 0.25f, d.y > 0 ? 1.0f : 0.25f, d.z > 0 ? 1.0f : 0.25f};
}

EnvironmentMapping mapping(L layout, int size, C convention = C::Common) {
    return *EnvironmentMapping::create(layout, EnvironmentMapping::imageSize(layout, size),
                                       convention);
}

Image octants(L layout, int size, C convention = C::Common) {
    const EnvironmentMapping latLong = mapping(L::LatLong, 64);
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::vec3 color = octant(latLong.ray({x + 0.5f, y + 0.5f})->direction);
            for (int c = 0; c < 3; ++c)
                image.f32()[static_cast<std::size_t>((y * 64 + x) * 3 + c)] = color[c];
        }
    return resampleEnvironment(image, latLong, mapping(layout, size, convention));
}

class EnvironmentFile : public SceneFixture {
  protected:
    ImagePtr load(const std::string& file, L layout = L::Automatic) {
        m_notices.clear();
        const auto image = loadEnvironmentImage(m_worker, file, m_notices, layout);
        EXPECT_TRUE(image.ok()) << image.error().text();
        return image.ok() ? *image : nullptr;
    }
    Error failure(const std::string& file, L layout = L::Automatic) {
        const auto image = loadEnvironmentImage(m_worker, file, m_notices, layout);
        EXPECT_FALSE(image.ok());
        return image.ok() ? Error{} : image.error();
    }
    static void expectOctants(const ImagePtr& image) {
        ASSERT_NE(image, nullptr);
        ASSERT_EQ(image->width(), 2 * image->height());
        const EnvironmentMapping latLong = mapping(L::LatLong, image->width());
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 d = glm::normalize(
                glm::vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 0.8f : -0.8f, i & 4 ? 0.6f : -0.6f));
            EXPECT_LT(glm::length(latLong.lookup(*image, d) - octant(d)), 0.02f) << i;
        }
    }
    std::string saveExr(const Image& image, const std::string& name, const std::string& envmap) {
        std::vector<ImagePart> parts(1);
        parts[0].image = image;
        parts[0].attributes["envmap"] = envmap;
        const auto bytes = encodeImage(m_worker, parts, ImageFileFormat::Exr);
        EXPECT_TRUE(bytes.ok());
        return m_folder.write(name, *bytes).string();
    }
    std::string path(const char* name) { return (m_folder / name).string(); }
    std::vector<Notice> m_notices;
};

TEST_F(EnvironmentFile, EveryLayoutIsGuessedAndReadsUnmirrored) {
    for (const L layout : {L::LatLong, L::AngularMap, L::HorizontalCross, L::VerticalCross,
                           L::HorizontalStrip, L::VerticalStrip})
        for (const char* ending : {"exr", "hdr"}) {
            SCOPED_TRACE(layoutLabel(layout));
            const std::string file = save(
                octants(layout, 48), fmt::format("sky{}.{}", static_cast<int>(layout), ending));
            std::vector<Notice> notices;
            const auto picture = readEnvironmentPicture(m_worker, file, L::Automatic, notices);
            ASSERT_TRUE(picture.ok()) << picture.error().text();
            EXPECT_EQ(picture->layout, layout);
            EXPECT_EQ(mentions(notices, "mirror ball"), layout == L::AngularMap);
            EXPECT_EQ(notices.size(), layout == L::AngularMap ? 1u : 0u);
            expectOctants(load(file));
        }
}

TEST_F(EnvironmentFile, AChosenLayoutWins) {
    const std::string ball = save(octants(L::MirrorBall, 96), "ball.exr");
    expectOctants(load(ball, L::MirrorBall));
    EXPECT_TRUE(m_notices.empty());
    // Taken for an angular map, what is seen to the side moves.
    const auto angular = load(ball);
    EXPECT_TRUE(mentions(m_notices, "mirror ball"));
    EXPECT_NE(*angular, *load(ball, L::MirrorBall));
    const Error error = failure(ball, L::HorizontalCross);
    EXPECT_EQ(error.kind, ErrorKind::Usage);
    EXPECT_EQ(error.file, ball);
    EXPECT_NE(error.message.find("four faces wide"), std::string::npos) << error.message;
}

// 4 : 3 and 3 : 4 are also the proportions of photographs, 1 : 1 of everything.
TEST_F(EnvironmentFile, PhotographsAreNoCrosses) {
    Image photo(64, 48, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < photo.f32().size(); ++i)
        photo.f32()[i] = static_cast<float>(i % 7);
    EXPECT_FALSE(guessLayout(photo, {}).fits);
    EXPECT_EQ(guessLayout(octants(L::HorizontalCross, 16), {}).layout, L::HorizontalCross);
    Image square(48, 48, 3, PixelType::F32, ColorEncoding::Linear);
    std::ranges::fill(square.f32(), 1.0f);
    EXPECT_FALSE(guessLayout(square, {}).fits);
    load(save(square, "square.exr"));
    EXPECT_TRUE(mentions(m_notices, "stretched"));
}

TEST_F(EnvironmentFile, OpenExrsEnvmapAttributeDecides) {
    expectOctants(load(saveExr(octants(L::LatLong, 64, C::OpenExr), "ll.exr", "latlong")));
    expectOctants(load(saveExr(octants(L::VerticalStrip, 32, C::OpenExr), "cube.exr", "cube")));
    EXPECT_TRUE(m_notices.empty());
    // Chosen by hand, the same file is an ordinary lat-long: half a turn away.
    const auto plain = load(path("ll.exr"), L::LatLong);
    const EnvironmentMapping common = mapping(L::LatLong, 64);
    const glm::vec3 d = glm::normalize(glm::vec3(1.0f, 0.5f, 0.7f));
    EXPECT_LT(glm::length(common.lookup(*plain, d) - octant({-d.x, d.y, -d.z})), 1e-3f);
}

// OpenEXR's readers repair a file that was cut off while it was written; others refuse it.
TEST_F(EnvironmentFile, EnvironmentMapsAreWrittenToTheirEnd) {
    for (const char* envmap : {"latlong", "cube"}) {
        const L layout = std::string(envmap) == "cube" ? L::VerticalStrip : L::LatLong;
        const std::string file = saveExr(octants(layout, 32, C::OpenExr), "map.exr", envmap);
        EXPECT_TRUE(Imf::InputFile(file.c_str()).isComplete()) << envmap;
    }
}

TEST_F(EnvironmentFile, SixFilesAreFoundByTheirNames) {
    const Image strip = octants(L::VerticalStrip, 24);
    const auto face = [&](int i) {
        Image image(24, 24, 3, PixelType::F32, ColorEncoding::Linear);
        std::copy_n(strip.f32().begin() + i * 24 * 24 * 3, 24 * 24 * 3, image.f32().begin());
        return image;
    };
    const std::array<std::array<const char*, 6>, 4> names{
        {{"sky_px.exr", "sky_nx.exr", "sky_py.exr", "sky_ny.exr", "sky_pz.exr", "sky_nz.exr"},
         {"posx.hdr", "negx.hdr", "posy.hdr", "negy.hdr", "posz.hdr", "negz.hdr"},
         {"S-Right.exr", "S-Left.exr", "S-Top.exr", "S-Bottom.exr", "S-Front.exr", "S-Back.exr"},
         {"room+X.exr", "room-X.exr", "room+Y.exr", "room-Y.exr", "room+Z.exr", "room-Z.exr"}}};
    for (const auto& set : names) {
        for (int i = 0; i < 6; ++i)
            save(face(i), set[static_cast<std::size_t>(i)]);
        expectOctants(load(path(set[0])));
        expectOctants(load(path(set[3]), L::SixFaces));
        EXPECT_TRUE(m_notices.empty());
    }
    // One picture may serve as several faces.
    for (const char* end : {"px", "nx", "py", "ny", "pz", "nz"})
        std::filesystem::create_symlink(path("sky_px.exr"),
                                        m_folder / fmt::format("link_{}.exr", end));
    const auto links = load(path("link_nz.exr"));
    EXPECT_EQ(links->width(), 96);
    // ahead and to the left
    EXPECT_LT(glm::length(links->linear(48, 24) - links->linear(24, 24)), 1e-5f);

    // Missing, of another size, of no such name
    std::filesystem::remove(path("sky_ny.exr"));
    const Error missing = failure(path("sky_px.exr"), L::SixFaces);
    EXPECT_EQ(missing.kind, ErrorKind::InputMissing);
    EXPECT_EQ(missing.file, path("sky_ny.exr"));
    save(Image(20, 20, 3, PixelType::F32, ColorEncoding::Linear), "sky_ny.exr");
    const Error uneven = failure(path("sky_px.exr"));
    EXPECT_EQ(uneven.kind, ErrorKind::InputBroken);
    EXPECT_NE(uneven.message.find("20 × 20"), std::string::npos);
    EXPECT_TRUE(sixFaceFiles("/a/apex.hdr").empty());
    EXPECT_EQ(sixFaceFiles("/a/PX.hdr")[5], "/a/NZ.hdr");
    EXPECT_NE(failure(save(face(0), "lone.exr"), L::SixFaces).message.find("px nx py"),
              std::string::npos);
}

TEST_F(EnvironmentFile, TinyGreyAndTransparentPicturesAreRead) {
    Image one(1, 1, 1, PixelType::F32, ColorEncoding::Linear);
    one.f32()[0] = 0.5f;
    const auto constant = load(save(one, "one.exr"));
    EXPECT_EQ(constant->width(), 2);
    EXPECT_EQ(constant->linear(1, 0), glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    for (const ImageSize size :
         {ImageSize{1, 9}, ImageSize{9, 1}, ImageSize{1, 6}, ImageSize{6, 1}}) {
        Image row(size.width, size.height, 4, PixelType::F32, ColorEncoding::Linear);
        for (std::size_t i = 0; i < row.f32().size(); ++i)
            row.f32()[i] = i % 4 == 3 ? 0.25f : 2.0f; // alpha is no light
        const auto image = load(save(row, "row.exr"));
        EXPECT_EQ(image->channels(), 3);
        EXPECT_NEAR(image->linear(0, 0).g, 2.0f, 1e-5f);
    }
}

TEST_F(EnvironmentFile, LargeLatLongsAreAveragedDown) {
    Image wide(4200, 2100, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < wide.f32().size(); ++i)
        wide.f32()[i] = static_cast<float>(1 + i / 3 % 2);
    const auto image = load(save(wide, "wide.hdr"));
    EXPECT_EQ(image->width(), 4096);
    EXPECT_EQ(image->height(), 2048);
    constexpr double kSphere = 12.566370614359172;
    EXPECT_NEAR(environmentFlux(*image, mapping(L::LatLong, 4096)).x / kSphere, 1.5, 1e-4);
}

// --- Kinds of OpenEXR files ----------------------------------------------------------------------

std::vector<Imf::Rgba> rgbaPixels(int count) {
    std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = Imf::Rgba(0.5f, 0.25f, 1.0f, 1.0f);
    return pixels;
}

TEST_F(EnvironmentFile, LuminanceAndChromaBecomeRgb) {
    const auto pixels = rgbaPixels(16 * 8);
    for (const auto& [name, channels] :
         {std::pair("yc.exr", Imf::WRITE_YC), {"y.exr", Imf::WRITE_Y}}) {
        Imf::RgbaOutputFile file(path(name).c_str(), 16, 8, channels);
        file.setFrameBuffer(pixels.data(), 1, 16);
        file.writePixels(8);
    }
    const auto color = load(path("yc.exr"));
    EXPECT_NEAR(color->linear(7, 3).r, 0.5f, 5e-3f);
    EXPECT_NEAR(color->linear(7, 3).g, 0.25f, 5e-3f);
    EXPECT_NEAR(color->linear(7, 3).b, 1.0f, 1e-2f);
    const auto grey = load(path("y.exr"));
    EXPECT_NEAR(grey->linear(7, 3).r, 0.2126f * 0.5f + 0.7152f * 0.25f + 0.0722f, 2e-3f);
    EXPECT_EQ(grey->linear(7, 3).r, grey->linear(7, 3).b);
}

TEST_F(EnvironmentFile, OtherPrimariesAreConverted) {
    const auto pixels = rgbaPixels(16 * 8);
    Imf::Header header(16, 8);
    // ACES 2065-1
    Imf::addChromaticities(header, Imf::Chromaticities({0.7347f, 0.2653f}, {0.0f, 1.0f},
                                                       {0.0001f, -0.077f}, {0.32168f, 0.33767f}));
    {
        Imf::RgbaOutputFile file(path("aces.exr").c_str(), header, Imf::WRITE_RGB);
        file.setFrameBuffer(pixels.data(), 1, 16);
        file.writePixels(8);
    }
    // AP0 to linear Rec.709 with Bradford's adaptation: 2.52169 -1.13413 -0.38756, ...
    const glm::vec4 rgb = load(path("aces.exr"))->linear(3, 3);
    EXPECT_NEAR(rgb.r, 2.52169f * 0.5f - 1.13413f * 0.25f - 0.38756f, 2e-3f);
    EXPECT_NEAR(rgb.g, -0.27648f * 0.5f + 1.37272f * 0.25f - 0.09624f, 2e-3f);
    EXPECT_NEAR(rgb.b, -0.01538f * 0.5f - 0.15298f * 0.25f + 1.16835f, 2e-3f);
}

TEST_F(EnvironmentFile, TilesAreReadAndOtherSubsamplingAndDepthRefused) {
    Imf::Header tiled(32, 16);
    tiled.setTileDescription(Imf::TileDescription(8, 8));
    for (const char* name : {"R", "G", "B"})
        tiled.channels().insert(name, Imf::Channel(Imf::FLOAT));
    std::vector<float> values(32 * 16, 2.0f);
    const auto slice = [&] {
        return Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                          32 * sizeof(float));
    };
    {
        Imf::TiledOutputFile file(path("tiled.exr").c_str(), tiled);
        Imf::FrameBuffer buffer;
        for (const char* name : {"R", "G", "B"})
            buffer.insert(name, slice());
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    EXPECT_EQ(load(path("tiled.exr"))->linear(31, 15).b, 2.0f);
    ImageLoadOptions reduced;
    reduced.maxSide = 8;
    const auto small = loadImage(m_worker, path("tiled.exr"), reduced);
    ASSERT_TRUE(small.ok()) << small.error().text();
    EXPECT_EQ(small->image().width(), 8);
    EXPECT_EQ(small->image().linear(7, 3).r, 2.0f);

    Imf::Header subsampled(32, 16);
    subsampled.channels().insert("R", Imf::Channel(Imf::FLOAT));
    subsampled.channels().insert("G", Imf::Channel(Imf::FLOAT));
    subsampled.channels().insert("B", Imf::Channel(Imf::FLOAT, 2, 2));
    {
        Imf::OutputFile file(path("sub.exr").c_str(), subsampled);
        Imf::FrameBuffer buffer;
        buffer.insert("R", slice());
        buffer.insert("G", slice());
        Imf::Slice half = slice();
        half.xSampling = half.ySampling = 2;
        buffer.insert("B", half);
        file.setFrameBuffer(buffer);
        file.writePixels(16);
    }
    EXPECT_NE(failure(path("sub.exr")).message.find("lower resolution"), std::string::npos);

    Imf::Header deep(4, 2);
    deep.channels().insert("R", Imf::Channel(Imf::FLOAT));
    deep.setType(Imf::DEEPSCANLINE);
    deep.compression() = Imf::ZIPS_COMPRESSION;
    {
        Imf::DeepScanLineOutputFile file(path("deep.exr").c_str(), deep);
        std::vector<unsigned> counts(8, 1);
        std::vector<float*> samples(8, values.data());
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()),
                                                 sizeof(unsigned), 4 * sizeof(unsigned)));
        buffer.insert("R", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()),
                                          sizeof(float*), 4 * sizeof(float*), sizeof(float)));
        file.setFrameBuffer(buffer);
        file.writePixels(2);
    }
    EXPECT_NE(failure(path("deep.exr")).message.find("deep images"), std::string::npos);
}

TEST_F(EnvironmentFile, TheFirstPartWithColourIsTaken) {
    std::vector<ImagePart> parts(3);
    parts[0].name = "depth";
    parts[0].image = Image(16, 8, 1, PixelType::F32, ColorEncoding::Linear);
    parts[0].image.setChannelNames({"Z"});
    parts[1].name = "beauty";
    parts[1].image = Image(16, 8, 4, PixelType::F32, ColorEncoding::Linear);
    parts[1].image.setChannelNames({"beauty.R", "beauty.G", "beauty.B", "beauty.Z"});
    for (std::size_t i = 0; i < parts[1].image.f32().size(); ++i)
        parts[1].image.f32()[i] = static_cast<float>(1 + i % 4);
    parts[2] = parts[0];
    parts[2].name = "other";
    const auto bytes = encodeImage(m_worker, parts, ImageFileFormat::Exr);
    ASSERT_TRUE(bytes.ok());
    const auto image = load(m_folder.write("parts.exr", *bytes).string());
    EXPECT_EQ(image->linear(3, 3), glm::vec4(1.0f, 2.0f, 3.0f, 1.0f));

    parts.erase(parts.begin() + 1);
    const auto colourless = encodeImage(m_worker, parts, ImageFileFormat::Exr);
    ASSERT_TRUE(colourless.ok());
    const Error error = failure(m_folder.write("depth.exr", *colourless).string());
    EXPECT_EQ(error.kind, ErrorKind::InputBroken);
    EXPECT_NE(error.message.find("channels Z"), std::string::npos) << error.message;
}

TEST_F(EnvironmentFile, LayoutsHaveOneNameInScriptsAndOnTheCommandLine) {
    EXPECT_EQ(layoutNamed("angularMap"), L::AngularMap);
    EXPECT_EQ(layoutNamed("angular-map"), L::AngularMap);
    EXPECT_EQ(layoutNamed("LAT-LONG"), L::LatLong);
    EXPECT_EQ(layoutNamed("sphere"), std::nullopt);
    EXPECT_EQ(layoutLabel(L::SixFaces), "Six faces");
}

} // namespace
} // namespace patina
