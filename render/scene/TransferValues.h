// What bakes of radiance transfer say of each mesh instance, or of each material by texels, on the
// GPU; and the light that it lets arrive, as RelightPass keeps it up to date.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"
#include "render/gl/Buffer.h"
#include "render/gl/Texture.h"
#include "render/scene/LightId.h"

#include <array>
#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace patina::render {

// Elements (vertices, or texels in rows from the top) and their coefficients.
struct Transfer {
    gl::Buffer direct;  // `vectors` vec4 each: the coefficients, zeros at the end
    gl::Buffer bounced; // 3 · vectors each: red, green, blue; empty: none
    // Per element: (-T_11, -T_1-1, T_10), along the bent normal, and the ambient visibility.
    gl::Buffer cone;
    gl::Buffer numbers; // per element: bake error, sky visibility; empty: the bake holds neither
    gl::Texture coneTexels, numberTexels; // of texel bakes, instead of the buffers
    std::size_t count = 0;
    int side = 0; // of a texel bake, else 0
    int stride = 0;
    std::uint64_t revision = 0; // never the same for two uploads
    [[nodiscard]] int vectors() const { return (stride + 3) / 4; }
    [[nodiscard]] int order() const; // bands
};

// Radiance that a surface of albedo 1 sends out in the present light: RelightPass's own.
struct ExitRadiance {
    gl::Buffer values;  // vec4 for each element
    gl::Texture texels; // the same, of texel bakes
    // What they were made of; what follows `bounced` only where it differs from place to place.
    struct Sources {
        std::uint64_t transfer = 0, light = 0, bounced = 0, nearLights = 0, places = 0,
                      shares = 0; // revisions
        glm::mat4 transform{0.0f};
        friend bool operator==(const Sources&, const Sources&) = default;
    } sources;
    // The share of lights near by, and what it was made of; empty where there are none.
    gl::Buffer nearValues;
    Sources nearSources;
    std::uint64_t nearRevision = 0;
};

// How much of each local light arrives at the elements, on the GPU.
struct NearShareBuffers {
    std::vector<NearShares> sources; // what was uploaded, by light of NearShadows::request
    std::size_t elements = 0;
    // For each light after another a float for each element, negative: none. `perBuffer` lights in
    // each buffer: no driver takes them all of a large mesh in one.
    std::size_t perBuffer = 1;
    std::vector<gl::Buffer> buffers;
    [[nodiscard]] bool empty() const { return sources.empty(); }
};

// In the light of one environment.
struct LitByLight {
    // One for each of Unshadowed, Shadowed and Prt, so that two can be seen side by side.
    std::array<ExitRadiance, 3> stages;
    // What came by way of other surfaces in this light, from a solver that is faster than the
    // coefficients: vec4 for each element, replaces Transfer::bounced. Empty: none.
    gl::Buffer bouncedLight;
    std::uint64_t bouncedRevision = 0;
};

struct LitElements {
    std::map<LightId, LitByLight> byLight; // made when it is first shown in it
    NearShareBuffers nearShares;
    std::uint64_t nearSharesRevision = 0;

    // Unshadowed 0, Shadowed 1, Prt 2.
    [[nodiscard]] static std::size_t stageIndex(LightingMode mode);
    [[nodiscard]] ExitRadiance& stage(LightId light, LightingMode mode) {
        return byLight[light].stages[stageIndex(mode)];
    }
    // Of a light that it has been shown in.
    [[nodiscard]] const ExitRadiance& stage(LightId light, LightingMode mode) const {
        return byLight.at(light).stages[stageIndex(mode)];
    }
};

// The transfer that the document's bakes hold; a live preview hides an attached bake's values.
class TransferValues {
  public:
    explicit TransferValues(gl::Context& context)
        : m_context(context) {}

    // Takes over the document's bakes, uploading what is new; whether there was any.
    bool update(const Document& document);
    // `values`: stride for each vertex.
    void preview(Id mesh, int stride, std::span<const float> values);
    void clearPreview() { m_previews.clear(); }

    // Null when there is none, or one for another number of vertices.
    [[nodiscard]] const Transfer* ofMesh(Id mesh, std::size_t vertexCount) const;
    [[nodiscard]] const Transfer* ofMaterial(Id material) const; // texels

  private:
    Transfer upload(int stride, std::span<const float> values, std::span<const float> bounced,
                    std::span<const float> sky, std::span<const float> error, int side);

    gl::Context& m_context;
    BakeArtifactPtr m_vertexBake, m_texelBake;
    std::map<Id, Transfer> m_attached, m_previews; // by mesh
    std::map<Id, Transfer> m_attachedTexels;       // by material
    std::uint64_t m_revision = 0;
};

} // namespace patina::render
