// The capability token for OpenGL: whoever needs GL takes a gl::Context&. It stands for "a 4.5 core
// context is current on this thread".
#pragma once

#include "core/base/Result.h"

#include <memory>
#include <string>

namespace patina::gl {

struct ContextInfo {
    std::string vendor, renderer, version; // "Mesa", "llvmpipe (…)", "4.5 (Core Profile) …"
    int maxTextureSize = 0;
    int maxSamples = 1;
    bool software = false; // llvmpipe, softpipe, swrast
};

class Context {
  public:
    virtual ~Context() = default;
    [[nodiscard]] const ContextInfo& info() const { return m_info; }

    // Wraps the context that is current (the viewport's). Error NoOpenGl when there is none or it
    // is older than 4.5.
    static Result<std::unique_ptr<Context>> adoptCurrent();

    // Creates a context without any window or X server: on a graphics card where there is one
    // (unless LIBGL_ALWAYS_SOFTWARE says otherwise), else on Mesa's software. `renderer`: only one
    // of that ContextInfo::renderer will do; empty: any. Current on this thread until destroyed.
    // Error NoOpenGl with what was tried.
    static Result<std::unique_ptr<Context>> createHeadless(const std::string& renderer = {});

  protected:
    ContextInfo m_info;
};

} // namespace patina::gl
