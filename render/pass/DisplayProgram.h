// The tone mapping program of one OpenColorIO view, with its tables.
#pragma once

#include "core/io/DisplayTransform.h"
#include "render/gl/Program.h"
#include "render/gl/Texture.h"

#include <vector>

namespace patina::render {

class DisplayProgram {
  public:
    // Error Internal with the compiler's log when the driver refuses OpenColorIO's shader.
    static Result<DisplayProgram> create(gl::Context& context, const DisplayTransform& transform);

    [[nodiscard]] const gl::Program& program() const { return m_program; }
    void bindTables() const; // to units 1, 2 …; 0 is the picture's

  private:
    gl::Program m_program;
    std::vector<gl::Texture> m_tables;
};

} // namespace patina::render
