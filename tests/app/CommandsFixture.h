// The commands themselves, on built-in scenes.
#pragma once

#include "CommandRunner.h"
#include "core/io/ImageIO.h"
#include "core/worker/WorkerClient.h"

#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace patina::test {

// The program's own decoder, beside it in $PATINA_BIN_DIR.
class Commands : public testing::Test {
  protected:
    Image load(const std::string& file) {
        Result<LoadedImage> image = loadImage(m_worker, file);
        EXPECT_TRUE(image.ok()) << image.error().text();
        return image->image();
    }
    void save(const std::string& file, int width, int height, int channels,
              const std::vector<int>& values) {
        Image image(width, height, channels, PixelType::U8, ColorEncoding::Srgb);
        for (std::size_t i = 0; i < image.u8().size(); ++i)
            image.u8()[i] = static_cast<std::uint8_t>(values[i % values.size()]);
        const Result<void> saved = saveImage(m_worker, image, file);
        EXPECT_TRUE(saved.ok());
    }

    TemporaryFolder m_folder;
    WorkerClient m_worker;
};

} // namespace patina::test
