// Radiance is what the scene has, what cannot be known is counted, and what makes no bracket is
// refused with the reason.
#include "core/bracket/BracketPreview.h"
#include "tests/core/bracket/Photos.h"

#include <atomic>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <thread>

namespace patina {
namespace {

using test::Camera;
using test::Shot;
using testing::ElementsAre;
using testing::HasSubstr;

// What must be found in a pixel of aligned photos, from their codes.
struct Truth {
    bool above = false, below = false; // a channel is white, or black, in all of them
    bool sure = true;                  // each channel has a code from 40 to 215 in one of them
};

Truth truthAt(const std::vector<Shot>& shots, const Camera& camera, int x, int y) {
    Truth truth;
    for (int c = 0; c < 3; ++c) {
        bool white = true, black = true, sure = false;
        for (const Shot& shot : shots) {
            const int code = test::codeOf(shot, camera, x, y, c, 255);
            white = white && code == 255;
            black = black && code == 0;
            sure = sure || (code >= 40 && code <= 215);
        }
        truth.above = truth.above || white;
        truth.below = truth.below || black;
        truth.sure = truth.sure && sure;
    }
    return truth;
}

class Brackets : public test::BracketPhotos {
  protected:
    // Largest relative error of the radiance where it is sure, up to one factor for all.
    static double radianceError(const Bracket& bracket, const std::vector<Shot>& shots,
                                const Camera& camera) {
        const std::span<const float> found = bracket.merged.image.f32();
        double least = 1e30, most = 0.0;
        for (int y = 0; y < test::kPhotoHeight; ++y)
            for (int x = 0; x < test::kPhotoWidth; ++x)
                if (truthAt(shots, camera, x, y).sure)
                    for (int c = 0; c < 3; ++c) {
                        const double ratio =
                            found[static_cast<std::size_t>(3 * (y * test::kPhotoWidth + x) + c)] /
                            test::sceneRadiance(x, y, c);
                        least = std::min(least, ratio);
                        most = std::max(most, ratio);
                    }
        return std::sqrt(most / least) - 1.0; // to either side of the middle
    }
};

TEST_F(Brackets, HaveTheRadianceOfTheScene) {
    const std::vector<Shot> shots = test::fiveShots("tif");
    for (const Camera& camera : {Camera(test::gammaCamera), Camera(test::filmCamera)}) {
        EXPECT_LT(radianceError(make(writeAll(shots, camera)), shots, camera), 0.02);
        EXPECT_LT(
            radianceError(make(writeAll(shots, camera, OIIO::TypeDesc::UINT16)), shots, camera),
            0.02);
    }
}

TEST_F(Brackets, OfLinearPicturesAreExact) {
    std::vector<Shot> shots = test::fiveShots("exr");
    const auto files = writeAll(shots, {}, OIIO::TypeDesc::FLOAT);
    const Bracket bracket = make(files);
    EXPECT_EQ(bracket.report.response, ResponseKind::Linear);
    const std::span<const float> found = bracket.merged.image.f32();
    // Values are those of the photo in the middle.
    for (int x = 5; x < test::kPhotoWidth; x += 7) {
        const double truth = test::sceneRadiance(x, 100, 0) * test::exposureOf(shots[2]);
        if (truth > 15.0) // clipped
            continue;
        const auto at = static_cast<std::size_t>(3 * (100 * test::kPhotoWidth + x));
        EXPECT_NEAR(found[at] / truth, 1.0, 1e-4);
    }
}

TEST_F(Brackets, LookAsThePhotoInTheMiddleDoes) {
    const std::vector<Shot> shots = test::fiveShots("tif");
    const Bracket bracket = make(writeAll(shots, test::srgbCamera));
    for (int x = 0; x < test::kPhotoWidth; x += 5) {
        const int code = test::codeOf(shots[2], test::srgbCamera, x, 100, 1, 255);
        if (code < 60 || code > 200)
            continue;
        const float linear =
            bracket.merged.image
                .f32()[static_cast<std::size_t>(3 * (100 * test::kPhotoWidth + x) + 1)];
        EXPECT_NEAR(test::srgbCamera(linear) * 255.0, code, 1.5);
    }
}

TEST_F(Brackets, CountWhatIsClippedInAllPhotos) {
    std::vector<Shot> shots = test::fiveShots("tif");
    shots = {shots[0], shots[1], shots[2]}; // too few for twelve stops
    const auto camera = [](double exposure) { return test::filmCamera(exposure) - 0.03; };
    const Bracket bracket = make(writeAll(shots, camera));
    std::size_t above = 0, below = 0, wrong = 0;
    for (int y = 0; y < test::kPhotoHeight; ++y)
        for (int x = 0; x < test::kPhotoWidth; ++x) {
            const Truth truth = truthAt(shots, camera, x, y);
            const std::uint8_t mark =
                bracket.merged.marks[static_cast<std::size_t>(y * test::kPhotoWidth + x)];
            above += truth.above ? 1 : 0;
            below += truth.below ? 1 : 0;
            wrong += ((mark & kClippedAbove) != 0) != truth.above ? 1 : 0;
            wrong += ((mark & kClippedBelow) != 0) != truth.below ? 1 : 0;
        }
    const double pixels = test::kPhotoWidth * test::kPhotoHeight;
    ASSERT_GT(above, 1000u);
    ASSERT_GT(below, 1000u);
    EXPECT_EQ(wrong, 0u);
    EXPECT_DOUBLE_EQ(bracket.report.clippedAbove, static_cast<double>(above) / pixels);
    EXPECT_DOUBLE_EQ(bracket.report.clippedBelow, static_cast<double>(below) / pixels);

    // What is white in the darkest photo has that one's value: no less than its brightest
    // neighbours.
    float white = 0.0f, most = 0.0f;
    for (std::size_t i = 0; i < bracket.merged.marks.size(); ++i) {
        const float value = bracket.merged.image.f32()[3 * i + 1];
        most = std::max(most, value);
        if ((bracket.merged.marks[i] & kClippedAbove) != 0)
            white = std::max(white, value);
    }
    EXPECT_EQ(white, most);
}

TEST_F(Brackets, ComeInAnyOrder) {
    const auto files = writeAll(test::fiveShots("tif"), test::gammaCamera);
    const Bracket sorted = make(files);
    const Bracket mixed = make({files[3], files[0], files[4], files[2], files[1]});
    EXPECT_EQ(sorted.merged.image, mixed.merged.image);
    for (std::size_t i = 0; i < files.size(); ++i)
        EXPECT_EQ(mixed.report.photos[i].file, files[i]);
    EXPECT_THAT(mixed.report.warnings, ElementsAre());
}

TEST_F(Brackets, ReadShutterApertureAndIso) {
    // The same exposures by other means: two stops each.
    const std::vector<Shot> shots{{"a.jpg", 1.0 / 250, 8.0, 100.0},
                                  {"b.jpg", 1.0 / 250, 4.0, 100.0},
                                  {"c.jpg", 1.0 / 250, 4.0, 400.0}};
    const Bracket bracket =
        make(writeAll(shots, [](double e) { return test::gammaCamera(30 * e); }));
    ASSERT_EQ(bracket.report.photos.size(), 3u);
    EXPECT_NEAR(bracket.report.photos[0].ev, -2.0, 1e-3);
    EXPECT_NEAR(bracket.report.photos[1].ev, 0.0, 1e-3);
    EXPECT_NEAR(bracket.report.photos[2].ev, 2.0, 1e-3);
    EXPECT_EQ(exposureText(bracket.report.photos[0].exposure), "1/250 s, f/8, ISO 100");
    EXPECT_EQ(exposureText({2.0, 5.6, 0.0}), "2 s, f/5.6");
    const Result<PhotoExposure> read = readExposure(worker(), m_folder / "c.jpg");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(exposureText(*read), "1/250 s, f/4, ISO 400");
}

TEST_F(Brackets, TakeExposuresThatAreGiven) {
    std::vector<Shot> shots = test::fiveShots("png");
    const auto files = writeAll(shots, test::gammaCamera); // their Exif says the same
    BracketOptions options;
    options.exposuresEv = {10, 12, 14, 16, 18};
    const Bracket given = make(files, options);
    const Bracket read = make(writeAll(test::fiveShots("tif"), test::gammaCamera));
    for (std::size_t i = 0; i < files.size(); ++i)
        EXPECT_NEAR(given.report.photos[i].ev, read.report.photos[i].ev, 1e-3);
    for (std::size_t i = 0; i < read.merged.marks.size(); i += 97)
        EXPECT_NEAR(given.merged.image.f32()[3 * i] / read.merged.image.f32()[3 * i], 1.0, 1e-3);
    for (const double none : {std::numeric_limits<double>::quiet_NaN(), -1e9}) {
        options.exposuresEv[2] = none;
        EXPECT_THAT(refusalOf(files, options).message, HasSubstr("from -100 to 100"));
    }
    options.exposuresEv.pop_back();
    EXPECT_THAT(refusalOf(files, options).message,
                HasSubstr("4 exposures were given for 5 photos"));
}

TEST_F(Brackets, SayWhatIsDoubtful) {
    std::vector<Shot> shots = test::fiveShots("tif");
    shots[1].seconds = shots[2].seconds;
    EXPECT_THAT(make(writeAll(shots, test::gammaCamera)).report.warnings,
                ElementsAre(HasSubstr("photo1.tif and photo2.tif have the same exposure")));

    const auto files = writeAll(test::fiveShots("tif"), test::gammaCamera);
    BracketOptions options;
    options.exposuresEv = {0, 2, 6, 4, 8};
    EXPECT_THAT(make(files, options).report.warnings,
                testing::Contains(HasSubstr(
                    "photo2.tif is darker than photo3.tif, although its exposure is 2.0 EV "
                    "more")));
}

TEST_F(Brackets, OfBlackPhotosHaveNoResponse) {
    const auto files = writeAll(test::fiveShots("tif"), [](double) { return 0.0; });
    const Bracket bracket = make(files);
    EXPECT_EQ(bracket.report.response, ResponseKind::Assumed);
    EXPECT_EQ(bracket.report.clippedBelow, 1.0);
    EXPECT_THAT(bracket.report.warnings, ElementsAre(HasSubstr("the sRGB curve is assumed")));
}

// Of a pixel or two nothing can be said but their radiance.
TEST_F(Brackets, CanBeAsSmallAsAPixel) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{3, 20}}) {
        std::vector<std::filesystem::path> files;
        for (const Shot& shot : test::fiveShots("tif"))
            files.push_back(write(shot, test::srgbCamera, OIIO::TypeDesc::UINT8, width, height));
        const Bracket bracket = make(files);
        EXPECT_EQ(bracket.report.response, ResponseKind::Assumed);
        EXPECT_EQ(bracket.merged.image.width(), width);
        EXPECT_EQ(bracket.report.photos[0].shift, PhotoShift());
        const double truth =
            test::sceneRadiance(0, 0, 1) * test::exposureOf(test::fiveShots("")[2]);
        EXPECT_NEAR(bracket.merged.image.f32()[1] / truth, 1.0, 0.05);
    }
}

// Nothing changes although the exposures do: not what a camera does, and no reason to crash.
TEST_F(Brackets, OfOnePhotoAtManyExposuresHaveNoResponse) {
    std::vector<std::filesystem::path> files;
    for (Shot shot : test::fiveShots("tif"))
        files.push_back(
            write(shot, [&](double e) { return test::gammaCamera(e / test::exposureOf(shot)); }));
    const Bracket bracket = make(files);
    EXPECT_EQ(bracket.report.response, ResponseKind::Assumed);
    EXPECT_GT(bracket.report.disagreeing, 0.2);
}

TEST_F(Brackets, AreRefusedWithTheReason) {
    const std::vector<Shot> shots = test::fiveShots("tif");
    const auto files = writeAll(shots, test::gammaCamera);
    EXPECT_THAT(refusalOf({files[0]}).message, HasSubstr("two photos or more"));
    EXPECT_EQ(refusalOf({}).kind, ErrorKind::Usage);
    EXPECT_THAT(refusalOf({files[0], files[0]}).message, HasSubstr("the same exposure"));

    const auto silent = write({"silent.tif", 0.0}, test::gammaCamera);
    const Error missing = refusalOf({files[0], silent});
    EXPECT_THAT(missing.message, HasSubstr("exposure time (Exif)"));
    EXPECT_EQ(missing.file, silent);
    EXPECT_EQ(missing.kind, ErrorKind::Usage);

    const auto withIso = write({"iso.jpg", 0.1}, test::gammaCamera);
    const auto noIso = write({"no-iso.jpg", 3.0, 8.0, 0.0}, [](double) { return 0.5; });
    EXPECT_THAT(refusalOf({withIso, noIso}).message, HasSubstr("does not say its ISO"));

    const auto small = write({"small.tif", 3.0}, test::gammaCamera, OIIO::TypeDesc::UINT8, 100, 50);
    const Error size = refusalOf({files[0], small});
    EXPECT_THAT(size.message, HasSubstr("100 × 50 pixels, photo0.tif has 480 × 320"));
    EXPECT_EQ(size.file, small);

    const auto linear = write({"linear.exr", 3.0}, {}, OIIO::TypeDesc::FLOAT);
    EXPECT_THAT(refusalOf({files[0], linear}).message, HasSubstr("linear (floating point)"));

    const auto broken = m_folder.write("broken.jpg", "\xff\xd8\xff and no more");
    EXPECT_EQ(refusalOf({files[0], broken}).file, broken);
    EXPECT_EQ(refusalOf({files[0], broken}).kind, ErrorKind::InputBroken);
    EXPECT_EQ(refusalOf({files[0], m_folder / "none.jpg"}).kind, ErrorKind::InputMissing);
}

TEST_F(Brackets, LeaveNothingAfterACancel) {
    const auto files = writeAll(test::fiveShots("tif"), test::gammaCamera);
    JobControl control;
    control.cancel();
    const Result<Bracket> made = makeBracket(worker(), files, {}, control.context());
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().kind, ErrorKind::Cancelled);
}

// Wherever it is when the cancel comes, also while the worker decodes, nothing of it is left.
TEST_F(Brackets, CanBeCancelledAnywhere) {
    const auto files = writeAll(test::fiveShots("tif"), test::gammaCamera);
    for (const double at : {0.1, 0.5, 0.6, 0.8}) {
        JobControl control;
        std::atomic<bool> ended = false;
        Result<Bracket> made = Error{};
        std::thread work([&] {
            made = makeBracket(worker(), files, {}, control.context());
            ended = true;
        });
        while (!ended && control.progress().fraction < at)
            std::this_thread::yield();
        control.cancel();
        work.join();
        if (at < 0.2) {
            EXPECT_FALSE(made.ok()); // four photos are still to be read
        }
        if (!made.ok()) { // else it was faster
            EXPECT_EQ(made.error().kind, ErrorKind::Cancelled) << at;
        }
        EXPECT_TRUE(worker().childProcesses().empty());
    }
}

TEST_F(Brackets, AreToldFromOtherPhotosByTheirExif) {
    const std::vector<std::filesystem::path> files{"a.jpg", "b.jpg"};
    const auto is = [&](const PhotoExposure& a, const PhotoExposure& b) {
        return isBracket(files, std::vector{a, b});
    };
    EXPECT_TRUE(is({0.1, 8, 100}, {0.2, 8, 100}));
    EXPECT_FALSE(is({0.1, 8, 100}, {0.1, 8, 100}));
    EXPECT_FALSE(is({0.1, 8, 100}, {}));
    EXPECT_FALSE(is({0.1, 8, 100}, {0.2, 0, 100}));
}

TEST_F(Brackets, ArePreviewedWithTheirMarks) {
    MergedPhotos merged{Image(4, 2, 3, PixelType::F32, ColorEncoding::Linear),
                        std::vector<std::uint8_t>(8)};
    std::ranges::fill(merged.image.f32(), 0.25f);
    merged.marks[1] = kClippedAbove;
    merged.marks[2] = kClippedBelow | kDisagrees;
    merged.marks[7] = kDisagrees;
    const Image plain = drawPreview(shrinkMerged(merged, 64), 2.0f, false);
    EXPECT_EQ(plain.u8()[0], 255);
    const Image marked = drawPreview(shrinkMerged(merged, 64), 0.0f, true);
    const MarkColors colors;
    const auto pixel = [&](std::size_t at) {
        return std::array{marked.u8()[3 * at], marked.u8()[3 * at + 1], marked.u8()[3 * at + 2]};
    };
    EXPECT_EQ(pixel(0), (std::array<std::uint8_t, 3>{137, 137, 137})); // sRGB of 1/4
    EXPECT_EQ(pixel(1), colors.above);
    EXPECT_EQ(pixel(2), colors.below);
    EXPECT_EQ(pixel(7), colors.disagrees);
    // Of four pixels one is clipped, and one more twice over: both count once.
    const BracketPreview small = shrinkMerged(merged, 2);
    ASSERT_EQ(small.image.width(), 2);
    EXPECT_EQ(small.marks[0].above, 0.25f);
    EXPECT_EQ(small.marks[1].below, 0.25f);
    EXPECT_EQ(small.marks[1].disagrees, 0.25f);
}

} // namespace
} // namespace patina
