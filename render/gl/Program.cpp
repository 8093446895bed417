#include "render/gl/Program.h"

#include <algorithm>
#include <array>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <vector>

namespace patina::gl {

namespace {

void deleteShader(unsigned id) {
    glDeleteShader(id);
}
using Shader = Handle<deleteShader>;

GLenum stageEnum(Stage stage) {
    switch (stage) {
    case Stage::Vertex:
        return GL_VERTEX_SHADER;
    case Stage::Fragment:
        return GL_FRAGMENT_SHADER;
    case Stage::Compute:
        return GL_COMPUTE_SHADER;
    }
    return GL_VERTEX_SHADER;
}

Error failure(std::string_view label, std::string_view what, std::string log) {
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n'))
        log.pop_back();
    return Error{
        ErrorKind::Internal, fmt::format("The shader {} does not {}.", label, what), {}, log};
}

std::map<std::string, int, std::less<>> activeUniforms(GLuint program) {
    std::map<std::string, int, std::less<>> result;
    GLint count = 0, longest = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    glGetProgramiv(program, GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
    std::string name(static_cast<std::size_t>(std::max(longest, 1)), '\0');
    for (GLint i = 0; i < count; ++i) {
        GLint size = 0;
        GLsizei length = 0;
        GLenum type = 0;
        glGetActiveUniform(program, static_cast<GLuint>(i), longest, &length, &size, &type,
                           name.data());
        const std::string trimmed = name.substr(0, static_cast<std::size_t>(length));
        const GLint location = glGetUniformLocation(program, trimmed.c_str());
        if (location >= 0) // members of blocks have none
            result.emplace(trimmed, location);
    }
    return result;
}

} // namespace

void deleteProgram(unsigned id) {
    glDeleteProgram(id);
}

Result<Program> Program::create(Context&, std::string_view label,
                                std::span<const StageSource> sources) {
    std::vector<Shader> shaders;
    for (const StageSource& source : sources) {
        Shader shader(glCreateShader(stageEnum(source.stage)));
        const char* text = source.text.c_str();
        glShaderSource(shader.id(), 1, &text, nullptr);
        glCompileShader(shader.id());
        GLint compiled = GL_FALSE, length = 0;
        glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
        if (compiled != GL_TRUE) {
            glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
            std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
            glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
            return failure(label, "compile", log);
        }
        shaders.push_back(std::move(shader));
    }

    Program result;
    result.m_handle = Handle<deleteProgram>(glCreateProgram());
    const GLuint program = result.id();
    for (const Shader& shader : shaders)
        glAttachShader(program, shader.id());
    glLinkProgram(program);
    for (const Shader& shader : shaders)
        glDetachShader(program, shader.id());
    GLint linked = GL_FALSE, length = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
        glGetProgramInfoLog(program, length, nullptr, log.data());
        return failure(label, "link", log);
    }
    glObjectLabel(GL_PROGRAM, program, static_cast<GLsizei>(label.size()), label.data());
    result.m_locations = activeUniforms(program);
    return result;
}

void Program::use() const {
    glUseProgram(id());
}

int Program::location(std::string_view name) const {
    const auto found = m_locations.find(name);
    return found == m_locations.end() ? -1 : found->second;
}

void Program::set(std::string_view name, int value) const {
    glProgramUniform1i(id(), location(name), value);
}
void Program::set(std::string_view name, unsigned value) const {
    glProgramUniform1ui(id(), location(name), value);
}
void Program::set(std::string_view name, float value) const {
    glProgramUniform1f(id(), location(name), value);
}
void Program::set(std::string_view name, const glm::vec2& value) const {
    glProgramUniform2fv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::vec3& value) const {
    glProgramUniform3fv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::vec4& value) const {
    glProgramUniform4fv(id(), location(name), 1, &value[0]);
}
void Program::set(std::string_view name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, &value[0][0]);
}

} // namespace patina::gl
