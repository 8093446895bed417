// `patina bracket`. What the radiance is belongs to tests/core/bracket.
#include "CommandsFixture.h"

#include <algorithm>
#include <cmath>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class BracketCommand : public Commands {
  protected:
    // A grey ramp under the sRGB curve at 2^ev; no Exif.
    std::string photo(const std::string& name, double ev, int width = 256) {
        std::vector<int> values;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < width; ++x) {
                const double radiance = std::exp2(ev - 5.0 + 10.0 * x / width + 0.005 * y);
                const double code =
                    radiance <= 0.0031308
                        ? 12.92 * radiance
                        : 1.055 * std::pow(std::min(radiance, 1.0), 1 / 2.4) - 0.055;
                values.insert(values.end(), 3, static_cast<int>(std::lround(255.0 * code)));
            }
        save(m_folder / name, width, 128, 3, values);
        return m_folder / name;
    }
};

} // namespace

TEST_F(BracketCommand, WritesOnePictureAndSaysHow) {
    const std::vector<std::string> photos{photo("a.png", -2.5), photo("b.png", 0.0),
                                          photo("c.png", 2.5)};
    for (const char* name : {"out.exr", "out.hdr"}) {
        const Outcome made =
            runPatina({"bracket", photos[2], photos[0], photos[1], "--exposures", "2.5,-2.5,0",
                       "-o", m_folder / name, "--marks", m_folder / "marks.png", "--json"});
        ASSERT_EQ(made.status, 0) << made.err << made.out;
        const nlohmann::json json = made.json();
        EXPECT_EQ(json["command"], "bracket");
        EXPECT_EQ(json["width"], 256);
        EXPECT_EQ(json["response"]["kind"], "sRGB");
        EXPECT_EQ(json["response"]["logExposures"][0].size(), 256u);
        ASSERT_EQ(json["photos"].size(), 3u);
        EXPECT_EQ(json["photos"][0]["file"], photos[0]);
        EXPECT_DOUBLE_EQ(json["photos"][0]["ev"], -2.5);
        EXPECT_EQ(json["photos"][0]["shift"], nlohmann::json({0, 0}));
        EXPECT_GT(json["photos"][2]["white"], 0.3);
        EXPECT_EQ(json["outputs"].size(), 2u);
        const Image image = load(m_folder / name);
        // As the photo at 0 EV, and two stops beyond its white.
        EXPECT_NEAR(image.linear(128, 0).r, 1.0f, 0.02f);
        EXPECT_NEAR(image.linear(180, 0).r, std::exp2(2.03125f), 0.1f);
    }
    EXPECT_EQ(load(m_folder / "marks.png").height(), 128);
}

TEST_F(BracketCommand, RefusesWhatMakesNoBracket) {
    const std::string a = photo("a.png", -3.0), b = photo("b.png", 3.0),
                      wide = photo("wide.png", 0.0, 300);
    const std::string out = m_folder / "out.exr";
    const struct {
        std::vector<std::string> arguments;
        int status;
        const char* message;
    } cases[] = {
        {{"bracket", a, b, "-o", out}, 2, "does not say its exposure time (Exif)"},
        {{"bracket", a, b, "-o", out, "--exposures", "1"},
         2,
         "1 exposures were given for 2 photos"},
        {{"bracket", a, b, "-o", out, "--exposures", "1,x"}, 2, "a number of stops for each photo"},
        {{"bracket", a, b, "-o", out, "--exposures", "nan,1"},
         2,
         "a number of stops for each photo"},
        {{"bracket", a, b, "-o", out, "--exposures", "0,inf"},
         2,
         "a number of stops for each photo"},
        {{"bracket", a, b, "-o", out, "--exposures", "0,1e30"}, 2, "from -100 to 100"},
        {{"bracket", a, b, "-o", out, "--exposures", "1,1"}, 2, "the same exposure"},
        {{"bracket", a, "-o", out, "--exposures", "1"}, 2, "two photos or more"},
        {{"bracket", a, wide, "-o", out, "--exposures", "-3,0"}, 2, "300 × 128 pixels"},
        {{"bracket", a, b, "-o", m_folder / "out.png"}, 2, ".exr or .hdr"},
        {{"bracket", a, b, "-o", out, "--marks", m_folder / "m.exr"}, 2, "--marks"},
        {{"bracket", "-o", out}, 2, "PHOTO"},
        {{"bracket", a, m_folder / "none.png", "-o", out, "--exposures", "0,2"}, 66, "none.png"},
        {{"bracket", a, b, "-o", m_folder / "no/out.exr", "--exposures", "0,2"}, 73, "no"},
    };
    for (const auto& c : cases) {
        const Outcome outcome = runPatina(c.arguments);
        EXPECT_EQ(outcome.status, c.status) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(c.message));
    }
    EXPECT_THAT(m_folder.files(), ElementsAre("a.png", "b.png", "wide.png"));
}
