// Radiance transfer for engines: the vertices' coefficients as attributes of glTF, the light they
// meet as JSON, and the few lines of GLSL that multiply the two.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"

#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace patina {

// How the coefficients lie in the attributes _PRT_0, _PRT_1 …: four to a vec4, the last filled up
// with zeros; where bounces are coloured those for red first, then green, then blue.
struct TransferLayout {
    int bands = 0;
    bool colored = false;

    [[nodiscard]] int vectors() const { return (bands * bands + 3) / 4; } // of a colour
    [[nodiscard]] int attributes() const { return vectors() * (colored ? 3 : 1); }
    friend bool operator==(const TransferLayout&, const TransferLayout&) = default;
};

// What every program reads: OpenGL promises 16 attributes, of which position, normal, tangent and
// texture coordinates take four.
inline constexpr int kCommonAttributes = 12;

// The first `bands` bands (0: all) of a PrtVertex bake.
[[nodiscard]] TransferLayout transferLayout(const BakeArtifact& artifact, int bands);

// The values of each attribute: T + B, one vec4 per vertex.
[[nodiscard]] std::vector<std::vector<glm::vec4>> transferAttributes(const VertexBake& bake,
                                                                     const TransferLayout& layout);

// The light of the document from far away, its environments as they are mixed and its directional
// lights, as in core/export/ShFile.h (radiance, world axes).
[[nodiscard]] std::string transferLightJson(const Document& document, const TransferLayout& layout,
                                            const JobContext& job);

// A vertex shader's function for this layout, with its attributes and uniforms; GLSL 3.30.
[[nodiscard]] std::string transferShader(const TransferLayout& layout, const std::string& glb,
                                         const std::string& lightFile);

} // namespace patina
