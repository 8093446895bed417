// A solution per texel: the scene's meshes as they are, undivided, with texture coordinates of
// their own for it, and one light map that all of them share, so that a texel is as large on every
// surface.
#pragma once

#include "core/base/Id.h"
#include "core/image/Image.h"
#include "core/mesh/Mesh.h"
#include "core/radiosity/RadiosityPicture.h"
#include "core/radiosity/document/LitDocument.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace patina {

// A side of a mesh of the document that light falls on.
struct LightMapSurface {
    Id instance = 0;            // MeshInstance::id
    bool back = false;          // of triangles whose two sides both reflect
    MeshPtr mesh;               // world, metres, with the scene's texture coordinates; no tangents
    std::vector<glm::vec2> uvs; // of each vertex in the light map, from its top-left corner, 0…1
};

struct RadiosityLightMap {
    int side = 0;                  // texels
    ImagePtr radiance;             // side × side, RGB, F32, linear: of all that leaves, W/(m² sr)
    std::vector<std::uint8_t> lit; // of each texel, 1: of a surface; others continue what is near
    std::vector<LightMapSurface> surfaces;
};

inline constexpr int kMaxRadiosityMapSize = 4096;

struct RadiosityMapSettings {
    int size = 1024; // side in texels, 1…kMaxRadiosityMapSize
    // Look::Gathered: gatherRays are those of a whole texel; `samples` is not used.
    radiosity::PictureSettings picture;
};

// A texel has the mean over four points of the surface that it shows; charts keep two texels to one
// another. The same for any number of threads. Errors: Usage for a size out of range, a mesh of too
// many triangles, or more charts than have room; Cancelled.
Result<RadiosityLightMap> radiosityLightMap(const SolvedSurfaces& solved,
                                            const radiosity::Solution& solution,
                                            const RadiosityMapSettings& settings,
                                            const JobContext& job);

// As displays show it: 1 - e^(-kL), or cut off at 1 where `exposure` is nullopt. RGB, U8, sRGB.
[[nodiscard]] ImagePtr shownLightMap(const Image& radiance, std::optional<double> exposure);

// The surfaces with that picture as their emission, and black otherwise: cut-outs keep the texture
// that makes them. `automatic`: automaticExposure() of the same solution, which files keep.
[[nodiscard]] LitDocument litDocument(const Document& document, const RadiosityLightMap& map,
                                      std::optional<double> exposure, double automatic);

} // namespace patina
