#include "render/pass/DisplayProgram.h"

#include "core/document/Document.h"
#include "render/shader/ShaderSources.h"

#include <array>
#include <fmt/format.h>

namespace patina::render {

namespace {

gl::Texture makeTable(gl::Context& context, const DisplayTransform::Table& table) {
    gl::TextureSettings settings;
    settings.kind = table.depth > 0    ? gl::TextureKind::Volume
                    : table.height > 0 ? gl::TextureKind::Flat
                                       : gl::TextureKind::Line;
    settings.format = table.channels == 1 ? gl::PixelFormat::R32f : gl::PixelFormat::Rgba32f;
    settings.width = table.width;
    settings.height = std::max(table.height, 1);
    settings.depth = std::max(table.depth, 1);
    gl::Texture texture(context, table.sampler, settings);
    texture.upload(0, table.channels, gl::SampleType::F32, table.values.data());
    texture.setSampling(table.linear ? gl::Filter::Linear : gl::Filter::Nearest, gl::Wrap::Clamp);
    return texture;
}

} // namespace

Result<DisplayProgram> DisplayProgram::create(gl::Context& context,
                                              const DisplayTransform& transform) {
    const std::array<std::string, 1> defines{"OPEN_COLOR_IO"};
    std::vector<gl::StageSource> stages;
    ExpandedShader shader;
    for (const auto& [stage, file] :
         {std::pair{gl::Stage::Vertex, "screen.vert"}, {gl::Stage::Fragment, "tonemap.frag"}}) {
        if (auto expanded = expandShader(ShaderSources(), file, defines, shader); !expanded)
            return expanded.error();
        stages.push_back({stage, shader.text});
    }
    // tonemap.frag declares ocioDisplay(); here is what it does.
    stages.back().text += "\n#line 1 1000\n" + transform.shader;

    auto program = gl::Program::create(context, "OpenColorIO", stages);
    if (!program)
        return Error{ErrorKind::Internal,
                     fmt::format("the graphics driver refuses what OpenColorIO makes of the view "
                                 "\"{}\" of the display \"{}\"; choose another one",
                                 transform.view, transform.display),
                     transform.config, program.error().detail};
    DisplayProgram result;
    result.m_program = std::move(*program);
    result.m_program.use();
    for (const DisplayTransform::Table& table : transform.tables) {
        result.m_tables.push_back(makeTable(context, table));
        result.m_program.set(table.sampler, static_cast<int>(result.m_tables.size()));
    }
    return result;
}

void DisplayProgram::bindTables() const {
    unsigned unit = 0;
    for (const gl::Texture& table : m_tables)
        table.bind(++unit);
}

} // namespace patina::render
