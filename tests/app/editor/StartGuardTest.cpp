// A start that died leaves the layout out the next time.
#include "app/editor/StartGuard.h"

#include <QCoreApplication>
#include <QProcess>
#include <QSettings>
#include <gtest/gtest.h>
#include <optional>

namespace patina::editor {
namespace {

constexpr auto kKey = "start/process";

// Of a process that has ended.
qint64 deadProcess() {
    QProcess process;
    process.start(QStringLiteral("true"), QStringList());
    EXPECT_TRUE(process.waitForStarted());
    const qint64 number = process.processId();
    EXPECT_TRUE(process.waitForFinished());
    return number;
}

TEST(StartGuardTest, KnowsWhetherTheLastStartArrived) {
    QSettings().remove(QLatin1String(kKey));
    {
        const StartGuard first;
        EXPECT_FALSE(first.lastStartDied()) << "there was none";
        EXPECT_EQ(QSettings().value(QLatin1String(kKey)).toLongLong(),
                  QCoreApplication::applicationPid());
    }
    EXPECT_FALSE(QSettings().contains(QLatin1String(kKey))) << "it ended in order";

    QSettings().setValue(QLatin1String(kKey), deadProcess());
    StartGuard second;
    EXPECT_TRUE(second.lastStartDied());
    second.arrived();
    EXPECT_FALSE(QSettings().contains(QLatin1String(kKey)));
}

TEST(StartGuardTest, AnotherEditorThatIsStartingIsNoDeadOne) {
    QProcess other;
    other.start(QStringLiteral("sleep"), {QStringLiteral("60")});
    ASSERT_TRUE(other.waitForStarted());
    QSettings().setValue(QLatin1String(kKey), other.processId());
    {
        const StartGuard guard;
        EXPECT_FALSE(guard.lastStartDied());
    }
    other.kill();
    other.waitForFinished();
    EXPECT_FALSE(QSettings().contains(QLatin1String(kKey)));
}

} // namespace
} // namespace patina::editor
