#include "tests/render/Golden.h"

#include "core/io/ImageIO.h"
#include "core/worker/WorkerClient.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace patina {

namespace {

struct Difference {
    float max = 0.0f, mean = 0.0f;
};

Difference difference(const Image& a, const Image& b) {
    Difference result;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.u8().size(); ++i) {
        const float d = std::abs(static_cast<float>(a.u8()[i]) - static_cast<float>(b.u8()[i]));
        result.max = std::max(result.max, d);
        sum += static_cast<double>(d);
    }
    result.mean = static_cast<float>(sum / static_cast<double>(a.u8().size()));
    return result;
}

void write(WorkerClient& worker, const Image& picture, const std::filesystem::path& file) {
    std::filesystem::create_directories(file.parent_path());
    const auto saved = saveImage(worker, picture, file);
    EXPECT_TRUE(saved.ok()) << (saved.ok() ? std::string() : saved.error().text());
}

} // namespace

void expectGolden(const Image& picture, const std::string& name, const GoldenLimits& limits) {
    namespace fs = std::filesystem;
    const fs::path golden = fs::path(PATINA_GOLDEN_DIR) / (name + ".png");
    const fs::path actual = fs::path(PATINA_GOLDEN_OUTPUT_DIR) / (name + ".png");
    WorkerClient worker;
    const char* update = std::getenv("PATINA_UPDATE_GOLDEN");
    if (update && std::string(update) == "1") {
        write(worker, picture, golden);
        return;
    }
    if (!fs::exists(golden)) {
        write(worker, picture, golden);
        FAIL() << golden << " was missing and has been written: look at it, then commit it.";
    }
    const auto loaded = loadImage(worker, golden, {.integerEncoding = ColorEncoding::Srgb});
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    const Image& expected = loaded->image();
    const bool sameShape =
        expected.width() == picture.width() && expected.height() == picture.height() &&
        expected.channels() == picture.channels() && expected.type() == PixelType::U8;
    const Difference d = sameShape ? difference(picture, expected) : Difference{255.0f, 255.0f};
    if (d.max > limits.max || d.mean > limits.mean)
        write(worker, picture, actual);
    EXPECT_TRUE(d.max <= limits.max && d.mean <= limits.mean)
        << name << ": differs by at most " << d.max << " (limit " << limits.max
        << ") and on average " << d.mean << " (limit " << limits.mean << ") of 255; see " << actual
        << ". PATINA_UPDATE_GOLDEN=1 accepts the new pictures.";
}

} // namespace patina
