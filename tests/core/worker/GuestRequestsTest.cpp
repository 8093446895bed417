#include "core/worker/GuestRequests.h"

#include "tests/support/TemporaryFolder.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

class OpenBelow : public testing::Test {
  protected:
    OpenBelow()
        : home(fs::canonical(folder.path())) {
        folder.write(".ssh/id_rsa", std::string_view("key"));
        folder.write("letter.txt", std::string_view("dear"));
        folder.write("chair/chair.obj", std::string_view("v 0 0 0"));
        folder.write("chair/maps/wood.bin", std::string_view("wood"));
        folder.write("chairs/other.bin", std::string_view("other"));
    }
    int open(const fs::path& below, const fs::path& path) {
        FileDescriptor file;
        const int error = openBelow(below, path, file);
        EXPECT_EQ(file.valid(), error == 0) << path;
        return error;
    }
    void link(const std::string& target, const std::string& name) const {
        fs::create_symlink(target, home / "chair" / name);
    }

    test::TemporaryFolder folder;
    const fs::path home;
    const fs::path chair = home / "chair";
};

TEST_F(OpenBelow, FilesOfTheFolderAreOpenedReadOnly) {
    FileDescriptor file;
    ASSERT_EQ(openBelow(chair, chair / "maps/wood.bin", file), 0);
    std::array<char, 8> text{};
    EXPECT_EQ(::read(file.get(), text.data(), text.size()), 4);
    EXPECT_EQ(::fcntl(file.get(), F_GETFL) & O_ACCMODE, O_RDONLY);
    EXPECT_EQ(open(chair, chair / "maps/../chair.obj"), 0);
    EXPECT_EQ(open(chair, chair / "gone.bin"), ENOENT);
}

TEST_F(OpenBelow, NothingElseIs) {
    EXPECT_EQ(open(chair, home / "letter.txt"), EACCES);
    EXPECT_EQ(open(chair, chair / "../letter.txt"), EACCES);
    EXPECT_EQ(open(chair, chair / "maps/../../letter.txt"), EACCES);
    EXPECT_EQ(open(chair, home / "chairs/other.bin"), EACCES) << "a name that begins alike";
    EXPECT_EQ(open(chair, home / "gone.txt"), EACCES) << "nor is said what exists";
    EXPECT_EQ(open(chair, chair), EACCES);
    EXPECT_EQ(open(chair, chair / "maps"), EACCES);
    EXPECT_EQ(open(chair, "chair.obj"), EACCES) << "relative to what?";
    EXPECT_EQ(open(chair, ""), EACCES);
    EXPECT_EQ(open({}, chair / "chair.obj"), EACCES);
    EXPECT_EQ(open({}, "/etc/passwd"), EACCES);
    EXPECT_EQ(open(home, home / ".ssh/id_rsa"), EACCES) << "a model in the home folder";
    EXPECT_EQ(open(home, home / "letter.txt"), 0);
}

TEST_F(OpenBelow, LinksAreFollowedAsLongAsTheyStayBelow) {
    link("maps/wood.bin", "inside");
    link((chair / "maps").string(), "folder");
    link("../letter.txt", "outside");
    link("/etc/passwd", "absolute");
    link("..", "parent");
    link("outside", "twice");
    link("loop", "loop");
    link("/proc/self/environ", "environment");
    EXPECT_EQ(open(chair, chair / "inside"), 0);
    EXPECT_EQ(open(chair, chair / "folder/wood.bin"), 0);
    EXPECT_EQ(open(chair, chair / "outside"), EACCES);
    EXPECT_EQ(open(chair, chair / "absolute"), EACCES);
    EXPECT_EQ(open(chair, chair / "parent/letter.txt"), EACCES);
    EXPECT_EQ(open(chair, chair / "twice"), EACCES);
    EXPECT_EQ(open(chair, chair / "loop"), ELOOP);
    EXPECT_EQ(open(chair, chair / "environment"), EACCES);
    fs::create_symlink(".ssh/id_rsa", home / "plain");
    EXPECT_EQ(open(home, home / "plain"), EACCES) << "to a hidden file";
}

TEST_F(OpenBelow, PipesAndDevicesAreNot) {
    ASSERT_EQ(::mkfifo((chair / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(open(chair, chair / "pipe"), EACCES);
    EXPECT_EQ(open("/dev", "/dev/tty"), EACCES);
    EXPECT_EQ(open("/dev", "/dev/null"), EACCES);
}

class Requests : public testing::Test {
  protected:
    Requests() {
        std::array<int, 2> pair{};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()), 0);
        mine = FileDescriptor(pair[0]);
        theirs = FileDescriptor(pair[1]);
    }
    static protocol::Report memory(std::int64_t size) {
        protocol::Report report;
        report.event = protocol::Event::CreateMemory;
        report.value = size;
        return report;
    }
    // What the child gets: an errno, and the size of the file.
    std::pair<int, off_t> fetch() {
        protocol::Grant grant;
        const auto received =
            protocol::receive(theirs.get(), std::as_writable_bytes(std::span(&grant, 1)));
        EXPECT_TRUE(received && received->size == sizeof grant);
        EXPECT_EQ(received->descriptors.empty(), grant.error != 0);
        if (received->descriptors.empty())
            return {grant.error, -1};
        struct stat status {};
        ::fstat(received->descriptors[0].get(), &status);
        growth = ::ftruncate(received->descriptors[0].get(), status.st_size + 1) == 0 ? 0 : errno;
        return {0, status.st_size};
    }
    int ask(GuestRequests& requests, std::int64_t size) {
        EXPECT_TRUE(requests.answer(mine.get(), memory(size), {}));
        return fetch().first;
    }

    FileDescriptor mine, theirs;
    int growth = 0; // errno
};

TEST_F(Requests, MemoryFilesShareOneLimitAndDoNotGrow) {
    GuestRequests requests({{}, {}, -1, 1000, false});
    EXPECT_EQ(ask(requests, 600), 0);
    EXPECT_EQ(growth, EPERM);
    EXPECT_EQ(ask(requests, 401), ENOMEM);
    EXPECT_EQ(ask(requests, 400), 0);
    EXPECT_EQ(ask(requests, 1), ENOMEM);
    EXPECT_EQ(ask(requests, 0), 0);
    EXPECT_EQ(ask(requests, protocol::kGrowing), EPERM);
    EXPECT_EQ(ask(requests, -1000), EPERM);
}

TEST_F(Requests, AnEncoderHasOneFileThatGrows) {
    GuestRequests requests({{}, {}, -1, 1000, true});
    EXPECT_EQ(ask(requests, protocol::kGrowing), 0);
    EXPECT_EQ(growth, 0);
    EXPECT_EQ(ask(requests, protocol::kGrowing), EPERM);
}

TEST_F(Requests, WhoDoesNotFetchGetsNoMore) {
    GuestRequests requests({{}, {}, -1, 1000, false});
    EXPECT_TRUE(requests.answer(mine.get(), memory(1), {}));
    EXPECT_FALSE(requests.answer(mine.get(), memory(1), {}));
    fetch();
    EXPECT_TRUE(requests.answer(mine.get(), memory(1), {}));
}

TEST_F(Requests, ThePayloadIsOpenedAgainUnderItsName) {
    const test::TemporaryFolder folder;
    const fs::path target = folder.write("aces/config.ocio", std::string_view("config"));
    const fs::path name = folder.path() / "studio" / "config.ocio";
    fs::create_directory(name.parent_path());
    fs::create_symlink(target, name);
    const FileDescriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
    GuestRequests requests({name, fs::canonical(name.parent_path()), file.get(), 0, false});
    protocol::Report report;
    report.event = protocol::Event::OpenFile;
    EXPECT_TRUE(requests.answer(mine.get(), report, name.native()));
    EXPECT_EQ(fetch(), std::pair(0, off_t{6}));
    EXPECT_TRUE(requests.answer(mine.get(), report, target.native()));
    EXPECT_EQ(fetch().first, EACCES);
    report.event = protocol::Event::OpenPayload;
    EXPECT_TRUE(requests.answer(mine.get(), report, {}));
    EXPECT_EQ(fetch(), std::pair(0, off_t{6}));
}

} // namespace
} // namespace patina
