#include "core/base/Log.h"
#include "render/gl/ContextSetup.h"

#include <algorithm>
#include <cctype>
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <string_view>

namespace patina::gl {

namespace {

std::string glText(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text ? text : "";
}

// Asks a window-system library that is already loaded whether it has a current context. Going
// through libepoxy instead would end the process when there is none.
bool hasCurrentContext(const char* library, const char* function) {
    void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL | RTLD_NOLOAD);
    if (!handle)
        return false;
    using GetCurrent = void* (*)();
    const auto getCurrent = reinterpret_cast<GetCurrent>(dlsym(handle, function));
    const bool current = getCurrent && getCurrent() != nullptr;
    dlclose(handle);
    return current;
}

#ifndef NDEBUG
void APIENTRY onDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                             const GLchar* text, const void*) {
    const std::string_view message(text, static_cast<std::size_t>(length));
    if (type == GL_DEBUG_TYPE_ERROR)
        logError("OpenGL: {}", message);
    else if (severity != GL_DEBUG_SEVERITY_NOTIFICATION && type != GL_DEBUG_TYPE_PERFORMANCE)
        logDebug("OpenGL: {}", message);
}
#endif

class AdoptedContext final : public Context {
  public:
    explicit AdoptedContext(ContextInfo info) { m_info = std::move(info); }
};

} // namespace

Result<ContextInfo> describeCurrentContext() {
    ContextInfo info;
    info.vendor = glText(GL_VENDOR);
    info.renderer = glText(GL_RENDERER);
    info.version = glText(GL_VERSION);
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 45)
        return Error{ErrorKind::NoOpenGl,
                     "Patina needs OpenGL 4.5; update the graphics driver, or run with "
                     "LIBGL_ALWAYS_SOFTWARE=1.",
                     {},
                     info.renderer + ": " + info.version};
    GLint number = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &number);
    info.maxTextureSize = number;
    GLint colorSamples = 1, depthSamples = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colorSamples);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depthSamples);
    info.maxSamples = std::max(1, std::min(colorSamples, depthSamples));
    std::string lower = info.renderer;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "software"})
        info.software = info.software || lower.find(name) != std::string::npos;

#ifndef NDEBUG
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onDebugMessage, nullptr);
#endif
    return info;
}

Result<std::unique_ptr<Context>> Context::adoptCurrent() {
    const bool current = hasCurrentContext("libEGL.so.1", "eglGetCurrentContext") ||
                         hasCurrentContext("libGLX.so.0", "glXGetCurrentContext") ||
                         hasCurrentContext("libGL.so.1", "glXGetCurrentContext");
    if (!current)
        return Error{ErrorKind::NoOpenGl, "No OpenGL context is current.", {}, {}};
    Result<ContextInfo> info = describeCurrentContext();
    if (!info)
        return info.error();
    return std::unique_ptr<Context>(std::make_unique<AdoptedContext>(std::move(*info)));
}

} // namespace patina::gl
