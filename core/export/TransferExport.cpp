#include "core/export/TransferExport.h"

#include "core/base/Check.h"
#include "core/export/ShFile.h"
#include "core/math/SphericalHarmonics.h"
#include "core/mix/LightMix.h"
#include "core/mix/TransferLight.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <span>

namespace patina {
namespace {

bool coloured(const VertexBake& bake) {
    for (std::size_t i = 0; i + 2 < bake.bounced.size(); i += 3)
        if (bake.bounced[i] != bake.bounced[i + 1] || bake.bounced[i] != bake.bounced[i + 2])
            return true;
    return false;
}

} // namespace

TransferLayout transferLayout(const BakeArtifact& artifact, int bands) {
    CHECK(artifact.kind == BakeKind::PrtVertex);
    return {bands == 0 ? artifact.order : std::min(bands, artifact.order),
            std::any_of(artifact.vertices.begin(), artifact.vertices.end(), coloured)};
}

std::vector<std::vector<glm::vec4>> transferAttributes(const VertexBake& bake,
                                                       const TransferLayout& layout) {
    const auto stride = static_cast<std::size_t>(bake.stride);
    const auto count =
        static_cast<std::size_t>(layout.bands) * static_cast<std::size_t>(layout.bands);
    const auto vectors = static_cast<std::size_t>(layout.vectors());
    const std::size_t vertices = bake.values.size() / stride;
    CHECK_LE(count, stride);
    std::vector<std::vector<glm::vec4>> attributes(
        static_cast<std::size_t>(layout.attributes()),
        std::vector<glm::vec4>(vertices, glm::vec4(0.0f)));
    for (std::size_t a = 0; a < attributes.size(); ++a) {
        const std::size_t color = a / vectors;
        for (std::size_t i = a % vectors * 4; i < std::min(count, a % vectors * 4 + 4); ++i)
            for (std::size_t v = 0; v < vertices; ++v) {
                const std::size_t from = v * stride + i;
                attributes[a][v][static_cast<glm::length_t>(i % 4)] =
                    bake.values[from] +
                    (bake.bounced.empty() ? 0.0f : bake.bounced[3 * from + color]);
            }
    }
    return attributes;
}

std::string transferLightJson(const Document& document, const TransferLayout& layout,
                              const JobContext& job) {
    std::map<ImagePtr, std::vector<glm::vec3>> known;
    for (const EnvironmentPart& part : environmentParts(document))
        known[part.image] = projectLatLong(*part.image, layout.bands, job);
    const std::vector<glm::vec3> light = transferLight(
        document, layout.bands, [&](const EnvironmentPart& part) -> std::span<const glm::vec3> {
            const auto found = known.find(part.image);
            if (found == known.end())
                return {};
            return found->second;
        });
    return shJson(light, ShQuantity::Radiance);
}

std::string transferShader(const TransferLayout& layout, const std::string& glb,
                           const std::string& lightFile) {
    const int vectors = layout.vectors(), count = layout.bands * layout.bands;
    std::string text = fmt::format(
        R"(// Radiance transfer of {0}: shadows{1} of any environment, per vertex.
//
// _PRT_n are the vertex attributes of that name in the file: {2} transfer coefficients of {3} bands,
// four to a vec4{4}.
// prtLight: "coefficients" of {5}, or those of your own environment, L_i = integral of
// L(d) Y_i(d) over the sphere, packed the same way: prtLight[k] holds L_4k … L_4k+3 of a colour{6}.
// Y: real spherical harmonics with Condon-Shortley phase, index l(l+1)+m; world axes, +Y up.
// That file holds the directional lights of the scene, too, as soft discs: only their highlights are
// left to be added. Lights near by are not in it.
// To rotate the environment rotate L; to rotate the object, rotate L the other way.
)",
        glb, layout.colored ? " and bounces" : "", count, layout.bands,
        layout.colored ? ": first those for red, then green, then blue" : "", lightFile,
        fmt::format(":\n// {0} vectors of red, {0} of green, {0} of blue", vectors));
    for (int i = 0; i < layout.attributes(); ++i)
        text += fmt::format("in vec4 _PRT_{};\n", i);
    text += fmt::format("uniform vec4 prtLight[{}];\n\n", 3 * vectors);
    text += "// Times the surface's linear base colour: the radiance that leaves a matt surface.\n"
            "// What truncation makes negative is dark.\n"
            "vec3 prtRadiance() {\n    vec3 sum = vec3(0.0);\n";
    for (int k = 0; k < vectors; ++k)
        text += fmt::format("    sum += vec3(dot(_PRT_{}, prtLight[{}]), dot(_PRT_{}, "
                            "prtLight[{}]),\n                dot(_PRT_{}, prtLight[{}]));\n",
                            k, k, layout.colored ? vectors + k : k, vectors + k,
                            layout.colored ? 2 * vectors + k : k, 2 * vectors + k);
    return text + "    return max(sum, vec3(0.0));\n}\n";
}

} // namespace patina
