// The second wall: what Landlock alone refuses, in a process whose system calls are not filtered.
#include "app/worker/Landlock.h"

#include "tests/support/TemporaryFolder.h"

#include <cerrno>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace patina {
namespace {

// In a process of its own, which ends with the errno of `attempt`: 0 when it succeeded. 255:
// Landlock could not be had.
int afterGivingUpFiles(const std::function<long()>& attempt) {
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
        if (!worker::giveUpFiles(worker::landlockVersion()).empty())
            ::_exit(255);
        ::_exit(attempt() < 0 ? errno : 0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(pid, &status, 0), pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 254;
}

TEST(Landlock, RefusesEveryFile) {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("key", std::string_view("secret"));
    const std::string other = folder / "other";
    // A kernel without it says so, and nobody takes that for a wall.
    const int refused = worker::landlockVersion() > 0 ? EACCES : 255;
    EXPECT_EQ(afterGivingUpFiles([&] { return ::open(file.c_str(), O_RDONLY); }), refused);
    EXPECT_EQ(afterGivingUpFiles([&] { return ::open(file.c_str(), O_WRONLY); }), refused);
    EXPECT_EQ(afterGivingUpFiles([&] { return ::open(other.c_str(), O_RDWR | O_CREAT, 0600); }),
              refused);
    EXPECT_EQ(afterGivingUpFiles([&] { return ::unlink(file.c_str()); }), refused);
    EXPECT_EQ(afterGivingUpFiles([&] { return ::open("/proc/self/environ", O_RDONLY); }), refused);
    EXPECT_EQ(afterGivingUpFiles([&] { return ::open("/dev/null", O_RDONLY); }), refused);
    EXPECT_EQ(
        afterGivingUpFiles([&] { return ::open(folder.path().c_str(), O_RDONLY | O_DIRECTORY); }),
        refused);
    EXPECT_EQ(afterGivingUpFiles([] { return ::execl("/bin/true", "true", nullptr); }), refused);
    EXPECT_EQ(::access(file.c_str(), F_OK), 0) << "it is still there";
}

TEST(Landlock, NewerVersionsRefuseNetworkAndSignals) {
    const int version = worker::landlockVersion();
    const auto port = [] {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(9);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        return static_cast<long>(
            ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address));
    };
    EXPECT_EQ(afterGivingUpFiles(port), version == 0 ? 255 : version < 4 ? ECONNREFUSED : EACCES);
    EXPECT_EQ(afterGivingUpFiles([] { return ::kill(::getppid(), 0); }), version == 0  ? 255
                                                                         : version < 6 ? 0
                                                                                       : EPERM);
}

} // namespace
} // namespace patina
