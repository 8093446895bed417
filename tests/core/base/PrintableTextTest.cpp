// No text steers a terminal.
#include "core/base/PrintableText.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace patina {
namespace {

TEST(PrintableText, ControlCharactersBecomePictures) {
    EXPECT_EQ(printableLine("a\x1b]52;c;ZXZpbA==\x07z"), "a␛]52;c;ZXZpbA==␇z");
    EXPECT_EQ(printableLine("two\r\nlines\tand \x7f"), "two␍␊lines␉and ␡");
    EXPECT_EQ(printableText("two\r\nlines\tand"), "two␍\nlines\tand");
    EXPECT_EQ(printableLine(std::string_view("\0", 1)), "␀");
}

TEST(PrintableText, EightBitControlsAndChangesOfDirectionAreReplaced) {
    EXPECT_EQ(printableLine("\xc2\x9b"
                            "31m"),
              "\xef\xbf\xbd"
              "31m"); // CSI
    EXPECT_EQ(printableLine("\x9b"
                            "31m"),
              "\xef\xbf\xbd"
              "31m"); // and as a byte
    EXPECT_EQ(printableLine("gnp.\u202eexe"), "gnp.\xef\xbf\xbd"
                                              "exe");
    EXPECT_EQ(printableLine("a\u2028b\u2066c"), "a\xef\xbf\xbd"
                                                "b\xef\xbf\xbd"
                                                "c");
}

TEST(PrintableText, LanguagesStayAsTheyAre) {
    for (const char* text : {"Grüße, стул, 椅子, כיסא, كرسي", "👩\u200d🚀 é", "x² → ±½", ""})
        EXPECT_EQ(printableLine(text), text);
}

// All code points: nothing that comes out is a control character, and JSON means the same as
// before.
TEST(PrintableText, OfEveryCodePoint) {
    for (char32_t c = 0; c <= 0x10ffff; ++c) {
        if (c >= 0xd800 && c <= 0xdfff)
            continue;
        std::string text;
        if (c < 0x80)
            text = {static_cast<char>(c)};
        else if (c < 0x800)
            text = {static_cast<char>(0xc0 | c >> 6), static_cast<char>(0x80 | (c & 63))};
        else if (c < 0x10000)
            text = {static_cast<char>(0xe0 | c >> 12), static_cast<char>(0x80 | (c >> 6 & 63)),
                    static_cast<char>(0x80 | (c & 63))};
        else
            text = {static_cast<char>(0xf0 | c >> 18), static_cast<char>(0x80 | (c >> 12 & 63)),
                    static_cast<char>(0x80 | (c >> 6 & 63)), static_cast<char>(0x80 | (c & 63))};
        const std::string shown = printableLine(text);
        ASSERT_EQ(printableLine(shown), shown) << static_cast<unsigned>(c);
        ASSERT_FALSE(shown.size() == 1 &&
                     (static_cast<unsigned char>(shown[0]) < 32 || shown == "\x7f"));
        if (c < 0x3000) {
            const std::string json = printableJson(nlohmann::json(text).dump());
            ASSERT_EQ(nlohmann::json::parse(json).get<std::string>(), text);
            for (const char byte : json)
                ASSERT_FALSE((byte >= 0 && byte < 32) || byte == 0x7f);
        }
    }
}

} // namespace
} // namespace patina
