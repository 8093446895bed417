#include "app/cli/Report.h"

#include <gtest/gtest.h>

using namespace patina;
using namespace patina::cli;

TEST(Report, EveryKindOfErrorHasItsExitStatus) {
    EXPECT_EQ(exitStatus(ErrorKind::Usage), 2);
    EXPECT_EQ(exitStatus(ErrorKind::InputBroken), 65);
    EXPECT_EQ(exitStatus(ErrorKind::InputMissing), 66);
    EXPECT_EQ(exitStatus(ErrorKind::NoOpenGl), 69);
    EXPECT_EQ(exitStatus(ErrorKind::Internal), 70);
    EXPECT_EQ(exitStatus(ErrorKind::CannotCreate), 73);
    EXPECT_EQ(exitStatus(ErrorKind::Io), 74);
    EXPECT_EQ(exitStatus(ErrorKind::Cancelled), 130);
}

// A name from a file as long as it likes does not push the other values out of sight.
TEST(Report, LongNamesMoveTheirOwnValueAlone) {
    Report report("info", false, false);
    testing::internal::CaptureStdout();
    report.table("Settings", {{"samples", "64"}, {std::string(70'000, 'x'), "1"}, {"seed", "0"}});
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_LT(text.size(), 70'200u);
    EXPECT_NE(text.find("  samples  64\n"), std::string::npos);
    EXPECT_NE(text.find("x  1\n"), std::string::npos);
    EXPECT_NE(text.find("  seed     0\n"), std::string::npos);
}

TEST(Report, NumbersAreWrittenForPeople) {
    EXPECT_EQ(countText(0), "0");
    EXPECT_EQ(countText(999), "999");
    EXPECT_EQ(countText(1000), "1,000");
    EXPECT_EQ(countText(12345678), "12,345,678");
    EXPECT_EQ(bytesText(1023), "1023 bytes");
    EXPECT_EQ(bytesText(1536), "1.5 KiB");
    EXPECT_EQ(bytesText(std::size_t{5} << 20), "5.0 MiB");
    EXPECT_EQ(bytesText(std::size_t{3} << 40), "3072.0 GiB");
}
