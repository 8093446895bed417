#include "app/worker/Zygote.h"

#include "app/worker/Child.h"
#include "core/worker/FileDescriptor.h"
#include "core/worker/WorkerProtocol.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

namespace patina::worker {

namespace {

struct Running {
    pid_t pid = -1;
    FileDescriptor socket; // the request's; invalid once the client has hung up
};

void report(int socket, protocol::Event event, std::int64_t value) {
    protocol::Report message;
    message.event = event;
    message.value = value;
    protocol::send(socket, message); // a client that is gone needs no report
}

class Zygote {
  public:
    explicit Zygote(int control)
        : m_control(control) {
        sigset_t children;
        sigemptyset(&children);
        sigaddset(&children, SIGCHLD);
        sigprocmask(SIG_BLOCK, &children, nullptr);
        m_signals = FileDescriptor(::signalfd(-1, &children, SFD_CLOEXEC | SFD_NONBLOCK));
    }

    int run();

  private:
    bool accept(); // false: the client is gone
    void start(const protocol::Request& request, std::vector<FileDescriptor> descriptors);
    void reap();

    FileDescriptor m_control;
    FileDescriptor m_signals;
    std::vector<Running> m_running;
};

int Zygote::run() {
    std::vector<pollfd> waiting;
    while (true) {
        waiting.assign({{m_control.get(), POLLIN, 0}, {m_signals.get(), POLLIN, 0}});
        for (const Running& child : m_running) // a negative descriptor is skipped by poll
            waiting.push_back({child.socket.get(), 0, 0});
        if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR)
            return 1;

        // The client has closed its end: nobody waits for this child any more.
        for (std::size_t i = 2; i < waiting.size(); ++i)
            if ((waiting[i].revents & (POLLHUP | POLLERR)) != 0) {
                ::kill(m_running[i - 2].pid, SIGKILL);
                m_running[i - 2].socket.reset();
            }
        if ((waiting[1].revents & POLLIN) != 0)
            reap();
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
        m_signals.reset();
        m_running.clear(); // the descriptors of the siblings
        sigset_t none;
        sigemptyset(&none);
        sigprocmask(SIG_SETMASK, &none, nullptr);
        runChild(request, std::move(descriptors));
    }
    report(descriptors[0].get(), protocol::Event::Started, pid);
    m_running.push_back({pid, std::move(descriptors[0])});
}

void Zygote::reap() {
    signalfd_siginfo ignored{};
    while (::read(m_signals.get(), &ignored, sizeof ignored) > 0) {
    }
    int status = 0;
    for (pid_t pid = 0; (pid = ::waitpid(-1, &status, WNOHANG)) > 0;) {
        const auto child = std::find_if(m_running.begin(), m_running.end(),
                                        [&](const Running& c) { return c.pid == pid; });
        if (child == m_running.end())
            continue;
        if (child->socket.valid())
            report(child->socket.get(), protocol::Event::Ended, status);
        m_running.erase(child);
    }
}

} // namespace

int serve(int controlSocket) {
    return Zygote(controlSocket).run();
}

} // namespace patina::worker
