// patina compare.
#include "CommandsFixture.h"

#include <cmath>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(Commands, CompareGivesExactNumbers) {
    save(m_folder / "a.png", 2, 1, 3, {255, 0, 0, 10, 20, 30});
    save(m_folder / "b.png", 2, 1, 3, {0, 0, 0, 10, 20, 30});
    const Outcome outcome = runPatina(
        {"compare", m_folder / "a.png", m_folder / "b.png", "--json", "-o", m_folder / "d.png"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    nlohmann::json json = outcome.json();
    EXPECT_EQ(json["command"], "compare");
    EXPECT_NEAR(json["rmse"].get<double>(), std::sqrt(1.0 / 6), 1e-9);
    EXPECT_NEAR(json["psnr"].get<double>(), 10 * std::log10(6.0), 1e-9);
    EXPECT_NEAR(json["relmse"].get<double>(), 1 / 0.01 / 6, 1e-9);
    EXPECT_EQ(json["max"], 1.0);
    EXPECT_EQ(json["samples"], 6);
    EXPECT_EQ(json["different"], 1);
    EXPECT_EQ(json["identical"], false);
    const Image difference = load(m_folder / "d.png");
    EXPECT_THAT(difference.u8(), ElementsAre(255, 0, 0, 0, 0, 0));
}

TEST_F(Commands, CompareNamesTheFileThatHasNoNumbers) {
    for (const char* name : {"a.exr", "b.exr"}) {
        Image image(2, 1, 3, PixelType::F32, ColorEncoding::Linear);
        image.f32()[4] = name[0] == 'b' ? std::nanf("") : 1.0f;
        ASSERT_TRUE(saveImage(m_worker, image, m_folder / name).ok());
    }
    for (const bool first : {false, true}) {
        const Outcome outcome = runPatina({"compare", m_folder / (first ? "b.exr" : "a.exr"),
                                           m_folder / (first ? "a.exr" : "b.exr")});
        EXPECT_EQ(outcome.status, 65);
        EXPECT_THAT(outcome.err, HasSubstr("b.exr"));
        EXPECT_THAT(outcome.err, HasSubstr("1 of its samples"));
    }
}

// The same numbers of other primaries are another colour: green of ACEScg (AP1) lies outside of
// Rec.709.
TEST_F(Commands, CompareKnowsThePrimariesOfPictures) {
    const auto write = [&](const char* name, const std::string& header) {
        std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + header + "\n-Y 1 +X 2\n";
        for (int pixel = 0; pixel < 2; ++pixel)
            file += std::string("\0\x80\0\x81", 4); // 0 1 0
        writeBytes(m_folder / name, file);
    };
    write("plain.hdr", "");
    write("rec709.hdr", "PRIMARIES=0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290\n");
    write("acescg.hdr", "PRIMARIES=0.713 0.293 0.165 0.830 0.128 0.044 0.32168 0.33767\n");
    const auto compared = [&](const char* a, const char* b) {
        return runPatina({"compare", m_folder / a, m_folder / b, "--json"}).json();
    };
    EXPECT_EQ(compared("plain.hdr", "rec709.hdr")["identical"], true);
    EXPECT_EQ(compared("acescg.hdr", "acescg.hdr")["identical"], true);
    const nlohmann::json json = compared("acescg.hdr", "plain.hdr");
    EXPECT_EQ(json["identical"], false);
    // AP1 green in linear Rec.709, white adapted: -0.6217, 1.1408, -0.1290 (to four digits, as in
    // the tables of ACES 1.0.3).
    EXPECT_NEAR(json["max"].get<double>(), 0.6217, 2e-3);
    EXPECT_NEAR(json["rmse"].get<double>(),
                std::sqrt((0.6217 * 0.6217 + 0.1408 * 0.1408 + 0.1290 * 0.1290) / 3), 2e-3);
    ASSERT_EQ(json["converted"].size(), 1u);
    EXPECT_THAT(json["converted"][0]["file"].get<std::string>(), HasSubstr("acescg.hdr"));
    EXPECT_THAT(json["warnings"][0].get<std::string>(), HasSubstr("converted to Rec.709"));
}

TEST_F(Commands, CompareSaysThatImagesAreIdentical) {
    save(m_folder / "a.png", 2, 2, 3, {1, 2, 3, 4});
    const Outcome human = runPatina({"compare", m_folder / "a.png", m_folder / "a.png"});
    EXPECT_EQ(human.status, 0);
    EXPECT_THAT(human.out, HasSubstr("rmse    0\n"));
    EXPECT_THAT(human.out, HasSubstr("identical"));
    nlohmann::json json =
        runPatina({"compare", m_folder / "a.png", m_folder / "a.png", "--json"}).json();
    EXPECT_EQ(json["identical"], true);
    EXPECT_TRUE(json["psnr"].is_null());
    save(m_folder / "b.png", 1, 2, 3, {1});
    EXPECT_EQ(runPatina({"compare", m_folder / "a.png", m_folder / "b.png"}).status, 2);
}

TEST_F(Commands, CompareGivesFlipAndSsimOfPictures) {
    save(m_folder / "black.png", 16, 12, 3, {0});
    save(m_folder / "white.png", 16, 12, 3, {255});
    const std::vector<std::string> arguments = {"compare", m_folder / "black.png",
                                                m_folder / "white.png", "--json"};
    const nlohmann::json json = runPatina(arguments).json();
    EXPECT_NEAR(json["flip"].get<double>(), 0.967379, 1e-5);
    EXPECT_NEAR(json["ssim"].get<double>(), 1e-4 / (1 + 1e-4), 1e-7);
    EXPECT_EQ(json["flipDetails"]["kind"], "ldr");
    EXPECT_NEAR(json["flipDetails"]["pixelsPerDegree"].get<double>(), 67.02, 0.01);
    EXPECT_FALSE(json["flipDetails"].contains("exposures"));
    EXPECT_EQ(json["maxPixel"], nlohmann::json({0, 0}));
    const nlohmann::json same =
        runPatina({"compare", m_folder / "black.png", m_folder / "black.png", "--json"}).json();
    EXPECT_EQ(same["flip"], 0.0);
    EXPECT_EQ(same["ssim"], 1.0);
}

TEST_F(Commands, CompareLooksAtLinearPicturesAtSeveralExposures) {
    const auto write = [&](const char* name, float light, int channels) {
        Image image(4, 4, channels, PixelType::F32, ColorEncoding::Linear);
        for (std::size_t i = 0; i < image.f32().size(); ++i)
            image.f32()[i] = light * static_cast<float>(i + 1);
        ASSERT_TRUE(saveImage(m_worker, image, m_folder / name).ok());
    };
    write("a.exr", 1.0f, 3);
    write("b.exr", 1.5f, 3);
    const Outcome outcome =
        runPatina({"compare", m_folder / "a.exr", m_folder / "b.exr", "--json"});
    const nlohmann::json json = outcome.json();
    EXPECT_GT(json["flip"], 0.0);
    EXPECT_EQ(json["flipDetails"]["kind"], "hdr");
    EXPECT_EQ(json["flipDetails"]["exposures"]["count"], 2);
    EXPECT_LT(json["flipDetails"]["exposures"]["start"], json["flipDetails"]["exposures"]["stop"]);
    EXPECT_THAT(runPatina({"compare", m_folder / "a.exr", m_folder / "b.exr"}).out,
                HasSubstr("HDR, 2 exposures from "));

    // Coefficients are compared, too, but nobody sees them.
    write("c.exr", 1.0f, 6);
    write("d.exr", 2.0f, 6);
    const std::vector<std::string> coefficients = {"compare", m_folder / "c.exr",
                                                   m_folder / "d.exr", "--json"};
    const nlohmann::json numbers = runPatina(coefficients).json();
    EXPECT_GT(numbers["rmse"], 0.0);
    EXPECT_TRUE(numbers["flip"].is_null());
    EXPECT_TRUE(numbers["ssim"].is_null());
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--fail-above", "flip=1"},
          std::vector<std::string>{"-o", m_folder / "e.exr", "--difference", "flip"}}) {
        std::vector<std::string> refused = coefficients;
        refused.insert(refused.end(), more.begin(), more.end());
        EXPECT_EQ(runPatina(refused).status, 2) << more[0];
    }
}

TEST_F(Commands, CompareFailsBeyondLimits) {
    save(m_folder / "a.png", 2, 2, 3, {100});
    save(m_folder / "b.png", 2, 2, 3, {151}); // 0.2 apart, 13.98 dB
    const auto status = [&](const std::vector<std::string>& limits) {
        std::vector<std::string> arguments = {"compare", m_folder / "a.png", m_folder / "b.png"};
        arguments.insert(arguments.end(), limits.begin(), limits.end());
        return runPatina(arguments).status;
    };
    EXPECT_EQ(status({"--fail-above", "rmse=0.21"}), 0);
    EXPECT_EQ(status({"--fail-above", "rmse=0.19"}), 1);
    EXPECT_EQ(status({"--fail-above", "rmse=0.21", "--fail-above", "max=0.19"}), 1);
    EXPECT_EQ(status({"--fail-above", "flip=0.0001"}), 1);
    EXPECT_EQ(status({"--fail-below", "psnr=13"}), 0);
    EXPECT_EQ(status({"--fail-below", "psnr=14"}), 1);
    EXPECT_EQ(status({"--fail-below", "ssim=0.999"}), 1);
    for (const char* wrong : {"rmse", "rmse=", "rmse=x", "rmse=1,2", "lpips=1", "rmse=nan", "=1"})
        EXPECT_EQ(status({"--fail-above", wrong}), 2) << wrong;

    const Outcome failed = runPatina(
        {"compare", m_folder / "a.png", m_folder / "b.png", "--json", "--fail-above", "max=0.1"});
    EXPECT_EQ(failed.status, 1);
    EXPECT_THAT(failed.err, HasSubstr("max is 0.2, above 0.1"));
    EXPECT_THAT(failed.json()["failed"], ElementsAre("max is 0.2, above 0.1"));
    EXPECT_NEAR(failed.json()["rmse"].get<double>(), 0.2, 1e-6); // numbers all the same
    EXPECT_FALSE(failed.json().contains("error"));
    // Identical pictures pass any limit of what they should not fall below.
    EXPECT_EQ(runPatina({"compare", m_folder / "a.png", m_folder / "a.png", "--fail-below",
                         "psnr=1000", "--fail-below", "ssim=1"})
                  .status,
              0);
}

TEST_F(Commands, CompareFitsOtherSizesWhenAskedAndSaysSo) {
    save(m_folder / "a.png", 4, 2, 3, {100});
    save(m_folder / "b.png", 2, 2, 3, {100});
    const Outcome refused = runPatina({"compare", m_folder / "a.png", m_folder / "b.png"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("4 × 2 and 2 × 2 pixels"));
    EXPECT_THAT(refused.err, HasSubstr("--fit"));
    const Outcome fitted =
        runPatina({"compare", m_folder / "a.png", m_folder / "b.png", "--fit", "--json"});
    EXPECT_EQ(fitted.status, 0) << fitted.err;
    EXPECT_THAT(fitted.err,
                HasSubstr("b.png was scaled from 2 × 2 to 4 × 2 pixels, which changes"));
    EXPECT_EQ(fitted.json()["fitted"]["from"], nlohmann::json({2, 2}));
    EXPECT_EQ(fitted.json()["fitted"]["stretched"], true);
    EXPECT_LT(fitted.json()["max"], 1e-6);
    EXPECT_FALSE(runPatina({"compare", m_folder / "a.png", m_folder / "a.png", "--fit", "--json"})
                     .json()
                     .contains("fitted"));
}

TEST_F(Commands, CompareWritesEachDifference) {
    save(m_folder / "a.png", 2, 1, 3, {255, 255, 255, 51, 51, 51});
    save(m_folder / "b.png", 2, 1, 3, {0, 0, 0, 102, 102, 102});
    const auto write = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {
            "compare", m_folder / "a.png", m_folder / "b.png", "--json", "-o", m_folder / name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json()["difference"];
    };
    EXPECT_EQ(write("signed.exr", {"--difference", "signed"})["shown"], "signed");
    const Image numbers = load(m_folder / "signed.exr");
    EXPECT_EQ(numbers.channels(), 1);
    EXPECT_FLOAT_EQ(numbers.sample(0, 0, 0), 1.0f);
    EXPECT_FLOAT_EQ(numbers.sample(1, 0, 0), 0.0f); // negative samples are read as 0

    EXPECT_EQ(write("signed.png", {"--difference", "signed"})["from"], -1.0);
    const Image colors = load(m_folder / "signed.png");
    EXPECT_GT(colors.sample(0, 0, 0), colors.sample(0, 0, 2)); // orange above
    EXPECT_LT(colors.sample(1, 0, 0), colors.sample(1, 0, 2)); // blue below

    const nlohmann::json absolute = write("absolute.png", {"--difference", "absolute"});
    EXPECT_EQ(absolute["to"], 1.0);
    EXPECT_EQ(write("ranged.png", {"--difference", "absolute", "--range", "0.2"})["to"].dump(),
              nlohmann::json(0.2f).dump());
    const Image ranged = load(m_folder / "ranged.png");
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(ranged.sample(0, 0, c), ranged.sample(1, 0, c)); // both at the end of the scale

    // FLIP is shown from 0 to 1 in magma, whose blue is never 0 and ends at 191.
    EXPECT_EQ(write("flip.png", {"--difference", "flip"})["to"], 1.0);
    EXPECT_GT(load(m_folder / "flip.png").u8()[0], 200);
    EXPECT_EQ(write("hidden.png", {"--difference", "relative", "--visible", "1"})["visible"], 1.0);
    const Image hidden = load(m_folder / "hidden.png");
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(hidden.sample(0, 0, c), hidden.sample(1, 0, c)); // nothing is left

    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"-o", m_folder / "d.png", "--difference", "squared"},
          std::vector<std::string>{"--difference", "flip"},
          std::vector<std::string>{"-o", m_folder / "d.hdr", "--difference", "signed"},
          std::vector<std::string>{"-o", m_folder / "d.txt"},
          std::vector<std::string>{"-o", m_folder / "d.png", "--difference", "flip", "--range",
                                   "0"}}) {
        std::vector<std::string> arguments = {"compare", m_folder / "a.png", m_folder / "b.png"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(runPatina(arguments).status, 2) << wrong.back();
    }
}
