// The process that decodes a file, taken over by it: what it then tries against the user, other
// processes and the client is refused by the kernel or not believed. Each with Landlock, where the
// kernel has it, and without.
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sched.h>
#include <set>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
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
    int expected = ENOSYS; // as if the kernel had no such call
};

const json kBlock = {{"bytes", 256}}; // zeros
json resultOf(int call) {
    return {{"result", call}};
}

class CompromisedGuest : public testing::TestWithParam<bool> {
  protected:
    CompromisedGuest() {
        limits.landlock = GetParam();
        client.setLimits(limits);
    }

    Result<WorkerClient::Reply> ask(json header) {
        header["op"] = "selfTest";
        return client.request(WorkerKind::Model, header.dump(), std::span<const std::byte>(),
                              "chair.obj");
    }
    static json parsed(const Result<WorkerClient::Reply>& reply) {
        EXPECT_TRUE(reply.ok()) << reply.error().text();
        return reply.ok() ? json::parse(reply->header) : json();
    }
    json answer(json header) { return parsed(ask(std::move(header))); }
    // Their errnos.
    std::vector<int> attempt(const std::vector<Attack>& calls) {
        json list = json::array();
        for (const Attack& call : calls)
            list.push_back({{"number", call.number}, {"arguments", call.arguments}});
        std::vector<int> errors;
        for (const json& result : answer({{"do", "call"}, {"calls", list}}))
            errors.push_back(result.value("errno", -1));
        return errors;
    }
    void expectRefused(const std::vector<Attack>& attacks) {
        for (const Attack& attack : attacks)
            EXPECT_EQ(attempt({attack}), std::vector{attack.expected}) << attack.name;
    }

    WorkerLimits limits{std::size_t{4} << 30, 20.0, 60.0};
    WorkerClient client;
};

INSTANTIATE_TEST_SUITE_P(With, CompromisedGuest, testing::Bool(),
                         [](const testing::TestParamInfo<bool>& landlock) {
                             return landlock.param ? "Landlock" : "outLandlock";
                         });

TEST_P(CompromisedGuest, CannotReachTheNetworkOrOtherPrograms) {
    const int victim = ::getpid();
    expectRefused({{"socket", SYS_socket, {AF_INET, SOCK_STREAM, 0}},
                   {"socketpair", SYS_socketpair, {AF_UNIX, SOCK_STREAM, 0, kBlock}},
                   {"connect", SYS_connect, {3, kBlock, 16}},
                   {"bind", SYS_bind, {3, kBlock, 16}},
                   {"a message to another socket", SYS_sendmsg, {1, kBlock, 0}},
                   {"kill", SYS_kill, {victim, 0}},
                   {"kill all", SYS_kill, {-1, 0}},
                   {"tkill", SYS_tkill, {victim, 0}},
                   {"tgkill", SYS_tgkill, {victim, victim, 0}},
                   {"rt_sigqueueinfo", SYS_rt_sigqueueinfo, {victim, 10, kBlock}},
                   {"pidfd_open", 434, {victim, 0}},
                   {"pidfd_send_signal", 424, {3, 0, 0, 0}},
                   {"ptrace", SYS_ptrace, {16, victim, 0, 0}},
                   {"execve", SYS_execve, {"/bin/true", kBlock, kBlock}},
                   {"execveat", SYS_execveat, {AT_FDCWD, "/bin/true", kBlock, kBlock, 0}},
                   {"a process", SYS_clone, {SIGCHLD, 0, 0, 0, 0}},
                   {"a namespace", SYS_clone, {SIGCHLD | CLONE_NEWUSER, 0, 0, 0, 0}},
                   {"clone3", SYS_clone3, {kBlock, 88}},
                   {"unshare", SYS_unshare, {CLONE_NEWUSER}},
                   {"setns", SYS_setns, {3, 0}}});
    EXPECT_EQ(answer({{"do", "try"}, {"call", "exec"}})["errno"], ENOSYS);
    EXPECT_EQ(answer({{"do", "try"}, {"call", "fork"}})["errno"], ENOSYS);
    EXPECT_EQ(answer({{"do", "try"}, {"call", "thread"}})["errno"], 0); // decoders do use threads
}

TEST_P(CompromisedGuest, CannotTypeIntoTheTerminal) {
    (void)answer({{"do", "describe"}});
    const int worker = client.workerProcess(WorkerKind::Model);
    EXPECT_EQ(::getsid(worker), worker);
    EXPECT_NE(::getsid(worker), ::getsid(0));
    constexpr long kLinuxConsole = 0x541C; // TIOCLINUX
    expectRefused({{"TIOCSTI", SYS_ioctl, {1, TIOCSTI, "x"}},
                   {"TIOCSTI, upper bits set", SYS_ioctl, {1, TIOCSTI | (1l << 40), "x"}},
                   {"TIOCLINUX", SYS_ioctl, {1, kLinuxConsole, kBlock}},
                   {"TIOCSCTTY", SYS_ioctl, {1, TIOCSCTTY, 1}},
                   {"TCGETS", SYS_ioctl, {0, TCGETS, kBlock}}});
}

TEST_P(CompromisedGuest, CannotHaveSignalsSentNorFilesLocked) {
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
                   {"F_SETPIPE_SZ", SYS_fcntl, {0, F_SETPIPE_SZ, 1 << 20}},
                   {"flock", SYS_flock, {0, 2}}});
}

TEST_P(CompromisedGuest, CannotRunWhatItWrites) {
    constexpr int kReadWrite = PROT_READ | PROT_WRITE;
    constexpr int kMemory = MAP_PRIVATE | MAP_ANONYMOUS;
    expectRefused({{"mmap", SYS_mmap, {0, 4096, kReadWrite | PROT_EXEC, kMemory, -1, 0}},
                   {"mmap to run", SYS_mmap, {0, 4096, PROT_READ | PROT_EXEC, kMemory, -1, 0}},
                   {"personality", SYS_personality, {0x0400000}}}); // READ_IMPLIES_EXEC
    EXPECT_EQ(attempt({{"", SYS_mmap, {0, 4096, kReadWrite, kMemory, -1, 0}},
                       {"", SYS_mprotect, {resultOf(0), 4096, kReadWrite | PROT_EXEC}},
                       {"", SYS_mprotect, {resultOf(0), 4096, PROT_READ | PROT_EXEC}},
                       {"", SYS_mprotect, {resultOf(0), 4096, PROT_READ | PROT_EXEC | (1l << 40)}},
                       {"", SYS_pkey_mprotect, {resultOf(0), 4096, PROT_EXEC, -1}},
                       {"", SYS_mprotect, {resultOf(0), 4096, PROT_READ}}}),
              (std::vector{0, ENOSYS, ENOSYS, ENOSYS, ENOSYS, 0}));
}

TEST_P(CompromisedGuest, CannotReachSharedMemoryNorQueues) {
    const int segment = ::shmget(IPC_PRIVATE, 4096, 0600);
    ASSERT_GE(segment, 0);
    expectRefused({{"shmget", SYS_shmget, {0x5041, 4096, 0}},
                   {"shmat", SYS_shmat, {segment, 0, 0}},
                   {"shmctl", SYS_shmctl, {segment, IPC_RMID, 0}},
                   {"msgget", SYS_msgget, {0x5041, 0}},
                   {"msgrcv", SYS_msgrcv, {0, kBlock, 8, 0, IPC_NOWAIT}},
                   {"semget", SYS_semget, {0x5041, 1, 0}},
                   {"semop", SYS_semop, {0, kBlock, 1}},
                   {"mq_open", SYS_mq_open, {"queue", O_RDONLY, 0, 0}},
                   {"mq_unlink", SYS_mq_unlink, {"queue"}}});
    EXPECT_EQ(::shmctl(segment, IPC_RMID, nullptr), 0) << "it is still there";
}

TEST_P(CompromisedGuest, CannotSlowOthersDownButArrangesItself) {
    const int victim = ::getpid();
    expectRefused({{"sched_setaffinity", SYS_sched_setaffinity, {victim, 8, kBlock}},
                   {"sched_setscheduler", SYS_sched_setscheduler, {victim, 0, kBlock}},
                   {"sched_setparam", SYS_sched_setparam, {victim, kBlock}},
                   {"sched_setattr", SYS_sched_setattr, {victim, kBlock, 0}},
                   {"sched_getaffinity", SYS_sched_getaffinity, {victim, 128, kBlock}},
                   {"setpriority", SYS_setpriority, {0, victim, 19}},
                   {"ioprio_set", SYS_ioprio_set, {1, victim, 0}},
                   {"prlimit64", SYS_prlimit64, {victim, RLIMIT_AS, kBlock, 0}},
                   {"prlimit64 of itself", SYS_prlimit64, {0, RLIMIT_AS, kBlock, 0}},
                   {"affinity of itself", SYS_sched_getaffinity, {0, 128, kBlock}, 0}});
}

TEST_P(CompromisedGuest, CannotReadTheMemoryOfItsClientNorOfItsWorker) {
    EXPECT_EQ(answer({{"do", "describe"}})["dumpable"], 0);
    EXPECT_EQ(::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0), 0);
    const int victim = ::getpid();
    expectRefused({{"dumpable again", SYS_prctl, {PR_SET_DUMPABLE, 1, 0, 0, 0}},
                   {"outliving us", SYS_prctl, {PR_SET_PDEATHSIG, 0, 0, 0, 0}},
                   {"a tracer", SYS_prctl, {PR_SET_PTRACER, -1, 0, 0, 0}},
                   {"another filter", SYS_prctl, {PR_SET_SECCOMP, 2, kBlock, 0, 0}},
                   {"seccomp", SYS_seccomp, {1, 0, kBlock}},
                   {"process_vm_readv", SYS_process_vm_readv, {victim, 0, 0, 0, 0, 0}},
                   {"process_vm_writev", SYS_process_vm_writev, {victim, 0, 0, 0, 0, 0}},
                   {"pidfd_getfd", 438, {3, 0, 0}},
                   {"kcmp", SYS_kcmp, {victim, victim, 0, 0, 0}},
                   {"move_pages", SYS_move_pages, {victim, 0, 0, 0, 0, 0}},
                   {"capset", SYS_capset, {kBlock, kBlock}}});
}

TEST_P(CompromisedGuest, CannotReachTheKernelsOtherDoors) {
    expectRefused({{"io_uring_setup", 425, {8, kBlock}},
                   {"io_uring_enter", 426, {3, 1, 0, 0, 0, 0}},
                   {"bpf", SYS_bpf, {0, kBlock, 72}},
                   {"userfaultfd", SYS_userfaultfd, {0}},
                   {"keyctl", SYS_keyctl, {0, -3, 1, 0, 0}},
                   {"add_key", SYS_add_key, {"user", "name", "x", 1, -3}},
                   {"request_key", SYS_request_key, {"user", "name", "", -3}},
                   {"perf_event_open", SYS_perf_event_open, {kBlock, 0, -1, -1, 0}},
                   {"modify_ldt", 154, {0, kBlock, 16}},
                   {"mount", SYS_mount, {"none", "/tmp", "tmpfs", 0, 0}},
                   {"inotify_init1", SYS_inotify_init1, {0}},
                   {"landlock, to shut others out", 444, {kBlock, 8, 0}}});
}

TEST_P(CompromisedGuest, SeesNothingOfTheUsersEnvironment) {
    ::setenv("PATINA_TEST_TOKEN", "secret", 1);
    WorkerClient fresh;
    const json described =
        parsed(fresh.request(WorkerKind::Model, R"({"op":"selfTest","do":"describe"})",
                             std::span<const std::byte>(), "chair.obj"));
    std::ifstream start(fmt::format("/proc/{}/environ", fresh.workerProcess(WorkerKind::Model)));
    const std::string startedWith(std::istreambuf_iterator<char>(start), {});
    ::unsetenv("PATINA_TEST_TOKEN");
    EXPECT_EQ(described["environment"], json::array());
    EXPECT_THAT(startedWith, Not(HasSubstr("secret")));
}

TEST_P(CompromisedGuest, CannotFloodTheSystemWithFilesOrThreads) {
    const json described = answer({{"do", "describe"}});
    EXPECT_EQ(described["openFiles"], 1024);
    // All tasks of this system are well below a million, and the limit lies little above them.
    EXPECT_GT(described["tasks"], 1024);
    EXPECT_LT(described["tasks"], 1'000'000);
    EXPECT_EQ(answer({{"do", "files"}})["errno"], EMFILE);
    // /dev/null, twice the log, the client, the payload; and what it answers with.
    EXPECT_LE(described["descriptors"].size(), 6u) << described["descriptors"];
}

// A memory file that was never written costs its sender nothing, and its reader all it claims.
TEST_P(CompromisedGuest, CannotMakeItsClientTakeMemory) {
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

// What the sanitizers leave out of the sandbox (app/worker/SystemCallFilter.cpp).
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_P(CompromisedGuest, IsUnderLandlockWhereThereIsOne) {
    constexpr unsigned kAskForVersion = 1;
    const long version = ::syscall(SYS_landlock_create_ruleset, nullptr, 0, kAskForVersion);
    EXPECT_EQ(answer({{"do", "describe"}})["landlock"], GetParam() ? std::max(version, 0l) : 0);
}

// Its own list beside that of the filter, so that one more call is noticed.
TEST_P(CompromisedGuest, HasNoCallsButThoseThatDecodersNeed) {
    const std::set<long> known = {
        SYS_read,
        SYS_pread64,
        SYS_write,
        SYS_writev,
        SYS_lseek,
        SYS_close,
        SYS_fstat,
        SYS_ftruncate,
        SYS_fcntl,
        SYS_sendmsg,
        SYS_recvmsg,
        SYS_brk,
        SYS_mmap,
        SYS_munmap,
        SYS_mremap,
        SYS_mprotect,
        SYS_madvise,
        SYS_futex,
        SYS_set_robust_list,
        SYS_rseq,
        SYS_sched_yield,
        SYS_sched_getaffinity,
        SYS_clone,
        SYS_exit,
        SYS_exit_group,
        SYS_rt_sigaction,
        SYS_rt_sigprocmask,
        SYS_rt_sigreturn,
        SYS_tgkill,
        SYS_clock_gettime,
        SYS_clock_nanosleep,
        SYS_gettimeofday,
        SYS_getrandom,
        SYS_getpid,
        SYS_gettid,
        SYS_prctl,
        SYS_prlimit64,
        SYS_restart_syscall,
        // answered by the client
        SYS_openat,
        SYS_newfstatat,
        SYS_faccessat,
        SYS_memfd_create,
#if defined(SYS_open)
        SYS_open,
        SYS_stat,
        SYS_lstat,
        SYS_access,
        // The kernel's own probes: no filter sees them, and from anywhere else they are SIGILL.
        335,
        336,
#endif
    };
    std::vector<Attack> unknown;
    constexpr long kCalls = 1024; // more than any kernel has
    for (long number = 0; number < kCalls; ++number)
        if (!known.contains(number))
            unknown.push_back({"", number, json::array()});
    const std::vector<int> errors = attempt(unknown);
    ASSERT_EQ(errors.size(), unknown.size());
    for (std::size_t i = 0; i < errors.size(); ++i)
        EXPECT_EQ(errors[i], ENOSYS) << unknown[i].number;
#if defined(__x86_64__)
    constexpr long kOtherAbi = 0x40000000; // x32: the same kernel under other numbers
    const auto reply = ask(
        {{"do", "call"}, {"calls", {{{"number", kOtherAbi | SYS_getpid}, {"arguments", {0}}}}}});
    ASSERT_FALSE(reply.ok());
    EXPECT_THAT(reply.error().detail, HasSubstr("SIGSYS"));
#endif
}

// A home with a key, and a model in one of its folders that is being read.
class GuestAmongFiles : public CompromisedGuest {
  protected:
    GuestAmongFiles() {
        folder.write(".ssh/id_ed25519", std::string_view("PRIVATE KEY"));
        folder.write("letter.txt", std::string_view("Dear"));
        folder.write("models/chair.obj", std::string_view("v 0 0 0"));
        folder.write("models/chair.mtl", std::string_view("newmtl oak"));
    }
    // A request that reads the file `model` of home.
    std::vector<int> attemptWith(const std::string& model, const std::vector<Attack>& calls) {
        json header = {{"op", "selfTest"}, {"do", "call"}, {"calls", json::array()}};
        for (const Attack& call : calls)
            header["calls"].push_back({{"number", call.number}, {"arguments", call.arguments}});
        const FileDescriptor file(::open((home / model).c_str(), O_RDONLY | O_CLOEXEC));
        std::vector<int> errors;
        for (const json& result :
             parsed(client.request(WorkerKind::Model, header.dump(), file.get(), home / model, {},
                                   insideCanonicalFolder(home / model))))
            errors.push_back(result.value("errno", -1));
        return errors;
    }
    int opening(const std::filesystem::path& path, int flags = O_RDONLY,
                const std::string& model = "models/chair.obj") {
        return attemptWith(model, {{"", SYS_openat, {AT_FDCWD, path.string(), flags, 0600}}}).at(0);
    }

    test::TemporaryFolder folder;
    const std::filesystem::path home = std::filesystem::canonical(folder.path());
    const std::filesystem::path models = home / "models";
};

INSTANTIATE_TEST_SUITE_P(With, GuestAmongFiles, testing::Bool(),
                         [](const testing::TestParamInfo<bool>& landlock) {
                             return landlock.param ? "Landlock" : "outLandlock";
                         });

TEST_P(GuestAmongFiles, ReadsTheModelsFolderAndNothingElse) {
    EXPECT_EQ(opening(models / "chair.obj"), 0);
    EXPECT_EQ(opening(models / "chair.mtl"), 0);
    EXPECT_EQ(opening(models / "gone.mtl"), ENOENT);
    std::filesystem::create_symlink(home / ".ssh/id_ed25519", models / "link");
    std::filesystem::create_symlink(home, models / "up");
    ASSERT_EQ(::mkfifo((models / "pipe").c_str(), 0600), 0);
    for (const std::filesystem::path& secret :
         {home / ".ssh/id_ed25519", home / "letter.txt", models / "../letter.txt", models / "link",
          models / "up/letter.txt", models / "pipe", models, std::filesystem::path("/etc/passwd"),
          std::filesystem::path("/etc/shadow"), std::filesystem::path("../letter.txt"),
          std::filesystem::path(std::getenv("HOME") != nullptr ? std::getenv("HOME") : "/root") /
              ".ssh/id_rsa"}) {
        EXPECT_EQ(opening(secret), EACCES) << secret;
        EXPECT_EQ(attemptWith("models/chair.obj",
                              {{"", SYS_newfstatat, {AT_FDCWD, secret.string(), kBlock, 0}}}),
                  std::vector{EACCES})
            << "nor its size: " << secret;
    }
    // A model that lies in the home folder itself gives no keys away.
    folder.write("chair.obj", std::string_view("v 0 0 0"));
    EXPECT_EQ(opening(home / ".ssh/id_ed25519", O_RDONLY, "chair.obj"), EACCES);
    // Pictures have no folder at all.
    expectRefused({{"without a folder",
                    SYS_openat,
                    {AT_FDCWD, (models / "chair.mtl").string(), O_RDONLY},
                    EACCES}});
}

TEST_P(GuestAmongFiles, CannotReadOtherProcesses) {
    const pid_t neighbour = ::fork(); // of the same user, and hides nothing
    if (neighbour == 0) {
        ::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0);
        ::pause();
        ::_exit(0);
    }
    for (const std::string& who :
         {std::to_string(neighbour), std::to_string(::getpid()), std::string("1"),
          std::to_string(client.workerProcess(WorkerKind::Model)), std::string("self")})
        for (const char* file : {"mem", "environ", "maps", "cmdline", "cwd/x", "root/etc/passwd"}) {
            const std::string path = fmt::format("/proc/{}/{}", who, file);
            EXPECT_EQ(opening(path), EACCES) << path;
        }
    ::kill(neighbour, SIGKILL);
    ::waitpid(neighbour, nullptr, 0);
}

TEST_P(GuestAmongFiles, CannotOpenTerminalsNorDevices) {
    for (const char* device : {"/dev/tty", "/dev/console", "/dev/tty1", "/dev/pts/0", "/dev/ptmx",
                               "/dev/null", "/dev/zero", "/dev/shm", "/dev/mem", "/dev/input"})
        EXPECT_EQ(opening(device), EACCES) << device;
}

TEST_P(GuestAmongFiles, CannotChangeTheFileSystem) {
    const std::string existing = models / "chair.mtl";
    const std::string fresh = models / "new";
    for (const int flags : {O_WRONLY, O_RDWR, O_RDWR | O_TRUNC, O_WRONLY | O_APPEND})
        EXPECT_EQ(opening(existing, flags), EACCES) << flags;
    EXPECT_EQ(opening(fresh, O_RDWR | O_CREAT), EACCES);
    EXPECT_EQ(opening(fresh, O_RDONLY | O_CREAT), ENOENT);
    const std::string folderName = models;
    expectRefused({{"openat2", 437, {AT_FDCWD, existing, kBlock, 24}},
                   {"unlink", SYS_unlinkat, {AT_FDCWD, existing, 0}},
                   {"rename", SYS_renameat2, {AT_FDCWD, existing, AT_FDCWD, fresh, 0}},
                   {"link", SYS_linkat, {AT_FDCWD, existing, AT_FDCWD, fresh, 0}},
                   {"symlink", SYS_symlinkat, {existing, AT_FDCWD, fresh}},
                   {"mkdir", SYS_mkdirat, {AT_FDCWD, fresh, 0700}},
                   {"mknod", SYS_mknodat, {AT_FDCWD, fresh, S_IFIFO | 0600, 0}},
                   {"fchmodat", SYS_fchmodat, {AT_FDCWD, existing, 0777}},
                   {"fchmodat2", 452, {AT_FDCWD, existing, 0777, 0}},
                   {"utimensat", SYS_utimensat, {AT_FDCWD, existing, 0, 0}},
                   {"truncate", SYS_truncate, {existing, 0}},
                   {"readlink", SYS_readlinkat, {AT_FDCWD, existing, kBlock, 256}},
                   {"statx", SYS_statx, {AT_FDCWD, existing, 0, 0, kBlock}},
                   {"getdents64", SYS_getdents64, {0, kBlock, 256}},
                   {"chdir", SYS_chdir, {folderName}},
                   {"setxattr", SYS_setxattr, {existing, "user.x", kBlock, 16, 0}},
                   {"setxattrat", 463, {AT_FDCWD, existing, 0, "user.x", kBlock, 16}},
                   {"file_setattr", 469, {AT_FDCWD, existing, kBlock, 16, 0}},
                   {"open_tree", 428, {AT_FDCWD, folderName, 1}},
                   {"move_mount", 429, {AT_FDCWD, existing, AT_FDCWD, fresh, 0}},
                   {"fsopen", 430, {"tmpfs", 0}},
                   {"mount_setattr", 442, {AT_FDCWD, folderName, 0, kBlock, 32}}});
    EXPECT_FALSE(std::filesystem::exists(fresh));
    EXPECT_EQ(std::filesystem::file_size(existing), 10u);
}

TEST_P(CompromisedGuest, CannotTakeMoreMemoryThanItsLimit) {
    limits.memoryBytes = std::size_t{256} << 20;
    client.setLimits(limits);
    const json taken = answer({{"do", "memory"}, {"each", 60 << 20}});
    EXPECT_EQ(taken["errno"], ENOMEM);
    EXPECT_LE(taken["files"], 4) << "256 MiB"; // (its address space is full before that)
    expectRefused(
        {{"a large one", SYS_memfd_create, {"x", 0, (256 << 20) + 1}, ENOMEM},
         {"one that grows", SYS_memfd_create, {"x", 0, -1}, EPERM},
         {"shared pages", SYS_mmap, {0, 257l << 20, 3, MAP_SHARED | MAP_ANONYMOUS, -1, 0}, ENOMEM},
         {"memfd_secret", 447, {0}},
         {"a pipe", SYS_pipe2, {kBlock, 0}},
         {"fallocate", SYS_fallocate, {1, 0, 0, 1 << 20}}});
    EXPECT_EQ(attempt({{"", SYS_memfd_create, {"x", 0, 200 << 20}},
                       {"", SYS_memfd_create, {"x", 0, 100 << 20}},
                       {"", SYS_ftruncate, {resultOf(0), 250 << 20}},
                       {"", SYS_close, {resultOf(0)}},
                       {"", SYS_memfd_create, {"x", 0, 100 << 20}}}),
              (std::vector{0, ENOMEM, EPERM, 0, ENOMEM}));
}

#endif

} // namespace
} // namespace patina
