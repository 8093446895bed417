#include "core/codec/image/LuminanceChroma.h"

#include "core/codec/Codec.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <algorithm>

namespace patina::codec {

std::optional<LuminanceChromaImage> readLuminanceChroma(const std::string& file, bool headerOnly) {
    try {
        Imf::RgbaInputFile input(file.c_str());
        if ((input.channels() & Imf::WRITE_C) == 0)
            return std::nullopt;
        const Imath::Box2i window = input.dataWindow();
        const long long width = static_cast<long long>(window.max.x) - window.min.x + 1;
        const long long height = static_cast<long long>(window.max.y) - window.min.y + 1;
        checkImageSize(width, height, 3, sizeof(float));
        LuminanceChromaImage image;
        image.width = static_cast<int>(width);
        image.height = static_cast<int>(height);
        if (Imf::hasChromaticities(input.header())) {
            const Imf::Chromaticities c = Imf::chromaticities(input.header());
            image.chromaticities = {c.red.x,  c.red.y,  c.green.x, c.green.y,
                                    c.blue.x, c.blue.y, c.white.x, c.white.y};
        }
        if (headerOnly)
            return image;
        image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        std::vector<Imf::Rgba> row(static_cast<std::size_t>(width));
        auto target = image.rgb.begin();
        for (int y = window.min.y; y <= window.max.y; ++y) {
            // OpenEXR wants the address that pixel (0, y) would have.
            input.setFrameBuffer(row.data() - window.min.x, 1, 0);
            input.readPixels(y);
            for (const Imf::Rgba& pixel : row)
                for (const float sample : {float(pixel.r), float(pixel.g), float(pixel.b)})
                    *target++ = sample;
        }
        return image;
    } catch (const Refusal&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        throw Refusal("the file is damaged or cut short; save or download it again",
                      std::string("openexr: ") + exception.what());
    }
}

} // namespace patina::codec
