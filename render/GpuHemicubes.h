// Hemicubes for form factors, drawn by OpenGL: an item buffer of the five faces, with depths. It
// has a thread with a context of its own, as rows of form factors are computed on all others.
#pragma once

#include "core/radiosity/HemicubeDrawer.h"
#include "render/gl/Context.h"

#include <memory>
#include <string>

namespace patina::render {

class GpuHemicubes final : public radiosity::HemicubeDrawer {
  public:
    // Without a window, as gl::Context::createHeadless(). Error NoOpenGl.
    static Result<std::shared_ptr<GpuHemicubes>> create();
    ~GpuHemicubes() override;

    Result<std::unique_ptr<radiosity::DrawnHemicubes>> load(const radiosity::FaceItems& faces,
                                                            int resolution) override;
    [[nodiscard]] std::string name() const override;
    [[nodiscard]] const gl::ContextInfo& info() const;

  private:
    class Thread;
    struct Scene;
    class Drawn;
    explicit GpuHemicubes(std::shared_ptr<Thread> thread);

    std::shared_ptr<Thread> m_thread; // shared with what was loaded
};

} // namespace patina::render
