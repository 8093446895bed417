// Pictures and files for the tests of reading and writing.
#pragma once

#include "core/io/ImageIO.h"
#include "core/worker/WorkerClient.h"

#include <gtest/gtest.h>
#include <random>

namespace patina::test {

// Every sample different from its neighbours, all values of the type in use.
inline Image noise(int width, int height, int channels, PixelType type, ColorEncoding encoding) {
    Image image(width, height, channels, type, encoding);
    std::mt19937 random(static_cast<unsigned>(width * 31 + channels));
    switch (type) {
    case PixelType::U8:
        for (std::uint8_t& sample : image.u8())
            sample = static_cast<std::uint8_t>(random());
        break;
    case PixelType::U16:
        for (std::uint16_t& sample : image.u16())
            sample = static_cast<std::uint16_t>(random());
        break;
    case PixelType::F32:
        for (float& sample : image.f32())
            sample = static_cast<float>(random() % 4096) / 256.0f; // exact as half up to 8
        break;
    }
    return image;
}

class ImageFiles : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        s_worker = std::make_unique<WorkerClient>();
        s_worker->setLimits({std::size_t{4} << 30, 20.0, 60.0});
    }
    static void TearDownTestSuite() { s_worker.reset(); }
    static WorkerClient& worker() { return *s_worker; }

    static Bytes encode(const Image& image, ImageFileFormat format,
                        const ImageSaveOptions& options = {}) {
        auto bytes = encodeImage(worker(), image, format, options);
        EXPECT_TRUE(bytes.ok()) << bytes.error().text();
        return bytes.ok() ? std::move(*bytes) : Bytes();
    }
    static LoadedImage decode(const Bytes& bytes, const std::string& name = "memory",
                              const ImageLoadOptions& options = {}) {
        auto loaded = loadImageFromMemory(worker(), bytes, name, options);
        EXPECT_TRUE(loaded.ok()) << loaded.error().text();
        if (loaded.ok())
            return std::move(*loaded);
        LoadedImage empty;
        empty.parts.resize(1);
        return empty;
    }

  private:
    static inline std::unique_ptr<WorkerClient> s_worker;
};

} // namespace patina::test
