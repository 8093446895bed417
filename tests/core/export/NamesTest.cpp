#include "core/export/Names.h"

#include <gtest/gtest.h>

using namespace patina;

TEST(Names, KeepValidUtf8AndReplaceTheRest) {
    EXPECT_EQ(cleanName("Körper 身体 🗿", "x"), "Körper 身体 🗿");
    EXPECT_EQ(cleanName("a\xff"
                        "b",
                        "x"),
              "a\xef\xbf\xbd"
              "b");
    EXPECT_EQ(cleanName("\xc0\xaf", "x"), "\xef\xbf\xbd\xef\xbf\xbd"); // overlong '/'
    EXPECT_EQ(cleanName("\xed\xa0\x80", "x"),
              "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");                 // a surrogate
    EXPECT_EQ(cleanName("\xf4\x90\x80\x80", "x").size(), 12u);         // beyond U+10FFFF
    EXPECT_EQ(cleanName("\xe2\x82", "x"), "\xef\xbf\xbd\xef\xbf\xbd"); // cut off
    EXPECT_EQ(cleanName("tab\there\x7f", "x"), "tab here ");
    EXPECT_EQ(cleanName("", "Mesh"), "Mesh");
    EXPECT_EQ(cleanName(" \n", "Mesh"), "Mesh");
}

TEST(Names, FileNamesNeedNoEscaping) {
    EXPECT_EQ(fileSafeName("Worn paint (2).v1", "x"), "Worn_paint__2_.v1");
    EXPECT_EQ(fileSafeName("../../etc", "x"), ".._.._etc");
    EXPECT_EQ(fileSafeName("身体", "body"), "body");
    EXPECT_EQ(fileSafeName("..", "x"), "x");
    EXPECT_EQ(fileSafeName(std::string(500, 'a'), "x").size(), 100u);
}

TEST(Names, RepeatedNamesAreNumberedAlsoWhenOnlyTheCaseDiffers) {
    UniqueNames names;
    EXPECT_EQ(names.take("Body"), "Body");
    EXPECT_EQ(names.take("Body"), "Body_2");
    EXPECT_EQ(names.take("body"), "body_3");
    EXPECT_EQ(names.take("Body_2"), "Body_2_2");
}
