#include "core/base/Log.h"
#include "render/gl/ContextSetup.h"

#include <array>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <mutex>
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

bool eglLibraryPresent() {
    void* handle = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (!handle)
        return false;
    dlclose(handle);
    return true;
}

} // namespace

Result<std::unique_ptr<Context>> Context::createHeadless() {
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
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        auto context = contextOn(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
        if (context)
            return context;
        tried += "surfaceless: " + context.error().text() + "; ";
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count))
            for (EGLint i = 0; i < count; ++i) {
                auto context = contextOn(eglGetPlatformDisplayEXT(
                    EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
                if (context)
                    return context;
                tried += fmt::format("device {}: {}; ", i, context.error().text());
            }
    }
    return none(tried.empty() ? "EGL offers neither surfaceless contexts nor devices" : tried);
}

} // namespace patina::gl
