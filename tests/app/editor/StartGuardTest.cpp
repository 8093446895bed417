// A start that died leaves out, the next time, what it may have died of.
#include "app/editor/StartGuard.h"

#include "core/base/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <QProcess>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace patina::editor {
namespace {

using LeaveOut = StartGuard::LeaveOut;

// Of a process that has ended.
qint64 deadProcess() {
    QProcess process;
    process.start(QStringLiteral("true"), QStringList());
    EXPECT_TRUE(process.waitForStarted());
    const qint64 number = process.processId();
    EXPECT_TRUE(process.waitForFinished());
    return number;
}

class StartGuardTest : public testing::Test {
  protected:
    // As if that process had written it.
    void sayOf(qint64 process) {
        const auto text = readTextFile(mark, 64);
        ASSERT_TRUE(text.ok());
        const std::string rest = text->substr(text->find(' '));
        ASSERT_TRUE(writeFileAtomically(mark, fmt::format("{}{}", process, rest)).ok());
    }
    const test::TemporaryFolder folder;
    const std::filesystem::path mark = folder / "state" / "starting";
};

TEST_F(StartGuardTest, ADeathLeavesOutTheDocksThenTheLayout) {
    {
        const StartGuard first(mark);
        EXPECT_EQ(first.leaveOut(), LeaveOut::Nothing) << "there was none";
        EXPECT_TRUE(std::filesystem::exists(mark));
    }
    EXPECT_FALSE(std::filesystem::exists(mark)) << "it ended in order";

    for (const LeaveOut expected :
         {LeaveOut::Nothing, LeaveOut::OpenedDocks, LeaveOut::Layout, LeaveOut::Layout}) {
        const StartGuard guard(mark);
        EXPECT_EQ(guard.leaveOut(), expected);
        sayOf(deadProcess()); // it dies
    }
    StartGuard arrives(mark);
    arrives.arrived();
    EXPECT_FALSE(std::filesystem::exists(mark));
    EXPECT_EQ(StartGuard(mark).leaveOut(), LeaveOut::Nothing);
}

TEST_F(StartGuardTest, WithoutDocksToCloseItWasTheLayout) {
    {
        const StartGuard guard(mark);
        sayOf(deadProcess());
    }
    {
        StartGuard second(mark);
        EXPECT_EQ(second.leaveOut(), LeaveOut::OpenedDocks);
        second.leaveOutLayout();
        sayOf(deadProcess());
    }
    EXPECT_EQ(StartGuard(mark).leaveOut(), LeaveOut::Layout);
}

TEST_F(StartGuardTest, AnotherEditorThatIsStartingIsNoDeadOne) {
    QProcess other;
    other.start(QStringLiteral("sleep"), {QStringLiteral("60")});
    ASSERT_TRUE(other.waitForStarted());
    {
        const StartGuard guard(mark);
        sayOf(other.processId());
    }
    {
        const StartGuard guard(mark);
        EXPECT_EQ(guard.leaveOut(), LeaveOut::Nothing);
    }
    other.kill();
    other.waitForFinished();
    EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST_F(StartGuardTest, AMarkThatIsNoneSaysNothing) {
    std::filesystem::create_directories(mark.parent_path());
    for (const char* text : {"", "x", "-7 1", "99999999999999999999 3", "0 0"}) {
        ASSERT_TRUE(writeFileAtomically(mark, std::string_view(text)).ok());
        EXPECT_EQ(StartGuard(mark).leaveOut(), LeaveOut::Nothing) << text;
    }
}

TEST_F(StartGuardTest, SaysWhatIsMissing) {
    EXPECT_TRUE(StartGuard::text({QStringLiteral("Library"), QStringLiteral("Log")})
                    .contains(QStringLiteral("Library, Log")));
    EXPECT_TRUE(StartGuard::text({}).contains(QStringLiteral("All docks")));
}

} // namespace
} // namespace patina::editor
