// A linked shader program.
#pragma once

#include "core/base/Result.h"
#include "render/gl/Context.h"
#include "render/gl/Handle.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace patina::gl {

enum class Stage { Vertex, Fragment, Compute };

struct StageSource {
    Stage stage = Stage::Vertex;
    std::string text; // complete GLSL, starting with #version
};

void deleteProgram(unsigned id);

class Program {
  public:
    Program() = default; // empty: id 0, no context needed
    // Compiles and links. Error Internal; `detail` is the compiler's log, unmodified.
    static Result<Program> create(Context& context, std::string_view label,
                                  std::span<const StageSource> sources);

    [[nodiscard]] unsigned id() const { return m_handle.id(); }
    [[nodiscard]] bool empty() const { return id() == 0; }

    void use() const;
    // A name the program does not use is ignored: compilers remove what has no effect.
    void set(std::string_view name, int value) const;
    void set(std::string_view name, unsigned value) const;
    void set(std::string_view name, float value) const;
    void set(std::string_view name, const glm::vec2& value) const;
    void set(std::string_view name, const glm::vec3& value) const;
    void set(std::string_view name, const glm::vec4& value) const;
    void set(std::string_view name, const glm::mat4& value) const;

  private:
    [[nodiscard]] int location(std::string_view name) const;

    Handle<deleteProgram> m_handle;
    std::map<std::string, int, std::less<>> m_locations; // of all active uniforms
};

} // namespace patina::gl
