// The process that decodes a file, taken over by it: what it then tries against the user, other
// processes and the client is refused by the kernel or not believed.
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sched.h>
#include <sstream>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace patina {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

struct Attack {
    const char* name;
    long number; // of the system call
    json arguments;
    int expected = EPERM;
};

const json kBlock = {{"bytes", 256}}; // zeros

class CompromisedGuest : public testing::Test {
  protected:
    CompromisedGuest() { client.setLimits(limits); }

    Result<WorkerClient::Reply> ask(json header) {
        header["op"] = "selfTest";
        return client.request(WorkerKind::Model, header.dump(), std::span<const std::byte>(),
                              "chair.obj");
    }
    json answer(json header) {
        const auto reply = ask(std::move(header));
        EXPECT_TRUE(reply.ok()) << reply.error().text();
        return reply.ok() ? json::parse(reply->header) : json();
    }
    int attempt(long number, const json& arguments) {
        return answer({{"do", "call"}, {"number", number}, {"arguments", arguments}})
            .value("errno", -1);
    }
    void expectRefused(const std::vector<Attack>& attacks) {
        for (const Attack& attack : attacks)
            EXPECT_EQ(attempt(attack.number, attack.arguments), attack.expected) << attack.name;
    }

    WorkerLimits limits{std::size_t{4} << 30, 20.0, 60.0};
    WorkerClient client;
};

TEST_F(CompromisedGuest, CannotReachTheNetworkOrOtherPrograms) {
    expectRefused({{"socket", SYS_socket, {AF_INET, SOCK_STREAM, 0}},
                   {"kill", SYS_kill, {::getpid(), 0}},
                   {"tgkill", SYS_tgkill, {::getpid(), ::getpid(), 0}},
                   {"pidfd_open", 434, {::getpid(), 0}},
                   {"ptrace", SYS_ptrace, {16, ::getpid(), 0, 0}},
                   {"io_uring_setup", 425, {8, kBlock}}});
    EXPECT_EQ(answer({{"do", "try"}, {"call", "exec"}})["errno"], EPERM);
    EXPECT_EQ(answer({{"do", "try"}, {"call", "fork"}})["errno"], EPERM);
    EXPECT_EQ(answer({{"do", "try"}, {"call", "thread"}})["errno"], 0); // decoders do use threads
}

TEST_F(CompromisedGuest, CannotTypeIntoTheTerminal) {
    const json described = answer({{"do", "describe"}});
    EXPECT_EQ(described["session"], client.workerProcess(WorkerKind::Model));
    EXPECT_NE(described["session"], ::getsid(0));
    constexpr long kLinuxConsole = 0x541C; // TIOCLINUX
    expectRefused({{"TIOCSTI", SYS_ioctl, {1, TIOCSTI, "x"}},
                   {"TIOCSTI, upper bits set", SYS_ioctl, {1, TIOCSTI | (1l << 40), "x"}},
                   {"TIOCLINUX", SYS_ioctl, {1, kLinuxConsole, kBlock}},
                   {"TIOCSCTTY", SYS_ioctl, {1, TIOCSCTTY, 1}},
                   {"/dev/tty", SYS_openat, {AT_FDCWD, "/dev/tty", O_RDONLY}, ENXIO}});
}

TEST_F(CompromisedGuest, CannotHaveSignalsSentNorFilesLocked) {
    const int victim = ::getpid();
    expectRefused({{"F_SETOWN", SYS_fcntl, {0, F_SETOWN, victim}},
                   {"F_SETOWN, upper bits set", SYS_fcntl, {0, F_SETOWN | (1l << 40), victim}},
                   {"F_SETOWN_EX", SYS_fcntl, {0, F_SETOWN_EX, kBlock}},
                   {"F_SETSIG", SYS_fcntl, {0, F_SETSIG, SIGKILL}},
                   {"O_ASYNC", SYS_fcntl, {0, F_SETFL, O_ASYNC}},
                   {"FIOASYNC", SYS_ioctl, {0, FIOASYNC, kBlock}},
                   {"FIOSETOWN", SYS_ioctl, {0, FIOSETOWN, kBlock}},
                   {"F_SETLK", SYS_fcntl, {0, F_SETLK, kBlock}},
                   {"F_SETLEASE", SYS_fcntl, {0, F_SETLEASE, F_RDLCK}},
                   {"flock", SYS_flock, {0, 2}}});
}

TEST_F(CompromisedGuest, CannotChangeTheFileSystem) {
    const test::TemporaryFolder folder;
    const std::string existing = folder.write("existing", std::string_view("keep"));
    const std::string fresh = folder.path() / "new";
    expectRefused({{"create", SYS_openat, {AT_FDCWD, fresh, O_RDONLY | O_CREAT, 0600}},
                   {"write", SYS_openat, {AT_FDCWD, existing, O_WRONLY}},
                   {"openat2", 437, {AT_FDCWD, existing, kBlock, 24}},
                   {"fchmodat2", 452, {AT_FDCWD, existing, 0777, 0}},
                   {"setxattrat", 463, {AT_FDCWD, existing, 0, "user.x", kBlock, 16}},
                   {"removexattrat", 466, {AT_FDCWD, existing, 0, "user.x"}},
                   {"file_setattr", 469, {AT_FDCWD, existing, kBlock, 16, 0}},
                   {"open_tree", 428, {AT_FDCWD, folder.path().string(), 1}},
                   {"open_tree_attr", 467, {AT_FDCWD, folder.path().string(), 1, kBlock, 32}},
                   {"move_mount", 429, {AT_FDCWD, existing, AT_FDCWD, fresh, 0}},
                   {"fsopen", 430, {"tmpfs", 0}},
                   {"fspick", 433, {AT_FDCWD, folder.path().string(), 0}},
                   {"mount_setattr", 442, {AT_FDCWD, folder.path().string(), 0, kBlock, 32}},
                   {"a call of the future", 505, {0, 0, 0}}});
    EXPECT_FALSE(std::filesystem::exists(fresh));
}

TEST_F(CompromisedGuest, CannotSlowOthersDownButArrangesItself) {
    const int victim = ::getpid();
    expectRefused({{"sched_setaffinity", SYS_sched_setaffinity, {victim, 8, kBlock}},
                   {"sched_setscheduler", SYS_sched_setscheduler, {victim, 0, kBlock}},
                   {"sched_setparam", SYS_sched_setparam, {victim, kBlock}},
                   {"sched_setattr", SYS_sched_setattr, {victim, kBlock, 0}},
                   {"sched_getaffinity", SYS_sched_getaffinity, {victim, 128, kBlock}, ENOSYS},
                   {"setpriority", SYS_setpriority, {0, victim, 19}},
                   {"ioprio_set", SYS_ioprio_set, {1, victim, 0}},
                   {"of itself", SYS_sched_getaffinity, {0, 128, kBlock}, 0}});
}

TEST_F(CompromisedGuest, SeesNothingOfTheUsersEnvironment) {
    ::setenv("PATINA_TEST_TOKEN", "secret", 1);
    WorkerClient fresh;
    const auto reply = fresh.request(WorkerKind::Model, R"({"op":"selfTest","do":"describe"})",
                                     std::span<const std::byte>(), "chair.obj");
    ::unsetenv("PATINA_TEST_TOKEN");
    ASSERT_TRUE(reply.ok()) << reply.error().text();
    const json described = json::parse(reply->header);
    EXPECT_EQ(described["environment"], json::array());
    EXPECT_THAT(described["startedWith"].get<std::string>(), Not(HasSubstr("secret")));
}

TEST_F(CompromisedGuest, CannotReadTheMemoryOfItsClientNorOfItsWorker) {
    EXPECT_EQ(answer({{"do", "describe"}})["dumpable"], 0);
    EXPECT_EQ(::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0), 0);
    for (const int pid : {::getpid(), client.workerProcess(WorkerKind::Model)})
        for (const char* file : {"mem", "environ", "maps"}) {
            const std::string path = fmt::format("/proc/{}/{}", pid, file);
            EXPECT_EQ(attempt(SYS_openat, {AT_FDCWD, path, O_RDONLY}), EACCES) << path;
        }
    expectRefused({{"dumpable again", SYS_prctl, {PR_SET_DUMPABLE, 1, 0, 0, 0}},
                   {"outliving us", SYS_prctl, {PR_SET_PDEATHSIG, 0, 0, 0, 0}},
                   {"a tracer", SYS_prctl, {PR_SET_PTRACER, -1, 0, 0, 0}},
                   {"process_vm_readv", SYS_process_vm_readv, {::getpid(), 0, 0, 0, 0, 0}},
                   {"capset", SYS_capset, {kBlock, kBlock}}});
}

TEST_F(CompromisedGuest, CannotFloodTheSystemWithFilesOrThreads) {
    std::istringstream lines(answer({{"do", "describe"}})["limits"].get<std::string>());
    std::map<std::string, long> limit; // "Max open files            1024    1024    files"
    for (std::string line; std::getline(lines, line);)
        for (const char* name : {"Max open files", "Max processes"})
            if (line.starts_with(name))
                limit[name] = std::atol(line.c_str() + 26); // "unlimited" is 0
    EXPECT_EQ(limit["Max open files"], 1024);
    // All tasks of this system are well below a million, and the limit lies little above them.
    EXPECT_GT(limit["Max processes"], 1024);
    EXPECT_LT(limit["Max processes"], 1'000'000);
    EXPECT_EQ(answer({{"do", "files"}})["errno"], EMFILE);
}

// A memory file that was never written costs its sender nothing, and its reader all it claims.
TEST_F(CompromisedGuest, CannotMakeItsClientTakeMemory) {
    limits.replyBytes = 1 << 20;
    client.setLimits(limits);
    EXPECT_TRUE(ask({{"do", "echo"}, {"hollow", true}, {"size", 1 << 20}}).ok());
    const auto payload = ask({{"do", "echo"}, {"hollow", true}, {"size", (1 << 20) + 1}});
    ASSERT_FALSE(payload.ok());
    EXPECT_EQ(payload.error().kind, ErrorKind::InputBroken);
    EXPECT_THAT(payload.error().message, HasSubstr("more than the supported 1 MiB"));

    const auto header = ask({{"do", "echo"}, {"words", (256 << 20) + 1}});
    ASSERT_FALSE(header.ok());
    EXPECT_THAT(header.error().message, HasSubstr("makes no sense"));

    const auto error = ask({{"do", "throw"}, {"words", 2 << 20}});
    ASSERT_FALSE(error.ok());
    EXPECT_LT(error.error().message.size(), 1000u);
}

} // namespace
} // namespace patina
