#include "core/base/Log.h"
#include "render/gl/ContextSetup.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace patina::gl {

namespace {

// EGL hands the same display to every caller in the process and does not count them: it is
// terminated with the last context. Only then has Mesa written all that it compiled to its cache on
// disk (it does so on a thread of the lowest priority, and drops what is left when a process ends).
class Display {
  public:
    static std::shared_ptr<Display> open(EGLDisplay handle) {
        static std::mutex mutex;
        static std::map<EGLDisplay, std::weak_ptr<Display>> known;
        const std::lock_guard lock(mutex);
        std::shared_ptr<Display> display = known[handle].lock();
        if (!display && handle != EGL_NO_DISPLAY && eglInitialize(handle, nullptr, nullptr)) {
            display = std::shared_ptr<Display>(new Display(handle), [](Display* closing) {
                const std::lock_guard closingLock(mutex);
                // Another one may have been opened since the last owner let go.
                if (known[closing->m_handle].expired())
                    eglTerminate(closing->m_handle);
                delete closing;
            });
            known[handle] = display;
        }
        return display;
    }
    [[nodiscard]] EGLDisplay handle() const { return m_handle; }

  private:
    explicit Display(EGLDisplay handle)
        : m_handle(handle) {}
    EGLDisplay m_handle;
};

class HeadlessContext final : public Context {
  public:
    HeadlessContext(std::shared_ptr<Display> display, EGLContext context)
        : m_display(std::move(display))
        , m_context(context) {}
    ~HeadlessContext() override {
        eglMakeCurrent(m_display->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(m_display->handle(), m_context);
        m_display.reset();
        eglReleaseThread();
    }
    void setInfo(ContextInfo info) { m_info = std::move(info); }

  private:
    std::shared_ptr<Display> m_display;
    EGLContext m_context;
};

Result<std::unique_ptr<Context>> contextOn(EGLDisplay handle) {
    const auto failed = [](const char* step) {
        return Error{ErrorKind::NoOpenGl, step, {}, fmt::format("EGL error 0x{:x}", eglGetError())};
    };
    std::shared_ptr<Display> opened = Display::open(handle);
    if (!opened)
        return failed("no display");
    const EGLDisplay display = handle;
    if (!eglBindAPI(EGL_OPENGL_API))
        return failed("no desktop OpenGL");
    // Nothing is drawn to a surface: contexts without a configuration are enough.
    constexpr std::array<EGLint, 9> kAttributes{EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                5,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifdef NDEBUG
                                                EGL_NONE,
                                                EGL_NONE,
#else
                                                EGL_CONTEXT_OPENGL_DEBUG,
                                                EGL_TRUE,
#endif
                                                EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
    if (context == EGL_NO_CONTEXT)
        return failed("no OpenGL 4.5 core context");
    auto result = std::make_unique<HeadlessContext>(std::move(opened), context);
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return failed("context without a surface refused");
    Result<ContextInfo> info = describeCurrentContext();
    if (!info)
        return info.error();
    result->setInfo(std::move(*info));
    return std::unique_ptr<Context>(std::move(result));
}

// Somewhere a context may be had.
struct Candidate {
    std::string name;
    std::function<EGLDisplay()> display;
};

// The best first: graphics cards, then Mesa's surfaceless platform, which on machines with another
// vendor's driver knows software only, then software by name.
std::vector<Candidate> candidates() {
    std::vector<Candidate> cards, software;
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration"))
        eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    // Mesa's variable, which other drivers do not read.
    const char* always = std::getenv("LIBGL_ALWAYS_SOFTWARE");
    const bool wantsSoftware = always && (*always == '1' || *always == 't' || *always == 'y');
    const bool tells = epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query");
    for (const EGLDeviceEXT device : std::span(devices).first(static_cast<std::size_t>(count))) {
        const char* extensions = tells ? eglQueryDeviceStringEXT(device, EGL_EXTENSIONS) : nullptr;
        const bool isSoftware =
            extensions &&
            std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
        std::vector<Candidate>& list = isSoftware ? software : cards;
        list.push_back({fmt::format("device {}", cards.size() + software.size()), [device] {
                            return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device,
                                                            nullptr);
                        }});
    }
    std::vector<Candidate> all;
    if (!wantsSoftware)
        all = std::move(cards);
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        all.push_back({"surfaceless", [] {
                           return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                           EGL_DEFAULT_DISPLAY, nullptr);
                       }});
    std::ranges::move(software, std::back_inserter(all));
    return all;
}

bool eglLibraryPresent() {
    void* handle = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!handle)
        return false;
    dlclose(handle);
    return true;
}

} // namespace

Result<std::unique_ptr<Context>> Context::createHeadless(const std::string& renderer) {
    const auto none = [](std::string detail) {
        return Error{ErrorKind::NoOpenGl,
                     "No OpenGL 4.5 could be started without a display; install Mesa's EGL driver "
                     "(Debian: libegl1 libgl1-mesa-dri).",
                     {},
                     std::move(detail)};
    };
    if (!eglLibraryPresent()) // libepoxy would end the process
        return none("libEGL.so.1 is missing");

    std::string tried;
    for (const Candidate& candidate : candidates()) {
        auto context = contextOn(candidate.display());
        if (context && (renderer.empty() || context.value()->info().renderer == renderer))
            return context;
        tried += fmt::format("{}: {}; ", candidate.name,
                             context ? "it is " + context.value()->info().renderer
                                     : context.error().text());
    }
    return none(tried.empty() ? "EGL offers neither surfaceless contexts nor devices" : tried);
}

} // namespace patina::gl
