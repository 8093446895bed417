// split-sum-pictures OUT.png|.jpg HDR…: white metal spheres (F = 1, single scattering) under the
// first HDR as the split sum lights them, by the sum over every direction, and how far they are
// apart; prints the figures for each HDR. Run by scripts/docs-pictures.
#include "core/image/Srgb.h"
#include "core/image/TextRaster.h"
#include "core/io/ImageIO.h"
#include "core/job/Parallel.h"
#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/DfgTable.h"
#include "core/light/Ibl.h"
#include "core/math/Shading.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

using namespace patina;

namespace {

constexpr int kSide = 200, kCaption = 26, kGap = 8, kTable = 128, kColumns = 4;
constexpr glm::vec3 kView(0.0f, 0.0f, 1.0f); // seen from far away
constexpr std::array kRoughness{0.3f, 0.6f};
constexpr float kShownDifference = 0.5f; // white or black

int fail(const Error& error) {
    std::fprintf(stderr, "split-sum-pictures: %s %s\n", error.file.c_str(), error.message.c_str());
    return 1;
}

struct Texel {
    glm::vec3 direction;
    glm::vec3 flux;
};

// Every texel of the environment, 128² on a face: far less than a lobe of these roughnesses.
std::vector<Texel> texelsOf(const IblMaps& maps) {
    const CubeLevel level = halveCube(maps.prefiltered.front());
    const std::vector<float> omega = cubeSolidAngles(level.size);
    const auto n = static_cast<std::size_t>(level.size);
    const auto side = static_cast<float>(n);
    std::vector<Texel> texels;
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        texels.push_back(
            {glm::normalize(cubeDirection(static_cast<int>(i / (n * n)),
                                          (static_cast<float>(i % n) + 0.5f) / side,
                                          (static_cast<float>(i / n % n) + 0.5f) / side)),
             level.texels[i] * omega[i % omega.size()]});
    return texels;
}

glm::vec3 everyDirection(const std::vector<Texel>& texels, const glm::vec3& n, float alpha) {
    const float NoV = std::max(glm::dot(n, kView), shading::kMinNoV);
    glm::dvec3 sum(0.0);
    for (const Texel& texel : texels) {
        const float NoL = glm::dot(n, texel.direction);
        if (NoL <= 0.0f)
            continue;
        const float NoH =
            std::clamp(glm::dot(n, glm::normalize(texel.direction + kView)), 0.0f, 1.0f);
        sum += glm::dvec3(texel.flux * (shading::D_GGX(NoH, alpha) * NoL *
                                        shading::V_SmithGGXCorrelated(NoV, NoL, alpha)));
    }
    return sum;
}

// As IblTest's and the shader's lookup: texels on the ends of both ranges.
glm::vec3 tableAt(const Image& table, float NoV, float perceptualRoughness) {
    const float x = NoV * (kTable - 1), y = perceptualRoughness * (kTable - 1);
    const int x0 = std::min(static_cast<int>(x), kTable - 2);
    const int y0 = std::min(static_cast<int>(y), kTable - 2);
    const auto at = [&](int i, int j) {
        return glm::vec3(table.sample(i, j, 0), table.sample(i, j, 1), table.sample(i, j, 2));
    };
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), fx),
                    glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), fx), fy);
}

// tilt 1 looks along the mirror direction, as Karis 2013 does.
glm::vec3 splitSum(const IblMaps& maps, const glm::vec3& dfg, const glm::vec3& n, float tilt,
                   float perceptualRoughness) {
    const glm::vec3 d = glm::mix(n, glm::reflect(-kView, n), tilt);
    const LevelPair levels = levelsOf(maps, perceptualRoughness);
    return (dfg.x + dfg.y) * glm::mix(sampleCube(maps.prefiltered[levels.first], d),
                                      sampleCube(maps.prefiltered[levels.second], d), levels.share);
}

float brightest(const glm::vec3& c) {
    return std::max({c.x, c.y, c.z});
}

struct Sphere {
    std::array<std::vector<glm::vec3>, 3> radiance; // along the lobe, along the mirror, the sum
    std::vector<bool> covered;

    // Root mean square of the differences over that of the picture.
    [[nodiscard]] double rms(std::size_t which) const {
        double squares = 0.0, norm = 0.0;
        for (std::size_t i = 0; i < covered.size(); ++i) {
            const glm::dvec3 off = radiance[which][i] - radiance[2][i], exact = radiance[2][i];
            squares += glm::dot(off, off);
            norm += glm::dot(exact, exact);
        }
        return std::sqrt(squares / norm);
    }
};

Sphere drawSphere(const IblMaps& maps, const std::vector<Texel>& texels, const Image& table,
                  float perceptualRoughness) {
    Sphere sphere;
    constexpr auto kPixels = static_cast<std::size_t>(kSide) * kSide;
    for (std::vector<glm::vec3>& picture : sphere.radiance)
        picture.assign(kPixels, glm::vec3(0.0f));
    std::vector<char> covered(kPixels, 0);
    parallelFor({}, kSide, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < kSide; ++x) {
                const auto at = [](std::size_t i) {
                    return (2.0f * static_cast<float>(i) + 1.0f) / kSide - 1.0f;
                };
                const float square = at(x) * at(x) + at(y) * at(y);
                if (square >= 0.99f) // the rim, where N·V is nearly 0
                    continue;
                const glm::vec3 n(at(x), -at(y), std::sqrt(1.0f - square));
                const glm::vec3 dfg = tableAt(table, n.z, perceptualRoughness);
                const std::size_t i = y * kSide + x;
                covered[i] = 1;
                sphere.radiance[0][i] = splitSum(maps, dfg, n, dfg.z, perceptualRoughness);
                sphere.radiance[1][i] = splitSum(maps, dfg, n, 1.0f, perceptualRoughness);
                sphere.radiance[2][i] =
                    everyDirection(texels, n, perceptualRoughness * perceptualRoughness);
            }
    });
    sphere.covered.assign(covered.begin(), covered.end());
    return sphere;
}

// Linear light, 0…1, onto the sheet.
void put(Image& sheet, int left, int top, std::size_t pixel, const glm::vec3& light) {
    const int x = left + static_cast<int>(pixel % kSide), y = top + static_cast<int>(pixel / kSide);
    for (int c = 0; c < 3; ++c)
        sheet.u8()[static_cast<std::size_t>((y * sheet.width() + x) * 3 + c)] =
            linearToSrgb8(std::clamp(light[c], 0.0f, 1.0f));
}

void paint(Image& sheet, const Sphere& sphere, int top, float scale) {
    for (std::size_t i = 0; i < sphere.covered.size(); ++i) {
        if (!sphere.covered[i])
            continue;
        const std::array shown{sphere.radiance[0][i], sphere.radiance[2][i]};
        for (int column = 0; column < 2; ++column)
            put(sheet, column * (kSide + kGap), top, i, scale * shown[std::size_t(column)]);
        for (int column = 2; column < kColumns; ++column) {
            const glm::vec3& one = sphere.radiance[std::size_t(column - 2)][i];
            const float off = (one.x + one.y + one.z - glm::dot(shown[1], glm::vec3(1.0f))) /
                              glm::dot(shown[1], glm::vec3(1.0f));
            // Grey is none, in the display's steps
            const float grey = std::clamp(0.5f + 0.5f * off / kShownDifference, 0.0f, 1.0f);
            put(sheet, column * (kSide + kGap), top, i, glm::vec3(srgbToLinear(grey)));
        }
    }
}

} // namespace

int main(int argc, char* argv[]) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: split-sum-pictures OUT.png|.jpg HDR…\n");
        return 2;
    }
    WorkerClient worker;
    const Result<TextRaster> text = TextRaster::create();
    if (!text)
        return fail(text.error());
    const Image table = computeDfgTable(kTable, Distribution::GGX, Visibility::SmithCorrelated,
                                        DfgTexels::ToTheEnds);
    Image sheet(kColumns * (kSide + kGap) - kGap,
                static_cast<int>(kRoughness.size()) * (kSide + kCaption + kGap), 3, PixelType::U8,
                ColorEncoding::Srgb);
    std::ranges::fill(sheet.u8(), std::uint8_t{24});
    for (int file = 2; file < argc; ++file) {
        std::vector<Notice> notices;
        const Result<ImagePtr> environment = loadEnvironmentImage(worker, argv[file], notices);
        if (!environment)
            return fail(environment.error());
        const Result<IblMaps> maps = computeIbl(**environment, {}, {});
        if (!maps)
            return fail(maps.error());
        const std::vector<Texel> texels = texelsOf(*maps);
        // The mean radiance is a third as bright as the screen.
        const float mean = brightest(maps->radianceSh[0]) * 0.28209479f;
        const float scale = 0.3f / std::max(mean, 1e-20f);
        int top = 0;
        for (const float r : kRoughness) {
            const Sphere sphere = drawSphere(*maps, texels, table, r);
            fmt::print("{}: perceptual roughness {}: rms {:.1f} % along the lobe, {:.1f} % along "
                       "the mirror direction\n",
                       argv[file], r, 100.0 * sphere.rms(0), 100.0 * sphere.rms(1));
            if (file > 2)
                continue;
            paint(sheet, sphere, top, scale);
            const std::array captions{
                fmt::format("Split sum, roughness {}", r), std::string("Every direction"),
                fmt::format("Difference, rms {:.1f} %", 100.0 * sphere.rms(0)),
                fmt::format("Mirror direction, {:.1f} %", 100.0 * sphere.rms(1))};
            for (int column = 0; column < kColumns; ++column)
                text->draw(sheet, column * (kSide + kGap) + 4, top + kSide + 19, 15,
                           glm::vec3(0.9f), captions[std::size_t(column)]);
            top += kSide + kCaption + kGap;
        }
    }
    const Result<ImageFileFormat> format = imageFormatForPath(argv[1]);
    if (!format)
        return fail(format.error());
    const Result<Bytes> bytes = encodeImage(worker, {{"", sheet, {}}}, *format);
    if (!bytes)
        return fail(bytes.error());
    const Result<void> written = writeFileAtomically(argv[1], *bytes);
    return written ? 0 : fail(written.error());
}
