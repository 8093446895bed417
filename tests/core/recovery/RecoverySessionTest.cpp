// Which work is offered, and that nothing but whole work ever is.

#include "core/recovery/RecoverySession.h"
#include "tests/support/TemporaryFolder.h"

#include <csignal>
#include <gmock/gmock.h>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

RecoveryRecord someRecord(const std::string& name, std::int64_t writtenAt = now()) {
    RecoveryRecord record;
    record.name = name;
    record.file = "/home/ann/f\xe9.patina"; // not UTF-8, as file names may be
    record.savedContent = {1, 2};
    record.writtenAt = writtenAt;
    record.unsavedSince = writtenAt - 60;
    record.steps = 3;
    record.lastStep = "Change Roughness";
    record.meshes = 2;
    record.bakes = {{BakeKind::PrtVertex, {3, 4}, {5, 6}, 256}};
    record.leftOut = {"the rest"};
    record.outside = {"/pictures/a\xff.png", "/b.gltf#embedded:2"};
    record.project = "{\"format\": \"patina\"}";
    return record;
}

// Work that an editor left behind that has ended.
fs::path abandon(const fs::path& root, const RecoveryRecord& record, std::size_t bakeBytes = 0) {
    auto session = RecoverySession::create(root);
    EXPECT_TRUE(session.ok());
    EXPECT_TRUE(writeRecoveryRecord((*session)->recordFile(), record).ok());
    if (bakeBytes > 0) {
        fs::create_directories((*session)->bakeFolder());
        EXPECT_TRUE(
            writeFileAtomically((*session)->bakeFolder() / "a.bake", Bytes(bakeBytes)).ok());
    }
    return (*session)->folder();
}

std::vector<std::string> names(const AbandonedWorks& found) {
    std::vector<std::string> result;
    for (const AbandonedWork& work : found.works)
        result.push_back(work.record.name);
    return result;
}

TEST(RecoveryRecord, ReadsWhatWasWritten) {
    const test::TemporaryFolder folder;
    const RecoveryRecord record = someRecord("helmet.patina");
    ASSERT_TRUE(writeRecoveryRecord(folder / "work", record).ok());
    const auto read = readRecoveryRecord(folder / "work");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(*read, record);
}

TEST(RecoveryRecord, ADamagedFileIsAnErrorAndNeverOtherValues) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(writeRecoveryRecord(folder / "work", someRecord("helmet.patina")).ok());
    const Result<Bytes> whole = readFile(folder / "work", 1 << 20);
    ASSERT_TRUE(whole.ok());
    std::mt19937 random(7);
    for (int run = 0; run < 300; ++run) {
        Bytes damaged = *whole;
        const std::size_t position = random() % damaged.size();
        if (run % 2 == 0)
            damaged.resize(position);
        else
            damaged[position] ^= static_cast<std::byte>(1u << (random() % 8));
        folder.write("damaged", std::span<const std::byte>(damaged));
        const auto read = readRecoveryRecord(folder / "damaged");
        ASSERT_FALSE(read.ok()) << "run " << run << ", position " << position;
        EXPECT_EQ(read.error().kind, ErrorKind::InputBroken);
    }
}

TEST(RecoverySession, ARunningEditorsWorkIsNeverOffered) {
    const test::TemporaryFolder root;
    auto running = RecoverySession::create(root.path());
    ASSERT_TRUE(running.ok());
    ASSERT_TRUE(writeRecoveryRecord((*running)->recordFile(), someRecord("running")).ok());
    EXPECT_THAT(names(abandonedWorks(root.path())), IsEmpty());
    EXPECT_TRUE(fs::exists((*running)->recordFile()));
}

TEST(RecoverySession, WorkOfAProcessThatWasKilledIsOffered) {
    const test::TemporaryFolder root;
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const auto session = RecoverySession::create(root.path());
        const bool written =
            session.ok() &&
            writeRecoveryRecord((*session)->recordFile(), someRecord("killed")).ok();
        const char answer = written ? 'y' : 'n';
        static_cast<void>(::write(ready[1], &answer, 1) == 1);
        while (true)
            ::pause();
    }
    char answer = 0;
    ASSERT_EQ(::read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, 'y');
    EXPECT_THAT(names(abandonedWorks(root.path())), IsEmpty()) << "it runs";
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_THAT(names(abandonedWorks(root.path())), ElementsAre("killed"));
}

TEST(RecoverySession, SeveralAreOfferedNewestFirstAndToOneEditorOnly) {
    const test::TemporaryFolder root;
    abandon(root.path(), someRecord("older", now() - 100));
    abandon(root.path(), someRecord("newest", now()));
    abandon(root.path(), someRecord("oldest", now() - 1000));
    const AbandonedWorks offered = abandonedWorks(root.path());
    EXPECT_THAT(names(offered), ElementsAre("newest", "older", "oldest"));
    EXPECT_THAT(names(abandonedWorks(root.path())), IsEmpty()) << "another editor shows them";
}

TEST(RecoverySession, WhatWasOfferedAndLeftIsOfferedAgain) {
    const test::TemporaryFolder root;
    abandon(root.path(), someRecord("work"));
    EXPECT_THAT(names(abandonedWorks(root.path())), ElementsAre("work"));
    EXPECT_THAT(names(abandonedWorks(root.path())), ElementsAre("work"));
}

TEST(RecoverySession, FoldersWithoutWorkGoAway) {
    const test::TemporaryFolder root;
    fs::create_directories(root.path() / "session-empty");
    EXPECT_THAT(names(abandonedWorks(root.path())), IsEmpty());
    EXPECT_THAT(root.files(), IsEmpty());
}

TEST(RecoverySession, DamagedWorkIsRemovedWithAWord) {
    const test::TemporaryFolder root;
    const fs::path folder = abandon(root.path(), someRecord("work"));
    fs::resize_file(folder / "work.recovery", 40);
    const AbandonedWorks found = abandonedWorks(root.path());
    EXPECT_THAT(names(found), IsEmpty());
    EXPECT_THAT(found.removed, ElementsAre(HasSubstr("damaged")));
}

TEST(RecoverySession, AgeAndNumberAreBoundedWithAWord) {
    const test::TemporaryFolder root;
    abandon(root.path(), someRecord("ancient", now() - 100 * 86400));
    for (int i = 0; i < 4; ++i)
        abandon(root.path(), someRecord(std::to_string(i), now() - i));
    RecoveryLimits limits;
    limits.count = 3;
    const AbandonedWorks found = abandonedWorks(root.path(), limits);
    EXPECT_THAT(names(found), ElementsAre("0", "1", "2"));
    EXPECT_THAT(found.removed, SizeIs(2));
}

TEST(RecoverySession, BakesOfTheOldestGoFirstAndTheWorkItselfStays) {
    const test::TemporaryFolder root;
    abandon(root.path(), someRecord("old", now() - 10), 4 << 20);
    abandon(root.path(), someRecord("new"), 4 << 20);
    RecoveryLimits limits;
    limits.bakeBytes = 6 << 20;
    {
        const AbandonedWorks found = abandonedWorks(root.path(), limits);
        ASSERT_THAT(names(found), ElementsAre("new", "old"));
        EXPECT_THAT(found.works[0].record.bakes, SizeIs(1));
        EXPECT_THAT(found.works[1].record.bakes, IsEmpty());
        EXPECT_THAT(found.works[1].record.leftOut, SizeIs(2)) << "and it says so";
        EXPECT_THAT(found.removed, SizeIs(1));
    }
    const AbandonedWorks again = abandonedWorks(root.path(), limits);
    EXPECT_THAT(again.removed, IsEmpty());
    EXPECT_THAT(again.works[1].record.leftOut, SizeIs(2)) << "later, too";
}

} // namespace
} // namespace patina
