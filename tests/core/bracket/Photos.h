// Photos of a scene whose radiance is known, taken by cameras whose response is known: by formula,
// not by what they test.
#pragma once

#include "core/bracket/Bracket.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace patina::test {

inline constexpr int kPhotoWidth = 480, kPhotoHeight = 320;

// Twelve stops from left to right, with blocks and waves, reddish above and bluish below.
inline double computedRadiance(int x, int y, int channel) {
    const auto wave = [](double value) { return 0.5 + 0.5 * std::sin(value); };
    // A hash of the block's place, 0 … 1.
    const auto block = [](int column, int row) {
        auto h = static_cast<std::uint32_t>(column) * 73856093u ^
                 static_cast<std::uint32_t>(row) * 19349663u;
        h = (h ^ (h >> 13u)) * 1274126177u;
        return static_cast<double>((h >> 8u) & 0xffffu) / 65535.0;
    };
    const double stops = -6.0 + 12.0 * (x + 0.5) / kPhotoWidth +
                         1.6 * (block((x + 1000) / 23, (y + 1000) / 17) - 0.5) +
                         0.5 * wave(0.031 * x + 0.017 * y) +
                         (channel - 1) * 0.6 * (y - 160.0) / kPhotoHeight;
    return std::exp2(stops);
}

// Radiance of the scene at a pixel, also somewhat outside the picture.
inline double sceneRadiance(int x, int y, int channel) {
    constexpr int kAround = 80, kColumns = kPhotoWidth + 2 * kAround,
                  kRows = kPhotoHeight + 2 * kAround;
    static const std::vector<double> kScene = [] { // each is asked for a hundred times
        std::vector<double> scene;
        for (int row = 0; row < kRows; ++row)
            for (int column = 0; column < kColumns; ++column)
                for (int c = 0; c < 3; ++c)
                    scene.push_back(computedRadiance(column - kAround, row - kAround, c));
        return scene;
    }();
    const auto pixel = static_cast<std::size_t>((y + kAround) * kColumns + x + kAround);
    return kScene.at(3 * pixel + static_cast<std::size_t>(channel));
}

// Code 0 … 1 of an exposure; 1 and more is clipped.
using Camera = std::function<double(double exposure)>;

inline double gammaCamera(double exposure) {
    return std::pow(exposure, 1.0 / 2.2);
}
// A film's: toe, straight part and shoulder.
inline double filmCamera(double exposure) {
    const double power = std::pow(exposure, 1.15);
    return 1.2 * power / (power + 0.45);
}
inline double srgbCamera(double exposure) {
    return exposure <= 0.0031308 ? 12.92 * exposure : 1.055 * std::pow(exposure, 1.0 / 2.4) - 0.055;
}

struct Shot {
    std::string name;
    double seconds = 0.0; // also what scales the radiance; 0: not written, and 1
    double fNumber = 8.0;
    double iso = 100.0;
    PhotoShift shift{};
};

inline double exposureOf(const Shot& shot) {
    const double seconds = shot.seconds > 0.0 ? shot.seconds : 1.0;
    return seconds * shot.iso / 100.0 * 64.0 / (shot.fNumber * shot.fNumber);
}

// The code of a pixel, 0 … top.
inline int codeOf(const Shot& shot, const Camera& camera, int x, int y, int channel, int top) {
    const double exposure =
        sceneRadiance(x - shot.shift.dx, y - shot.shift.dy, channel) * exposureOf(shot);
    return static_cast<int>(std::lround(std::clamp(camera(exposure), 0.0, 1.0) * top));
}

// Written by OpenImageIO with its Exif, in 8 or 16 bits or as linear floats, by the name's
// extension.
class BracketPhotos : public testing::Test {
  protected:
    static void SetUpTestSuite() { s_worker = std::make_unique<WorkerClient>(); }
    static void TearDownTestSuite() { s_worker.reset(); }
    static WorkerClient& worker() { return *s_worker; }

    std::filesystem::path write(const Shot& shot, const Camera& camera,
                                OIIO::TypeDesc type = OIIO::TypeDesc::UINT8,
                                int width = kPhotoWidth, int height = kPhotoHeight) {
        std::vector<std::uint8_t> bytes;
        std::vector<std::uint16_t> words;
        std::vector<float> floats;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    if (type == OIIO::TypeDesc::UINT8)
                        bytes.push_back(
                            static_cast<std::uint8_t>(codeOf(shot, camera, x, y, c, 255)));
                    else if (type == OIIO::TypeDesc::UINT16)
                        words.push_back(
                            static_cast<std::uint16_t>(codeOf(shot, camera, x, y, c, 65535)));
                    else
                        floats.push_back(static_cast<float>(
                            std::min(sceneRadiance(x - shot.shift.dx, y - shot.shift.dy, c) *
                                         exposureOf(shot),
                                     1.0)));
                }
        const void* pixels = type == OIIO::TypeDesc::UINT8    ? static_cast<void*>(bytes.data())
                             : type == OIIO::TypeDesc::UINT16 ? static_cast<void*>(words.data())
                                                              : static_cast<void*>(floats.data());
        const std::filesystem::path file = m_folder / shot.name;
        OIIO::ImageSpec spec(width, height, 3, type);
        if (shot.seconds > 0.0)
            spec.attribute("ExposureTime", static_cast<float>(shot.seconds));
        if (shot.fNumber > 0.0)
            spec.attribute("FNumber", static_cast<float>(shot.fNumber));
        if (shot.iso > 0.0)
            spec.attribute("Exif:PhotographicSensitivity", static_cast<int>(shot.iso));
        spec.attribute("CompressionQuality", 97);
        auto output = OIIO::ImageOutput::create(file.string());
        EXPECT_TRUE(output && output->open(file.string(), spec) &&
                    output->write_image(type, pixels) && output->close())
            << OIIO::geterror();
        return file;
    }

    std::vector<std::filesystem::path> writeAll(const std::vector<Shot>& shots,
                                                const Camera& camera,
                                                OIIO::TypeDesc type = OIIO::TypeDesc::UINT8) {
        std::vector<std::filesystem::path> files;
        for (const Shot& shot : shots)
            files.push_back(write(shot, camera, type));
        return files;
    }

    static Bracket make(const std::vector<std::filesystem::path>& files,
                        const BracketOptions& options = {}) {
        Result<Bracket> made = makeBracket(worker(), files, options);
        EXPECT_TRUE(made.ok()) << made.error().text();
        return made.ok() ? std::move(*made) : Bracket{};
    }
    static Error refusalOf(const std::vector<std::filesystem::path>& files,
                           const BracketOptions& options = {}) {
        const Result<Bracket> made = makeBracket(worker(), files, options);
        EXPECT_FALSE(made.ok());
        return made.ok() ? Error{} : made.error();
    }

    TemporaryFolder m_folder;

  private:
    static inline std::unique_ptr<WorkerClient> s_worker;
};

// Five photos, two stops apart. (Of 1/2, 1/4 … s OpenImageIO 2.4 makes 1/0 in a JPEG's Exif.)
inline std::vector<Shot> fiveShots(const std::string& extension) {
    std::vector<Shot> shots;
    for (int i = 0; i < 5; ++i)
        shots.push_back(
            {"photo" + std::to_string(i) + "." + extension, 0.9 * std::exp2(2.0 * i - 4.0)});
    return shots;
}

} // namespace patina::test
