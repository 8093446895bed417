// band-pictures OUT.png|.jpg HDR: an environment beside what its first bands of spherical harmonics
// hold, found by the classical 200 × 200 samples. Run by scripts/docs-pictures.
#include "core/image/TextRaster.h"
#include "core/io/ImageIO.h"
#include "core/light/EnvironmentProjection.h"
#include "core/light/ShBands.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cstdio>
#include <string>

using namespace patina;

namespace {

constexpr int kTileHeight = 200, kTileWidth = 2 * kTileHeight, kCaption = 26, kGap = 8;
constexpr int kSamples = 200 * 200;

int fail(const Error& error) {
    std::fprintf(stderr, "band-pictures: %s %s\n", error.file.c_str(), error.message.c_str());
    return 1;
}

// Of these proportions, scaled and cut to what a display shows.
Image shown(const Image& latLong, float scale) {
    Image image = shrinkImage(latLong, kTileWidth);
    for (float& sample : image.f32())
        sample = std::clamp(scale * sample, 0.0f, 1.0f);
    return convertImage(image, PixelType::U8, ColorEncoding::Srgb);
}

void paste(Image& sheet, const Image& tile, int left, int top) {
    for (int y = 0; y < tile.height(); ++y)
        for (int x = 0; x < tile.width(); ++x)
            for (int c = 0; c < 3; ++c)
                sheet.u8()[std::size_t(((top + y) * sheet.width() + left + x) * 3 + c)] =
                    tile.u8()[std::size_t((y * tile.width() + x) * tile.channels() + c)];
}

} // namespace

int main(int argc, char* argv[]) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: band-pictures OUT.png|.jpg HDR\n");
        return 2;
    }
    WorkerClient worker;
    std::vector<Notice> notices;
    const Result<ImagePtr> environment = loadEnvironmentImage(worker, argv[2], notices);
    if (!environment)
        return fail(environment.error());
    const Result<TextRaster> text = TextRaster::create();
    if (!text)
        return fail(text.error());
    const std::vector<glm::vec3> exact = projectLatLong(**environment, kMaxShOrder);
    const std::vector<glm::vec3> sampled =
        projectEnvironment(**environment, kMaxShOrder, ShMethod::Stratified, kSamples);
    // The mean radiance is half as bright as the screen.
    const float mean = std::max({exact[0].r, exact[0].g, exact[0].b}) * 0.28209479f;
    const float scale = 0.5f / std::max(mean, 1e-20f);

    constexpr int kColumns = 2, kRows = 3;
    Image sheet(kColumns * (kTileWidth + kGap) - kGap, kRows * (kTileHeight + kCaption + kGap), 3,
                PixelType::U8, ColorEncoding::Srgb);
    std::ranges::fill(sheet.u8(), std::uint8_t{24});
    int place = 0;
    const auto add = [&](const Image& picture, const std::string& caption) {
        const int left = place % kColumns * (kTileWidth + kGap),
                  top = place / kColumns * (kTileHeight + kCaption + kGap);
        paste(sheet, shown(picture, scale), left, top);
        text->draw(sheet, left + 4, top + kTileHeight + 19, 15, glm::vec3(0.9f), caption);
        ++place;
    };
    add(**environment, "Environment");
    for (const int bands : {1, 3, 5, 7})
        add(shLatLong(sampled, bands, kTileHeight),
            bands == 1 ? "1 band" : std::to_string(bands) + " bands");
    add(shLatLong(exact, 7, kTileHeight), "7 bands, every pixel instead of 200 × 200 samples");

    const Result<ImageFileFormat> format = imageFormatForPath(argv[1]);
    if (!format)
        return fail(format.error());
    const Result<Bytes> bytes = encodeImage(worker, {{"", sheet, {}}}, *format);
    if (!bytes)
        return fail(bytes.error());
    const Result<void> written = writeFileAtomically(argv[1], *bytes);
    return written ? 0 : fail(written.error());
}
