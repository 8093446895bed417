// A disk that a test fills and frees again. Where the system lets a process mount one, it is a
// small disk of its own, and writing ends with ENOSPC; elsewhere (containers that forbid it) the
// size of files is limited, and writing ends half-way with EFBIG. For a child process: it changes
// the process and needs one without other threads.
#pragma once

#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sched.h>
#include <string>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace patina::test {

class FullDisk {
  public:
    // `folder` exists and is empty. What is written into a disk of its own goes with the process.
    explicit FullDisk(std::filesystem::path folder)
        : m_folder(std::move(folder))
        , m_own(mountOwn()) {
        std::signal(SIGXFSZ, SIG_IGN); // write() fails instead
    }

    [[nodiscard]] bool isOwn() const { return m_own; }

    // Leaves `bytes` free, rounded up to pages.
    void fill(rlim_t bytes) {
        if (m_own) {
            const int file = ::open(filler().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
            const std::vector<char> page(4096, 'x');
            while (::write(file, page.data(), page.size()) > 0)
                ;
            const off_t left = ::lseek(file, 0, SEEK_END) - static_cast<off_t>(bytes);
            if (::ftruncate(file, left) != 0)
                std::perror("ftruncate");
            ::close(file);
        } else {
            limit(bytes);
        }
    }
    void free() {
        if (m_own)
            ::unlink(filler().c_str());
        else
            limit(RLIM_INFINITY);
    }

  private:
    [[nodiscard]] std::string filler() const { return (m_folder / "filler").string(); }

    static void limit(rlim_t bytes) {
        rlimit now{};
        ::getrlimit(RLIMIT_FSIZE, &now);
        now.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &now);
    }

    // As root of a user namespace, which needs no rights; else as root, if we are.
    [[nodiscard]] bool mountOwn() const {
        const uid_t user = ::geteuid();
        const gid_t group = ::getegid();
        if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0) {
            std::ofstream("/proc/self/setgroups") << "deny";
            std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
            std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
        } else if (::unshare(CLONE_NEWNS) != 0) {
            return false;
        }
        return ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
               ::mount("patina-test", m_folder.c_str(), "tmpfs", 0, "size=1m,mode=0700") == 0;
    }

    std::filesystem::path m_folder;
    bool m_own;
};

} // namespace patina::test
