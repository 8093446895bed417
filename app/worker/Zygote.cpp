#include "app/worker/Zygote.h"

#include "core/base/FileDescriptor.h"
#include "core/worker/WorkerProtocol.h"

#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace patina::worker {

namespace {

struct Running {
    pid_t pid = -1;
    FileDescriptor process; // readable when the child has ended
    FileDescriptor socket;  // the request's; invalid once the client has hung up
};

void report(int socket, protocol::Event event, std::int64_t value) {
    protocol::Report message;
    message.event = event;
    message.value = value;
    protocol::send(socket, message); // a client that is gone needs no report
}

// Children are watched through descriptors (pidfd) and not through SIGCHLD: the libraries have
// threads of their own, which may swallow the signal.
class Zygote {
  public:
    Zygote(int control, const Operations& operations)
        : m_control(control)
        , m_operations(operations) {}

    int run();

  private:
    bool accept(); // false: the client is gone
    void start(const protocol::Request& request, std::vector<FileDescriptor> descriptors);

    FileDescriptor m_control;
    const Operations& m_operations;
    std::vector<Running> m_running;
};

// True when the child has ended and its client knows.
bool reap(const Running& child) {
    int status = 0;
    if (::waitpid(child.pid, &status, WNOHANG) == 0)
        return false;
    if (child.socket.valid())
        report(child.socket.get(), protocol::Event::Ended, status);
    return true;
}

int Zygote::run() {
    std::vector<pollfd> waiting;
    while (true) {
        waiting.assign({{m_control.get(), POLLIN, 0}});
        for (const Running& child : m_running) { // a negative descriptor is skipped by poll
            waiting.push_back({child.process.get(), POLLIN, 0});
            waiting.push_back({child.socket.get(), 0, 0});
        }
        if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR)
            return 1;

        // The client has closed its end: nobody waits for this child any more.
        for (std::size_t i = 0; i < m_running.size(); ++i)
            if ((waiting[2 + 2 * i].revents & (POLLHUP | POLLERR)) != 0) {
                ::kill(m_running[i].pid, SIGKILL);
                m_running[i].socket.reset();
            }
        std::size_t index = 0;
        std::erase_if(m_running, [&](const Running& child) {
            return waiting[1 + 2 * index++].revents != 0 && reap(child);
        });
        if (waiting[0].revents != 0 && !accept())
            return 0; // the kernel kills the children with us (PR_SET_PDEATHSIG)
    }
}

bool Zygote::accept() {
    protocol::Request request;
    auto received =
        protocol::receive(m_control.get(), std::as_writable_bytes(std::span(&request, 1)));
    if (!received)
        return errno == EAGAIN;
    if (received->size == 0)
        return false;
    if (received->size == sizeof request && request.magic == protocol::kMagic &&
        received->descriptors.size() == protocol::kMaxDescriptors)
        start(request, std::move(received->descriptors));
    return true;
}

void Zygote::start(const protocol::Request& request, std::vector<FileDescriptor> descriptors) {
    const pid_t zygote = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0) {
        report(descriptors[0].get(), protocol::Event::CannotFork, errno);
        return;
    }
    if (pid == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != zygote)
            ::_exit(1); // it died in between
        m_control.reset();
        m_running.clear(); // the descriptors of the siblings
        runChild(m_operations, request, std::move(descriptors));
    }
    // (The C library of Debian 12 declares pidfd_open for C only.)
    FileDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
    if (!process.valid()) {
        report(descriptors[0].get(), protocol::Event::CannotFork, errno);
        ::kill(pid, SIGKILL);
        ::waitpid(pid, nullptr, 0);
        return;
    }
    report(descriptors[0].get(), protocol::Event::Started, pid);
    m_running.push_back({pid, std::move(process), std::move(descriptors[0])});
}

} // namespace

int serve(int controlSocket, const Operations& operations) {
    return Zygote(controlSocket, operations).run();
}

} // namespace patina::worker
