// The DFG tables of the split sum (core/light/DfgTable.h) as textures.
#pragma once

#include "core/material/ShadingModel.h"
#include "render/gl/Texture.h"

#include <map>
#include <utility>

namespace patina::render {

class DfgTextures {
  public:
    explicit DfgTextures(gl::Context& context)
        : m_context(context) {}

    // Terms of the specular lobe that the table is for: 25 ms (GGX) to 130 ms of processor time
    // when they are new, nothing when they have been in use before.
    const gl::Texture& of(const ShadingModel& model);
    [[nodiscard]] std::size_t memoryBytes() const;

  private:
    gl::Context& m_context;
    // By D and V, 128 KiB each: switching models to and fro, as one does to compare, is free.
    std::map<std::pair<Distribution, Visibility>, gl::Texture> m_tables;
};

} // namespace patina::render
